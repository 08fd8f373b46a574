# SPDX-License-Identifier: MIT
"""Id maps: from a particle's global id to its local index."""
import html
import math
import os
import re
from collections import defaultdict

from .claims import Claim
from .drawing import Look, label_at, label_ends, legend, mark_upright, new_panel, panel, panels
from .page import context_text, figure_cell, folded, markdown_row, table
from .pictures import plain_ticks
from .reading import RoomResults
from .spread import apart, figure_of, limits, middle, power, quotient, runs_of_choice, spans_text

OWN = ("dense", "bitmap", "paged", "flat", "chained_mixed", "chained_mod_prime")
RIVALS = ("std_unordered_map", "boost_flat_map", "absl_flat_hash_map", "absl_prefetched")
LIGGGHTS = "chained_mod_prime"
DEFAULT = "adaptive"
DEFAULT_PORTABLE = "adaptive_portable"

LOOKS = {
    "dense": Look("dense", "vermilion", "s"),
    "bitmap": Look("bitmap", "purple", "D"),
    "paged": Look("paged", "orange", "p"),
    "flat": Look("flat", "blue", "o", width=2),
    "flat_portable": Look("flat, portable", "blue", "o", "--"),
    "chained_mixed": Look("chained, mixed", "green", "^", short="chained"),
    LIGGGHTS: Look("LIGGGHTS' scheme: chains, the id modulo a prime", "yellow", "v", short="LIGGGHTS"),
    DEFAULT: Look("adaptive, the default", "ink", "o", (0, (1, 1)), 1.2, short="adaptive", is_hollow=True),
    DEFAULT_PORTABLE: Look("adaptive, portable", "ink", "s", (0, (1, 1)), 1.2, is_hollow=True),
    "std_unordered_map": Look("std::unordered_map", "grey", "x", "-.", 1.1, short="std"),
    "boost_flat_map": Look("boost::unordered_flat_map", "sky", "+", "-.", 1.1, short="boost"),
    "absl_flat_hash_map": Look("absl::flat_hash_map", "grey", "1", ":", 1.3, short="absl"),
    "absl_prefetched": Look("absl::flat_hash_map, prefetched", "grey", "2", ":", 1.3, short="absl prefetched"),
    "oracle": Look("oracle: places known, the limit of random access", "ink", "", "--", 1, short="oracle"),
    "plain_array": Look("plain array", "ink", "*", ":", 1),
}
# They would lie upon others
IN_TABLES_ALONE = ("flat_portable", DEFAULT_PORTABLE, "absl_prefetched", "plain_array")
# For series of the user's own, in the order in which they come
GUESTS = (("P", "-"), ("X", "--"), ("<", "-."), (">", ":"), ("h", "-"))
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
# What charts 1 and 2 show; the appendix has the others.
MEASURES = {"find_hit": "Batched look-up, ns each", "find_single": "Single look-up, ns each",
            "rebuild": "Rebuild, ns per particle", "memory": "Memory, bytes per particle"}
# The patterns of chart 2, and what they are called there
PATTERNS = {
    "uniform": "uniform, to compare", "lattice": "fresh lattice", "hopper": "long run in a hopper",
    "mixed_slice": "slice of a rank, mixed", "block": "blocks of 1024", "strided": "every 8th",
    "clustered": "clustered, rank << 40", "rank_in_low_bits": "rank in the low bits",
    "random_62_bits": "62 random bits",
    "stride_2^6": "multiples of 2^6", "stride_2^12": "multiples of 2^12", "stride_2^20": "multiples of 2^20",
    "fibonacci_30": "multiples of 832040", "multiples_of_B": "multiples of the buckets",
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
            self.times[(*cell, operation[0])].append(1e9 / row["items_per_second"])
            self.memory[cell] = row["bytes_per_particle"]

    def is_empty(self):
        return not self.times

    def repetitions(self):
        return {len(t) for t in self.times.values()}

    def median(self, pattern, count, ratio, series, operation):
        """A Spread; None if not measured."""
        times = self.times.get((pattern, count, ratio, series, operation))
        return middle(times) if times else None

    def best(self, candidates, pattern, count, ratio, operation):
        """(median, series) of the fastest candidate, or None."""
        found = [(value, s) for s in candidates if s != "absl_prefetched" or operation in BATCHES
                 if (value := self.median(pattern, count, ratio, s, operation))]
        return min(found) if found else None

    def looks(self):
        """{series: Look} of all that have figures; those that are not known here come last."""
        present = dict.fromkeys([key[3] for key in self.times] + [key[3] for key in self.refused])
        guests = [s for s in present if s not in LOOKS]
        return {**{s: look for s, look in LOOKS.items() if s in present},
                **{s: Look(s, "red", *GUESTS[k % len(GUESTS)]) for k, s in enumerate(guests)}}

    def points(self, operation=None):
        """All (pattern, N, ratio), in the order of measurement."""
        return list(dict.fromkeys(key[:3] for key in self.times if operation in (None, key[4])))

    def counts(self, pattern="uniform"):
        return sorted({n for p, n, _ in self.points() if p == pattern})

    def ratios(self, count, pattern="uniform"):
        return sorted({r for p, n, r in self.points() if p == pattern and n == count})


def label(series):
    return LOOKS[series].label if series in LOOKS else series


def head_label(series):
    """Without what explains it, which stands in the legend."""
    return label(series).split(": ")[0]


def short_label(series):
    return LOOKS[series].short if series in LOOKS else series


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


def claims_against_liggghts(results):
    claims = []
    for operation, target in (("find_hit", 3.0), ("rebuild", 2.5)):
        claim = Claim(f"{OPERATIONS[operation][0]}: LIGGGHTS' scheme / default", target)
        for count in (10**5, 10**6, 10**7):
            for point in sparse_points(results, count):
                theirs = results.median(*point, LIGGGHTS, operation)
                claim.add(quotient(theirs, results.median(*point, DEFAULT, operation)), place_name(point),
                          quotient(theirs, results.median(*point, DEFAULT_PORTABLE, operation)))
        claims.append(claim)
    claim = Claim("Memory: LIGGGHTS' scheme / flat with 4-byte slots", 4.0)
    for count in (10**5, 10**6, 10**7):
        for point in sparse_points(results, count):
            if slot_bytes(results, point) == 4:
                claim.add(quotient(results.memory.get((*point, LIGGGHTS)), results.memory.get((*point, "flat"))),
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
    slow = Claim("LIGGGHTS' scheme on multiples of its bucket count: nodes visited per look-up (degenerate)", 1000, "")
    for cell, (visits, _) in results.degenerate.items():
        slow.add(visits, place_name(cell[:3]))
    return claims + [memory, slow]


def all_claims(results):
    return (claims_against_rivals(results) + claims_on_memory(results) + claims_against_liggghts(results) +
            claims_against_limit(results) + claims_on_default(results) + claims_on_patterns(results))


# ---------------------------------------------------------------------------------------------------------------
# Sweeps over T/N, of uniform ids


def drawn_looks(results):
    return {s: look for s, look in results.looks().items() if s not in IN_TABLES_ALONE}


def value_of(results, count, ratio, series, measure):
    if measure == "memory":
        return results.memory.get(("uniform", count, ratio, series))
    return results.median("uniform", count, ratio, series, measure)


def own_costs(results, count, measure):
    """ratio -> {table: cost} of our own tables; the default follows one of them and is no choice of its own."""
    return lambda ratio: {s: v for s in OWN if (v := value_of(results, count, ratio, s, measure))}


def choices(results, count, measure):
    """[(table, [T/N])]; of those within noise the one that takes least memory."""
    costs, memory = own_costs(results, count, measure), own_costs(results, count, "memory")
    return runs_of_choice(results.ratios(count), costs, memory)


def choice_text(results, count, measure):
    """dense up to T/N = 8 and flat from 64 on"""
    return spans_text(choices(results, count, measure), "T/N = ", short_label, power)


def crossing(x0, x1, a0, a1, b0, b1):
    """Where the lines a and b, straight on log-log paper, meet between x0 and x1; None if they do not."""
    d0, d1 = math.log(a0 / b0), math.log(a1 / b1)
    if d0 == d1 or d0 * d1 > 0:
        return None
    share = d0 / (d0 - d1)
    return math.exp(math.log(x0) + share * (math.log(x1) - math.log(x0)))


def crossings(results, count, measure):
    """[(T/N, better before, better after)] where the best of our own tables changes, and where dense and flat meet, if
    they differ beyond noise on both sides.

    A table that is refused at the next T/N is lost somewhere between: a limit, no crossing."""
    found = []
    costs, ratios = own_costs(results, count, measure), results.ratios(count)
    for x0, x1 in zip(ratios, ratios[1:]):
        v0, v1 = costs(x0), costs(x1)
        pairs = [("dense", "flat"), ("flat", "dense")]
        if v0 and v1:
            pairs.insert(0, (min(v0, key=v0.get), min(v1, key=v1.get)))
        for before, after in dict.fromkeys(pairs):
            if before == after or not all(s in v for s in (before, after) for v in (v0, v1)):
                continue
            if v0[before] < v0[after] and all(apart(v[before], v[after]) for v in (v0, v1)):
                x = crossing(x0, x1, v0[before], v1[before], v0[after], v1[after])
                if x:
                    found.append((x, before, after))
    return sorted(found)


def draw_sweep(axes, results, count, measure, marked=2):
    """With the first `marked` crossings of our own tables."""
    ratios = results.ratios(count)
    ends = []
    for series, look in drawn_looks(results).items():
        points = [(r, v) for r in ratios if (v := value_of(results, count, r, series, measure))]
        if not points or (series == "oracle" and measure == "memory"):
            continue
        axes.plot(*zip(*points), **look.style(zorder=4 if series == DEFAULT else 3))
        if measure != "memory" and len(points) > 1:
            axes.fill_between([r for r, _ in points], [limits(v)[0] for _, v in points],
                              [limits(v)[1] for _, v in points], color=look.colour, alpha=.13, linewidth=0, zorder=1)
        if points[-1][0] == ratios[-1]:
            ends.append((*points[-1], look.short, look.colour))
        else:  # refused from here on
            label_at(axes, points[-1], look.short, look.colour)
    axes.set(xscale="log", yscale="log")
    axes.set_xlabel("T/N", fontsize=9, labelpad=1)
    axes.set_xticks(ratios, [power(r) for r in ratios])
    axes.minorticks_off()
    plain_ticks(axes.yaxis)
    for k, (x, before, after) in enumerate(crossings(results, count, measure)[:marked]):
        is_right = axes.transAxes.inverted().transform(axes.transData.transform((x, 1)))[0] > .5
        at = figure_of(x) if x < 1000 else f"{x:.1e}".replace("e+0", "e")
        mark_upright(axes, x, f"{short_label(before)} → {short_label(after)} at {at}", row=k,
                     side="right" if is_right else "left", line=(0, (1, 3)))
    label_ends(axes, ends)


def sweep_panel(results, count, measure, title, pyplot):
    figure, axes = new_panel(pyplot)
    draw_sweep(axes, results, count, measure)
    return panel(figure, pyplot, f"{title}: {power(count)} particles")


def sweep_counts(results):
    """Of the uniform ids: those sizes for which there is a sweep."""
    return [n for n in results.counts() if len(results.ratios(n)) > 1]


def sweep_table(results, count, measure):
    """All series that have a figure there, or are refused."""
    ratios = results.ratios(count)
    rows = []
    for series, look in results.looks().items():
        if series == "absl_prefetched" and measure not in BATCHES:  # where it is the plain map
            continue
        cells = [spread_cell(results, ("uniform", count, r), series, measure) for r in ratios]
        if any(cell != "<td></td>" for cell in cells):
            rows.append([look.label, *cells])
    return table(["T/N"] + [power(r) for r in ratios], rows)


def pattern_points(results):
    """{N: [patterns]} at T/N = 8, in the order of measurement."""
    found = defaultdict(list)
    for pattern, count, ratio in results.points("find_hit"):
        if ratio == 8 and pattern != "file":
            found[count].append(pattern)
    return {n: patterns for n, patterns in sorted(found.items()) if len(patterns) > 1}


def pattern_size(results):
    """Of chart 2: the size at which most patterns were measured; None if none were."""
    points = pattern_points(results)
    return max(points, key=lambda n: len(points[n])) if points else None


def pattern_table(results, count, patterns, measure):
    """Of {pattern: what it is called}; empty if nothing was measured."""
    rows, present = {}, {}
    for series in results.looks():
        if series == "absl_prefetched" and measure not in BATCHES:
            continue
        cells = [spread_cell(results, (p, count, 8), series, measure) for p in patterns]
        if any('class="figure"' in cell for cell in cells):
            present[series] = head_label(series)
            for pattern, cell in zip(patterns, cells):
                rows.setdefault(pattern, []).append(cell)
    if not present:
        return ""
    return table(["Pattern", *present.values()], [[patterns[p], *cells] for p, cells in rows.items()])


# ---------------------------------------------------------------------------------------------------------------
# Sections of the page


def spread_cell(results, point, series, operation):
    if operation == "memory":
        held = results.memory.get((*point, series))
        if held:
            return f'<td class="figure">{figure_of(held)}</td>'
    time = results.median(*point, series, operation)
    if time:
        return figure_cell(time)
    cell = (*point, series)
    if cell in results.refused:
        return f'<td title="{html.escape(results.refused[cell], quote=True)}">refused</td>'
    if cell in results.degenerate:
        visits, nanoseconds = results.degenerate[cell]
        measured = f", {figure_of(nanoseconds)} ns" if nanoseconds and operation == "rebuild" else ""
        return f"<td>degenerate: {visits:.0f} nodes{measured}</td>"
    return "<td></td>"


def sweep_section(results, pyplot):
    """Charts and tables of the operations that chart 1 has not."""
    operations = [o for o in OPERATIONS if o not in MEASURES and any(key[0] == "uniform" and key[4] == o
                                                                     for key in results.times)]
    parts = []
    if sweep_counts(results) and operations:
        parts = ["<h3>Other operations on uniform ids</h3>", legend(drawn_looks(results).values(), pyplot),
                 panels(sweep_panel(results, n, o, OPERATIONS[o][0], pyplot) for o in operations
                        for n in sweep_counts(results) if any(key[:2] == ("uniform", n) and key[4] == o
                                                              for key in results.times))]
    for count in reversed(results.counts()):
        is_sweep = count in sweep_counts(results)
        shown = operations if is_sweep else [*operations, *MEASURES]  # of a single T/N chart 1 has nothing
        parts += [folded(f"{what_of(o)}, {power(count)} particles", sweep_table(results, count, o)) for o in shown]
    return "".join(parts)


def what_of(measure):
    if measure == "memory":
        return MEASURES["memory"]
    return f"{', '.join(OPERATIONS[measure])}: median (its limits)"


def pattern_section(results):
    """Tables of the sizes, patterns and operations that chart 2 has not."""
    parts = []
    for count, patterns in pattern_points(results).items():
        for measure in ("find_hit", "find_half", "find_single", "rebuild", "memory"):
            is_shown = count == pattern_size(results) and measure in MEASURES
            content = pattern_table(results, count, {p: PATTERNS.get(p, p) for p in patterns
                                                     if not (is_shown and p in PATTERNS)}, measure)
            if content:
                parts.append(folded(f"{what_of(measure)}, {power(count)} particles", content))
    return "<h3>Other patterns and sizes, T/N = 8</h3>" + "".join(parts) if parts else ""


def file_section(results):
    """The ids of the user's own file: a table of everything."""
    parts = []
    for point in [p for p in results.points() if p[0] == "file"]:
        operations = [o for o in OPERATIONS if any((*point, s, o) in results.times for s in results.looks())]
        present = {s: look for s, look in results.looks().items()
                   if (*point, s) in results.memory or (*point, s) in results.refused}
        rows = [[look.label] + [spread_cell(results, point, s, o) for o in operations + ["memory"]]
                for s, look in present.items()]
        parts.append(f"<p>{point[1]} owned particles, T/N = {point[2]}; ns, bytes per particle.</p>" +
                     table(["Map"] + operations + ["memory"], rows))
    if not parts:
        return ""
    name = next((c["ids_file"] for c in results.contexts if c.get("ids_file")), "a file")
    return f'<h3 id="file">The ids of {html.escape(os.path.basename(name))}</h3>' + "".join(parts)


TITLE = "id maps"
INTRODUCTION = ("From a particle's global id to its local index: our storage policies, maps of other libraries, and an "
                "oracle: a table of 8 bytes per id whose places are known, which is the limit that random access sets. "
                "N owned particles and 20 % ghosts (5 % images of owned ones); 64-bit ids; one thread's CPU time.")
CLAIM_NOTE = ("Portable: the default without vector instructions, at the worst of the same points. LIGGGHTS' scheme: "
              "chains, the id modulo a prime.")


def sections(results, pyplot):
    return file_section(results) + sweep_section(results, pyplot) + pattern_section(results)


# ---------------------------------------------------------------------------------------------------------------
# Tables for the README


def markdown(results):
    context = results.contexts[0]
    columns = [s for s in (DEFAULT, DEFAULT_PORTABLE, "flat", "dense", LIGGGHTS, *RIVALS, "oracle")
               if any(key[3] == s for key in results.times)]
    lines = [f"{context_text(context, context['instruction_set'])} Uniform 64-bit ids, T/N = 8; ns per particle or "
             f"look-up, medians of {min(results.repetitions())} interleaved repetitions.", "",
             markdown_row(["operation", "N", *(head_label(s) for s in columns), "best rival / default"]),
             "|" + "---|" * (len(columns) + 3)]
    for operation in ("rebuild", "update", "find_hit", "find_half", "find_near", "find_single", "find_dependent"):
        for count in results.counts():
            point = ("uniform", count, 8)
            values = [results.median(*point, s, operation) for s in columns]
            rival = results.best(RIVALS, *point, operation)
            gain = quotient(rival and rival[0], results.median(*point, DEFAULT, operation))
            if any(values):
                lines.append(markdown_row([OPERATIONS[operation][0], power(count),
                                           *(figure_of(v) if v else "" for v in values),
                                           f"{gain:.2f}x" if gain else ""]))
    for count in results.counts():
        held = [results.memory.get(("uniform", count, 8, s)) for s in columns]
        lines.append(markdown_row(["bytes per particle", power(count), *(figure_of(v) if v else "" for v in held), ""]))
    lines += [""] + [f"- {power(n)} particles, {MEASURES[m].split(',')[0].lower()}: {text}." for n in results.counts()
                     for m in MEASURES if (text := choice_text(results, n, m))]
    return "\n".join(lines) + "\n"
