# SPDX-License-Identifier: MIT
"""Id maps: from a particle's global id to its local index."""
import html
import math
import os
import re
import statistics
from collections import defaultdict

from .page import (INK, Claim, Spread, figure_of, folded, markdown_row, plain_ticks, power,
                   quotient, spread_text, svg_of, table)
from .reading import RoomResults

OWN = ("dense", "bitmap", "paged", "flat", "chained_mixed", "chained_mod_prime")
RIVALS = ("std_unordered_map", "boost_flat_map", "absl_flat_hash_map", "absl_prefetched")
NOTES = "chained_mod_prime"  # the notes' scheme
DEFAULT = "adaptive"
DEFAULT_PORTABLE = "adaptive_portable"

# name: (label, colour, marker, line style, width). The colours have a luminance between those of both backgrounds;
# without colour, marker and line tell the series apart.
SERIES = {
    "dense": ("dense", "#d1603d", "s", "-", 1.6),
    "bitmap": ("bitmap", "#8a6fd1", "D", "-", 1.6),
    "paged": ("paged", "#b0873a", "p", "-", 1.6),
    "flat": ("flat", "#2a8fd0", "o", "-", 2.0),
    "flat_portable": ("flat, portable", "#2a8fd0", "o", "--", 1.2),
    "chained_mixed": ("chained, mixed", "#4fa35a", "^", "-", 1.4),
    "chained_mod_prime": ("chained, mod prime (LIGGGHTS' scheme)", "#c0508f", "v", "-", 1.4),
    "adaptive": ("adaptive (default)", INK, "O", "-", .9),
    "adaptive_portable": ("adaptive, portable", INK, "S", "--", .9),
    "std_unordered_map": ("std::unordered_map", "#888888", "x", "-.", 1.1),
    "boost_flat_map": ("boost::unordered_flat_map", "#2fa39b", "+", "-.", 1.1),
    "absl_flat_hash_map": ("absl::flat_hash_map", "#87922f", "1", "-.", 1.1),
    "absl_prefetched": ("absl, prefetched", "#87922f", "2", ":", 1.1),
    "oracle": ("oracle: places known", INK, "", ":", 1.6),
    "plain_array": ("plain array", INK, "*", "", 0),
}
# For policies of the user's own, in the order in which they come: colours and markers that no series above has.
GUESTS = (("#e2304a", "P"), ("#5a5fe8", "X"), ("#7ab317", "<"), ("#96694c", ">"), ("#d94fe0", "h"))
KNOWN = len(SERIES)
OPERATIONS = {
    "find_hit": ("Batched look-up, every id on the rank", "ns per look-up"),
    "find_half": ("Batched look-up, half of the ids elsewhere", "ns per look-up"),
    "find_near": ("Batched look-up, near-sequential ids", "ns per look-up"),
    "find_single": ("Single look-ups, independent", "ns per look-up"),
    "find_dependent": ("Single look-ups, each waits for the one before", "ns per look-up"),
    "rebuild": ("Rebuild with same-id links", "ns per particle"),
    "rebuild_without_links": ("Rebuild without links", "ns per particle"),
    "update": ("Update, 1 % of the entries changed", "ns per particle"),
}
BATCHES = ("find_hit", "find_half", "find_near")
HARD_PATTERNS = re.compile(r"multiples_of|stride_2|fibonacci|clustered|rank_in_low_bits|random_62_bits")


# ---------------------------------------------------------------------------------------------------------------
# Reading


class Results(RoomResults):
    """Medians and spreads by (pattern, N, ratio, series, operation)."""

    def __init__(self):
        super().__init__()
        self.times = defaultdict(list)  # ns per item, one per repetition
        self.memory = {}                # (pattern, N, ratio, series): bytes per particle
        self.refused = {}               # the same key: message
        self.degenerate = {}            # the same key: (visits per look-up, ns per particle of a rebuild or None)

    def measured(self):
        return (self.times,)

    def add(self, row):
        pattern, count, ratio, series, *operation = row["name"].split("/")
        cell = (pattern, int(count[2:]), int(ratio[6:]), series)
        if "refused" in row:
            self.refused[cell] = row["refused"]
        elif "degenerate" in row:
            if operation == ["rebuild"]:
                self.degenerate[cell] = (row["degenerate"], row.get("nanoseconds"))
        elif (*cell, operation[0]) not in self.already:  # of two runs of one cell the first counts
            if series not in SERIES:
                SERIES[series] = (series, *GUESTS[(len(SERIES) - KNOWN) % len(GUESTS)], "-", 1.6)
            self.times[(*cell, operation[0])].append(1e9 / row["items_per_second"])
            self.memory[cell] = row["bytes_per_particle"]

    def is_empty(self):
        return not self.times

    def repetitions(self):
        return {len(t) for t in self.times.values()}

    def median(self, pattern, count, ratio, series, operation):
        """A Spread; None if not measured."""
        times = self.times.get((pattern, count, ratio, series, operation))
        return Spread(statistics.median(times), min(times), max(times)) if times else None

    def best(self, candidates, pattern, count, ratio, operation):
        """(median, series) of the fastest candidate, or None."""
        found = [(value, s) for s in candidates if s != "absl_prefetched" or operation in BATCHES
                 if (value := self.median(pattern, count, ratio, s, operation))]
        return min(found) if found else None

    def points(self, operation=None):
        """All (pattern, N, ratio), in the order of measurement."""
        return list(dict.fromkeys(key[:3] for key in self.times if operation in (None, key[4])))

    def counts(self, pattern="uniform"):
        return sorted({n for p, n, _ in self.points() if p == pattern})

    def ratios(self, count, pattern="uniform"):
        return sorted({r for p, n, r in self.points() if p == pattern and n == count})


def label(series):
    return SERIES[series][0] if series in SERIES else series


def place_name(point):
    pattern, count, ratio = point
    return f"{pattern}, {power(count)}, T/N {power(ratio)}"


# ---------------------------------------------------------------------------------------------------------------
# Claims


def sparse_points(results, count):
    """Where the claims against the rivals are made."""
    return [p for p in results.points() if p[0] in ("uniform", "strided", "block", "clustered")
            and p[1] == count and p[2] >= 8]


def slot_bytes(results, point):
    """Of flat_storage: 4, 8 or 20 (with keys), from the memory that it took; None if not measured."""
    held = results.memory.get((*point, "flat"))
    return None if held is None else 4 if held < 12.5 else 8 if held < 19 else 20


def claims_against_rivals(results):
    claims = []
    speed = {"find_hit": {10**5: 2.0, 10**6: 2.2, 10**7: 1.9}, "find_half": {10**5: 3.0, 10**6: 2.5, 10**7: 2.0}}
    for operation, targets in speed.items():
        for count, target in targets.items():
            claim = Claim(f"{OPERATIONS[operation][0]}, {power(count)}: best rival / default", target)
            for point in sparse_points(results, count):
                rival = (results.best(RIVALS, *point, operation) or (None,))[0]
                claim.add(quotient(rival, results.median(*point, DEFAULT, operation)), place_name(point),
                          quotient(rival, results.median(*point, DEFAULT_PORTABLE, operation)))
            claims.append(claim)
    for count, narrow_target in {10**5: 1.6, 10**6: 1.6, 10**7: 2.3}.items():
        narrow = Claim(f"Rebuild with links, {power(count)}, 4-byte slots: best rival / default", narrow_target)
        wide = Claim(f"Rebuild with links, {power(count)}, wider slots: best rival / default", 1.4)
        for point in sparse_points(results, count):
            rival = (results.best(RIVALS, *point, "rebuild") or (None,))[0]
            (narrow if slot_bytes(results, point) == 4 else wide).add(
                quotient(rival, results.median(*point, DEFAULT, "rebuild")), place_name(point),
                quotient(rival, results.median(*point, DEFAULT_PORTABLE, "rebuild")))
        claims += [narrow, wide]
    return claims


def claims_on_memory(results):
    claims = []
    for width, target in ((4, 9.5), (8, 17.5)):
        claim = Claim(f"Memory of flat, {width}-byte slots", target, " B per particle", at_least=False)
        for count in (10**5, 10**6, 10**7):
            for point in sparse_points(results, count):
                if slot_bytes(results, point) == width:
                    claim.add(results.memory[(*point, "flat")], place_name(point))
        claims.append(claim)
    return claims


def claims_against_notes(results):
    claims = []
    for operation, target in (("find_hit", 3.0), ("rebuild", 2.5)):
        claim = Claim(f"{OPERATIONS[operation][0]}: notes' scheme / default", target)
        for count in (10**5, 10**6, 10**7):
            for point in sparse_points(results, count):
                notes = results.median(*point, NOTES, operation)
                claim.add(quotient(notes, results.median(*point, DEFAULT, operation)), place_name(point),
                          quotient(notes, results.median(*point, DEFAULT_PORTABLE, operation)))
        claims.append(claim)
    claim = Claim("Memory: notes' scheme / flat with 4-byte slots", 4.0)
    for count in (10**5, 10**6, 10**7):
        for point in sparse_points(results, count):
            if slot_bytes(results, point) == 4:
                claim.add(quotient(results.memory.get((*point, NOTES)), results.memory.get((*point, "flat"))),
                          place_name(point))
    return claims + [claim]


def claims_against_limit(results):
    targets = [("find_hit", 10**5, 2.2), ("find_hit", 10**6, 1.4), ("find_hit", 10**7, 1.5), ("rebuild", 10**6, 1.7),
               ("rebuild", 10**7, 1.0), ("find_dependent", 10**6, 1.25)]
    claims = []
    for operation, count, target in targets:
        point = ("uniform", count, 8)
        oracle = results.median(*point, "oracle", operation)
        claim = Claim(f"{OPERATIONS[operation][0]}, {power(count)}: default / oracle", target, at_least=False)
        claims.append(claim.add(quotient(results.median(*point, DEFAULT, operation), oracle), place_name(point),
                                quotient(results.median(*point, DEFAULT_PORTABLE, operation), oracle)))
    for operation in ("find_hit", "rebuild"):
        claim = Claim(f"{OPERATIONS[operation][0]}, T/N = 1: dense / plain array", 1.1, at_least=False)
        for count in results.counts():
            point = ("uniform", count, 1)
            claim.add(quotient(results.median(*point, "dense", operation),
                               results.median(*point, "plain_array", operation)), place_name(point))
        claims.append(claim)
    return claims


def claims_on_default(results):
    claims = []
    for operation in ("find_hit", "rebuild"):
        claim = Claim(f"{OPERATIONS[operation][0]}: default / best of our own, sweep of T/N", 1.1, at_least=False)
        for point in results.points(operation):
            own = results.best(OWN, *point, operation)
            if own and point[0] == "uniform":
                claim.add(quotient(results.median(*point, DEFAULT, operation), own[0]),
                          f"{place_name(point)}: {label(own[1])}")
        claims.append(claim)
    for count, target in ((10**4, None), (10**5, .9), (10**6, .9), (10**7, None)):
        claim = Claim(f"{OPERATIONS['find_single'][0]}, {power(count)}: best rival / default", target)
        for ratio in results.ratios(count):
            rival = results.best(RIVALS, "uniform", count, ratio, "find_single")
            if rival:
                claim.add(quotient(rival[0], results.median("uniform", count, ratio, DEFAULT, "find_single")),
                          f"{place_name(('uniform', count, ratio))}: {label(rival[1])}",
                          quotient(rival[0], results.median("uniform", count, ratio, DEFAULT_PORTABLE, "find_single")))
        claims.append(claim)
    return claims


def claims_on_patterns(results):
    claims = []
    for operation in ("find_hit", "rebuild"):
        claim = Claim(f"{OPERATIONS[operation][0]}: hard patterns / uniform, T/N 1024, default", 2.0, at_least=False)
        for pattern, count, ratio in results.points(operation):
            if HARD_PATTERNS.match(pattern) and ratio == 8:
                # Not at T/N 8: there the default is an array of the range, if that takes less than 8 MiB.
                uniform = [results.median("uniform", count, 1024, s, operation) for s in (DEFAULT, DEFAULT_PORTABLE)]
                here = [results.median(pattern, count, 8, s, operation) for s in (DEFAULT, DEFAULT_PORTABLE)]
                claim.add(quotient(here[0], uniform[0]), place_name((pattern, count, 8)), quotient(here[1], uniform[1]))
        claims.append(claim)
    memory = Claim("Memory of flat: hard patterns / uniform ids with slots of the same width", 1.05, at_least=False)
    for pattern, count, ratio in results.points("rebuild"):
        if HARD_PATTERNS.match(pattern) and ratio == 8:
            grown = quotient(results.memory.get((pattern, count, 8, "flat")),
                             results.memory.get(("uniform", count, 8, "flat")))
            width = slot_bytes(results, (pattern, count, 8))
            if grown:
                memory.add(grown / {4: 1, 8: 2, 20: 2.5}[width], place_name((pattern, count, 8)))
    slow = Claim("Notes' scheme on multiples of its bucket count: nodes visited per look-up (degenerate)", 1000, "")
    for cell, (visits, _) in results.degenerate.items():
        slow.add(visits, place_name(cell[:3]))
    return claims + [memory, slow]


def all_claims(results):
    return (claims_against_rivals(results) + claims_on_memory(results) + claims_against_notes(results) +
            claims_against_limit(results) + claims_on_default(results) + claims_on_patterns(results))


# ---------------------------------------------------------------------------------------------------------------
# Which policy to choose when

CHOICES = {"batched look-up": "find_hit", "single look-up": "find_single", "rebuild": "rebuild", "memory": None}


def own_values(results, point, operation):
    """{series: ns or bytes} of our own policies; the default follows one of them and is no choice of its own."""
    if operation is None:
        found = {s: results.memory.get((*point, s)) for s in OWN}
    else:
        found = {s: results.median(*point, s, operation) for s in OWN}
    return {s: value for s, value in found.items() if value}


def choice(results, point, operation):
    """[the best, and those within 5 % of it, which the noise does not tell apart]"""
    values = own_values(results, point, operation)
    if not values:
        return []
    least = min(values.values())
    return sorted((s for s, v in values.items() if v <= 1.05 * least), key=values.get)


def choice_cell(results, point, operation):
    chosen = choice(results, point, operation)
    if not chosen:
        return ""
    text = " ≈ ".join(label(s) for s in chosen)
    least = own_values(results, point, operation)[chosen[0]]
    text += f" · {figure_of(least)} {'B' if operation is None else 'ns'}"
    rival = results.best(RIVALS, *point, operation) if operation else None
    if rival and rival[0] < least / 1.05:
        text += f" ({label(rival[1])}: {figure_of(rival[0])})"
    return text


def choice_sentence(results, count, what, operation):
    """For 1e5 ids, batched look-up: dense up to T/N = 2, flat from 8 on."""
    runs = []  # [series, first ratio, last ratio]
    for ratio in results.ratios(count):
        chosen = choice(results, ("uniform", count, ratio), operation)
        if not chosen:
            continue
        if runs and runs[-1][0] in chosen:
            runs[-1][2] = ratio
        else:
            runs.append([chosen[0], ratio, ratio])
    parts = []
    for k, (series, first, last) in enumerate(runs):
        if len(runs) == 1:
            span = "everywhere"
        elif k == 0:
            span = f"at T/N = {power(last)}" if first == last else f"up to T/N = {power(last)}"
        elif k == len(runs) - 1:
            span = f"from {power(first)} on"
        else:
            span = f"at {power(first)}" if first == last else f"from {power(first)} to {power(last)}"
        parts.append(f"{label(series)} {span}")
    return f"{power(count)} particles, {what}: {', '.join(parts)}."


# ---------------------------------------------------------------------------------------------------------------
# Charts


def crossing(x0, x1, a0, a1, b0, b1):
    """Where the lines a and b, straight on log-log paper, meet between x0 and x1; None if they do not."""
    d0, d1 = math.log(a0 / b0), math.log(a1 / b1)
    if d0 == d1 or d0 * d1 > 0:
        return None
    share = d0 / (d0 - d1)
    return math.exp(math.log(x0) + share * (math.log(x1) - math.log(x0)))


def crossings(results, count, operation):
    """[(T/N, better before, better after)] where the best of our own policies changes, and where dense and flat meet.

    A policy that is refused at the next T/N is lost somewhere between: a limit, no crossing.
    """
    found = []
    ratios = results.ratios(count)
    for x0, x1 in zip(ratios, ratios[1:]):
        v0, v1 = (own_values(results, ("uniform", count, x), operation) for x in (x0, x1))
        pairs = [("dense", "flat"), ("flat", "dense")]
        if v0 and v1:
            pairs.insert(0, (min(v0, key=v0.get), min(v1, key=v1.get)))
        for before, after in dict.fromkeys(pairs):
            if before == after or not all(s in v for s in (before, after) for v in (v0, v1)):
                continue
            if v0[before] < v0[after]:
                x = crossing(x0, x1, v0[before], v1[before], v0[after], v1[after])
                if x:
                    found.append((x, before, after))
    return found


def style_of(series):
    _, colour, marker, line, width = SERIES.get(series, (series, "#888888", ".", "-", 1))
    style = {"color": colour, "marker": marker, "linestyle": line or "none", "linewidth": width, "markersize": 5,
             "label": label(series)}
    if marker in ("O", "S"):  # a ring or a frame around the policy that it follows
        style.update(marker=marker.lower(), markersize=9, markerfacecolor="none")
    if series == "flat_portable":
        style.update(markerfacecolor="none")
    if marker in "x+12":
        style.update(markersize=7)
    return style


def drawn_series(results, count, operation):
    """Those with figures; the prefetching wrapper only where it differs from the plain map."""
    return [s for s in SERIES if (s != "absl_prefetched" or operation in BATCHES) and
            any(sweep_value(results, count, r, s, operation) for r in results.ratios(count))]


def sweep_value(results, count, ratio, series, operation):
    if operation == "memory":
        return results.memory.get(("uniform", count, ratio, series))
    return results.median("uniform", count, ratio, series, operation)


def sweep_chart(results, count, operation, title, unit, pyplot):
    figure, axes = pyplot.subplots(figsize=(5.6, 4.2))
    ratios = results.ratios(count)
    for series in drawn_series(results, count, operation):
        points = [(r, v) for r in ratios if (v := sweep_value(results, count, r, series, operation))]
        style = style_of(series)
        if len(points) == 1 and not style["marker"]:
            style.update(marker="_", markersize=14, markeredgewidth=1.6)  # a line needs two points to be seen
        axes.plot(*zip(*points), **style, zorder=4 if series.startswith(DEFAULT) else 3)
    axes.set(xscale="log", yscale="log", xlabel="T/N: range of the ids per id", ylabel=unit)
    if len(ratios) == 1:
        axes.set_xlim(ratios[0] / 2, ratios[0] * 2)
    axes.set_xticks(ratios, [power(r) for r in ratios])
    axes.minorticks_off()
    plain_ticks(axes.yaxis)
    axes.grid(True)
    meetings = sorted(crossings(results, count, None if operation == "memory" else operation))
    for k, (x, before, after) in enumerate(meetings):
        axes.axvline(x, color=INK, linewidth=.8, linestyle=(0, (2, 3)))
        axes.annotate(f"{label(before)} → {label(after)}: {figure_of(x)}", (x, 1.01 + .045 * (len(meetings) - 1 - k)),
                      xycoords=("data", "axes fraction"), fontsize=7.5, ha="left")
    axes.set_title(title, pad=6 + 12 * len(meetings), loc="left")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, .5), frameon=False, fontsize=8, handlelength=3)
    return svg_of(figure, pyplot, f"{title}, {power(count)} particles")


def pattern_points(results):
    """{N: [patterns]} at T/N = 8, in the order of measurement."""
    found = defaultdict(list)
    for pattern, count, ratio in results.points("find_hit"):
        if ratio == 8 and pattern != "file":
            found[count].append(pattern)
    return {n: patterns for n, patterns in sorted(found.items()) if len(patterns) > 1}


def pattern_chart(results, count, patterns, pyplot):
    operations = ("find_hit", "rebuild")
    figure, pair = pyplot.subplots(1, 2, sharey=True, figsize=(11, 1.6 + .3 * len(patterns)))
    rows = range(len(patterns))
    handles = {}
    for axes, operation in zip(pair, operations):
        for series in SERIES:
            if series == "absl_prefetched" and operation not in BATCHES:
                continue
            points = [(v, k) for k, p in enumerate(patterns) if (v := results.median(p, count, 8, series, operation))]
            if not points:
                continue
            style = style_of(series)
            if series == "oracle":
                style["marker"] = "|"
            if "portable" in series:
                style.update(markerfacecolor="none", alpha=.55)
            style["linestyle"] = "none"
            handles.setdefault(series, axes.plot(*zip(*points), **style)[0])
        axes.set(xscale="log", xlabel=OPERATIONS[operation][1])
        axes.set_title(OPERATIONS[operation][0], loc="left")
        base = results.median("uniform", count, 1024, DEFAULT, operation)
        if base:
            axes.axvline(2 * base, color=INK, linewidth=.8, linestyle=(0, (2, 3)))
            axes.annotate("2 × uniform, T/N 1024, default", (2 * base, 1.0), fontsize=7.5,
                          xycoords=("data", "axes fraction"), va="bottom", ha="center", annotation_clip=False)
            axes.set_title(OPERATIONS[operation][0], loc="left", pad=16)
        mark_degenerate(axes, results, count, patterns)
        plain_ticks(axes.xaxis)
        axes.grid(True, axis="both")
    pair[0].set_yticks(list(rows), patterns)
    pair[0].set_ylim(len(patterns) - .4, -.6)
    figure.subplots_adjust(wspace=.2)
    figure.legend(handles.values(), [h.get_label() for h in handles.values()], loc="upper center", ncol=4,
                  frameon=False, fontsize=8, bbox_to_anchor=(.5, .11 - .55 / figure.get_figheight()))
    return svg_of(figure, pyplot, f"Patterns of ids, {power(count)} particles")


def mark_degenerate(axes, results, count, patterns):
    """An arrow beyond the right edge, where the notes' scheme is out of any scale."""
    for k, pattern in enumerate(patterns):
        if (pattern, count, 8, NOTES) in results.degenerate:
            visits = f"{results.degenerate[(pattern, count, 8, NOTES)][0]:,.0f}".replace(",", "\u202f")
            axes.annotate(f"▶ notes' scheme:\n   {visits} nodes", (1.005, k), ha="left", va="center", fontsize=7.5,
                          xycoords=("axes fraction", "data"), color=SERIES[NOTES][1], annotation_clip=False)


# ---------------------------------------------------------------------------------------------------------------
# Sections of the page


def spread_cell(results, point, series, operation):
    if operation == "memory":
        held = results.memory.get((*point, series))
        if held:
            return f'<td class="figure">{figure_of(held)}</td>'
    times = results.times.get((*point, series, operation))
    if times:
        return f'<td class="figure">{spread_text(times)}</td>'
    cell = (*point, series)
    if cell in results.refused:
        return f'<td title="{html.escape(results.refused[cell], quote=True)}">refused</td>'
    if cell in results.degenerate:
        visits, nanoseconds = results.degenerate[cell]
        measured = f", {figure_of(nanoseconds)} ns" if nanoseconds and operation == "rebuild" else ""
        return f"<td>degenerate: {visits:.0f} nodes{measured}</td>"
    return "<td></td>"


def sweep_table(results, count, operation):
    ratios = results.ratios(count)
    refusing = {s for (p, n, _, s) in results.refused if (p, n) == ("uniform", count)}
    rows = []
    for series in SERIES:
        if series in drawn_series(results, count, operation) or series in refusing:
            rows.append([label(series)] +
                        [spread_cell(results, ("uniform", count, r), series, operation) for r in ratios])
    return table(["T/N"] + [power(r) for r in ratios], rows)


def pattern_table(results, count, patterns, operation):
    present = [s for s in SERIES if any(results.median(p, count, 8, s, operation) for p in patterns)
               and (s != "absl_prefetched" or operation in BATCHES)]
    rows = [[p] + [spread_cell(results, (p, count, 8), s, operation) for s in present] for p in patterns]
    return table(["Pattern"] + [label(s) for s in present], rows)


def sweep_section(results, count, pyplot):
    parts = [f'<h2 id="n{count}">{power(count)} particles, uniform ids</h2><div class="charts">']
    charts = {o: v for o, v in OPERATIONS.items() if any((("uniform", count, r, s, o) in results.times)
                                                         for r in results.ratios(count) for s in SERIES)}
    charts["memory"] = ("Memory", "bytes per particle")
    for operation, (title, unit) in charts.items():
        parts.append("<figure>" + sweep_chart(results, count, operation, title, unit, pyplot) +
                     folded(f"Figures: {unit}" + (", median (lowest–highest)" if operation != "memory" else ""),
                            sweep_table(results, count, operation)) + "</figure>")
    return "".join(parts) + "</div>"


def pattern_section(results, pyplot):
    parts = ['<h2 id="patterns">Patterns of ids, T/N = 8</h2><p>Uniform ids, and those that simulations make. The '
             "dashed line is twice what the default takes for uniform ids. Patterns with a stride of their own "
             "ignore T/N.</p>"]
    for count, patterns in pattern_points(results).items():
        parts.append(f"<h3>{power(count)} particles</h3><figure>" + pattern_chart(results, count, patterns, pyplot))
        for operation in ("find_hit", "find_half", "find_single", "rebuild", "memory"):
            title, unit = OPERATIONS.get(operation, ("Memory", "bytes per particle"))
            if operation == "memory":
                present = [s for s in SERIES if any((p, count, 8, s) in results.memory for p in patterns)]
                rows = [[p] + [spread_cell(results, (p, count, 8), s, operation) for s in present] for p in patterns]
                content = table(["Pattern"] + [label(s) for s in present], rows)
            else:
                content = pattern_table(results, count, patterns, operation)
            parts.append(folded(f"Figures: {title}, {unit}", content))
        parts.append("</figure>")
    return "".join(parts) if len(parts) > 1 else ""


def file_section(results):
    """The ids of the user's own file: a table of everything."""
    parts = []
    for point in [p for p in results.points() if p[0] == "file"]:
        operations = [o for o in OPERATIONS if any((*point, s, o) in results.times for s in SERIES)]
        rows = [[label(s)] + [spread_cell(results, point, s, o) for o in operations + ["memory"]]
                for s in SERIES if (*point, s) in results.memory or (*point, s) in results.refused]
        parts.append(f"<p>{point[1]} owned particles, T/N = {point[2]}; ns, bytes per particle.</p>" +
                     table(["Map"] + operations + ["memory"], rows))
    if not parts:
        return ""
    name = next((c["ids_file"] for c in results.contexts if c.get("ids_file")), "a file")
    return f'<h2 id="file">The ids of {html.escape(os.path.basename(name))}</h2>' + "".join(parts)


def choice_section(results):
    parts = ['<h2 id="choose">Which policy when</h2><p>The best of our own policies for uniform ids, with those '
             "that are within 5 % of it (≈), which the noise does not tell apart; in brackets a rival that is "
             "faster still. The default picks among them at each rebuild.</p>"]
    for count in results.counts():
        rows = [[power(r)] + [choice_cell(results, ("uniform", count, r), o) for o in CHOICES.values()]
                for r in results.ratios(count)]
        sentences = [choice_sentence(results, count, what, o) for what, o in CHOICES.items()]
        parts.append(f"<h3>{power(count)} particles</h3>" + table(["T/N", *CHOICES], rows) + "<ul>" +
                     "".join(f"<li>{html.escape(s)}</li>" for s in sentences) + "</ul>")
    return "".join(parts)


TITLE = "id maps"
INTRODUCTION = ("From a particle's global id to its local index: our storage policies, maps of other libraries, and an "
                "oracle: a table of 8 bytes per id whose places are known, which is the limit that random access sets. "
                "N owned particles and 20 % ghosts (5 % images of owned ones); 64-bit ids; one thread's CPU time.")
CLAIM_NOTE = ("Portable: the default without vector instructions, at the worst of the same points. The notes' scheme "
              "is that of LIGGGHTS: chains, the id modulo a prime.")


def links(results):
    """[(anchor, text)] of the sections."""
    return ([("choose", "Which policy when")] + [(f"n{n}", f"{power(n)} particles") for n in results.counts()] +
            ([("patterns", "Patterns")] if pattern_points(results) else []))


def sections(results, pyplot):
    return (choice_section(results) + file_section(results) +
            "".join(sweep_section(results, n, pyplot) for n in results.counts()) + pattern_section(results, pyplot))


# ---------------------------------------------------------------------------------------------------------------
# Tables for the README


def markdown(results):
    context = results.contexts[0]
    columns = [s for s in (DEFAULT, DEFAULT_PORTABLE, "flat", "dense", NOTES, *RIVALS, "oracle")
               if any(key[3] == s for key in results.times)]
    lines = [f"{context['machine']}, {context['compiler']}, `{context['flags']}`, {context['instruction_set']}, "
             f"commit {context['commit']}. Uniform 64-bit ids, T/N = 8; ns per particle or look-up, medians of "
             f"{min(len(t) for t in results.times.values())} interleaved repetitions.", "",
             markdown_row(["operation", "N", *(label(s) for s in columns), "best rival / default"]),
             "|" + "---|" * (len(columns) + 3)]
    for operation in ("rebuild", "update", "find_hit", "find_half", "find_near", "find_single", "find_dependent"):
        for count in results.counts():
            point = ("uniform", count, 8)
            values = [results.median(*point, s, operation) for s in columns]
            rival = results.best(RIVALS, *point, operation)
            gain = quotient(rival and rival[0], results.median(*point, DEFAULT, operation))
            if any(values):
                lines.append(markdown_row([operation.replace("_", " "), power(count),
                                           *(figure_of(v) if v else "" for v in values),
                                           f"{gain:.2f}x" if gain else ""]))
    for count in results.counts():
        held = [results.memory.get(("uniform", count, 8, s)) for s in columns]
        lines.append(markdown_row(["bytes per particle", power(count), *(figure_of(v) if v else "" for v in held), ""]))
    lines += [""] + [f"- {choice_sentence(results, n, what, o)}"
                     for n in results.counts() for what, o in CHOICES.items()]
    return "\n".join(lines) + "\n"
