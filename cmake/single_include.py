#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One header from many: tsubu.hpp, or another that is named, with all that it includes of tsubu put in its place.

    python3 cmake/single_include.py include tsubu/tsubu.hpp build/single/tsubu.hpp
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'#include <(tsubu/[\w./]+)>')


def lines_of(root, name, seen):
    """The lines of a header, those of the headers that it includes where they are first included."""
    if name in seen:
        return
    seen.add(name)
    for line in (root / name).read_text(encoding="utf-8").splitlines():
        included = INCLUDE.match(line)
        if included:
            yield from lines_of(root, included[1], seen)
        elif line != "#pragma once" and not line.startswith("// SPDX"):
            yield line


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    root, name, target = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
    licence = (root.parent / "LICENSE").read_text(encoding="utf-8").rstrip().splitlines()
    head = ["// SPDX-License-Identifier: MIT", *("// " + line if line else "//" for line in licence), "#pragma once"]
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("\n".join([*head, *lines_of(root, name, set())]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
