#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does every header keep to its room? Checks include/tsubu and prints each breach with file and remedy.

layers.py ROOT                 checks ROOT/include/tsubu
layers.py ROOT --listed FILE   also compares the headers with the list in FILE (one path a line)
layers.py ROOT --self-test     plants each kind of breach in a copy, and fails unless it is found

Exit code: 0 clean, 1 breaches, 2 usage.
"""
import re
import shutil
import sys
import tempfile
from pathlib import Path

ROOMS = ["core", "id", "domain", "store", "io", "comm", "neighbor", "dem", "testing"]
# Umbrella -> umbrellas that it may include.
UMBRELLAS = {"tsubu.hpp": set(), "mpi.hpp": {"tsubu.hpp"}, "hdf5.hpp": {"tsubu.hpp"}}
# A library that a target of its own stands for -> its header, the one that includes it, and their umbrella.
LIBRARIES = {"MPI": ("mpi.h", "comm/detail/include_mpi.hpp", "mpi.hpp"),
             "HDF5": ("hdf5.h", "io/detail/hdf5_library.hpp", "hdf5.hpp")}
BANNED_INCLUDES = {"iostream", "ranges", "functional", "random", "regex", "memory_resource", "format", "sstream"}
BANNED_NAMES = re.compile(r"util|helper|common|misc|manager|data(?!_file)|info|process|handle|\bdo_")
MAX_BYTES = 25000
MAX_MACROS = 8
# What the comment of a policy says beside its concept; the source only where there is one.
CARD_PARTS = ("Cost", "Deterministic", "Choose it", "Do not")
# Switches of <mpi.h>, which the header that includes it sets.
MPI_SWITCHES = {"OMPI_SKIP_MPICXX", "MPICH_SKIP_MPICXX"}


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def room_of(header):
    return header.split("/")[0] if "/" in header else ""


def rank_of(header):
    """Left rooms have low ranks; a header at the top (umbrella, version) is handled by its own rules."""
    return ROOMS.index(room_of(header))


def cycles(graph):
    """One path for each back edge that a depth-first walk meets."""
    found, state, path = [], {}, []

    def walk(header):
        state[header] = "open"
        path.append(header)
        for to in graph[header]:
            if state.get(to) == "open":
                found.append(path[path.index(to):] + [to])
            elif to in graph and to not in state:
                walk(to)
        path.pop()
        state[header] = "done"

    for header in sorted(graph):
        if header not in state:
            walk(header)
    return found


def reach(graph, start):
    seen, left = set(), [start]
    while left:
        header = left.pop()
        if header not in seen:
            seen.add(header)
            left += graph.get(header, [])
    return seen


def include_breaches(text, graph):
    """Each header includes its own room and those to its left."""
    bad = []
    for header, includes in graph.items():
        room = room_of(header)
        if room and room not in ROOMS:
            bad.append(f"{header}: there is no room '{room}'; the rooms are {' < '.join(ROOMS)}")
            continue
        if not room and header not in UMBRELLAS and header != "version.hpp":
            bad.append(f"{header}: only version.hpp and the umbrellas lie outside the rooms")
        for to in includes:
            if to not in text:
                bad.append(f"{header}: includes <tsubu/{to}>, which does not exist")
            elif to in UMBRELLAS:
                if to not in UMBRELLAS.get(header, set()):
                    bad.append(f"{header}: includes the umbrella {to}; include what is used instead")
            elif room and room_of(to) in ROOMS:
                if rank_of(to) > rank_of(header):
                    bad.append(f"{header}: includes {to} of a room further right; move one of them")
                if "/detail/" in to and room_of(to) != room:
                    bad.append(f"{header}: includes {to}; detail is for its own room only")
            elif header in UMBRELLAS and "/detail/" in to:
                bad.append(f"{header}: an umbrella has no use for {to}")
    return bad + ["cycle: " + " -> ".join(cycle) for cycle in cycles(graph)]


def library_breaches(code):
    """Includes of what is not ours."""
    bad = []
    for header, content in code.items():
        for name in re.findall(r"#\s*include\s*<([^>]+)>", content):
            if name in BANNED_INCLUDES:
                bad.append(f"{header}: <{name}> is not for public headers: it costs every user's compile time")
            for theirs, ours, _ in LIBRARIES.values():
                if name == theirs and header != ours:
                    bad.append(f"{header}: <{theirs}> is included by {ours} only; include that")
        if re.search(r'#\s*include\s*"', content):
            bad.append(f'{header}: #include "..."; write #include <tsubu/...>')
    return bad


def macro_breaches(code):
    macros = {}
    for header, content in code.items():
        for macro in re.findall(r"#\s*define\s+(\w+)", content):
            if header != LIBRARIES["MPI"][1] or macro not in MPI_SWITCHES:
                macros.setdefault(macro, header)
    bad = [f"{h}: macro {m} without TSUBU_" for m, h in macros.items() if not m.startswith("TSUBU_")]
    if len(macros) > MAX_MACROS:
        bad.append(f"{len(macros)} macros ({', '.join(sorted(macros))}); {MAX_MACROS} is the most")
    return bad


def form_breaches(header, text, content):
    """Of one header, with and without its comments."""
    size = len(text.encode())
    if size > MAX_BYTES:
        yield f"{header}: {size} bytes, {MAX_BYTES} is the most; split it into its ideas"
    if not text.startswith("// SPDX-License-Identifier: MIT\n/// @file\n"):
        yield f"{header}: does not begin with the SPDX line and '/// @file'"
    if header != "version.hpp" and "#pragma once" not in content:
        yield f"{header}: no #pragma once"
    if BANNED_NAMES.search(header.split("/")[-1]):
        yield f"{header}: the name says nothing; name the idea"
    for comment in re.findall(r"(?:^[ \t]*///.*\n)+", text, re.M):
        card = " ".join(line.strip().removeprefix("///").strip() for line in comment.splitlines())
        lacking = [part for part in CARD_PARTS if "Concept:" in card and part.lower() not in card.lower()]
        if lacking:
            yield f"{header}: the card \"{card[:60]} ...\" lacks {', '.join(lacking)}"


def reach_breaches(text, graph):
    """What the umbrellas bring, and what they do not."""
    bad = []
    for library, (_, ours, home) in LIBRARIES.items():
        for umbrella in sorted(set(UMBRELLAS) - {home}):
            if ours in reach(graph, umbrella):
                bad.append(f"{umbrella}: reaches {ours}; what needs {library} belongs into {home}")
    public = {h for h in text if room_of(h) in ROOMS and room_of(h) != "testing" and "/detail/" not in h}
    for header in sorted(public - set().union(*(reach(graph, umbrella) for umbrella in UMBRELLAS))):
        bad.append(f"{header}: is in no umbrella")
    return bad


def breaches(root):
    base = root / "include" / "tsubu"
    text = {str(p.relative_to(base)): p.read_text(encoding="utf-8") for p in sorted(base.rglob("*.hpp"))}
    code = {h: without_comments(t) for h, t in text.items()}
    graph = {h: re.findall(r"#\s*include\s*<tsubu/([^>]+)>", c) for h, c in code.items()}
    if not text:
        return [f"{base}: no headers there"]
    return (include_breaches(text, graph) + library_breaches(code) + macro_breaches(code) +
            [breach for h in text for breach in form_breaches(h, text[h], code[h])] + reach_breaches(text, graph))


def list_breaches(root, listed):
    base = root / "include" / "tsubu"
    there = {str(p.relative_to(base)) for p in base.rglob("*.hpp")}
    return ([f"{h}: not in the lists of CMakeLists.txt, so it would not be installed" for h in sorted(there - listed)]
            + [f"{h}: in the lists of CMakeLists.txt, but not there" for h in sorted(listed - there)])


def self_test(root):
    head = "// SPDX-License-Identifier: MIT\n/// @file\n/// Planted.\n#pragma once\n"
    # name -> (files to write or to append to, words that must be reported)
    plants = {
        "up-include": ({"core/planted.hpp": head + "#include <tsubu/id/concepts.hpp>\n"}, "further right"),
        "cycle": ({"core/planted_a.hpp": head + "#include <tsubu/core/planted_b.hpp>\n",
                   "core/planted_b.hpp": head + "#include <tsubu/core/planted_a.hpp>\n"}, "cycle: "),
        "umbrella": ({"id/planted.hpp": head + "#include <tsubu/tsubu.hpp>\n"}, "includes the umbrella"),
        "foreign detail": ({"id/planted.hpp": head + "#include <tsubu/core/detail/planted.hpp>\n",
                            "core/detail/planted.hpp": head}, "own room only"),
        "mpi.h": ({"comm/planted.hpp": head + "#include <mpi.h>\n"}, "include_mpi.hpp only"),
        "MPI in the core": ({"tsubu.hpp": "#include <tsubu/comm/detail/include_mpi.hpp>\n"}, "what needs MPI"),
        "hdf5.h": ({"io/planted.hpp": head + "#include <hdf5.h>\n"}, "hdf5_library.hpp only"),
        "HDF5 in mpi.hpp": ({"mpi.hpp": "#include <tsubu/io/h5md_writer.hpp>\n"}, "what needs HDF5"),
        "banned include": ({"core/planted.hpp": head + "#include <iostream>\n"}, "<iostream> is not for"),
        "quoted include": ({"core/planted.hpp": head + '#include "types.hpp"\n'}, '#include "..."'),
        "size": ({"core/planted.hpp": head + "// filler\n" * 3000}, "is the most; split"),
        "macros": ({"core/planted.hpp": head + "".join(f"#define TSUBU_P{k}\n" for k in range(9))}, "macros ("),
        "foreign macro": ({"core/planted.hpp": head + "#define EXPECTS 1\n"}, "without TSUBU_"),
        "room": ({"attic/planted.hpp": head}, "there is no room"),
        "missing": ({"core/planted.hpp": head + "#include <tsubu/core/nowhere.hpp>\n"}, "does not exist"),
        "name": ({"core/string_utils.hpp": head}, "says nothing"),
        "guard": ({"core/planted.hpp": head.replace("#pragma once\n", "")}, "no #pragma once"),
        "licence": ({"core/planted.hpp": "#pragma once\n"}, "SPDX"),
        "card": ({"core/planted.hpp": head + "/// A policy.\n///\n/// Concept: planted. Cost: O(1). Deterministic: yes. "
                  "Choose it always.\n"}, "lacks Do not"),
        "umbrella gap": ({"core/planted.hpp": head}, "in no umbrella"),
    }
    missed = 0
    before = set(breaches(root))
    for name, (files, words) in plants.items():
        with tempfile.TemporaryDirectory() as copy:
            shutil.copytree(root / "include", Path(copy) / "include")
            for path, content in files.items():
                target = Path(copy) / "include" / "tsubu" / path
                target.parent.mkdir(parents=True, exist_ok=True)
                with target.open("a", encoding="utf-8") as out:
                    out.write(content)
            found = any(words in b for b in set(breaches(Path(copy))) - before)
        print(f"{'found ' if found else 'MISSED'}  {name}")
        missed += not found
    return missed


def main(arguments):
    if not arguments or len(arguments) > 3:
        print(__doc__, file=sys.stderr)
        return 2
    root = Path(arguments[0])
    if arguments[1:] == ["--self-test"]:
        return 1 if self_test(root) else 0
    found = breaches(root)
    if len(arguments) == 3 and arguments[1] == "--listed":
        base = root.resolve() / "include" / "tsubu"
        lines = Path(arguments[2]).read_text(encoding="utf-8").splitlines()
        found += list_breaches(root, {str(Path(line).resolve().relative_to(base)) for line in lines if line})
    elif len(arguments) > 1:
        print(__doc__, file=sys.stderr)
        return 2
    for breach in found:
        print(breach)
    print(f"{len(found)} breaches")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
