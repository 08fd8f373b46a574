# SPDX-License-Identifier: MIT
"""Chart 2: the ids that simulations make."""
from ..drawing import legend, new_panel, panel, panels, tables
from ..id_map import (DEFAULT, LIGGGHTS, LOOKS, MEASURES, PATTERNS, RIVALS, drawn_looks, pattern_points,
                      pattern_size, pattern_table)
from ..pictures import plain_ticks
from ..spread import apart, figure_of, limits, power, quotient

ROOM = "id"
TITLE = "What if ids are as simulations make them?"
QUESTION = ("The same maps on the ids of a fresh lattice, of a hopper after a long run of insertion and deletion, of "
            "one rank's slice, and on strided and clustered ones of 64 bits; T/N = 8 where a pattern has no stride of "
            "its own. The left is best.")
ABSENT = "bench/run --only id"


def is_there(results):
    return pattern_size(results) is not None


def measured(results):
    """[pattern]"""
    present = pattern_points(results)[pattern_size(results)]
    return [p for p in PATTERNS if p in present]


def value_of(results, pattern, series, measure):
    cell = (pattern, pattern_size(results), 8, series)
    return results.memory.get(cell) if measure == "memory" else results.median(*cell, measure)


def pattern_panel(results, measure, pyplot):
    names = measured(results)
    rows = .205 * (len(names) + .8)  # inches; the last row is followed by a remark
    figure, axes = new_panel(pyplot, (4.1, rows + .4), (.36, .3 / (rows + .4), .59, rows / (rows + .4)))
    for series, look in drawn_looks(results).items():
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
        degenerate = results.degenerate.get((pattern, pattern_size(results), 8, LIGGGHTS))
        if degenerate and measure != "memory":
            axes.annotate(f"LIGGGHTS: {degenerate[0]:.0f} nodes ▶", (1, k + .75), xycoords=("axes fraction", "data"),
                          ha="right", va="center", fontsize=7.5, color=LOOKS[LIGGGHTS].colour)
    axes.set_yticks(range(len(names)), [PATTERNS[p] for p in names], fontsize=8.5)
    axes.set_ylim(len(names) + .3, -.5)
    axes.tick_params(axis="y", length=0)
    return panel(figure, pyplot, f"{MEASURES[measure]}: {power(pattern_size(results))} particles")


def drawn(results, pyplot):
    return legend(drawn_looks(results).values(), pyplot) + panels(pattern_panel(results, m, pyplot) for m in MEASURES)


def advice(results):
    names, size = measured(results), pattern_size(results)
    default, best_rival = {}, {}
    for p in names:
        default[p] = value_of(results, p, DEFAULT, "find_hit")
        rival = results.best(RIVALS, p, size, 8, "find_hit")
        best_rival[p] = rival and rival[0]
    default = {p: v for p, v in default.items() if v}
    if not default:
        return "", []
    worst, least = max(default, key=default.get), min(default, key=default.get)
    found = [(f"whatever makes the ids, choose adaptive: a batched look-up of {power(size)} takes "
              f"{figure_of(default[least])} to {figure_of(default[worst])} ns",
              f"{PATTERNS[least]}; {PATTERNS[worst]}")]
    ratios = [(quotient(best_rival[p], v), p) for p, v in default.items() if best_rival.get(p)]
    if ratios:
        beyond = [r for r, p in ratios if r > 1 and apart(best_rival[p], default[p])]
        low, high = min(ratios), max(ratios)
        found.append((f"the best rival takes {figure_of(low[0])} to {figure_of(high[0])} times that, beyond noise in "
                      f"{len(beyond)} of {len(ratios)} patterns", f"{PATTERNS[low[1]]}; {PATTERNS[high[1]]}"))
    refused = [p for p in names if (p, size, 8, "dense") in results.refused]
    if refused:
        found.append((f"for {len(refused)} of {len(names)} patterns dense is refused, since their range would not fit "
                      "into memory", ""))
    bad = [(visits, p) for (p, n, _, _), (visits, _) in results.degenerate.items() if n == size and p in names]
    if bad:
        found.append((f"do not take ids modulo a prime: on {PATTERNS[max(bad)[1]]} a look-up visits {max(bad)[0]:.0f} "
                      "nodes of one chain", ""))
    return "", found


def figures(results):
    names = {p: PATTERNS[p] for p in measured(results)}
    spread = lambda measure: "" if measure == "memory" else ": median (its limits)"
    return tables([(f"{title}, {power(pattern_size(results))} particles{spread(measure)}",
                    pattern_table(results, pattern_size(results), names, measure))
                   for measure, title in MEASURES.items()])
