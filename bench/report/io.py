# SPDX-License-Identifier: MIT
"""Files: how fast particles are read and written, beside fscanf, fprintf and moving the same bytes."""
from collections import defaultdict

from .claims import Claim
from .page import context_text, figure_cell, markdown_row, ratio_cell, table
from .pictures import INK, colour, svg_of
from .reading import RoomResults
from .spread import Spread, figure_of, listed, middle, power, quotient, scaled

# (task, variant): what the rows of charts and tables are called
TASKS = {
    ("read", "atomic"): "read, atomic",
    ("read", "sphere"): "read, sphere",
    ("read", "full"): "read, full with bonds",
    ("read", "full_lammps"): "read, full as LAMMPS writes it",
    ("write", "full"): "write, full with bonds",
    ("restart_read", "soa"): "read a restart",
    ("restart_write", "soa"): "write a restart",
    ("vtk_write", "soa"): "write VTK (.vtp)",
}
BY_C = {"read": "fscanf", "write": "fprintf"}
# names, label, colour
SERIES = (
    (("tsubu",), "tsubu", colour("blue")),
    (("fscanf", "fprintf"), "fscanf, fprintf", colour("vermilion")),
    (("plain",), "the bytes alone", colour("grey")),
)
PROMISE = 5.0
CHARTS = (("LAMMPS data files", ("read", "write")), ("Restart and VTK, binary", ("restart_read", "restart_write",
                                                                                  "vtk_write")))

TITLE = "files"
INTRODUCTION = ("Particles from and to files: LAMMPS data files beside fscanf and fprintf of the same numbers, restart "
                "and VTK files, and read() and write() of the same bytes, which is the limit of the machine. Files "
                "lie in memory where there is such a place; one thread's CPU time.")
CLAIM_NOTE = ""


class Results(RoomResults):
    """Bytes per second by (task, variant, series, N)."""

    def __init__(self):
        super().__init__()
        self.rates = defaultdict(list)  # bytes per second, one per repetition
        self.bytes = {}                 # (task, variant, N): of the file

    def measured(self):
        return (self.rates,)

    def add(self, row):
        _, task, variant, series, last = row["name"].split("/")
        cell = (task, variant, series, int(last.split(":")[1]))
        if cell in self.already:  # of two runs of one cell the first counts
            return
        self.rates[cell].append(row["bytes_per_second"])
        if series == "tsubu":
            self.bytes[(task, variant, cell[3])] = row["bytes"]

    def is_empty(self):
        return not self.rates

    def repetitions(self):
        return {len(t) for t in self.rates.values()}

    def rate(self, task, variant, series, count):
        """MB/s, a Spread; None if not measured."""
        found = self.rates.get((task, variant, series, count))
        return scaled(middle(found), 1e-6) if found else None

    def over(self, task, variant, rival, count):
        """How many times as fast as the rival; of the seconds, since a rival may write other bytes."""
        seconds = [self.seconds(task, variant, series, count) for series in (rival, "tsubu")]
        return quotient(*seconds)

    def seconds(self, task, variant, series, count):
        """For the file of tsubu: a rival that writes longer numbers is not the faster for it."""
        rate = self.rate(task, variant, series, count)
        size = self.bytes.get((task, variant, count))
        return Spread(size / rate / 1e6, size / rate.high / 1e6, size / rate.low / 1e6) if rate and size else None

    def counts(self):
        return sorted({n for *_, n in self.rates})

    def tasks(self, kinds=None):
        present = {cell[:2] for cell in self.rates}
        return [t for t in TASKS if t in present and (kinds is None or t[0] in kinds)]


def all_claims(results):
    claim = Claim("A data file read: tsubu / fscanf", PROMISE)
    for count in results.counts():
        for task, variant in results.tasks(("read",)):
            claim.add(results.over(task, variant, "fscanf", count), f"{variant.replace('_', ', ')}, {power(count)}")
    written = Claim("A data file written: tsubu / fprintf", None)
    for count in results.counts():
        for task, variant in results.tasks(("write",)):
            written.add(results.over(task, variant, "fprintf", count), f"{variant}, {power(count)}")
    return [claim, written]


# ---------------------------------------------------------------------------------------------------------------
# Charts


def rate_chart(results, count, title, kinds, pyplot):
    """MB/s: a group of bars for each kind of file."""
    tasks = results.tasks(kinds)
    present = [s for s in SERIES if any(results.rate(*t, name, count) for t in tasks for name in s[0])]
    figure, axes = pyplot.subplots(figsize=(5.6, 1.0 + (.22 + .2 * len(present)) * len(tasks)))
    high = .8 / len(present)
    values = []
    for k, (names, label, shade) in enumerate(present):
        for row, task in enumerate(tasks):
            rate = next((r for name in names if (r := results.rate(*task, name, count))), None)
            if not rate:
                continue
            place = row + high * (k - (len(present) - 1) / 2)
            axes.barh(place, rate, height=high * .9, color=shade, label=label if label else None, zorder=3)
            axes.plot([rate.low, rate.high], [place, place], color=INK, linewidth=1, zorder=4)
            axes.annotate(figure_of(rate), (rate.high, place), xytext=(4, 0), textcoords="offset points", va="center",
                          fontsize=8)
            values.append(rate)
            label = None
    axes.set_xscale("log")
    low, top = min(values), max(v.high for v in values)
    left = next(x for x in (100, 50, 20, 10, 5, 2, 1, .1) if x <= low / 1.5)
    axes.set_xlim(left, top * 2.2)
    ticks = [m * 10.0**e for e in range(-1, 6) for m in (1, 3) if left <= m * 10.0**e <= top * 2.2]
    axes.set_xticks(ticks, [f"{t:,.0f}".replace(",", "\u202f") if t >= 1 else f"{t:g}" for t in ticks])
    axes.minorticks_off()
    axes.set_yticks(range(len(tasks)), [TASKS[t].replace(" as ", "\nas ") for t in tasks])
    axes.set_ylim(len(tasks) - .45, -.55)
    axes.set_xlabel("MB/s")
    axes.grid(True, axis="x")
    axes.set_title(f"{title}, {power(count)} particles", loc="left")
    axes.legend(loc="upper center", bbox_to_anchor=(.4, -.62 / figure.get_figheight()), ncol=3, frameon=False,
                fontsize=8)
    return figure


# ---------------------------------------------------------------------------------------------------------------
# Sections of the page


def verdict_cell(ratio):
    """Does reading keep the promise here?"""
    if ratio is None:
        return "<td></td>"
    verdict = Claim("", PROMISE).verdict_at(ratio)
    return f'<td class="{verdict}">{ {"holds": "✓ holds", "fails": "✗ fails"}.get(verdict, "too noisy to tell") }</td>'


def rate_table(results, kinds):
    rows = []
    for task, variant in results.tasks(kinds):
        for count in results.counts():
            if not results.rate(task, variant, "tsubu", count):
                continue
            rival = BY_C.get(task)
            against = results.over(task, variant, rival, count) if rival else None
            size = results.bytes[(task, variant, count)] / 1e6
            row = [TASKS[(task, variant)], power(count), f'<td class="figure">{size:.3g}</td>',
                   figure_cell(results.rate(task, variant, "tsubu", count))]
            if any(kind in BY_C for kind in kinds):
                row += [figure_cell(results.rate(task, variant, rival, count) if rival else None), ratio_cell(against),
                        verdict_cell(against) if task == "read" else ""]
            row += [figure_cell(results.rate(task, variant, "plain", count)),
                    ratio_cell(results.over(task, variant, "plain", count))]
            rows.append(row)
    by_c = ["fscanf, fprintf", "tsubu / C", f"at least {PROMISE:g}x"] if any(kind in BY_C for kind in kinds) else []
    return table(["File", "Particles", "MB", "tsubu, MB/s", *by_c, "the bytes alone, MB/s", "tsubu / bytes"], rows)


def time_sentence(results):
    """How long the largest files take."""
    count = results.counts()[-1]
    texts = []
    for task, variant in results.tasks():
        seconds = results.seconds(task, variant, "tsubu", count)
        if seconds and (task, variant) in (("read", "full"), ("write", "full"), ("restart_read", "soa")):
            what = {"read": "is read", "write": "is written", "restart_read": "is read as a restart"}[task]
            rival = BY_C.get(task) and results.seconds(task, variant, BY_C[task], count)
            beside = f" ({BY_C[task]}: {figure_of(rival)} s)" if rival else ""
            texts.append(f"{what} in {figure_of(seconds)} s{beside}")
    if not texts:
        return ""
    size = results.bytes.get(("read", "full", count)) or results.bytes.get(("write", "full", count))
    of = f", a data file of {size / 1e6:.0f} MB," if size else ""
    return f"<p>A system of {power(count)} particles of style full{of} {listed(texts)}.</p>"


FILE_TEXT = (
    "The reader of tsubu checks each line and keeps its number, so that an error names the place; fscanf of the same "
    "numbers into arrays checks the count of what it read. Median (its limits). Scales are logarithmic. tsubu / C "
    "compares the time for the same particles, whatever the length of their numbers.")


def sections(results, pyplot):
    parts = [f'<h2 id="files">Files</h2><p>{FILE_TEXT}</p>{time_sentence(results)}<div class="charts">']
    for title, kinds in CHARTS:
        for count in results.counts()[-1:]:
            if results.tasks(kinds):
                parts.append("<figure>" + svg_of(rate_chart(results, count, title, kinds, pyplot), pyplot, title) +
                             "</figure>")
    parts.append("</div>")
    for title, kinds in CHARTS:
        if results.tasks(kinds):
            parts.append(f"<h3>{title}</h3>" + rate_table(results, kinds))
    return "".join(parts)


# ---------------------------------------------------------------------------------------------------------------
# Tables for the README


def markdown(results):
    context = results.contexts[0]
    lines = [context_text(context), "",
             f"MB/s, medians of {min(results.repetitions())} interleaved repetitions; in brackets how many times as "
             "fast tsubu is for the same particles.", "",
             markdown_row(["file", "N", "tsubu", "fscanf, fprintf", "the bytes alone"]), "|" + "---|" * 5]
    for task, variant in results.tasks():
        for count in results.counts():
            rates = [results.rate(task, variant, series, count) for series in ("tsubu", BY_C.get(task, ""), "plain")]
            if not rates[0]:
                continue
            ratio = results.over(task, variant, BY_C[task], count) if task in BY_C else None
            cells = [figure_of(rate) if rate else "" for rate in rates]
            cells[1] += f" ({ratio:.1f}x)" if ratio else ""
            lines.append(markdown_row([TASKS[(task, variant)], power(count), *cells]))
    return "\n".join(lines) + "\n"
