# SPDX-License-Identifier: MIT
"""Chart 1: which table for which ids. Rebuild, look-ups and memory over how sparse the ids are."""
from ..drawing import legend, panels, tables
from ..id_map import (DEFAULT, MEASURES, OPERATIONS, RIVALS, choice_text, choices, draw_sweep, drawn_looks, own_costs,
                      short_label, sweep_counts, sweep_panel, sweep_table, value_of)
from ..reading import Refusal
from ..spread import apart, figure_of, power, quotient

ROOM = "id"
TITLE = "Which table for which ids?"
QUESTION = ("Time and memory of a map from global ids to local indices, over T/N: the range of the ids divided by "
            "their number, 1 where they are numbered without gaps. Dotted uprights: where the best of our own tables "
            "changes. Tinted: the limits of the median.")
ABSENT = "bench/run --only id"


def is_there(results):
    return bool(sweep_counts(results))


def readme_chart(results, pyplot):
    """Batched look-up and rebuild at the largest size up to 1e6, side by side."""
    count = max((n for n in sweep_counts(results) if n <= 10**6), default=None)
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
    return legend(drawn_looks(results).values(), pyplot) + panels(
        sweep_panel(results, count, measure, title, pyplot) for measure, title in MEASURES.items()
        for count in sweep_counts(results))


def size_of(results):
    """Of the sentence."""
    counts = sweep_counts(results)
    return max((n for n in counts if n <= 10**6), default=counts[-1])


def numbers_text(results, count, measure):
    """dense 2.84 ns, absl prefetched 28.4 at T/N = 2; flat 11.2 ns, boost 48.1 at 1e6"""
    costs = own_costs(results, count, measure)
    texts = []
    for series, places in choices(results, count, measure):
        values = costs(places[-1])
        text = f"{short_label(series)} {figure_of(values[series])} {'B' if measure == 'memory' else 'ns'}"
        rival = results.best(RIVALS, "uniform", count, places[-1], measure) if measure != "memory" else None
        if rival:
            text += f", {short_label(rival[1])} {figure_of(rival[0])}"
            if not apart(rival[0], values[series]):
                text += " within noise"
        texts.append(f"{text} at {power(places[-1])}")
    return "; ".join(texts)


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
        text += (f", and takes {figure_of(worst[0])} times as long at the worst of the others, {worst[1]} at "
                 f"T/N = {power(worst[2])}")
    return text


def advice(results):
    count = size_of(results)
    names = {"find_hit": "batched look-ups", "find_single": "single look-ups", "rebuild": "rebuilds",
             "memory": "memory"}
    found = [(f"for {name} {text}", numbers_text(results, count, measure)) for measure, name in names.items()
             if (text := choice_text(results, count, measure))]
    default = default_text(results, count)
    if default:
        found.append((f"or choose none: {default}", ""))
    return f"For {power(count)} particles choose", found


def figures(results):
    spread = lambda measure: "" if measure == "memory" else ": median (its limits)"
    return tables([(f"{title}, {power(count)} particles{spread(measure)}", sweep_table(results, count, measure))
                   for count in reversed(sweep_counts(results)) for measure, title in MEASURES.items()])
