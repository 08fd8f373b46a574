#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Which lines and branches of include/ have the tests run? tests/run --coverage calls this after the tests.

A line or branch of a template counts once, as run if any of its instantiations has run it: llvm-cov's own summary takes
the best instantiation instead. Nothing is left out. What is evaluated by the compiler alone is in no program, and not
counted; nor is a template that nothing instantiates, but tests/static instantiates all members of the front templates.
"""
import argparse
import bisect
import collections
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADERS = ROOT / "include/tsubu"


def programs_in(build):
    """What has counters in it: all programs, and the instantiations that are compiled only."""
    found = [path for path in build.rglob("*") if path.is_file() and (
        path.suffix == ".o" and "static_tests" in str(path) or
        os.access(path, os.X_OK) and path.suffix == "" and path.read_bytes()[:4] == b"\x7fELF")]
    return sorted(path for path in found if "CompilerIdC" not in str(path))


def lines_from(text):
    """lcov -> file -> line -> how often it has run."""
    lines = collections.defaultdict(dict)
    now = None
    for row in text.splitlines():
        if row.startswith("SF:"):
            now = lines[row[3:]]
        elif row.startswith("DA:"):
            number, count = map(int, row[3:].split(",")[:2])
            now[number] = max(now.get(number, 0), count)
    return lines


def branches_from(text):
    """JSON -> file -> place in the source -> how often each way was taken, without those that the compiler decided."""
    branches = {}
    for file in json.loads(text)["data"][0]["files"]:
        here = collections.defaultdict(lambda: [0, 0])
        for branch in file["branches"]:
            both = here[tuple(branch[:4])]
            both[0] += branch[4]
            both[1] += branch[5]
        # Of a constant condition, as `if constexpr` has, neither way is counted, although it is reached.
        begins = [tuple(segment[:2]) for segment in file["segments"]]
        counts = [segment[2] if segment[3] else 0 for segment in file["segments"]]
        branches[file["filename"]] = {
            place: both for place, both in here.items()
            if any(both) or counts[bisect.bisect_right(begins, place[:2]) - 1] == 0}
    return branches


def runs_of(numbers):
    """[3, 4, 5, 9] -> 3-5, 9"""
    runs = []
    for n in numbers:
        if runs and n == runs[-1][1] + 1:
            runs[-1][1] = n
        else:
            runs.append([n, n])
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in runs)


class Tally:
    def __init__(self):
        self.lines = self.lines_run = self.branches = self.branches_run = 0

    def add(self, lines, branches):
        self.lines += len(lines)
        self.lines_run += sum(1 for count in lines.values() if count)
        self.branches += 2 * len(branches)
        self.branches_run += sum((taken > 0) + (passed > 0) for taken, passed in branches.values())

    @staticmethod
    def share(part, whole):
        return 100 * part / whole if whole else 100.0

    def as_dict(self):
        return {"lines": self.lines, "lines_run": self.lines_run,
                "lines_percent": round(self.share(self.lines_run, self.lines), 2),
                "branches": self.branches, "branches_run": self.branches_run,
                "branches_percent": round(self.share(self.branches_run, self.branches), 2)}

    def row(self, name):
        return (f"{name:10}{self.lines:8}{self.lines_run:8}{self.share(self.lines_run, self.lines):9.2f} %"
                f"{self.branches:10}{self.branches_run:8}{self.share(self.branches_run, self.branches):9.2f} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="where the programs are, and profiles/")
    parser.add_argument("--llvm-suffix", default="", help="-19 for llvm-cov-19")
    parser.add_argument("--least", type=float, default=95, help="of the lines, in per cent")
    given = parser.parse_args()
    build = given.build.resolve()

    def llvm(tool, *arguments):
        done = subprocess.run([f"llvm-{tool}{given.llvm_suffix}", *map(str, arguments)], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"llvm-{tool}: {done.stderr.strip()}")
        return done.stdout

    profiles = sorted((build / "profiles").glob("*.profraw"))
    if not profiles:
        sys.exit(f"no counters in {build / 'profiles'}: have the tests run?")
    merged = build / "merged.profdata"
    llvm("profdata", "merge", "-sparse", *profiles, "-o", merged)
    first, *others = programs_in(build)
    asked = [first, *(f"-object={one}" for one in others), f"-instr-profile={merged}",
             f"-ignore-filename-regex=^{re.escape(str(ROOT))}/(tests|bench)/|^/usr/(include|lib)/"]
    lines = lines_from(llvm("cov", "export", *asked, "-format=lcov"))
    branches = branches_from(llvm("cov", "export", *asked, "-skip-functions"))
    llvm("cov", "show", *asked, "-format=html", f"-output-dir={build / 'html'}", "-project-title=tsubu")

    by_room = {room.name: Tally() for room in sorted(HEADERS.iterdir()) if room.is_dir()}
    total = Tally()
    files = {}
    for path in sorted(HEADERS.rglob("*.hpp")):
        name = path.relative_to(HEADERS)
        room = name.parts[0]
        if room not in by_room:
            continue  # the umbrellas include, and do nothing else
        here = lines.get(str(path), {})
        ways = branches.get(str(path), {})
        for one in (by_room[room], total):
            one.add(here, ways)
        of_file = Tally()
        of_file.add(here, ways)
        files[str(name)] = of_file.as_dict() | {"lines_not_run": sorted(n for n, count in here.items() if not count)}

    if total.lines == 0:
        sys.exit(f"no line of {HEADERS} has a counter: were the tests built in another checkout?")
    print(f"{'room':10}{'lines':>8}{'run':>8}{'':11}{'branches':>10}{'taken':>8}", flush=True)
    for room, counted in by_room.items():
        print(counted.row(room))
    print(total.row("all"))
    print("Not run:")
    for name, one in files.items():
        if one["lines_not_run"]:
            print(f"  {name}: {runs_of(one['lines_not_run'])}")
    of_rooms = {room: counted.as_dict() for room, counted in by_room.items()}
    result = {"all": total.as_dict(), "rooms": of_rooms, "files": files}
    (build / "coverage.json").write_text(json.dumps(result, indent=1) + "\n")
    print(f"Line by line: {build / 'html/index.html'}; as numbers: {build / 'coverage.json'}")
    share = Tally.share(total.lines_run, total.lines)
    if share < given.least:
        print(f"{share:.2f} % of the lines are run, fewer than {given.least} %")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
