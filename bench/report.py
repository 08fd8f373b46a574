#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the results of the programs of bench/ as one page without references to anything outside itself, prints what
the README shows of them, or compares two runs.

    report.py RESULT.json [MORE.json.gz ...] -o bench/out/report.html
    report.py --compare OLD NEW -o bench/out/compare.html
    report.py --sentences RESULT.json ...     what each chart advises
    report.py --shortfalls RESULT.json ...    which claims fail
    report.py --markdown RESULT.json          tables
    report.py --picture FILE.svg RESULT.json

Times are medians over the repetitions, with the limits between which the median lies at 93 % or more (of five to seven
repetitions, the lowest and the highest). Every ratio is one of two medians of
the same group, so of two series whose repetitions ran interleaved; in the room store each repetition has a ratio of its
own. The package report, beside this file, does the work: a module per room, charts/ for the five that the page begins
with, front for what stands around them, compare for two runs, and spread, claims, pictures, drawing and page for what all
share.
"""
import sys

from report.__main__ import main  # the package: python takes it before the module of the same name

if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8")  # a terminal may have no µ by itself
    sys.exit(main(__doc__.split("\n\n")[0]))
