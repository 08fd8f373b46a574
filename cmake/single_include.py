#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One header from many: an umbrella with all that it includes of tsubu put in its place, and its comments kept.

single_include.py INCLUDE UMBRELLA OUTPUT
single_include.py include tsubu/tsubu.hpp build/single_include/tsubu/tsubu.hpp

Each header begins with a line that names it, so that the place of an error is found; #line is not used, for it would
name files that whoever has the single one does not have.
"""
import pathlib
import re
import sys

WIDTH = 120
OURS = re.compile(r"\s*#\s*include\s*<(tsubu/[\w./]+)>")
THEIRS = re.compile(r"\s*#\s*include\s*<([\w./]+)>")
FILE_COMMENT = re.compile(r"// SPDX[^\n]*\n/// @file\n((?:///[^\n]*\n)*)")


class SingleInclude:
    def __init__(self, root):
        self.root = root
        self.standard = set()  # headers of others, needed whatever is defined
        self.placed = {}       # header of ours -> whether it is there under a condition only

    def text_of(self, name):
        return (self.root / name).read_text(encoding="utf-8")

    def lines_with_depth(self, text):
        """Each line, and in how many #if it lies."""
        depth = 0
        for line in text.splitlines():
            if re.match(r"\s*#\s*endif\b", line):
                depth -= 1
            yield line, depth
            if re.match(r"\s*#\s*if", line):
                depth += 1

    def place(self, name, condition=False):
        """The lines that stand for an include of `name`."""
        if name in self.placed:
            if self.placed[name] and not condition:
                sys.exit(f"{name}: included under a condition in one place, and without in a later one; which is it?")
            return
        text = self.text_of(name)
        if not condition:
            # What a conditional header includes may be needed without the condition as well: it goes first.
            for line, depth in self.lines_with_depth(text):
                included = OURS.match(line)
                if included and depth > 0:
                    for needed in OURS.finditer(self.text_of(included[1])):
                        yield from self.place(needed[1])
        self.placed[name] = condition
        body = []
        has_defined = False
        for line, depth in self.lines_with_depth(self.without_file_comment(name, text)):
            ours, theirs = OURS.match(line), THEIRS.match(line)
            has_defined = has_defined or re.match(r"\s*#\s*define\b", line) is not None
            if ours:
                if depth == 0:
                    yield from self.place(ours[1], condition)
                else:
                    body += self.place(ours[1], True)
            elif theirs and depth == 0 and not condition and not has_defined:  # a macro is a switch of what follows
                self.standard.add(theirs[1])
            elif line != "#pragma once":
                body.append(line)
        yield from self.banner(name, text)
        yield from body

    @staticmethod
    def without_file_comment(name, text):
        if not FILE_COMMENT.match(text):
            sys.exit(f"{name}: does not begin with the SPDX line and '/// @file'")
        return FILE_COMMENT.sub("", text, count=1)

    @staticmethod
    def banner(name, text):
        yield ""
        yield f"// {name} ".ljust(WIDTH, "-")
        yield from (line.replace("///", "//", 1) for line in FILE_COMMENT.match(text)[1].splitlines())

    def header(self, umbrella):
        number = int(re.search(r"define TSUBU_VERSION (\d+)", self.text_of("tsubu/version.hpp"))[1])
        version = f"{number // 10000}.{number // 100 % 100}.{number % 100}"
        body = list(self.place(umbrella))
        licence = (self.root.parent / "LICENSE").read_text(encoding="utf-8").splitlines()
        yield "// SPDX-License-Identifier: MIT"
        yield f"// tsubu {version}: <{umbrella}> and all that it includes, made by cmake/single_include.py. Either this"
        yield "// file or the headers that it was made of, not both in one program."
        yield "//"
        yield from (f"// {line}".rstrip() for line in licence)
        yield "#pragma once"
        yield ""
        yield from (f"#include <{name}>" for name in sorted(self.standard))
        blank = False
        for line in body:  # where includes were, blank lines are left
            if line or not blank:
                yield line
            blank = not line


def main(arguments):
    if len(arguments) != 3:
        sys.exit(__doc__)
    output = pathlib.Path(arguments[2])
    text = "\n".join(SingleInclude(pathlib.Path(arguments[0]).resolve()).header(arguments[1])) + "\n"
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
