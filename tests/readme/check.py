#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Is everything in the README that comes from elsewhere what it is there?

    <!-- tests/readme/first.cpp -->                                     and below it a fence: the file, word for word
    <!-- bench/report.py --markdown bench/results/store.json.gz -->     to <!-- end -->: what the command prints

    python3 tests/readme/check.py             says what differs; exit code 1 if anything does
    python3 tests/readme/check.py --write     writes it anew
"""
import gzip
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
COMMANDS = ("bench/report.py", "tests/compile_cost/compile_cost.py")  # no others are run
FENCE = re.compile(r"<!-- (\S+) -->\n```(\w+)\n(.*?)```\n", re.S)
PRINTED = re.compile(r"<!-- (\S+\.py .*?) -->\n(.*?)<!-- end -->\n", re.S)
SPDX = re.compile(r"^(//|#) SPDX-License-Identifier: MIT\n")


def of_file(name):
    return SPDX.sub("", (ROOT / name).read_text(encoding="utf-8"))


def of_command(command):
    program, *arguments = shlex.split(command)
    if program not in COMMANDS:
        raise ValueError(f"{program} is none of {', '.join(COMMANDS)}")
    done = subprocess.run([sys.executable, program, *arguments], cwd=ROOT, capture_output=True, encoding="utf-8",
                          env={**os.environ, "PYTHONIOENCODING": "utf-8"}, check=False)
    if done.returncode != 0:
        raise ValueError(done.stderr.strip())
    return f"\n{done.stdout.strip()}\n\n"  # Markdown wants empty lines around tables


def faults_outside(text, shown):
    """Code that comes from nowhere, programs that are not shown, links and pictures that lead nowhere."""
    for fence in re.finditer(r"^```\w+$", text, re.M):
        if not re.search(r"<!-- \S+ -->\n$", text[:fence.start()]):
            yield f"line {text.count(chr(10), 0, fence.start()) + 1}: no line <!-- FILE --> directly above the code"
    if len(re.findall(r"^<!-- \S+\.py .*-->$", text, re.M)) != len(re.findall(r"^<!-- end -->$", text, re.M)):
        yield "not every <!-- COMMAND --> has its <!-- end -->"
    prose = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    heads = re.findall(r"^#+ (.*)$", prose, re.M)
    anchors = {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}
    for target in re.findall(r"\]\(([^)\s]+)\)", prose):
        if target.startswith("#"):
            if target[1:] not in anchors:
                yield f"no heading for the link {target}"
        elif "://" not in target and not (ROOT / target).exists():
            yield f"there is no {target}"
    for program in sorted((ROOT / "tests/readme").glob("*.cpp")):
        name = str(program.relative_to(ROOT))
        if name not in shown:
            yield f"{name} is not shown in the README"


def dirty_runs():
    """Stored runs that no commit can repeat."""
    for path in sorted((ROOT / "bench/results").glob("*.json.gz")):
        with gzip.open(path, "rt", encoding="utf-8") as file:
            commit = json.load(file)["context"]["commit"]
        if commit.endswith("-dirty"):
            yield f"{path.relative_to(ROOT)} was measured with changes that no commit holds: {commit}"


def main():
    write = sys.argv[1:] == ["--write"]
    if sys.argv[1:] and not write:
        sys.exit(__doc__)
    text = README.read_text(encoding="utf-8")
    faults, shown, checked = [], [], 0

    def renewed(place, source, make, old, form):
        nonlocal checked
        checked += 1
        try:
            new = make(source)
        except (OSError, ValueError) as fault:
            faults.append(f"{source}: {fault}")
            return place
        if new != old and not write:
            faults.append(f"{source}: the README differs; python3 tests/readme/check.py --write")
        return form(new)

    def renew_fence(match):
        shown.append(match[1])
        return renewed(match[0], match[1], of_file, match[3],
                       lambda new: f"<!-- {match[1]} -->\n```{match[2]}\n{new}```\n")

    def renew_printed(match):
        if "<!-- " in match[2]:
            faults.append(f"{match[1]}: no <!-- end --> below it")
            return match[0]
        return renewed(match[0], match[1], of_command, match[2],
                       lambda new: f"<!-- {match[1]} -->\n{new}<!-- end -->\n")

    new_text = PRINTED.sub(renew_printed, FENCE.sub(renew_fence, text))
    faults += faults_outside(text, shown)
    faults += dirty_runs()
    if write and new_text != text:
        README.write_text(new_text, encoding="utf-8")
    for fault in faults:
        print(f"README.md: {fault}", file=sys.stderr)
    print(f"{checked} pieces of the README compared with where they come from")
    return 1 if faults or checked == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
