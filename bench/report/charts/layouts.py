# SPDX-License-Identifier: MIT
"""Chart 3: which layout, as particles carry more."""
from ..drawing import label_ends, legend, new_panel, panel, panels, tables
from ..page import spread_text, table
from ..pictures import plain_ticks
from ..spread import apart, figure_of, listed, power, runs_of_choice, spans_text
from ..store import LOOKS

ROOM = "store"
TITLE = "Which layout, and what does another field cost?"
QUESTION = ("Time per particle over the bytes that each carries. An update reads and writes 80 of them; a sort moves "
            "all; a pack copies all of every third particle into a message. Bars: where the median lies, at 93 % or "
            "more.")
ABSENT = "bench/run --only store"
OPERATIONS = {"update": ("Update, ns per particle", "updates"), "permute": ("Sort, ns per particle", "sorts"),
              "pack": ("Pack, ns per packed particle", "packs")}


def is_there(results):
    return bool(results.carried)


def counts_of(results):
    return sorted({n for *_, n in results.carried})


def sizes_of(results, count):
    return sorted({size for _, _, size, n in results.carried if n == count})


def carried_panel(results, operation, count, pyplot):
    figure, axes = new_panel(pyplot, box=(.135, .155, .64, .81))
    sizes = sizes_of(results, count)
    ends, highest, lowest = [], 0, 1e9
    for layout, look in LOOKS.items():
        points = [(b, t) for b in sizes if (t := results.carried_time(layout, operation, b, count))]
        if not points:
            continue
        places, times = zip(*points)
        axes.errorbar(places, times, yerr=[[t - t.low for t in times], [t.high - t for t in times]],
                      elinewidth=.9, capsize=2, **look.style())
        highest, lowest = max(highest, *times), min(lowest, *times)
        ends.append((*points[-1], look.short, look.colour))
    axes.set(xscale="log", yscale="log", ylim=(lowest / 1.6, highest * 1.9))
    axes.set_xlabel("bytes that a particle carries", fontsize=9, labelpad=1)
    axes.set_xticks(sizes, [str(b) for b in sizes])
    axes.minorticks_off()
    plain_ticks(axes.yaxis)
    label_ends(axes, ends)
    return panel(figure, pyplot, f"{OPERATIONS[operation][0]}: {power(count)} particles")


def drawn(results, pyplot):
    return legend(LOOKS.values(), pyplot) + panels(
        carried_panel(results, operation, count, pyplot) for count in counts_of(results) for operation in OPERATIONS)


def operation_text(results, operation, count):
    sizes = sizes_of(results, count)
    costs = lambda size: {l: t for l in LOOKS if (t := results.carried_time(l, operation, size, count))}
    runs = runs_of_choice(sizes, costs)
    if not runs:
        return None
    numbers = []
    for size in dict.fromkeys((sizes[0], sizes[-1])):
        values = costs(size)
        numbers.append(listed([f"{LOOKS[l].short} {figure_of(v)}" for l, v in values.items()]) + f" ns at {size} bytes")
    choice = (LOOKS[runs[0][0]].short if len(runs) == 1 else
              spans_text(runs, "", lambda l: LOOKS[l].short, lambda b: f"{b} bytes"))
    return f"{choice} where {OPERATIONS[operation][1]} count", "; ".join(numbers)


def growth_text(results, count):
    """How much an update slows down as particles carry what it does not need."""
    sizes = sizes_of(results, count)
    texts = []
    for layout, look in LOOKS.items():
        first, last = (results.carried_time(layout, "update", size, count) for size in (sizes[0], sizes[-1]))
        if first and last and len(sizes) > 1:
            growth = f"{last / first:.1f} times as long" if apart(first, last) else "as long within noise"
            texts.append(f"{growth} in {look.short}")
    if not texts:
        return ""
    return f"an update needs the same fields of {sizes[0]} bytes and of {sizes[-1]}; with the latter it takes {listed(texts)}"


def advice(results):
    count = counts_of(results)[-1]
    found = [t for o in OPERATIONS if (t := operation_text(results, o, count))]
    growth = growth_text(results, count)
    return f"For {power(count)} particles choose", found + ([(growth, "")] if growth else [])


def time_cell(results, cell):
    """ns, and ps for each byte that is carried."""
    time = results.carried_time(*cell)
    if not time:
        return "<td></td>"
    return (f'<td class="figure">{spread_text(time)} '
            f"<small>{figure_of(1e3 * time / cell[2])} ps per byte</small></td>")


def figures(results):
    parts = []
    for count in reversed(counts_of(results)):
        rows = []
        for operation, (title, _) in OPERATIONS.items():
            for layout, look in LOOKS.items():
                cells = [time_cell(results, (layout, operation, size, count)) for size in sizes_of(results, count)]
                rows.append([title.split(",")[0], look.short, *cells])
        parts.append((f"{power(count)} particles: ns, median (its limits), and by the bytes carried",
                      table(["", "Layout", *(f"{b} bytes" for b in sizes_of(results, count))], rows)))
    return tables(parts)
