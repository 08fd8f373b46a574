# SPDX-License-Identifier: MIT
"""The particle store: what a layout costs beside the same by hand, what a sort saves, what growth copies."""
from collections import defaultdict

from .claims import Claim
from .drawing import Look
from .page import context_text, escaped, figure_cell, folded, markdown_row, ratio_cell, table
from .pictures import GRID, INK, colour, svg_of
from .reading import RoomResults
from .spread import as_good, figure_of, listed, middle, power, quotient

LOOKS = {"soa": Look("soa, the default: an array per field", "blue", "o", short="soa"),
         "aos": Look("aos: an array of records", "vermilion", "s", "--", short="aos"),
         "aosoa16": Look("aosoa<16>: blocks of 16", "green", "^", "-.", short="aosoa<16>")}
# name: (title, unit, what is done, in a sentence)
OPERATIONS = {
    "update": ("Position and velocity update", "ns per particle", "are moved"),
    "one_field": ("One field of all, r ← c r", "ns per particle", "are asked for one field each"),
    "gather": ("Gather from 12 neighbours, sorted along a curve", "ns per particle", "look at their neighbours"),
    "pack": ("Full record packed, a third of the particles", "ns per packed particle", "are packed"),
    "permute": ("All fields permuted at random", "ns per particle", "are sorted"),
}
ORDERS = {"random": ("at random", ":"), "morton": ("Morton", "--"), "hilbert": ("Hilbert", "-")}
APPENDS = {
    "geometric": ("geometric_growth (default)", colour("blue"), "o"),
    "block": ("block_growth", colour("vermilion"), "s"),
    "std_vector": ("std::vector of records", colour("grey"), "x"),
}
FIELD_BYTES = 96  # id, position, velocity, force, radius, mass
RATIO_LIMIT = 1.05

TITLE = "particle store"
INTRODUCTION = (f"What a layout costs: particles of {FIELD_BYTES} bytes (id, position, velocity, force, radius, mass) "
                "in a store of each layout, beside arrays of the same layout written by hand. One thread's CPU time.")
CLAIM_NOTE = ("A store and its hand-written twin take turns, and each repetition gives a ratio of its own: for the "
              "store the limits are those of the median of these ratios, at 93 % or more.")


class Results(RoomResults):
    """Pairs by (layout, operation, N), gathers by (layout, order, N), orders by (curve, N), growth by (policy, N)."""

    def __init__(self):
        super().__init__()
        self.pairs = defaultdict(list)    # (ns of the store, ns by hand, their ratio), one per repetition
        self.bytes = {}                   # (layout, N): (bytes per place, bytes per particle)
        self.carried = defaultdict(list)  # (layout, operation, bytes per particle, N): ns
        self.gathers = defaultdict(list)  # ns per particle
        self.orders = defaultdict(list)   # ns per particle
        self.copies = {}                  # elements copied, reallocations
        self.appends = defaultdict(list)  # ns per append

    def measured(self):
        return self.pairs, self.carried, self.gathers, self.orders, self.appends

    def add(self, row):
        _, kind, *words, last = row["name"].split("/")
        cell = (*words, int(last.split(":")[1]))
        if kind == "carried":
            cell = (cell[0], cell[1], int(cell[2]), cell[3])
        if kind == "growth":
            self.copies.setdefault(cell, (row["copied"], row["reallocations"]))
        elif cell in self.already:  # of two runs of one cell the first counts
            return
        elif kind == "pair":
            self.pairs[cell].append((row["store_ns"], row["by_hand_ns"], row["ratio"]))
            self.bytes[(cell[0], cell[-1])] = (row["bytes_per_place"], row["bytes_per_particle"])
        elif kind == "carried":
            self.carried[cell].append(row["real_time"])
        elif kind == "sorted":
            self.gathers[cell].append(1e9 / row["items_per_second"])
        elif kind == "order":
            self.orders[cell].append(1e9 / row["items_per_second"])
        elif kind == "append":
            self.appends[cell].append(row["ns_per_append"])

    def is_empty(self):
        return not (self.pairs or self.carried or self.gathers or self.copies)

    def repetitions(self):
        return {len(t) for cells in (self.pairs, self.carried, self.gathers) for t in cells.values()}

    def time(self, layout, operation, count):
        """Of the store; a Spread, or None if not measured."""
        found = self.pairs.get((layout, operation, count))
        return middle([store for store, *_ in found]) if found else None

    def time_by_hand(self, layout, operation, count):
        found = self.pairs.get((layout, operation, count))
        return middle([hand for _, hand, _ in found]) if found else None

    def ratio(self, layout, operation, count):
        """Store / by hand, of the turns that they took one after the other."""
        found = self.pairs.get((layout, operation, count))
        return middle([ratio for *_, ratio in found]) if found else None

    def carried_time(self, layout, operation, size, count):
        found = self.carried.get((layout, operation, size, count))
        return middle(found) if found else None

    def gather(self, layout, order, count):
        found = self.gathers.get((layout, order, count))
        return middle(found) if found else None

    def counts(self, operation=None):
        return sorted({n for _, o, n in self.pairs if operation in (None, o)})

    def sorted_counts(self):
        return sorted({n for _, _, n in self.gathers})


def label(layout):
    return LOOKS[layout].short


# ---------------------------------------------------------------------------------------------------------------
# Claims


def all_claims(results):
    claims = []
    for operation, (title, *_) in OPERATIONS.items():
        claim = Claim(f"{title}: store / by hand, same layout", RATIO_LIMIT, at_least=False)
        for count in results.counts(operation):
            for layout in LOOKS:
                claim.add(results.ratio(layout, operation, count), f"{label(layout)}, {power(count)}")
        claims.append(claim)
    memory = Claim("Memory of a place for a particle / the sizes of its fields", 1.01, at_least=False)
    for (layout, count), (per_place, _) in results.bytes.items():
        memory.add(per_place / FIELD_BYTES, f"{label(layout)}, {power(count)}")
    claims.append(memory)
    most = 10**8
    copied, reallocations = results.copies.get(("geometric", most), (None, None))
    claims.append(Claim("geometric_growth, 1e8 appends: reallocations", 25, "", at_least=False).add(
        reallocations, "counted"))
    claims.append(Claim("geometric_growth, 1e8 appends: elements copied per append", 3, "", at_least=False).add(
        copied and copied / most, "counted"))
    by_blocks = results.copies.get(("block", most), (None, None))[0]
    claims.append(Claim("block_growth, 1e8 appends (expected to be dear): elements copied per append", 3000, "").add(
        by_blocks and by_blocks / most, "counted"))
    return claims


# ---------------------------------------------------------------------------------------------------------------
# Charts


def place_counts(axes, counts):
    axes.set_xticks(counts, [power(n) for n in counts])
    axes.minorticks_off()
    axes.set_xlim(counts[0] / 1.6, counts[-1] * 1.6)


def place_times(axes, values):
    """1, 2, 5, 10, ... from below the lowest to above the highest."""
    low, high = min(values) / 1.25, max(values) * 1.25
    ticks = [m * 10.0**e for e in range(-3, 9) for m in ((1, 2, 5) if high / low < 200 else (1,))]
    ticks = [t for t in ticks if low <= t <= high]
    axes.set_ylim(low, high)
    axes.set_yticks(ticks, [f"{t:g}" for t in ticks])
    axes.minorticks_off()


def bars(axes, places, values, **style):
    """A line through the medians, with bars from the lower to the upper limit."""
    limits = [[v - v.low for v in values], [v.high - v for v in values]]
    return axes.errorbar(places, values, yerr=limits, elinewidth=.9, capsize=2, linewidth=1.5, **style)


def pair_chart(results, operation, pyplot):
    """ns over N: the store in full lines, by hand dashed; beside one another, since they would hide one another."""
    title, unit, _ = OPERATIONS[operation]
    counts = results.counts(operation)
    figure, axes = pyplot.subplots(figsize=(5.6, 3.3))
    axes.set(xscale="log", yscale="log", xlabel="particles", ylabel=unit)
    values = []
    for k, layout in enumerate(LOOKS):
        measured = [n for n in counts if (layout, operation, n) in results.pairs]
        if not measured:
            continue
        look = LOOKS[layout]
        ours = [results.time(layout, operation, n) for n in measured]
        theirs = [results.time_by_hand(layout, operation, n) for n in measured]
        shift = 1.12 ** (k - 1)
        bars(axes, [n * shift / 1.03 for n in measured], ours, color=look.colour, marker=look.marker, markersize=5,
             label=look.short, zorder=4)
        bars(axes, [n * shift * 1.03 for n in measured], theirs, color=look.colour, marker=look.marker, markersize=6.5,
             markerfacecolor="none", linestyle=(0, (4, 2)), alpha=.8, label=f"{look.short}, by hand", zorder=3)
        values += [v for pair in zip(ours, theirs) for v in pair]
    place_counts(axes, counts)
    place_times(axes, [v.low for v in values] + [v.high for v in values])
    axes.grid(True)
    axes.set_title(title, loc="left")
    axes.legend(loc="upper center", bbox_to_anchor=(.5, -.18), ncol=3, frameon=False, fontsize=8, handlelength=3)
    return figure


def ratio_chart(results, pyplot):
    """A row per operation and N, a mark per layout."""
    rows = [(operation, n) for operation in OPERATIONS for n in results.counts(operation)]
    figure, axes = pyplot.subplots(figsize=(5.6, .6 + .26 * len(rows)))
    highest = lowest = 1.0
    for layout, look in LOOKS.items():
        found = [(k, r) for k, (o, n) in enumerate(rows) if (r := results.ratio(layout, o, n))]
        if not found:
            continue
        shift = .24 * (list(LOOKS).index(layout) - 1)
        places, ratios = zip(*found)
        limits = [[r - r.low for r in ratios], [r.high - r for r in ratios]]
        axes.errorbar(ratios, [k + shift for k in places], xerr=limits, color=look.colour,
                      marker=look.marker, markersize=4.5, linestyle="none", elinewidth=1, label=look.short)
        highest = max(highest, *ratios, *(min(r.high, 1.5 * r) for r in ratios))
        lowest = min(lowest, *ratios, *(r.low for r in ratios))
    axes.axvline(1, color=INK, linewidth=.8)
    axes.axvline(RATIO_LIMIT, color=INK, linewidth=.8, linestyle=(0, (2, 3)))
    axes.annotate(f"promise: {RATIO_LIMIT:g}", (RATIO_LIMIT, 1), xycoords=("data", "axes fraction"), xytext=(3, 2),
                  textcoords="offset points", fontsize=7.5, annotation_clip=False)
    axes.set_xlim(max(lowest - .02, .6), min(max(highest + .02, 1.1), 1.6))
    names = [f"{operation.replace('_', ' ')}, {power(n)}" for operation, n in rows]
    axes.set_yticks(range(len(rows)), names)
    axes.set_ylim(len(rows) - .4, -.6)
    for k in range(1, len(rows)):
        if rows[k][0] != rows[k - 1][0]:
            axes.axhline(k - .5, color=GRID, linewidth=.8)
    axes.set_xlabel("store / by hand, of the same layout")
    axes.grid(True, axis="x")
    axes.set_title("Store / by hand", loc="left", pad=14)
    axes.legend(loc="upper center", bbox_to_anchor=(.5, -.6 / figure.get_figheight()), ncol=3, frameon=False,
                fontsize=8)
    return figure


def sort_chart(results, pyplot):
    """The gather over N, in three orders."""
    counts = results.sorted_counts()
    figure, axes = pyplot.subplots(figsize=(5.6, 3.6))
    axes.set(xscale="log", yscale="log", xlabel="particles", ylabel="ns per particle")
    values = []
    for k, (layout, look) in enumerate(LOOKS.items()):
        for order, (order_name, line) in ORDERS.items():
            found = [(n * 1.06 ** (k - 1), v) for n in counts if (v := results.gather(layout, order, n))]
            if found:
                places, times = zip(*found)
                axes.plot(places, times, color=look.colour, marker=look.marker, markersize=4.5, linestyle=line,
                          linewidth=1.4, markerfacecolor=look.colour if order == "hilbert" else "none",
                          label=f"{look.short}, {order_name}")
                values += times
    place_counts(axes, counts)
    place_times(axes, values)
    axes.grid(True)
    axes.set_title("Gather from 12 neighbours, by the order of the particles", loc="left")
    axes.legend(loc="upper center", bbox_to_anchor=(.5, -.16), ncol=3, frameon=False, fontsize=8, handlelength=3)
    return figure


def copies_chart(results, pyplot):
    """Elements copied over appends: counted, not timed."""
    figure, axes = pyplot.subplots(figsize=(5.6, 3.3))
    axes.set(xscale="log", yscale="log", xlabel="appends, one by one", ylabel="elements copied")
    for policy in ("geometric", "block"):
        name, shade, marker = APPENDS[policy]
        found = sorted((n, copied) for (p, n), (copied, _) in results.copies.items() if p == policy and copied > 0)
        if found:
            axes.plot(*zip(*found), color=shade, marker=marker, markersize=5, linewidth=1.5, label=name)
    counts = sorted({n for _, n in results.copies})
    by_blocks = results.copies.get(("block", 10**8))
    if by_blocks:
        axes.annotate(f"{by_blocks[0]:.1e}".replace("e+", "e"), (10**8, by_blocks[0]), xytext=(-8, 0),
                      textcoords="offset points", ha="right", va="center", fontsize=8.5)
    axes.plot(counts, counts, color=INK, linewidth=.8, linestyle=(0, (2, 3)), label="one per append")
    axes.grid(True)
    axes.minorticks_off()
    axes.set_title("What growth copies", loc="left")
    axes.legend(loc="upper center", bbox_to_anchor=(.5, -.18), ncol=3, frameon=False, fontsize=8, handlelength=3)
    return figure


def append_chart(results, pyplot):
    counts = sorted({n for _, n in results.appends})
    figure, axes = pyplot.subplots(figsize=(5.6, 3.3))
    axes.set(xscale="log", yscale="log", xlabel="appends, one by one", ylabel="ns per append")
    values = []
    for series, (name, shade, marker) in APPENDS.items():
        found = [(n, middle(results.appends[(series, n)])) for n in counts if (series, n) in results.appends]
        if found:
            places, times = zip(*found)
            bars(axes, places, times, color=shade, marker=marker, markersize=5, label=name)
            values += [v for t in times for v in (t.low, t.high)]
    place_counts(axes, counts)
    place_times(axes, values)
    axes.grid(True)
    axes.set_title("What an append takes", loc="left")
    axes.legend(loc="upper center", bbox_to_anchor=(.5, -.18), ncol=3, frameon=False, fontsize=8, handlelength=3)
    return figure


# ---------------------------------------------------------------------------------------------------------------
# Which layout when


def fastest(results, operation, count):
    """(layout, median) of those that are within noise of the fastest; the fastest first."""
    times = {layout: results.time(layout, operation, count) for layout in LOOKS}
    return [(layout, times[layout]) for layout in as_good(times)]


def strengths(results, layout):
    """{operation: [N]} where no other layout is faster."""
    found = {}
    for operation in OPERATIONS:
        counts = [n for n in results.counts(operation) if layout in dict(fastest(results, operation, n))]
        if counts:
            found[operation] = counts
    return found


def strength_text(results, operation, counts):
    everywhere = counts == results.counts(operation)
    name = operation.replace("_", " ")
    return name if everywhere else f"{name} at {listed([power(n) for n in counts])}"


def advantage(results, layout, operations):
    """The largest factor by which the layout beats soa, or soa beats it: (factor, operation, N)."""
    found = [(quotient(results.time("soa", o, n), results.time(layout, o, n)), o, n)
             for o in operations for n in results.counts(o)]
    found = [f for f in found if f[0]]
    return max(found, default=None, key=lambda f: f[0]), min(found, default=None, key=lambda f: f[0])


def choice_sentences(results):
    sentences = []
    ours = strengths(results, "soa")
    if ours:
        sentences.append("soa, the default, is as good as any in " +
                         listed([strength_text(results, o, n) for o, n in ours.items()]) + ".")
    for layout in LOOKS:
        if layout == "soa" or not any((layout, o) == key[:2] for key in results.pairs for o in OPERATIONS):
            continue
        better = {}  # where soa is not as good
        for operation, counts in strengths(results, layout).items():
            only = [n for n in counts if n not in ours.get(operation, [])]
            if only:
                better[operation] = only
        best, worst = advantage(results, layout, better)[0], advantage(results, layout, OPERATIONS)[1]
        loss = (f"soa takes {figure_of(1 / worst[0])} times as long at most" if worst[0] > 1 else
                f"it takes up to {figure_of(1 / worst[0])} times as long as soa ({worst[1].replace('_', ' ')}, "
                f"{power(worst[2])})")
        if better:
            sentences.append(f"Choose {label(layout)} when most of the time goes into " +
                             listed([strength_text(results, o, n) for o, n in better.items()]) +
                             f": soa takes up to {figure_of(best[0])} times as long there; elsewhere {loss}.")
        else:
            sentences.append(f"{label(layout)} is nowhere the only best one in this run; {loss}.")
    return sentences


# ---------------------------------------------------------------------------------------------------------------
# Sections of the page


def pair_table(results, operation):
    head = ["Particles"]
    for layout in LOOKS:
        head += [label(layout), "by hand", "ratio"]
    rows = []
    for count in results.counts(operation):
        row = [power(count)]
        for layout in LOOKS:
            found = results.pairs.get((layout, operation, count))
            if found:
                row += [figure_cell(middle([store for store, *_ in found])),
                        figure_cell(middle([hand for _, hand, _ in found])),
                        ratio_cell(results.ratio(layout, operation, count))]
            else:
                row += ["", "", ""]
        rows.append(row)
    return table(head, rows)


def fastest_table(results):
    rows = []
    for operation, (title, *_) in OPERATIONS.items():
        cells = []
        for count in results.counts():
            names = fastest(results, operation, count)
            cells.append(" ≈ ".join(label(layout) for layout, _ in names) +
                         (f", {figure_of(names[0][1])} ns" if names else ""))
        rows.append([title, *cells])
    return table(["Fastest", *(power(n) for n in results.counts())], rows)


def memory_table(results):
    rows = []
    for layout in LOOKS:
        found = {n: held for (l, n), held in results.bytes.items() if l == layout}
        if found:
            per_place = max(held[0] for held in found.values())
            rows.append([label(layout), figure_of(FIELD_BYTES), f"{per_place:.2f}", f"{per_place / FIELD_BYTES:.3f}x"] +
                        [figure_of(found[n][1]) if n in found else "" for n in results.counts()])
    return table(["Layout", "Sum of the fields", "Per place", "ratio", *(f"Held per particle, {power(n)}"
                                                                   for n in results.counts())], rows)


def sort_table(results):
    """What an order costs, what it saves with each gather, and after how many gathers it has paid."""
    rows = []
    for count in results.sorted_counts():
        for curve in ("morton", "hilbert"):
            if (curve, count) not in results.orders:
                continue
            order = middle(results.orders[(curve, count)])
            row = [power(count), ORDERS[curve][0], figure_cell(order)]
            for layout in LOOKS:
                before, after = (results.gather(layout, o, count) for o in ("random", curve))
                row.append(f"{figure_of(before)} → {figure_of(after)}" if before and after else "")
                moved = results.time(layout, "permute", count)
                saved = before - after if before and after else 0
                row.append(f"{max(1, round((order + moved) / saved))}" if moved and saved > .05 * before else
                           "–" if moved else "")
            rows.append(row)
    head = ["Particles", "Curve", "Order, ns"]
    for layout in LOOKS:
        head += [f"{label(layout)}: gather, ns", "pays after"]
    return table(head, rows)


def copies_table(results):
    rows = []
    for count in sorted({n for _, n in results.copies}):
        row = [power(count)]
        for policy in ("geometric", "block"):
            copied, reallocations = results.copies.get((policy, count), (None, None))
            row += [f'<td class="figure">{copied:.3g}</td>', f'<td class="figure">{reallocations:g}</td>']
        rows.append(row)
    return table(["Appends", "geometric: copied", "reallocations", "block: copied", "reallocations"], rows)


def append_table(results):
    rows = []
    for count in sorted({n for _, n in results.appends}):
        rows.append([power(count)] + [
            figure_cell(middle(results.appends[(series, count)])) if (series, count) in results.appends else "" for series in APPENDS])
    return table(["Appends, ns each"] + [name for name, *_ in APPENDS.values()], rows)


PAIR_TEXT = (
    "Particles on a cubic grid, sorted along a Hilbert curve. Each repetition builds a store and its hand-written twin "
    "in random order and lets them take turns; bars are the limits of the median, at 93 % or more. Both have their "
    "memory in huge pages and keep what they free, and loops begin at cache lines, so that only the code differs.")
SORT_TEXT = (
    "The same particles, in random order and sorted along two curves: what the order costs to compute "
    "(order_along), and the gather before and after. A sort has paid after as many gathers as the last columns tell: "
    "order and permutation over what each gather saves; “–” where it saves less than 5 %.")
GROWTH_TEXT = (
    "Particles appended one by one to an empty store. geometric_growth takes half as much again, block_growth one "
    "block of 16384 more, as LIGGGHTS does: its copies grow with the square, to 3e11 for 1e8 appends. Copies are "
    "counted; the times are of appends that were made, to a store of layout soa.")


def sections(results, pyplot):
    parts = ['<h2 id="store">Store: what a layout costs</h2>']
    if results.pairs:
        parts.append(f"<p>{PAIR_TEXT}</p><h3>Which layout when</h3><ul>" +
                     "".join(f"<li>{s}</li>" for s in map(escaped, choice_sentences(results))) + "</ul>" +
                     fastest_table(results) + '<h3>Beside the same by hand</h3><div class="charts">')
        for operation, (title, unit, _) in OPERATIONS.items():
            if results.counts(operation):
                parts.append(f"<figure>{svg_of(pair_chart(results, operation, pyplot), pyplot, title)}" +
                             folded(f"Figures: {unit}, median (its limits)", pair_table(results, operation)) +
                             "</figure>")
        parts.append(f"<figure>{svg_of(ratio_chart(results, pyplot), pyplot, 'Store / by hand')}</figure></div>")
        parts.append("<h3>Bytes per particle</h3><p>A place is one of the capacity, which is whole blocks of 16384."
                     "</p>" + memory_table(results))
    if results.gathers:
        parts.append(f'<h3>What a sort saves</h3><p>{SORT_TEXT}</p><div class="charts"><figure>' +
                     svg_of(sort_chart(results, pyplot), pyplot, "Gather by the order of the particles") +
                     f"</figure></div>{sort_table(results)}")
    if results.copies:
        parts.append(f'<h3>Growth</h3><p>{GROWTH_TEXT}</p><div class="charts"><figure>' +
                     svg_of(copies_chart(results, pyplot), pyplot, "What growth copies") +
                     folded("Figures: elements copied", copies_table(results)) + "</figure>")
        if results.appends:
            parts.append(f"<figure>{svg_of(append_chart(results, pyplot), pyplot, 'What an append takes')}" +
                         folded("Figures: ns per append, median (its limits)", append_table(results)) + "</figure>")
        parts.append("</div>")
    return "".join(parts)


# ---------------------------------------------------------------------------------------------------------------
# Tables for the README


def markdown_carried(results):
    count = max(n for *_, n in results.carried)
    sizes = sorted({size for _, _, size, n in results.carried if n == count})
    lines = [f"ns per particle, {power(count)} of them, by the bytes that each carries.", "",
             markdown_row(["operation", "layout", *(f"{size} bytes" for size in sizes)]),
             "|" + "---|" * (2 + len(sizes))]
    for operation, name in (("update", "update"), ("permute", "sort"), ("pack", "pack, per packed particle")):
        for layout in LOOKS:
            times = [results.carried_time(layout, operation, size, count) for size in sizes]
            lines.append(markdown_row([name, f"`{label(layout)}`", *(figure_of(t) if t else "" for t in times)]))
    return lines


def markdown(results):
    context = results.contexts[0]
    counts = results.counts()
    lines = [context_text(context)]
    if results.pairs:
        repetitions = min(len(t) for t in results.pairs.values())
        lines += ["", f"ns per particle, medians of {repetitions} repetitions; in brackets the ratio to the same by "
                  "hand.", "",
                  markdown_row(["operation", "layout", *map(power, counts)]), "|" + "---|" * (2 + len(counts))]
        for operation, (title, *_) in OPERATIONS.items():
            for layout in LOOKS:
                cells = [f"{figure_of(t)} ({results.ratio(layout, operation, n):.2f}x)"
                         if (t := results.time(layout, operation, n)) else "" for n in counts]
                lines.append(markdown_row([title, f"`{label(layout)}`", *cells]))
        lines += [""] + [f"- {sentence}" for sentence in choice_sentences(results)]
    if results.carried:
        lines += [""] + markdown_carried(results)
    if results.gathers:
        counts = results.sorted_counts()
        lines += ["", "ns per particle of a gather from 12 neighbours, by the order of the particles.", "",
                  markdown_row(["layout", "order", *map(power, counts)]), "|" + "---|" * (2 + len(counts))]
        for layout in LOOKS:
            for order, (name, _) in ORDERS.items():
                cells = [figure_of(t) if (t := results.gather(layout, order, n)) else "" for n in counts]
                lines.append(markdown_row([f"`{label(layout)}`", name, *cells]))
    return "\n".join(lines) + "\n"
