# SPDX-License-Identifier: MIT
"""Chart 2: the ids that simulations make."""
from ..drawing import legend, new_panel, panel, panels, tables
from ..id_map import DEFAULT, NOTES, RIVALS, pattern_points, spread_cell
from ..page import apart, figure_of, limits, plain_ticks, power, quotient, table
from .sparsity import LOOKS, label

ROOM = "id"
TITLE = "What if ids are as simulations make them?"
QUESTION = ("The same maps on the ids of a fresh lattice, of a hopper after a long run of insertion and deletion, of "
            "one rank's slice, and on strided and clustered ones of 64 bits; T/N = 8 where a pattern has no stride of "
            "its own. The left is best.")
ABSENT = "bench/run --only id"
# pattern: what it is called here; the others stand in the appendix
NAMES = {
    "uniform": "uniform, to compare", "lattice": "fresh lattice", "hopper": "long run in a hopper",
    "mixed_slice": "slice of a rank, mixed", "block": "blocks of 1024", "strided": "every 8th",
    "clustered": "clustered, rank << 40", "rank_in_low_bits": "rank in the low bits",
    "random_62_bits": "62 random bits",
    "stride_2^6": "multiples of 2^6", "stride_2^12": "multiples of 2^12", "stride_2^20": "multiples of 2^20",
    "fibonacci_30": "multiples of 832040", "multiples_of_B": "multiples of the buckets",
}
SERIES = ("flat", "dense", "bitmap", "paged", "chained_mixed", NOTES, DEFAULT, *RIVALS[:3], "oracle")
MEASURES = {"find_hit": "Batched look-up, ns each", "find_single": "Single look-up, ns each",
            "rebuild": "Rebuild, ns per particle", "memory": "Memory, bytes per particle"}


def size_of(results):
    """Where most patterns were measured."""
    points = pattern_points(results)
    return max(points, key=lambda n: len(points[n])) if points else None


def is_there(results):
    return size_of(results) is not None


def measured(results):
    """[pattern]"""
    present = pattern_points(results)[size_of(results)]
    return [p for p in NAMES if p in present]


def value_of(results, pattern, series, measure):
    cell = (pattern, size_of(results), 8, series)
    return results.memory.get(cell) if measure == "memory" else results.median(*cell, measure)


def pattern_panel(results, measure, pyplot):
    names = measured(results)
    rows = .205 * (len(names) + .8)  # inches; the last row is followed by a remark
    figure, axes = new_panel(pyplot, (4.1, rows + .4), (.36, .3 / (rows + .4), .59, rows / (rows + .4)))
    for series in SERIES:
        look = LOOKS[series]
        points = [(v, k) for k, p in enumerate(names) if (v := value_of(results, p, series, measure))]
        if not points or (series == "oracle" and measure == "memory"):
            continue
        if series == "oracle":
            axes.plot(*zip(*points), linestyle="none", marker="|", markersize=8, color=look.colour)
            continue
        axes.plot(*zip(*points), **look.style(linestyle="none", alpha=.95, zorder=4 if series == DEFAULT else 3,
                                              **({"markersize": 7.5} if series == DEFAULT else {})))
        for value, k in points:
            if measure != "memory" and series in ("flat", DEFAULT, *RIVALS):
                axes.plot(limits(value), [k, k], color=look.colour, linewidth=.8, alpha=.6, zorder=2)
    axes.set_xscale("log")
    axes.minorticks_off()
    plain_ticks(axes.xaxis)
    for k, pattern in enumerate(names):
        degenerate = results.degenerate.get((pattern, size_of(results), 8, NOTES))
        if degenerate and measure != "memory":
            axes.annotate(f"mod prime: {degenerate[0]:.0f} nodes ▶", (1, k + .75), xycoords=("axes fraction", "data"),
                          ha="right", va="center", fontsize=7.5, color=LOOKS[NOTES].colour)
    axes.set_yticks(range(len(names)), [NAMES[p] for p in names], fontsize=8.5)
    axes.set_ylim(len(names) + .3, -.5)
    axes.tick_params(axis="y", length=0)
    return panel(figure, pyplot, f"{MEASURES[measure]}: {power(size_of(results))} particles")


def drawn(results, pyplot):
    present = [LOOKS[s] for s in SERIES if any(key[3] == s for key in results.times)]
    return legend(present, pyplot) + panels(pattern_panel(results, m, pyplot) for m in MEASURES)


def sentence(results):
    names = measured(results)
    count = power(size_of(results))
    default, flat, best_rival = {}, {}, {}
    for p in names:
        default[p] = value_of(results, p, DEFAULT, "find_hit")
        flat[p] = value_of(results, p, "flat", "find_hit")
        rival = results.best(RIVALS, p, size_of(results), 8, "find_hit")
        best_rival[p] = rival and rival[0]
    default = {p: v for p, v in default.items() if v}
    if not default:
        return ""
    worst, least = max(default, key=default.get), min(default, key=default.get)
    text = (f"Whatever makes the ids, choose adaptive: at {count} a batched look-up takes {figure_of(default[least])} "
            f"ns ({NAMES[least]}) to {figure_of(default[worst])} ns ({NAMES[worst]})")
    ratios = [(quotient(best_rival[p], v), p) for p, v in default.items() if best_rival.get(p)]
    if ratios:
        beyond = [r for r, p in ratios if r > 1 and apart(best_rival[p], default[p])]
        low, high = min(ratios), max(ratios)
        text += (f", and the best rival {figure_of(low[0])} to {figure_of(high[0])} times that, beyond noise in "
                 f"{len(beyond)} of {len(ratios)} patterns")
    refused = [p for p in names if (p, size_of(results), 8, "dense") in results.refused]
    if refused:
        text += f"; dense is refused for {len(refused)} of {len(names)} patterns, whose range would not fit into memory"
    bad = [(visits, p) for (p, n, _, _), (visits, _) in results.degenerate.items()
           if n == size_of(results) and p in names]
    if bad:
        text += (f"; do not take ids modulo a prime: on {NAMES[max(bad)[1]]} a look-up visits {max(bad)[0]:.0f} nodes "
                 "of one chain")
    return text + "."


def figures(results):
    names, count = measured(results), size_of(results)
    parts = []
    for measure, title in MEASURES.items():
        present = [s for s in SERIES if any(value_of(results, p, s, measure) for p in names)]
        content = table(["Pattern"] + [label(s) for s in present],
                        [[NAMES[p]] + [spread_cell(results, (p, count, 8), s, measure) for s in present]
                         for p in names])
        spread = "" if measure == "memory" else ": median (lowest–highest)"
        parts.append((f"{title}, {power(count)} particles{spread}", content))
    return tables(parts)
