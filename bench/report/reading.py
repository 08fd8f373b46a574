# SPDX-License-Identifier: MIT
"""Reads the files that the programs of bench/ write."""
import glob
import gzip
import json
import math
import os
import zlib

REQUIRED_CONTEXT = ("machine", "compiler", "flags", "commit", "instruction_set", "huge_pages", "date")
ROOMS = ("id", "domain", "store", "io", "comm", "dem")  # in the order of the page


class Refusal(Exception):
    """The input is not what the report can be made from."""


class RoomResults:
    """What is known of a room: rows of one file after the other, of which the first counts where two have the same.

    A room adds rows with add(row), and tells with measured() in which dictionaries the repetitions of its cells are."""

    def __init__(self):
        self.contexts = []
        self.already = set()  # cells of the files before

    def begin_file(self, context):
        self.contexts.append(context)
        self.already = {cell for cells in self.measured() for cell in cells}


def room_of(rows):
    """Rows begin with the name of their room, but for those of the id maps, which begin with a pattern of ids."""
    return next((name for name in ROOMS if any(row["name"].startswith(name + "/") for row in rows)), "id")


def files_of(path):
    """The file, or those of a folder."""
    if not os.path.isdir(path):
        return [path]
    found = sorted(f for pattern in ("*.json", "*.json.gz") for f in glob.glob(os.path.join(path, pattern)))
    if not found:
        raise Refusal(f"{path}: no figures in this folder (*.json, *.json.gz)")
    return found


def check_row(where, row):
    if not isinstance(row, dict) or not isinstance(row.get("name"), str):
        raise Refusal(f"{where} has no name")
    for key in ("items_per_second", "bytes_per_second"):
        value = row.get(key, 1)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0 < value < math.inf:
            raise Refusal(f"{where}, {row['name']}: {key} is {value}, not a number above 0")


def contents_of(path):
    """(context, rows), without the marks at the ends of groups."""
    opened = gzip.open(path, "rt", encoding="utf-8") if path.endswith(".gz") else open(path, encoding="utf-8")
    try:
        with opened as file:
            content = json.load(file)
    except (ValueError, EOFError, RecursionError, gzip.BadGzipFile, zlib.error) as fault:  # the latter two of a .gz that is cut short
        raise Refusal(f"{path}: not the JSON of a run ({fault})") from fault
    context = content.get("context") if isinstance(content, dict) else None
    if not isinstance(context, dict):
        raise Refusal(f"{path}: no context in it, which says where the figures are from")
    missing = [key for key in REQUIRED_CONTEXT if not context.get(key)]
    if missing:
        raise Refusal(f"{path}: the context lacks {', '.join(missing)}: figures without it are worth nothing; run a "
                      "program of bench/, not Google Benchmark alone")
    if not isinstance(content.get("benchmarks"), list):
        raise Refusal(f"{path}: no list of benchmarks in it, which is where the figures of a run stand")
    for number, row in enumerate(content["benchmarks"], 1):
        check_row(f"{path}: row {number}", row)
    return context, [row for row in content["benchmarks"] if "group_seconds" not in row]
