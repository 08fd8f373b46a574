#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""bench/run itself: runs that are stopped, that crash, and that measure a part. A copy of it works with stand-ins for
tools and programs, so that nothing is built or measured."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOLS = {
    "cmake": """
case $1 in
--version) echo 'cmake version 3.30.0' ;;
--build)  # the programs that are asked for become copies of the stand-in
    build=$2
    mkdir -p "$build/bench"
    while [ "$1" != --target ]; do shift; done
    shift
    for program; do cp "$STAND_IN" "$build/bench/$program"; done
    ;;
*) echo '-- Rivals: none' ;;
esac
""",
    "ninja": "", "some-c++": "",
    "python3": """
[ "$1" = -c ] || printf '%s\\n' "$*" >>"$STAND_IN_NOTES/drawn"
""",
}
# What it does stands in a file, since what is stopped goes on to do another thing.
PROGRAM = """
for argument; do
    case $argument in
    --plan) echo 60; exit ;;
    --benchmark_out=*) out=${argument#*=} ;;
    esac
done
case $(cat "$STAND_IN_NOTES/does") in
finishes) echo '{}' >"$out" ;;
crashes) kill -SEGV $$ ;;
fails) exit 7 ;;
"starts another, and waits")
    echo '{' >"$out"
    sleep 300 &
    echo $! >"$STAND_IN_NOTES/started.part"
    mv "$STAND_IN_NOTES/started.part" "$STAND_IN_NOTES/started"
    wait
    ;;
esac
"""


def is_alive(pid):
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"  # Z: it has ended, and nobody has asked how
    except FileNotFoundError:
        return False


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("bench/run", "cmake/packages.sh", "cmake/machine.sh"):
            (self.folder / name).parent.mkdir(exist_ok=True)
            shutil.copy(ROOT / name, self.folder / name)
        self.out = self.folder / "bench/out"
        tools = self.folder / "tools"
        tools.mkdir()
        for name, text in {**TOOLS, "stand_in": PROGRAM}.items():
            (tools / name).write_text(f"#!/bin/sh\n{text}", encoding="utf-8")
            (tools / name).chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "STAND_IN": str(tools / "stand_in"),
                            "STAND_IN_NOTES": str(self.folder)}

    def start(self, does, *options):
        (self.folder / "does").write_text(does, encoding="utf-8")
        return subprocess.Popen(
            [str(self.folder / "bench/run"), "--no-install", "--only", "id", "--compiler", "some-c++", *options],
            env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")

    def run_to_its_end(self, does, *options):
        with self.start(does, *options) as run:
            return run.communicate(timeout=60)[0], run.wait()

    def await_start_of(self, run):
        """Until the program of a room has started another; whose number."""
        started = self.folder / "started"
        deadline = time.monotonic() + 60
        while not started.exists() and run.poll() is None and time.monotonic() < deadline:
            time.sleep(.01)
        return int(started.read_text(encoding="utf-8"))

    def stop_by(self, number):
        with self.start("starts another, and waits") as run:
            pid = self.await_start_of(run)
            self.assertTrue(is_alive(pid))
            run.send_signal(number)
            said = run.communicate(timeout=60)[0]
        return said, run.returncode, pid

    def test_what_a_program_has_started_is_stopped_with_it(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(number):
                said, result, pid = self.stop_by(number)
                self.assertEqual(result, 130, said)
                self.assertIn("start again with --resume", said)
                self.assertFalse(is_alive(pid))
                (self.folder / "started").unlink()

    def test_a_stopped_run_goes_on_and_leaves_nothing_unfinished(self):
        self.stop_by(signal.SIGINT)
        self.assertTrue((self.out / "unfinished/id_map.json").exists())
        said, result = self.run_to_its_end("finishes", "--resume")
        self.assertEqual(result, 0, said)
        self.assertEqual([path.name for path in self.out.iterdir()], ["id_map.json"])
        self.assertIn("report.html", (self.folder / "drawn").read_text(encoding="utf-8"))

    def test_figures_of_other_rooms_stay_unfinished_and_are_named(self):
        (self.out / "unfinished").mkdir(parents=True)
        (self.out / "unfinished/dem.json").write_text("{}", encoding="utf-8")
        said, result = self.run_to_its_end("finishes", "--resume")
        self.assertEqual(result, 0, said)
        self.assertIn("still holds other rooms", said)
        self.assertTrue((self.out / "unfinished/dem.json").exists())

    def test_a_crash_is_a_failure_and_no_stop(self):
        for does, code in (("crashes", 139), ("fails", 7)):
            said, result = self.run_to_its_end(does)
            self.assertEqual(result, 1, said)
            self.assertIn(f"the room id_map failed with code {code}", said)
            self.assertNotIn("--resume and the same options", said)

    def test_a_second_run_leaves_the_first_alone(self):
        with self.start("starts another, and waits") as run:
            self.await_start_of(run)
            said, result = self.run_to_its_end("finishes")
            self.assertEqual(result, 1, said)
            self.assertIn(f"process {run.pid} works in {self.out.relative_to(self.folder)} already", said)
            self.assertTrue((self.out / "unfinished/id_map.json").exists())
            run.send_signal(signal.SIGTERM)
            run.communicate(timeout=60)
        self.assertFalse((self.out / "running").exists())
        (self.out / "running").write_text("999999999", encoding="utf-8")  # of one that was killed
        said, result = self.run_to_its_end("finishes", "--resume")
        self.assertEqual(result, 0, said)

    def test_a_part_of_a_room_does_not_replace_it(self):
        self.run_to_its_end("finishes")
        whole = self.out / "id_map.json"
        whole.write_text("of all groups", encoding="utf-8")
        self.assertEqual(self.run_to_its_end("finishes", "--filter", "uniform")[1], 0)
        self.assertEqual(whole.read_text(encoding="utf-8"), "of all groups")
        self.assertTrue((self.out / "filtered/id_map.json").exists())


if __name__ == "__main__":
    unittest.main()
