# SPDX-License-Identifier: MIT
"""Reads the figures of all rooms, and writes the page, or what the README shows."""
import argparse
import os
import sys

from . import comm, compare, dem, domain, front, id_map, io, reading, store
from .charts import sparsity
from .claims import FAILS, HOLDS, NOISY, claim_section, markdown_claims
from .page import appendix, context_section, document
from .pictures import plotting, write_picture
from .reading import Refusal, contents_of, files_of, room_of
from .spread import listed

README_CHARTS = {"id": sparsity.readme_chart, "dem": dem.readme_chart}
ROOMS = dict(zip(reading.ROOMS, (id_map, domain, store, io, comm, dem)))


class Figures:
    """The results of each room that has any, in the order of the page."""

    def __init__(self, paths):
        self.results = {name: room.Results() for name, room in ROOMS.items()}
        self.contexts = []
        for path in (file for path in paths for file in files_of(path)):
            self.read(path)
        self.results = {name: results for name, results in self.results.items() if not results.is_empty()}

    def read(self, path):
        context, rows = contents_of(path)
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
    claims = [claim for room, results in rooms for claim in room.all_claims(results)]
    notes = " ".join(room.CLAIM_NOTE for room, _ in rooms if room.CLAIM_NOTE)
    repetitions = [sorted(figures.results[name].repetitions()) for name, _ in figures.contexts]
    links = [*front.chart_links(), ("claims", "What must hold"), ("runs", "The runs"), ("rooms", "Room by room")]
    return (document("tsubu, measured", front.introduction(figures) + front.warnings(figures) +
                     front.missing(figures, ROOMS) +
                     "<nav>" + "".join(f'<a href="#{anchor}">{text}</a>' for anchor, text in links) + "</nav>" +
                     front.chart_sections(figures, pyplot) + claim_section(claims, notes) +
                     '<h2 id="runs">The runs</h2>' +
                     context_section([context for _, context in figures.contexts], repetitions) +
                     '<h2 id="rooms">Room by room</h2>' +
                     "".join(appendix(f"{room.TITLE[:1].upper()}{room.TITLE[1:]}",
                                      f"<p>{room.INTRODUCTION}</p>" + room.sections(results, pyplot))
                             for room, results in rooms)))


def write(path, text):
    """The file is there whole, or as it was."""
    os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)


def main(description):
    parser = argparse.ArgumentParser(prog="report.py", description=description)
    parser.add_argument("results", nargs="*", metavar="RESULT.json",
                        help="of a program of bench/; .json.gz is read as well; or a folder of them")
    parser.add_argument("-o", "--out", default="bench/out/report.html", help="the page (default: %(default)s)")
    instead = parser.add_mutually_exclusive_group()
    instead.add_argument("--markdown", action="store_true", help="print tables for the README instead of a page")
    instead.add_argument("--sentences", action="store_true", help="print what each chart says, for the README")
    instead.add_argument("--shortfalls", action="store_true", help="print which claims fail, for the README")
    instead.add_argument("--picture", metavar="FILE.svg",
                         help="draw the chart of the README instead of a page, of the first room that has figures")
    instead.add_argument("--compare", nargs=2, metavar=("OLD", "NEW"),
                         help="two runs, each a file of figures or a folder of them: a page, and a text beside it")
    arguments = parser.parse_args()
    if bool(arguments.results) == bool(arguments.compare):
        parser.error("give results, or two runs to compare")
    text_out = os.path.splitext(arguments.out)[0] + ".txt"
    if arguments.compare and text_out == arguments.out:
        parser.error(f"{arguments.out} is where the text beside the page goes: name a page, such as compare.html")
    try:
        if arguments.compare:
            old, new = map(compare.Run, arguments.compare)
            found = compare.Comparison(old, new)
            write(arguments.out, found.page())
            write(text_out, found.text(everything=True))
            sys.stdout.write(found.text() + f"\nAll rows: {arguments.out} and {text_out}\n")
            return 0
        figures = Figures(arguments.results)
        if arguments.markdown:
            sys.stdout.write("\n".join(room.markdown(results) for room, results in figures.rooms()))
            return 0
        if arguments.picture:
            name, results = next(iter(figures.results.items()))
            if name not in README_CHARTS:
                raise Refusal(f"no chart of the room {name} for the README; there are those of {listed(README_CHARTS)}")
            write_picture(arguments.picture, README_CHARTS[name](results, plotting()))
            return 0
        if arguments.sentences:
            sys.stdout.write("".join(f"{line}\n" for line in front.sentences(figures)))
            return 0
        if arguments.shortfalls:
            claims = [claim for room, results in figures.rooms() for claim in room.all_claims(results)]
            short = [claim for claim in claims if claim.verdict() == FAILS]
            held = sum(claim.verdict() == HOLDS for claim in claims)
            noisy = sum(claim.verdict() == NOISY for claim in claims)
            count = held + noisy + len(short)
            text = f"Of {count} claims with a target {held} hold, {noisy} are too noisy to tell, and "
            text += f"{len(short)} fail:\n" + "\n".join(markdown_claims(short)) if short else "none fails."
            sys.stdout.write(text + "\n")
            return 0
        write(arguments.out, page(figures))
    except (Refusal, OSError) as fault:
        print(f"report.py: {fault}", file=sys.stderr)
        return 1
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as fault:
        print(f"report.py: figures that cannot be drawn, maybe since rows are missing: {type(fault).__name__}: {fault}; "
              "measure the room anew, or leave its file out", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(__doc__))
