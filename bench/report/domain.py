# SPDX-License-Identifier: MIT
"""The domain: whose is x, how long that takes for a batch, and how far a wrapped position drifts."""
import html
from collections import defaultdict

from .claims import Claim
from .page import context_text, figure_cell, folded, markdown_row, ratio_cell, table
from .pictures import GRID, INK, colour, svg_of
from .reading import RoomResults
from .spread import figure_of, middle, power, quotient

# name: (label, colour, marker)
SCALARS = {
    "double": ("double", colour("blue"), "o"),
    "float": ("float", colour("vermilion"), "s"),
    "lattice32": ("lattice, int32", colour("green"), "^"),
    "lattice64": ("lattice, int64", colour("purple"), "D"),
}
BORDERS = ("exact", "padded")
OPERATIONS = {
    "owns_columns": "owns, columns",
    "owns_rows": "owns, array of vectors",
    "owner_columns": "owner, columns",
    "wrap_few_columns": "wrap, columns, 1 % outside",
    "wrap_half_columns": "wrap, columns, 50 % outside",
}
READ_LIMIT = 1.3
OFFSETS = ("0", "1e3", "1e6", "1e9")
STEPS = {
    "fine": "as finely as the scalar holds a step of one to two box lengths",
    "coarse": "multiples of 2⁻²⁰ box lengths, whose sums double holds at every offset",
}
# Where LIGGGHTS' epsilon of 1e-8 m is as large as the margin beside the box, and where it is lost beside a face.
EPSILON = 1e-8
VANISHES = {"double": 2**27, "float": 0.25}

TITLE = "domain"
INTRODUCTION = ("Whose is x: the points that a border policy gives to no rank or to two, nanoseconds per point of "
                "the batched predicates beside a plain read of the same bytes, and how far a position drifts over a "
                "million wraps. One thread's CPU time.")
CLAIM_NOTE = ("A plain read sums the bytes of the same three columns; the mask that owns writes counts against owns "
              "alone.")


class Results(RoomResults):
    """Times by (scalar, border, operation, N), partitions by (scalar, border, scale), errors by (scalar, step, origin).
    """

    def __init__(self):
        super().__init__()
        self.times = defaultdict(list)  # ns per point, one per repetition
        self.partitions = {}
        self.errors = {}
        self.refused = {}               # any of the keys above: message

    def measured(self):
        return (self.times,)

    def add(self, row):
        _, kind, *words = row["name"].split("/")
        last = words[-1].split(":")[1]
        if kind == "time":
            cell = (*words[:3], int(last))
            if cell not in self.already:  # of two runs of one cell the first counts
                self.times[cell].append(1e9 / row["items_per_second"])
            return
        cell = (*words[:2], float(last) if kind == "partition" else last)
        if "refused" in row:
            self.refused[cell] = row["refused"]
        else:
            (self.partitions if kind == "partition" else self.errors).setdefault(cell, row)

    def is_empty(self):
        return not (self.times or self.partitions or self.errors)

    def repetitions(self):
        return {len(t) for t in self.times.values()}

    def median(self, *cell):
        """A Spread of (scalar, border, operation, N); None if not measured."""
        times = self.times.get(cell)
        return middle(times) if times else None

    def counts(self):
        return sorted({cell[3] for cell in self.times})

    def scales(self, scalar, border):
        return sorted(scale for s, b, scale in self.partitions if (s, b) == (scalar, border))


def label(scalar):
    return SCALARS[scalar][0]


def scale_name(scale):
    """1e-300; 0.1, 1 and 10 as they are."""
    text = f"{scale:g}" if .01 < scale < 1000 else f"{scale:.0e}"
    return text.replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


# ---------------------------------------------------------------------------------------------------------------
# Claims


def claims_on_partition(results):
    claims = []
    for scalar in VANISHES:
        claim = Claim(f"exact, {scalar}: wrong points, at every scale", 0, "", at_least=False)
        for scale in results.scales(scalar, "exact"):
            found = results.partitions[(scalar, "exact", scale)]
            claim.add(found["wrong_owned"] + found["wrong_extended"], f"box of {scale_name(scale)}")
        claims.append(claim)
    for scalar, vanishes in VANISHES.items():
        measured = results.scales(scalar, "padded")
        small = [s for s in measured if s <= 10 * EPSILON]
        large = [s for s in measured if s > vanishes]
        for scales, field, what in ((small, "wrong_outside", "points outside that a rank owns"),
                                    (large, "wrong_inside", "points inside that no rank owns")):
            span = f"{scale_name(scales[0])} to {scale_name(scales[-1])}" if scales else "its ends"
            claim = Claim(f"padded, {scalar} (expected to be wrong): {what}, at {span}", 1, "")
            for scale in scales:
                claim.add(results.partitions[(scalar, "padded", scale)][field], f"box of {scale_name(scale)}")
            claims.append(claim)
        claim = Claim(f"padded, {scalar} (expected to be wrong): points without exactly one extended owner, at every "
                      "scale", 1, "")
        for scale in measured:
            claim.add(results.partitions[(scalar, "padded", scale)]["wrong_extended"], f"box of {scale_name(scale)}")
        claims.append(claim)
    return claims


def claims_on_time(results):
    claims = []
    for scalar in SCALARS:
        for count in (10**4, 10**5, 10**6, 10**7):
            if count == 10**7 and count not in results.counts():
                continue
            claim = Claim(f"Batched owns on columns, {label(scalar)}, {power(count)} points: owns / plain read",
                          READ_LIMIT, at_least=False)
            claims.append(claim.add(read_ratio(results, scalar, "exact", "owns_columns", count), "border exact"))
    return [c for c in claims if c.values or "1e7" not in c.text]


def claims_on_drift(results):
    claims = []
    for scalar in ("lattice32", "lattice64"):
        claim = Claim(f"{label(scalar)}: error after a million wraps, in box lengths", 0, "", at_least=False)
        for (s, step, offset), found in results.errors.items():
            if s == scalar:
                claim.add(found["error"], f"origin at {offset}, {step} steps")
        claims.append(claim)
    return claims


def all_claims(results):
    return claims_on_partition(results) + claims_on_time(results) + claims_on_drift(results)


def read_ratio(results, scalar, border, operation, count):
    return quotient(results.median(scalar, border, operation, count),
                    results.median(scalar, "any", "plain_read", count))


# ---------------------------------------------------------------------------------------------------------------
# Charts


LEAST = 3e-5  # the row for "none" of the partition's chart: below the smallest share that can be counted


def partition_chart(results, field, title, pyplot):
    """The share of wrong points over the size of the box, for each scalar and border."""
    figure, axes = pyplot.subplots(figsize=(5.6, 4.0))
    axes.set(xscale="log", yscale="log", xlim=(1e-306, 1e306))  # else the margins overflow
    for scalar in VANISHES:
        for border in BORDERS:
            scales = results.scales(scalar, border)
            if not scales:
                continue
            rows = [results.partitions[(scalar, border, s)] for s in scales]
            shares = [max(row[field] / row["points"], LEAST) for row in rows]
            name, shade, marker = SCALARS[scalar]
            is_padded = border == "padded"
            axes.plot(scales, shares, color=shade, marker=marker, markersize=3.5 if is_padded else 6, linewidth=1.4,
                      linestyle="-" if is_padded else (0, (4, 2)), label=f"{border}, {name}",
                      markerfacecolor=shade if is_padded else "none", markevery=1 if is_padded else 4,
                      zorder=4 if is_padded else 3)
    axes.set(xlabel="edge of the box [m]", ylabel="wrong, of points chosen near faces")
    axes.set_ylim(LEAST / 1.7, 1.6)
    axes.set_yticks([LEAST, 1e-3, 1e-2, 1e-1, 1], ["0", "0.1 %", "1 %", "10 %", "100 %"])
    axes.set_xticks([1e-300, 1e-200, 1e-100, 1, 1e100, 1e200, 1e300],
                    ["1e-300", "1e-200", "1e-100", "1", "1e100", "1e200", "1e300"])
    axes.minorticks_off()
    axes.grid(True)
    axes.axhline(LEAST, color=GRID, linewidth=1.4, zorder=1)
    axes.set_title(title, loc="left")
    return figure, axes


def end_words(axes, height):
    """What becomes of LIGGGHTS' epsilon at the two ends."""
    axes.text(.02, height, "epsilon is larger\nthan the box", transform=axes.transAxes, fontsize=8.5, va="top")
    axes.text(.98, height, "epsilon vanishes\nbeside the faces", transform=axes.transAxes, fontsize=8.5, va="top",
              ha="right")


def partition_charts(results, pyplot):
    """[(title, svg)]: over all scales, and where the two ends meet."""
    charts = []
    for field, title, near in (("wrong_owned", "owns: points whose owners are not one inside, none outside", False),
                               ("wrong_owned", "The same, boxes of 1e-12 m to 1e12 m", True),
                               ("wrong_inside", "owns: points of the box itself that no rank owns, or two", True),
                               ("wrong_extended", "owns_extended: points whose owners are not one", False)):
        figure, axes = partition_chart(results, field, title, pyplot)
        if near:
            axes.set_xlim(2e-13, 5e12)
            axes.set_xticks([10.0**k for k in range(-12, 13, 4)],
                            ["1e-12", "1e-8", "1e-4", "1", "1e4", "1e8", "1e12"])
        if field == "wrong_owned":
            end_words(axes, .30)
        axes.legend(loc="upper center", bbox_to_anchor=(.5, -.17), ncol=2, frameon=False, fontsize=8, handlelength=3)
        charts.append(svg_of(figure, pyplot, title + (", near 1 m" if near else "")))
    return charts


def wrap_count_of_chart(results):
    """The N whose times the chart takes: the largest that stays in the caches."""
    counts = [n for n in results.counts() if results.median("double", "exact", "wrap_half_columns", n)]
    return max((n for n in counts if n <= 10**5), default=min(counts, default=None))


def has_accuracy_chart(results):
    return bool(results.errors) and wrap_count_of_chart(results) is not None


OFFSET_MARKERS = dict(zip(OFFSETS, ("o", "s", "^", "D")))
MARKER_SIZES = dict(zip(OFFSETS, (4, 6.5, 10, 13)))  # equal errors lie inside one another


def step_time(results, scalar, count):
    """ns per point of what a step asks: a wrap of all, where few are outside, and who is still mine."""
    found = [results.median(scalar, "exact", operation, count) for operation in ("owns_columns", "wrap_few_columns")]
    return sum(found) if all(f is not None for f in found) else None


def accuracy_chart(results, pyplot):
    """What a step costs against the error of a million wraps."""
    count = wrap_count_of_chart(results)
    points = []  # (ns, error, scalar, offset)
    for scalar in SCALARS:
        speed = step_time(results, scalar, count)
        for offset in OFFSETS:
            found = results.errors.get((scalar, "fine", offset))
            if speed and found:
                points.append((speed, found["error"], scalar, offset))
    least = min((error for _, error, *_ in points if error > 0), default=1e-10)
    zero = 10 ** (len_floor(least) - 2)
    figure, axes = pyplot.subplots(figsize=(5.6, 4.2))
    for speed, error, scalar, offset in points:
        axes.plot(speed, error or zero, color=SCALARS[scalar][1], marker=OFFSET_MARKERS[offset],
                  markersize=MARKER_SIZES[offset], markerfacecolor="none", markeredgewidth=1.6, linestyle="none",
                  zorder=4)
    speeds = [p[0] for p in points]
    axes.set(yscale="log", xscale="log",
             xlabel=f"ns per point: batched wrap, 1 % outside, and owns; {power(count)} points",
             ylabel="worst error after 1e6 wraps [box lengths]")
    axes.set_xlim(min(speeds) / 1.6, max(speeds) * 1.6)
    axes.set_ylim(zero / 3, 8)
    exponents = list(range(len_floor(least) - len_floor(least) % 2, 1, 2))
    axes.set_yticks([zero] + [10.0**e for e in exponents], ["0"] + [f"1e{e}" if e else "1" for e in exponents])
    ticks = [t for t in (.1, .2, .5, 1, 2, 5, 10, 20, 50) if min(speeds) / 1.6 < t < max(speeds) * 1.6]
    axes.set_xticks(ticks, [f"{t:g}" for t in ticks])
    axes.minorticks_off()
    axes.grid(True)
    axes.axhline(zero, color=GRID, linewidth=1.6, zorder=1)
    axes.axhline(.5, color=INK, linewidth=.8, linestyle=(0, (2, 3)))
    axes.annotate("half a box: the position is lost", (.02, .5), xycoords=("axes fraction", "data"), xytext=(0, 3),
                  textcoords="offset points", fontsize=7.5)
    marks = [axes.plot([], [], color=SCALARS[scalar][1], marker="s", markersize=8, linestyle="none",
                       label=label(scalar))[0] for scalar in dict.fromkeys(p[2] for p in points)]
    marks += [axes.plot([], [], color=INK, marker=OFFSET_MARKERS[offset], markersize=7, markerfacecolor="none",
                        markeredgewidth=1.4, linestyle="none", label=f"origin at {offset}")[0] for offset in OFFSETS]
    axes.legend(handles=marks, loc="center left", bbox_to_anchor=(1.01, .5), frameon=False, fontsize=8)
    axes.set_title("Speed against accuracy", loc="left")
    return figure


def len_floor(value):
    """The exponent of the power of ten below a value."""
    return int(f"{value:e}".split("e")[1])


# ---------------------------------------------------------------------------------------------------------------
# Sections of the page


def time_cell(results, *cell):
    return figure_cell(results.median(*cell))


def time_rows(results):
    """(scalar, border, operation), those that are measured."""
    rows = []
    for scalar in SCALARS:
        keys = {cell[:3] for cell in results.times if cell[0] == scalar}
        rows += [(scalar, border, operation) for border in BORDERS for operation in OPERATIONS
                 if (scalar, border, operation) in keys and not (operation.startswith("wrap") and "lattice" in scalar)]
        rows += [key for key in [(scalar, "any", "plain_read")] if key in keys]
    return rows


def time_table(results):
    counts = results.counts()
    head = ["Scalar", "Border", "Operation"]
    for count in counts:
        head += [f"{power(count)} points", "/ plain read"]
    rows = []
    for scalar, border, operation in time_rows(results):
        row = [label(scalar), "" if border == "any" else border, OPERATIONS.get(operation, "plain read of the columns")]
        for count in counts:
            row.append(time_cell(results, scalar, border, operation, count))
            row.append(ratio_cell(read_ratio(results, scalar, border, operation, count))
                       if operation.startswith("owns") else "<td></td>")
        rows.append(row)
    return table(head, rows)


def error_text(found):
    return "0" if found == 0 else f"{found:.1e}"


def error_cell(results, cell, field):
    if cell in results.refused:
        return f'<td title="{html.escape(results.refused[cell], quote=True)}">refused</td>'
    found = results.errors.get(cell)
    return f'<td class="figure">{error_text(found[field])}</td>' if found else "<td></td>"


def error_table(results):
    rows = []
    for step in STEPS:
        for scalar in SCALARS:
            if any(key[:2] == (scalar, step) for key in (*results.errors, *results.refused)):
                rows.append([step, label(scalar), "as held"] +
                            [error_cell(results, (scalar, step, offset), "error") for offset in OFFSETS])
                if scalar.startswith("lattice"):
                    rows.append([step, label(scalar), "read as a double"] +
                                [error_cell(results, (scalar, step, offset), "error_as_read") for offset in OFFSETS])
    return table(["Steps", "Scalar", "Position"] + [f"origin at {offset}" for offset in OFFSETS], rows)


def partition_table(results):
    rows = []
    for scalar in VANISHES:
        for scale in sorted(set(results.scales(scalar, "exact") + results.scales(scalar, "padded"))):
            row = [label(scalar), scale_name(scale)]
            for border in BORDERS:
                cell = (scalar, border, scale)
                found = results.partitions.get(cell)
                if cell in results.refused:
                    row += [f'<td title="{html.escape(results.refused[cell], quote=True)}">refused</td>', "", ""]
                else:
                    row += [f'<td class="figure">{found[f]:g}</td>' if found else "<td></td>"
                            for f in ("wrong_inside", "wrong_outside", "wrong_extended")]
            row.append(f'<td class="figure">{found["points"]:g}</td>' if found else "<td></td>")
            rows.append(row)
    return table(["Scalar", "Box [m]"] + [f"{b}: {f}" for b in BORDERS for f in ("inside", "outside", "extended")] +
                 ["points"], rows)


PARTITION_TEXT = (
    "Boxes [0, s) in one and two dimensions, in 4 and 7 parts, not periodic. Asked are all faces and cuts, the "
    "numbers next to them, and for each box 1000 random points inside and 1000 within a tenth of s outside. A point "
    "is wrong where its owners are not one inside the box and none outside. So the share is one of points chosen to be "
    "hard, not of particles. The padded faces, with the epsilon of LIGGGHTS, 1e-8 m, are wrong at both ends; between "
    "them still for what lies within epsilon outside. Their owns_extended gives the cut between the first two parts to "
    "both, and nobody what lies below a single part.")
TIME_TEXT = (
    "Three dimensions, 8 ranks (2 × 2 × 2), points in random order; median (its limits). Columns begin at cache "
    "lines. Each wrap moves the same points as the one before: two boxes, half a box apart, take turns. No point of a "
    "lattice is ever outside, so its wrap has nothing to do and is left out.")
DRIFT_TEXT = (
    "x ← wrap(x + d), with d between one and two box lengths, forwards or backwards, so that every step wraps; 64 "
    "particles in the box [origin, origin + 1); the worst error in box lengths, the shorter way round, against exact "
    f"arithmetic. Steps are drawn fine, {STEPS['fine']}, or coarse, {STEPS['coarse']}. Where a sum x + d is held "
    "exactly, a wrap loses nothing; what is lost elsewhere is the rounding of the sum. A lattice position loses "
    "nothing; read as a double, it is rounded once.")


def sections(results, pyplot):
    parts = ['<h2 id="domain">Domain: whose is x</h2>']
    if results.partitions:
        parts.append(f'<h3>One owner for each point</h3><p>{PARTITION_TEXT}</p><div class="charts">')
        parts += [f"<figure>{chart}</figure>" for chart in partition_charts(results, pyplot)]
        parts.append("</div>" + folded("Figures: wrong points", partition_table(results)))
    if results.times:
        parts.append(f"<h3>Nanoseconds per point</h3><p>{TIME_TEXT}</p>" + time_table(results))
    if results.errors:
        parts.append(f"<h3>A million wraps</h3><p>{DRIFT_TEXT}</p>")
        errors = error_table(results)
        if has_accuracy_chart(results):
            chart = svg_of(accuracy_chart(results, pyplot), pyplot, "Speed against accuracy")
            errors = f'<div class="charts"><figure>{chart}</figure><figure>{errors}</figure></div>'
        parts.append(errors)
    return "".join(parts)


# ---------------------------------------------------------------------------------------------------------------
# Tables for the README


def markdown(results):
    context = results.contexts[0]
    counts = results.counts()
    lines = [context_text(context, context["instruction_set"])]
    if results.times:
        lines += ["", f"ns per point, medians of {min(results.repetitions())} interleaved repetitions; in brackets, "
                  "the ratio to a plain read of the same columns.", "",
                  markdown_row(["scalar", "border", "operation", *map(power, counts)]),
                  "|" + "---|" * (3 + len(counts))]
        for scalar, border, operation in time_rows(results):
            cells = []
            for count in counts:
                value = results.median(scalar, border, operation, count)
                ratio = read_ratio(results, scalar, border, operation, count) if operation.startswith("owns") else None
                cells.append((figure_of(value) + (f" ({ratio:.2f}x)" if ratio else "")) if value else "")
            lines.append(markdown_row([label(scalar), "" if border == "any" else border,
                                       OPERATIONS.get(operation, "plain read"), *cells]))
    if results.errors:
        lines += ["", "Worst error after 1e6 wraps, in box lengths; fine steps.", "",
                  markdown_row(["scalar", *(f"origin at {offset}" for offset in OFFSETS)]),
                  "|" + "---|" * (1 + len(OFFSETS))]
        for scalar in SCALARS:
            cells = [(scalar, "fine", offset) for offset in OFFSETS]
            if any(c in results.errors for c in cells):
                lines.append(markdown_row([label(scalar)] + [
                    error_text(results.errors[c]["error"]) if c in results.errors else
                    "refused" if c in results.refused else "" for c in cells]))
    return "\n".join(lines) + "\n"
