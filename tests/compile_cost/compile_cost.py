#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What including tsubu costs a user's compiler, and whether that has grown: every program pays it, every time.

compile_cost.py ROOT --check    compares with budget.json beside this file; exit code 1 if something grew past it
compile_cost.py ROOT --write    measures anew, and writes budget.json: the way to accept a growth, with its reason in
                                the commit
compile_cost.py ROOT --markdown prints a table of budget.json, for the README
  --cxx NAME    whose preprocessor counts lines; default: g++
  --clang NAME  which clang counts instantiations; default: clang++; where it is not found, they are left out

Counted are, for each public header, the lines that are left after the preprocessor, blank ones aside: those of tsubu
itself and all, with the standard library's; and, for two programs of the README, the templates that are instantiated.
Both are the same at every run. Those of others are compared only if the compiler is the one of budget.json. Time and
memory are written down as well, as the machine had them, and compared with nothing.
"""
import argparse
import collections
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ALLOWED = 0.05          # what small changes add without anybody having to speak of it
ALLOWED_LINES = 20      # likewise, for small headers
PROGRAMS = ["first", "bed"]  # one that includes everything and uses little, and one that uses much
BUDGET = pathlib.Path(__file__).with_name("budget.json")
ACCEPT = "cmake --build <build> --target tsubu_compile_budget"


def identity(compiler):
    words = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    return f"{'clang' if 'clang' in words else 'g++'} {re.search(r'[0-9]+[.][0-9.]+', words)[0].rstrip('.')}"


def public_headers(root):
    base = root / "include"
    names = sorted(p.relative_to(base).as_posix() for p in base.rglob("*.hpp"))
    found = [name for name in names if not re.search(r"/(detail|testing)/|/(mpi|hdf5|h5md)\w*\.hpp$", name)]
    if not found:
        sys.exit(f"{base}: no headers there")
    return found


def lines_by_file(root, compiler, header):
    """File -> lines that are left of it, of one header and all that it includes."""
    done = subprocess.run([compiler, "-std=c++20", "-E", "-x", "c++", f"-I{root / 'include'}", "-"],
                          input=f"#include <{header}>\n", capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{header} does not compile:\n{done.stderr}")
    count = collections.Counter()
    name = ""
    for line in done.stdout.split("\n"):
        if line.startswith("# "):  # a marker, # 12 "file" 1 3: what follows, up to the next, is of that file
            name = line.split('"', 2)[1]
        elif line and not line.isspace():
            count[name] += 1
    return count


def measure_headers(root, compiler):
    own = str(root / "include")
    found = {}
    for header in public_headers(root):
        count = lines_by_file(root, compiler, header)
        found[header] = {"own": sum(n for name, n in count.items() if name.startswith(own)), "all": sum(count.values())}
    return found


def measure_instantiations(root, clang, program):
    with tempfile.TemporaryDirectory() as folder:
        # Not -fsyntax-only: some versions write no trace then.
        subprocess.run([clang, "-std=c++20", "-S", "-emit-llvm", "-o", f"{folder}/program.ll", "-ftime-trace",
                        "-ftime-trace-granularity=0", f"-I{root / 'include'}",
                        str(root / f"tests/readme/{program}.cpp")], cwd=folder, check=True)
        trace, = pathlib.Path(folder).glob("*.json")  # its name differs between versions
        events = json.loads(trace.read_text())["traceEvents"]
    names = [e["args"]["detail"] for e in events if e["name"] in ("InstantiateClass", "InstantiateFunction")]
    return {"own": sum(name.startswith("tsubu::") for name in names), "all": len(names)}


def measure_effort(root, compiler, program):
    """Seconds of the processor and MiB for one program, without optimisation: the best of three."""
    command = [compiler, "-std=c++20", "-O0", "-c", f"-I{root / 'include'}", str(root / f"tests/readme/{program}.cpp"),
               "-o", "/dev/null"]
    # A process of its own for each: the peak of the children that this one has waited for never falls.
    probe = ("import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True); "
             "u = resource.getrusage(resource.RUSAGE_CHILDREN); print(u.ru_utime + u.ru_stime, u.ru_maxrss / 1024)")
    runs = [subprocess.run([sys.executable, "-c", probe, *command], capture_output=True, text=True, check=True).stdout
            for _ in range(3)]
    seconds, mebibytes = zip(*(map(float, run.split()) for run in runs))
    return {"seconds": round(min(seconds), 1), "MiB": round(min(mebibytes))}


def measure(root, cxx, clang):
    found = {"preprocessor": identity(cxx), "lines": measure_headers(root, cxx)}
    if clang:
        found["clang"] = identity(clang)
        found["instantiations"] = {p: measure_instantiations(root, clang, p) for p in PROGRAMS}
    return found


def growths(budget, found):
    """How much more, whose, and a sentence, for each figure that is past the budget or has none."""
    for what, tool in (("lines", "preprocessor"), ("instantiations", "clang")):
        if what not in found:
            continue
        same_tool = found[tool] == budget[tool]
        for name, figures in found[what].items():
            if name not in budget[what]:
                yield 0, name, f"{name}: no budget for it"
                continue
            for kind in ("own", "all") if same_tool else ("own",):
                before, after = budget[what][name][kind], figures[kind]
                if after > max(before * (1 + ALLOWED), before + ALLOWED_LINES):
                    whose = "of tsubu's own" if kind == "own" else "with the standard library's"
                    share = after / max(before, 1) - 1
                    yield share, name, f"{name}: {what} {whose} from {before} to {after} (+{100 * share:.0f} %)"


def check(root, cxx, clang):
    budget = json.loads(BUDGET.read_text())
    found = measure(root, cxx, clang)
    bad = sorted(growths(budget, found), reverse=True)
    for _, _, sentence in bad:
        print(sentence)
    if bad:
        if bad[0][1] in found["lines"]:  # that which has grown most is the nearest to the cause
            greatest = collections.Counter(lines_by_file(root, cxx, bad[0][1])).most_common(8)
            print(f"  most of {bad[0][1]}: " + ", ".join(f"{n} {pathlib.Path(f).name}" for f, n in greatest))
        print(f"Whoever includes these pays that, each time a program is compiled. Leave out an include or a template\n"
              f"that few need; or, if it is worth it, accept it by\n    {ACCEPT}\nand give the reason in the commit.")
        return 1
    said = f"{len(found['lines'])} headers"
    said += f" and {len(found['instantiations'])} programs" if clang else "; no clang here to count instantiations"
    print(f"{said}: nothing has grown by more than {100 * ALLOWED:.0f} %")
    return 0


def write(root, cxx, clang):
    if not clang:
        sys.exit("a budget has instantiations too: install clang, or name one by --clang")
    found = measure(root, cxx, clang)
    found["effort"] = {tool: {p: measure_effort(root, path, p) for p in PROGRAMS}
                       for tool, path in ((found["preprocessor"], cxx), (found["clang"], clang))}
    text = json.dumps(found, indent=2)
    text = re.sub(r"\{\n\s+([^{}]*?)\n\s+\}", lambda m: "{" + re.sub(r"\n\s+", " ", m[1]) + "}", text)
    BUDGET.write_text(text + "\n")
    print(f"{BUDGET}: written")
    return 0


def markdown():
    """What a user pays: of each room what its heaviest header brings, and of two programs the whole."""
    budget = json.loads(BUDGET.read_text())
    heaviest = {}
    for header, figures in budget["lines"].items():
        room = header.split("/")[1]
        if figures["all"] > heaviest.get(room, (0, 0, ""))[0]:
            heaviest[room] = (figures["all"], figures["own"], header)
    print(f"Lines after the preprocessor of {budget['preprocessor']}, without blank ones, of the heaviest header of "
          "each room but testing.\n")
    print("| header | lines | of them tsubu's |")
    print("|---|---|---|")
    for lines, own, header in sorted(heaviest.values()):
        if lines:
            print(f"| `{header}` | {lines} | {own} |")
    print("\nA program of this page, compiled without optimisation; processor time and greatest memory.\n")
    print("| program | compiler | s | MiB | templates instantiated | of them tsubu's |")
    print("|---|---|---|---|---|---|")
    for program in PROGRAMS:
        for compiler, effort in budget["effort"].items():
            counted = budget["instantiations"][program] if compiler == budget["clang"] else {"all": "", "own": ""}
            print(f"| `{program}.cpp` | {compiler} | {effort[program]['seconds']} | {effort[program]['MiB']} | "
                  f"{counted['all']} | {counted['own']} |")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=pathlib.Path)
    task = parser.add_mutually_exclusive_group(required=True)
    task.add_argument("--check", action="store_true")
    task.add_argument("--write", action="store_true")
    task.add_argument("--markdown", action="store_true")
    parser.add_argument("--cxx", default="g++")
    parser.add_argument("--clang", default="clang++")
    asked = parser.parse_args()
    if asked.markdown:
        return markdown()
    return (check if asked.check else write)(asked.root.resolve(), asked.cxx, shutil.which(asked.clang))


if __name__ == "__main__":
    sys.exit(main())
