#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the reference with Doxygen, and refuses what would be missing or broken in it.

reference.py INCLUDE FOLDER DOXYGEN     FOLDER holds the Doxyfile; the pages come to FOLDER/html

Doxygen gets copies of the headers, in which rooms, cards and tables are marked up: in the headers they are laid out for
people who read those. Lines keep their numbers. Exit code 1 if Doxygen warns, or if a sentence is missing: each type,
concept, function and variable outside of a class has one, and so has each word that is a member of a class: there or,
since one word is one idea, at another class, its own or a concept. Constructors, operators, the words of the standard's
containers and questions that a name asks, is_periodic, need none.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

# What a card has at the beginning of a line; "Choose it when" and "Do not when" go on in the same sentence.
CARD = re.compile(r"(\s*/// )(?:(Bytes per id|Bytes|Collective|Complexity|Concept|Cost|Deterministic|Growth|"
                  r"Invalidates|Invariant|Memory|Order|Precondition|Reference|Source|Threads|Writes):|"
                  r"(Choose it|Do not)(?= ))\s+(?=\S)")
KNOWN_WORDS = {"begin", "end", "cbegin", "cend", "size", "empty", "data", "swap", "clear", "capacity", "reserve",
               "resize", "push_back", "pop_back", "front", "back", "at", "get_allocator", "allocate", "deallocate",
               "min", "max", "get", "count", "insert", "emplace", "first", "second", "value", "span", "view", "path"}


def is_table(lines):
    """Columns of two spaces or more, in most lines of a paragraph that is not code already."""
    if len(lines) < 2 or re.match(r"\s*/// {4}", lines[0]) or any(re.match(r"\s*///\s+(@|\|)", line) for line in lines):
        return False
    return 2 * sum(bool(re.search(r"/// .*\S {2,}\S", line)) for line in lines) > len(lines)


def marked_up(text, room):
    """A header for Doxygen: line by line the same, but its room, cards and tables said in Doxygen's words."""
    done, paragraph = [], []
    # What is specialised of std is no entry of ours.
    text = re.sub(r"^template <[^\n]*>\n(inline constexpr bool std::)", r"//\n// \1", text, flags=re.M)

    def finish():
        if any(CARD.match(line) for line in paragraph):
            done.extend(CARD.sub(lambda m: f"{m[1]}@card{{{m[2] or m[3]}}} ", line) for line in paragraph)
        elif is_table(paragraph):
            done.extend(line.replace("/// ", "///     ", 1) for line in paragraph)  # as code
        else:
            done.extend(paragraph)
        paragraph.clear()

    for line in text.split("\n"):
        code, mark, said = line.partition("///")
        if mark and not said.startswith("    "):  # <word> is a place to be filled in, not HTML; examples keep it
            line = code + mark + re.sub(r"<([a-z][a-z ]*)>", r"&lt;\1&gt;", said)
        if re.match(r"\s*/// *\S", line):
            paragraph.append(line)
        else:
            finish()
            line = re.sub(r"^(namespace tsubu[\w:]* \{)$", rf"\1 /** @addtogroup room_{room} */ /** @{{ */", line)
            done.append(re.sub(r"^(\}  // namespace tsubu)", r"/** @} */ \1", line))
    finish()
    return "\n".join(done)


def warnings(folder, doxygen):
    ran = subprocess.run([doxygen, str(folder / "Doxyfile")], capture_output=True, text=True)
    said = (folder / "warnings.txt").read_text() if (folder / "warnings.txt").exists() else ""
    if ran.returncode != 0:
        said += ran.stdout + ran.stderr
    said = said.replace(f"{folder}/headers/", "include/")
    return list(dict.fromkeys(said.splitlines()))  # Doxygen says some twice: for the pages, and for the XML


def words_of(element):
    return set(re.findall(r"\w+", "".join(element.itertext()))) if element is not None else set()


def initial_value(member):
    initializer = member.find("initializer")
    return "" if initializer is None else "".join(initializer.itertext())


def missing_sentences(folder):
    def sentence(element):
        return words_of(element.find("briefdescription")) | words_of(element.find("detaileddescription"))

    explained = set(KNOWN_WORDS)  # words of members
    said = set()                  # (scope, word); (class, None) for the class itself
    suspects = []
    for path in sorted((folder / "xml").glob("*.xml")):
        for compound in xml.parse(path).getroot().iter("compounddef"):
            kind, name, own = compound.get("kind"), compound.findtext("compoundname"), sentence(compound)
            if kind not in ("class", "struct", "union", "concept", "namespace") or compound.get("prot") == "private":
                continue
            plain = re.sub(r"<.*", "", name)  # of a specialization the template
            if kind != "namespace":
                suspects.append((plain, None, True, f"{kind} {name}", compound.find("location")))
                if own:
                    said.add((plain, None))
            if kind == "concept":
                explained |= own | words_of(compound.find("initializer"))
            for member in compound.iter("memberdef"):
                word, what = re.sub(r"<.*", "", member.findtext("name")).strip(), member.get("kind")
                if sentence(member):
                    explained.add(word)
                    said.add((plain, word))
                elif what not in ("function", "variable") or member.get("prot") != "public":
                    continue
                elif re.match(r"(is|are|has|needs|keeps)_", word) or '"' in initial_value(member):
                    continue  # a question that the name asks; a law of a suite, whose value is the sentence
                elif word == plain.split("::")[-1] or re.match(r"operator\b|~", word) or not member.findtext("type"):
                    continue  # constructors and guides to them, destructors, operators
                elif kind == "namespace" or word not in own:
                    suspects.append((plain, word, kind == "namespace", f"{what} {name}::{word}",
                                     member.find("location")))
    for scope, word, is_outside, name, at in suspects:
        if (scope, word) not in said and (is_outside or word not in explained):
            yield f"include/{at.get('file')}:{at.get('line')}: {name} has no sentence"


def main(arguments):
    if len(arguments) != 3:
        sys.exit(__doc__)
    include, folder, doxygen = pathlib.Path(arguments[0]).resolve(), pathlib.Path(arguments[1]).resolve(), arguments[2]
    for old in ("headers", "html", "xml"):
        shutil.rmtree(folder / old, ignore_errors=True)
    for header in sorted(include.rglob("*.hpp")):
        name = header.relative_to(include)
        if "detail" not in name.parts:
            copy = folder / "headers" / name
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_text(marked_up(header.read_text(encoding="utf-8"), name.parts[1]), encoding="utf-8")
    bad = warnings(folder, doxygen) + sorted(set(missing_sentences(folder)))
    for line in bad:
        print(line)
    pages = len(list((folder / "html").glob("*.html")))
    print(f"{len(bad)} complaints; {pages} pages, from {folder / 'html/index.html'} on")
    return 1 if bad or not pages else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
