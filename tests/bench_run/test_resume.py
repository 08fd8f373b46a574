#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A run that is killed in its midst leaves a file that can be read, and goes on to the same rows as one that was not.

    test_resume.py PROGRAM    the program is stoppable_run
"""
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = ""


def run(path, *options):
    return subprocess.run([PROGRAM, *options, f"--benchmark_out={path}"], capture_output=True, text=True, check=False)


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def rows_of(path):
    return json.loads(text_of(path))["benchmarks"]


def measured(path):
    return [row for row in rows_of(path) if "group_seconds" not in row]


def finished(path):
    return [row["name"] for row in rows_of(path) if "group_seconds" in row]


def limit_files(size):
    """As a full disk would: a write beyond the size fails."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


class StoppedRun(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = os.path.join(self.folder.name, "dem.json")
        self.whole = os.path.join(self.folder.name, "whole.json")

    def tearDown(self):
        self.folder.cleanup()

    def kill_after(self, rows, *options):
        """Kills the program when the file has so many rows more, which is in the midst of a group unless by chance."""
        goal = rows + (len(rows_of(self.path)) if options else 0)
        with subprocess.Popen([PROGRAM, *options, f"--benchmark_out={self.path}"], stderr=subprocess.DEVNULL) as child:
            deadline = time.monotonic() + 30
            while child.poll() is None and time.monotonic() < deadline:
                if os.path.exists(self.path):
                    # Each look at the file of a running program is a test of its own: it must be whole.
                    if len(rows_of(self.path)) >= goal:
                        break
                time.sleep(.002)
            child.send_signal(signal.SIGKILL)

    def test_a_killed_run_goes_on_to_the_same_rows(self):
        self.assertEqual(run(self.whole).returncode, 0)
        self.kill_after(13)  # in the second of four groups, which have 9 rows and a mark each
        self.assertIn("dem/first", finished(self.path))
        self.assertNotIn("dem/fourth", finished(self.path))
        self.kill_after(12, "--resume")
        self.assertIn("dem/second", finished(self.path))
        again = run(self.path, "--resume")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(measured(self.path), measured(self.whole))
        self.assertEqual(finished(self.path), finished(self.whole))
        self.assertIn("resumed", json.loads(text_of(self.path))["context"])

    def test_finished_groups_are_not_measured_again(self):
        self.assertEqual(run(self.path, "--only", "first").returncode, 0)
        whole, rest = (int(run(self.path, "--plan", *more).stdout) for more in ((), ("--resume",)))
        self.assertEqual((whole, rest), (40, 30))
        again = run(self.path, "--resume")
        self.assertNotIn("dem/first", again.stderr)
        self.assertIn("dem/second", again.stderr)
        self.assertEqual(len(measured(self.path)), 4 * 9)

    def test_without_resume_a_run_begins_anew(self):
        self.assertEqual(run(self.path).returncode, 0)
        self.assertEqual(run(self.path, "--only", "third").returncode, 0)
        self.assertEqual(finished(self.path), ["dem/third"])

    def test_figures_whose_conditions_are_gone_are_not_gone_on_with(self):
        for condition, without in (("commit", ""), ("date", ""), ("date", '  "date": "",')):
            self.assertEqual(run(self.path, "--only", "first").returncode, 0)
            lines = [without if line.startswith(f'  "{condition}":') else line
                     for line in text_of(self.path).split("\n")]
            with open(self.path, "w", encoding="utf-8") as file:
                file.write("\n".join(line for line in lines if line))
            again = run(self.path, "--resume")
            self.assertNotEqual(again.returncode, 0)
            self.assertIn(condition, again.stderr)

    def test_a_torn_line_is_left_out(self):
        """As after a power failure: the file ends within a row."""
        self.assertEqual(run(self.whole).returncode, 0)
        text = text_of(self.whole)
        for end in (30, len(text) // 3, len(text) // 2, len(text) - 20):
            with open(self.path, "w", encoding="utf-8") as file:
                file.write(text[:end])
            self.assertEqual(run(self.path, "--resume").returncode, 0)
            self.assertEqual(measured(self.path), measured(self.whole))

    def test_a_full_disk_leaves_the_figures_as_they_were(self):
        self.assertEqual(run(self.path, "--only", "first").returncode, 0)
        before = text_of(self.path)
        room = len(before.encode()) // 2
        full = subprocess.run([PROGRAM, "--resume", f"--benchmark_out={self.path}"], capture_output=True, text=True,
                              check=False, preexec_fn=lambda: limit_files(room))
        self.assertEqual(full.returncode, 1)
        self.assertIn("is the disk full?", full.stderr)
        self.assertEqual(text_of(self.path), before)

    def test_other_conditions_are_refused_by_name(self):
        self.assertEqual(run(self.path).returncode, 0)
        before = rows_of(self.path)
        other = run(self.path, "--resume", "--quick")
        self.assertEqual(other.returncode, 1)
        self.assertIn('extent was "standard" and is "quick"', other.stderr)
        self.assertIn("without --resume", other.stderr)
        self.assertEqual(rows_of(self.path), before)
        for key in ("commit", "compiler", "flags", "machine"):
            text = text_of(self.path)
            value = json.loads(text)["context"][key]
            changed = text.replace(f'"{key}": "{value}"', f'"{key}": "another"')
            self.assertNotEqual(text, changed)
            with open(self.path, "w", encoding="utf-8") as file:
                file.write(changed)
            refused = run(self.path, "--resume")
            self.assertEqual(refused.returncode, 1)
            self.assertIn(f'{key} was "another"', refused.stderr)
            with open(self.path, "w", encoding="utf-8") as file:
                file.write(text)

    def test_the_plan_measures_nothing(self):
        planned = run(self.path, "--plan", "--quick")
        self.assertEqual((planned.returncode, planned.stdout), (0, "40\n"))
        self.assertFalse(os.path.exists(self.path))

    def test_time_left_is_that_of_the_whole_run(self):
        """Programs before took twice as long as planned, so this one and those after will: 2 * (40 + 560) seconds, or
        less while little has been measured, since a minute is believed to go as planned."""
        for before, left in (("3000,6000", 19), ("300,600", 18), ("5,10", 10)):
            first = run(self.path, "--whole-run", f"{before},560").stderr.splitlines()[0]
            os.remove(self.path)
            self.assertIn(f"about {left} min left", first)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
