# SPDX-License-Identifier: MIT
"""Chart 1: which table for which ids. Rebuild, look-ups and memory over how sparse the ids are."""
from ..drawing import Look, label_at, label_ends, legend, mark_upright, new_panel, panel, panels, tables
from ..id_map import DEFAULT, OPERATIONS, OWN, RIVALS, crossings, sweep_table, sweep_value
from ..id_map import label as long_label
from ..page import Refusal, apart, figure_of, limits, plain_ticks, power, quotient, runs_of_choice, spans_text

ROOM = "id"
TITLE = "Which table for which ids?"
QUESTION = ("Time and memory of a map from global ids to local indices, over T/N: the range of the ids by their "
            "number, 1 where they are numbered without gaps. Dotted uprights: where the best of our own tables "
            "changes. Tinted: from the lowest to the highest repetition.")
ABSENT = "bench/run --only id"
MEASURES = {"find_hit": "Batched look-up, ns each", "find_single": "Single look-up, ns each",
            "rebuild": "Rebuild, ns per particle", "memory": "Memory, bytes per particle"}
LOOKS = {
    "dense": Look("dense", "vermilion", "s"),
    "bitmap": Look("bitmap", "purple", "D"),
    "paged": Look("paged", "orange", "p"),
    "flat": Look("flat", "blue", "o", width=2),
    "chained_mixed": Look("chained, mixed", "green", "^", short="chained"),
    "chained_mod_prime": Look("chained, mod prime (LIGGGHTS' scheme)", "yellow", "v", short="mod prime"),
    DEFAULT: Look("adaptive, the default", "ink", "o", (0, (1, 1)), 1.2, short="adaptive", is_hollow=True),
    "std_unordered_map": Look("std::unordered_map", "grey", "x", "-.", 1.1, short="std"),
    "boost_flat_map": Look("boost::unordered_flat_map", "sky", "+", "-.", 1.1, short="boost"),
    "absl_flat_hash_map": Look("absl::flat_hash_map", "grey", "1", ":", 1.3, short="absl"),
    "oracle": Look("oracle: places known, the limit of random access", "ink", "", "--", 1, short="oracle"),
}


def is_there(results):
    return bool(counts_of(results))


def counts_of(results):
    """Of the uniform ids: those sizes for which there is a sweep."""
    return [n for n in results.counts() if len(results.ratios(n)) > 1]


def known(results):
    return {s: look for s, look in LOOKS.items() if any(key[3] == s for key in results.times)}


def value_of(results, count, ratio, series, measure):
    return sweep_value(results, count, ratio, series, measure)


def meetings_of(results, count, measure):
    """The crossings of our own tables that differ beyond noise before and after."""
    ratios = results.ratios(count)
    found = []
    for x, before, after in sorted(crossings(results, count, None if measure == "memory" else measure)):
        around = (max(r for r in ratios if r <= x), min(r for r in ratios if r >= x))
        pairs = [(value_of(results, count, r, before, measure), value_of(results, count, r, after, measure))
                 for r in around]
        if all(apart(a, b) for a, b in pairs):
            found.append((x, before, after))
    return found


def draw_sweep(axes, results, count, measure, marked=2):
    """With the first `marked` crossings of our own tables."""
    ratios = results.ratios(count)
    ends = []
    for series, look in known(results).items():
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
    for k, (x, before, after) in enumerate(meetings_of(results, count, measure)[:marked]):
        is_right = axes.transAxes.inverted().transform(axes.transData.transform((x, 1)))[0] > .5
        at = figure_of(x) if x < 1000 else f"{x:.1e}".replace("e+0", "e")
        mark_upright(axes, x, f"{LOOKS[before].short} → {LOOKS[after].short} at {at}", row=k,
                     side="right" if is_right else "left", line=(0, (1, 3)))
    label_ends(axes, ends)


def sweep_panel(results, count, measure, pyplot):
    figure, axes = new_panel(pyplot)
    draw_sweep(axes, results, count, measure)
    return panel(figure, pyplot, f"{MEASURES[measure]}: {power(count)} particles")


def readme_chart(results, pyplot):
    """Batched look-up and rebuild at the largest size up to 1e6, side by side."""
    count = max((n for n in counts_of(results) if n <= 10**6), default=None)
    if count is None:
        raise Refusal("no uniform ids of at most 1e6 particles in these results: nothing to draw")
    figure, pair = pyplot.subplots(1, 2, figsize=(10.4, 3.6), gridspec_kw={"wspace": .42})
    for axes, measure in zip(pair, ("find_hit", "rebuild")):
        axes.grid(True)
        draw_sweep(axes, results, count, measure, marked=0)
        axes.set_xlabel("T/N: range of the ids by their number")
        axes.set_title(f"{MEASURES[measure]}: {power(count)} particles", loc="left")
    return figure


def drawn(results, pyplot):
    return legend(known(results).values(), pyplot) + panels(
        sweep_panel(results, count, measure, pyplot) for measure in MEASURES for count in counts_of(results))


def label(series):
    return LOOKS[series].short if series in LOOKS else long_label(series)


def own_costs(results, count, measure):
    """ratio -> {table: cost}"""
    return lambda ratio: {s: v for s in OWN if (v := value_of(results, count, ratio, s, measure))}


def measure_text(results, count, measure):
    """for batched look-ups dense up to T/N = 8 (3.1 ns there, best rival 9.0) and flat from 64 on (...)"""
    costs = own_costs(results, count, measure)
    runs = runs_of_choice(results.ratios(count), costs)
    if not runs:
        return ""
    unit = "B" if measure == "memory" else "ns"
    numbers = []
    for series, places in runs:
        values = costs(places[-1])
        text = f"{label(series)} {figure_of(values[series])} {unit}"
        rival = results.best(RIVALS, "uniform", count, places[-1], measure) if measure != "memory" else None
        if rival:
            text += f", {label(rival[1])} {figure_of(rival[0])}"
            if not apart(rival[0], values[series]):
                text += ", within noise"
        numbers.append(f"{text} at {power(places[-1])}")
    what = {"find_hit": "batched look-ups", "find_single": "single look-ups", "rebuild": "rebuilds",
            "memory": "memory"}[measure]
    return f"for {what} {spans_text(runs, 'T/N = ', label, power)} ({'; '.join(numbers)})"


def default_text(results, count):
    """How good the default is, over the three times and all T/N."""
    points, good, worst = 0, 0, None
    for measure in ("find_hit", "find_single", "rebuild"):
        for ratio in results.ratios(count):
            ours = value_of(results, count, ratio, DEFAULT, measure)
            others = own_costs(results, count, measure)(ratio)
            if not ours or not others:
                continue
            points += 1
            best = min(others.values())
            if not apart(ours, best) or ours < best:
                good += 1
            elif worst is None or ours / best > worst[0]:
                worst = (quotient(ours, best), OPERATIONS[measure][0].split(",")[0].lower(), ratio)
    if not points:
        return ""
    text = f"adaptive, the default, is within noise of the best of our own tables at {good} of {points} points"
    if worst:
        text += (f", and takes {figure_of(worst[0])} times as long at the worst of the others ({worst[1]}, "
                 f"T/N = {power(worst[2])})")
    return text


def sentence(results):
    count = max((n for n in counts_of(results) if n <= 10**6), default=counts_of(results)[-1])
    texts = [t for measure in MEASURES if (t := measure_text(results, count, measure))]
    return (f"For {power(count)} particles choose {'; '.join(texts)}; or choose none: {default_text(results, count)}.")


def figures(results):
    spread = lambda measure: "" if measure == "memory" else ": median (lowest–highest)"
    return tables([(f"{title}, {power(count)} particles{spread(measure)}", sweep_table(results, count, measure))
                   for count in reversed(counts_of(results)) for measure, title in MEASURES.items()])
