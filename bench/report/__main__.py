# SPDX-License-Identifier: MIT
"""Reads the figures of all rooms, and writes the page, or what the README shows."""
import argparse
import gzip
import json
import os
import sys

from . import comm, dem, domain, id_map, io, store
from .page import REQUIRED_CONTEXT, STYLE, Refusal, claim_section, context_section, listed, plotting

ROOMS = {"id": id_map, "domain": domain, "store": store, "io": io, "comm": comm, "dem": dem}  # in the order of the page


def room_of(rows):
    """Rows begin with the name of their room, but for those of the id maps, which begin with a pattern of ids."""
    return next((name for name in ROOMS if any(row["name"].startswith(name + "/") for row in rows)), "id")


class Figures:
    """The results of each room that has any, in the order of the page."""

    def __init__(self, paths):
        self.results = {name: room.Results() for name, room in ROOMS.items()}
        self.contexts = []
        for path in paths:
            self.read(path)
        self.results = {name: results for name, results in self.results.items() if not results.is_empty()}

    def read(self, path):
        opened = gzip.open(path, "rt") if path.endswith(".gz") else open(path, encoding="utf-8")
        try:
            with opened as file:
                content = json.load(file)
        except ValueError as fault:
            raise Refusal(f"{path}: not the JSON of a finished run ({fault})") from fault
        context = content.get("context", {})
        missing = [key for key in REQUIRED_CONTEXT if not context.get(key)]
        if missing:
            raise Refusal(f"{path}: the context lacks {', '.join(missing)}: figures without it are worth nothing; "
                          "run a program of bench/, not Google Benchmark alone")
        rows = content["benchmarks"]
        context = {**context, "file": os.path.basename(path)}
        name = room_of(rows)
        self.contexts.append((name, context))
        results = self.results[name]
        results.begin_file(context)
        for row in rows:
            results.add(row)
        if results.is_empty():
            raise Refusal(f"{path}: no measurement in it")

    def rooms(self):
        return [(ROOMS[name], results) for name, results in self.results.items()]


def page(figures):
    pyplot = plotting()
    rooms = figures.rooms()
    title = f"tsubu: {listed([room.TITLE for room, _ in rooms])}"
    links = [("claims", "What must hold")] + [link for room, results in rooms for link in room.links(results)]
    claims = [claim for room, results in rooms for claim in room.all_claims(results)]
    notes = " ".join(room.CLAIM_NOTE for room, _ in rooms if room.CLAIM_NOTE)
    repetitions = [sorted(figures.results[name].repetitions()) for name, _ in figures.contexts]
    return (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
            '<meta name="viewport" content="width=device-width, initial-scale=1">'
            f"<style>{STYLE}</style></head><body><h1>{title}, measured</h1>" +
            "".join(f"<p>{room.INTRODUCTION}</p>" for room, _ in rooms) +
            context_section([context for _, context in figures.contexts], repetitions) +
            "<nav>" + "".join(f'<a href="#{anchor}">{text}</a>' for anchor, text in links) + "</nav>" +
            claim_section(claims, notes) +
            "".join(room.sections(results, pyplot) for room, results in rooms) + "</body></html>\n")


def main(description):
    parser = argparse.ArgumentParser(prog="report.py", description=description)
    parser.add_argument("results", nargs="+", metavar="RESULT.json",
                        help="of a program of bench/; .json.gz is read as well")
    parser.add_argument("-o", "--out", default="bench/out/report.html", help="the page (default: %(default)s)")
    instead = parser.add_mutually_exclusive_group()
    instead.add_argument("--markdown", action="store_true", help="print tables for the README instead of a page")
    instead.add_argument("--picture", metavar="FILE.svg",
                         help="draw the chart of the README instead of a page, of the first room that has figures")
    arguments = parser.parse_args()
    try:
        figures = Figures(arguments.results)
        if arguments.markdown:
            sys.stdout.write("\n".join(room.markdown(results) for room, results in figures.rooms()))
            return 0
        if arguments.picture:
            room, results = figures.rooms()[0]
            room.readme_picture(results, arguments.picture, plotting())
            return 0
        text = page(figures)
    except (Refusal, OSError) as fault:
        print(f"report.py: {fault}", file=sys.stderr)
        return 1
    os.makedirs(os.path.dirname(os.path.abspath(arguments.out)), exist_ok=True)
    with open(arguments.out, "w", encoding="utf-8") as file:
        file.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main(__doc__))
