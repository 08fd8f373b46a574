#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Would the tests see it? Plants the bugs of planted.py one at a time; the test that is named with each must fail.

A bug is one header, changed, in a folder that is searched before include/. Its test file is compiled alone against
both; first without any bug, where the named test cases must pass. tests/run --mutations calls this.
"""
import argparse
import concurrent.futures
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
from planted import BUGS  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Without optimisation: of a test that runs for a second, compiling is the dear part.
FLAGS = ["-std=c++20", "-O0", "-w", "-pthread", "-I", str(ROOT / "include"), "-I", str(ROOT / "tests")]
COMPILE_SECONDS = 600
RUN_SECONDS = 120  # what takes longer than any test case that is named waits for ever


def problem_with(bug):
    """Why the bug cannot be planted, or None."""
    header = ROOT / "include/tsubu" / bug.header
    if not header.is_file():
        return f"there is no include/tsubu/{bug.header}"
    found = header.read_text().count(bug.old)
    if found != 1:
        return f"what is to be replaced stands {found} times in include/tsubu/{bug.header}"
    if bug.old == bug.new:
        return "old and new are the same"
    test = ROOT / "tests" / bug.test
    if not test.is_file():
        return f"there is no tests/{bug.test}"
    if f'"{bug.case}"' not in test.read_text():
        return f"tests/{bug.test} has no test case of this name"
    return None


def plant(bug, folder):
    header = ROOT / "include/tsubu" / bug.header
    changed = folder / "tsubu" / bug.header
    changed.parent.mkdir(parents=True)
    changed.write_text(header.read_text().replace(bug.old, bug.new))


class Builder:
    def __init__(self, compiler, scratch):
        self.compiler = compiler
        self.scratch = scratch
        self.objects = []
        self.libraries = []
        for source in ("support/main.cpp", "support/counted_memory.cpp"):
            made = scratch / (pathlib.Path(source).stem + ".o")
            if complaint := self.call([*FLAGS, "-c", str(ROOT / "tests" / source), "-o", str(made)]):
                sys.exit(f"tests/{source} does not compile: {complaint}")
            self.objects.append(str(made))
        # Version 3 of the framework is a library, version 2 is all in main.o.
        if "_ZN5Catch7SessionC" not in subprocess.run(
                ["nm", "--defined-only", self.objects[0]], capture_output=True, text=True).stdout:
            self.libraries = ["-lCatch2"]

    def call(self, arguments):
        """What the compiler has to say if it fails, else None."""
        try:
            done = subprocess.run([self.compiler, *arguments], capture_output=True, text=True, timeout=COMPILE_SECONDS)
        except subprocess.TimeoutExpired:
            return f"not compiled after {COMPILE_SECONDS} s"
        return None if done.returncode == 0 else done.stderr or "failed"

    def build(self, test, program, first=None):
        before = [] if first is None else ["-I", str(first)]
        return self.call([*before, *FLAGS, str(ROOT / "tests" / test), *self.objects, "-o", str(program),
                          *self.libraries])


def error_in(complaint):
    """The line that matters: the first ones mostly say only which file has included which."""
    lines = complaint.splitlines()
    return next((line for line in lines if "error:" in line), lines[0])


def pattern_of(case):
    """A few letters mean something in a pattern; a template has the type behind its name."""
    return "".join("\\" + c if c in ",[]\\\"" else c for c in case) + "*"


def outcome(program, case, folder, seconds):
    """passed, failed or hangs; and what the test case wrote."""
    try:
        done = subprocess.run([str(program), pattern_of(case)], cwd=folder, capture_output=True, text=True,
                              errors="replace", timeout=seconds)
    except subprocess.TimeoutExpired as late:
        return "hangs", (late.stdout or b"").decode(errors="replace")
    if "No test cases matched" in done.stdout + done.stderr or "No tests ran" in done.stdout:
        return "absent", done.stdout + done.stderr
    return "passed" if done.returncode == 0 else "failed", done.stdout + done.stderr


def judge(bug, build, folder):
    """None if the test saw it; else why not."""
    plant(bug, folder / "include")
    program = folder / "program"
    complaint = build.build(bug.test, program, folder / "include")
    if bug.seen_by_compiler:
        saw = complaint and f"{bug.test}:" in complaint and "static_assert" in complaint and bug.says in complaint
        return None if saw else "SURVIVES: the test file compiles" if not complaint else error_in(complaint)
    if complaint:
        return "does not compile: " + error_in(complaint)
    result, text = outcome(program, bug.case, folder, bug.seconds or RUN_SECONDS)
    program.unlink()
    if result == "hangs":
        return None if bug.seconds else f"hangs for {RUN_SECONDS} s, where a failure was expected"
    if result == "passed":
        return "SURVIVES: the test passes"
    if bug.seconds:
        return f"{result}, where it was to wait for ever"
    if bug.says not in text:
        return f"another check has failed: the output lacks {bug.says!r}"
    return None


def main():
    parser = argparse.ArgumentParser(prog="tests/run --mutations", description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", help="only bugs whose name begins so")
    parser.add_argument("--compiler", default="clang++")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--check", action="store_true", help="only looks whether each bug can still be planted")
    parser.add_argument("--list", action="store_true")
    given = parser.parse_args()

    chosen = [bug for bug in BUGS if not given.names or any(bug.name.startswith(name) for name in given.names)]
    if not chosen:
        print(f"no bug has a name that begins with {' or '.join(given.names)}", file=sys.stderr)
        return 2
    if given.list:
        for bug in chosen:
            print(f"{bug.name:44} {bug.kind:20} {bug.test}: {bug.case}")
        return 0
    broken = [(bug, why) for bug in chosen if (why := problem_with(bug))]
    if len({bug.name for bug in BUGS}) != len(BUGS):
        broken.append((BUGS[0], "two bugs have the same name"))
    for bug, why in broken:
        print(f"{bug.name}: {why}", file=sys.stderr)
    if broken or given.check:
        print(f"{len(chosen)} bugs, {len(broken)} of which cannot be planted")
        return 1 if broken else 0

    began = time.monotonic()
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="tsubu-mutations-"))
    try:
        build = Builder(given.compiler, scratch)
        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:

            def sound(number, test):
                """Whether the test cases that are named pass without any bug: test case -> passed ..."""
                folder = scratch / f"sound{number}"
                folder.mkdir()
                cases = {bug.case for bug in chosen if bug.test == test}
                if complaint := build.build(test, folder / "program"):
                    return {case: "does not compile: " + error_in(complaint) for case in cases}
                results = {case: outcome(folder / "program", case, folder, RUN_SECONDS)[0] for case in cases}
                (folder / "program").unlink()
                return results

            def seen(number, bug):
                folder = scratch / f"bug{number}"
                folder.mkdir()
                return judge(bug, build, folder)

            tests = sorted({bug.test for bug in chosen})
            before = dict(zip(tests, pool.map(sound, range(len(tests)), tests)))
            survivors = 0
            for bug, why in zip(chosen, pool.map(seen, range(len(chosen)), chosen)):
                unchanged = before[bug.test][bug.case]
                if unchanged != "passed":
                    why = f"the test without the bug: {unchanged}"
                survivors += why is not None
                print(f"{'caught' if why is None else 'MISSED':7} {bug.name:44} {bug.kind:20} {bug.test}", flush=True)
                if why:
                    print(f"        {bug.case}: {why}", flush=True)
    finally:
        shutil.rmtree(scratch)
    print(f"{len(chosen) - survivors} of {len(chosen)} bugs caught by the tests that are named with them, "
          f"in {time.monotonic() - began:.0f} s")
    return 1 if survivors else 0


if __name__ == "__main__":
    os.environ.setdefault("LC_ALL", "C")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that the scratch folder goes too
    sys.exit(main())
