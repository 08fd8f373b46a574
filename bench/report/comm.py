# SPDX-License-Identifier: MIT
"""Ranks: what migration and ghosts cost beside MPI_Sendrecv of the same bytes, and what many ranks would send."""
import html
import itertools
import math
from collections import defaultdict

from .claims import Claim
from .page import context_text, figure_cell, markdown_row, ratio_cell, table
from .pictures import INK, colour, plain_ticks, svg_of
from .reading import Refusal, RoomResults
from .spread import figure_of, middle, power, quotient

SERIES = (  # name, label, colour, line
    ("tsubu", "tsubu", colour("blue"), "-"),
    ("direct", "tsubu, direct", colour("blue"), "-"),
    ("staged", "tsubu, staged", colour("purple"), "-"),
    ("hand", "by hand", colour("vermilion"), "-"),
    ("raw", "MPI_Sendrecv of the bytes", colour("grey"), "--"),
)
PATTERNS = ("direct", "staged")
TASKS = {"forward": "forward, positions", "reverse": "reverse, forces", "make_halo": "make_halo"}

# The promises: microseconds beyond a reduction; bytes by those of the leavers; times by those of the raw
# exchange, and by those of loops by hand.
SYNC_PROMISE, BYTES_PROMISE, MIGRATE_PROMISE, FORWARD_PROMISE, HAND_PROMISE = 50, 1.1, 2, 1.5, 1.5

# Assumptions of the model, of a network of today.
OVERHEAD = .4e-6   # s that a core is busy with a message, sent and received
LATENCY = 1.5e-6   # s until one is there that others wait for: once for each step of a pattern or reduction
BANDWIDTH = 10e9   # bytes per second that go out of a rank
MANY = 100_000     # ranks

TITLE = "ranks"
INTRODUCTION = ("Ranks: particles that migrate, and ghosts that follow their owners, beside MPI_Sendrecv of the same "
                "bytes and a program by hand. Times are those of the slowest rank, from a barrier on; contenders take "
                "turns.")
CLAIM_NOTE = ""


class Results(RoomResults):
    """Microseconds by (task, variant, series), one per turn; traffic by (task, series, ranks)."""

    def __init__(self):
        super().__init__()
        self.times = defaultdict(list)
        self.moved = {}   # percent: bytes by those of the leavers
        self.fields = {}  # (task, variant): of one row
        self.model = {}
        self.ranks = None

    def measured(self):
        return (self.times,)

    def add(self, row):
        _, task, variant, series, last = row["name"].split("/")
        ranks = int(last.split(":")[1])
        if task == "model":
            self.model.setdefault((variant, series, ranks), row)
            return
        if self.ranks not in (None, ranks):
            raise Refusal(f"figures of {self.ranks} ranks and of {ranks}: give files of one number of ranks")
        self.ranks = ranks
        if task == "moved":
            self.moved.setdefault(int(variant), row["bytes"] / row["leaver_bytes"])
            return
        cell = (task, variant, series)
        if cell in self.already:  # of two runs of one cell the first counts
            return
        self.times[cell].append(row["real_time"] / 1e3)
        self.fields[cell[:2]] = row

    def is_empty(self):
        return not self.times and not self.model

    def repetitions(self):
        return {len(t) for t in self.times.values()} or {1}

    def time(self, task, variant, series):
        """us, a Spread; None if not measured."""
        found = self.times.get((task, str(variant), series))
        return middle(found) if found else None

    def over_raw(self, task, variant, series):
        """How many times as long as the raw exchange, turn by turn."""
        return quotient(self.time(task, variant, series), self.time(task, variant, "raw"))

    def over_hand(self, task, variant, series):
        return quotient(self.time(task, variant, series), self.time(task, variant, "hand"))

    def percents(self):
        return sorted({int(variant) for task, variant, _ in self.times if task == "migrate"})

    def sizes(self):
        return sorted({variant for task, variant, _ in self.times if task in TASKS}, key=int, reverse=True)

    def series(self, task, variant):
        return [s for s in SERIES if (task, str(variant), s[0]) in self.times]

    def model_ranks(self):
        return sorted({ranks for _, _, ranks in self.model})


def all_claims(results):
    on = f"{results.ranks} ranks" if results.ranks else ""
    stays = Claim("migrate, none leaves, beyond an empty reduction", SYNC_PROMISE, " us", at_least=False)
    still, sync = results.time("migrate", 0, "tsubu"), results.time("sync", "none", "reduction")
    if still and sync:
        stays.add(type(still)(still - sync, still.low - sync.high, still.high - sync.low), on)
    moved = Claim("Bytes that migrate sends / those of the leavers", BYTES_PROMISE, at_least=False)
    for percent, ratio in sorted(results.moved.items()):
        if results.ranks and results.ranks > 1:
            moved.add(ratio, f"{percent} % leave")
    migrated = Claim("migrate / MPI_Sendrecv of the leavers' bytes", MIGRATE_PROMISE, at_least=False)
    for percent in results.percents():
        migrated.add(results.over_raw("migrate", percent, "tsubu"), f"{percent} % leave")
    migrated_by_hand = Claim("migrate / by hand", HAND_PROMISE, at_least=False)
    for percent in results.percents():
        migrated_by_hand.add(results.over_hand("migrate", percent, "tsubu"), f"{percent} % leave")
    forward = Claim("forward / MPI_Sendrecv of the ghosts' bytes", FORWARD_PROMISE, at_least=False)
    for size in results.sizes():
        for pattern in PATTERNS:
            forward.add(results.over_raw("forward", size, pattern), f"{size} ghosts, {pattern}")
    by_hand = []
    for task in ("forward", "reverse"):
        by_hand.append(Claim(f"{task} / by hand", HAND_PROMISE, at_least=False))
        for size in results.sizes():
            for pattern in PATTERNS:
                by_hand[-1].add(results.over_hand(task, size, pattern), f"{size} ghosts, {pattern}")
    counted = Claim("Bytes per rank counted / by the formula, farthest from 1", None, at_least=False)
    for (task, series, ranks), row in results.model.items():
        expected = formula(task, series, row)
        if expected[1] and ranks >= 8:
            ratio = row["bytes"] / expected[1]
            counted.add(max(ratio, 1 / ratio), f"{task}, {series}, {ranks} ranks")
    return [stays, moved, migrated, migrated_by_hand, forward, *by_hand, counted]


# ---------------------------------------------------------------------------------------------------------------
# The model


def parts_by_rank(grid, share):
    """share(offset) of what a rank sends, added up by the rank that it goes to; what stays on the rank is left out."""
    sums = defaultdict(float)
    for offset in itertools.product((-1, 0, 1), repeat=3):
        place = tuple(o % p for o, p in zip(offset, grid))
        if any(place):
            sums[place] += share(offset)
    return sums


def traffic(task, series, grid, particles, cutoff, step):
    """(messages, bytes) of a rank and step: unit cubes in a periodic grid, particles spread evenly."""
    if task == "migrate":
        # Displacements evenly between -step and step along each axis: through each face go step / 4 of the particles.
        def leaves(offset):
            return particles * math.prod(step / 4 if o else 1 - step / 2 for o in offset)
        sums = parts_by_rank(grid, leaves)
        messages = sum(1 - math.exp(-n) for n in sums.values())
        return messages, 64 * sum(sums.values()) + 8 * messages
    if series == "staged":
        # Slabs one after the other, each as wide as the cube and the ghosts that it has by then.
        messages = size = 0
        for axis, count in enumerate(grid):
            if count > 1:
                messages += 2
                size += 2 * cutoff * (1 + 2 * cutoff)**axis
        return messages, 24 * particles * size
    # What lies within the cutoff of a face, an edge, a corner of the next rank.
    volume = (0, cutoff, math.pi * cutoff**2 / 4, math.pi * cutoff**3 / 6)
    sums = parts_by_rank(grid, lambda offset: particles * volume[sum(map(abs, offset))])
    return len(sums), 24 * sum(sums.values())


def formula(task, series, row, grid=None):
    grid = grid or tuple(int(row[f"grid_{axis}"]) for axis in "xyz")
    return traffic(task, series, grid, row["particles"], row["cutoff"], row["step"])


def grid_of(ranks):
    """Powers of two, dealt out to the axes in turn, as measured; else three or more along each axis, all the same."""
    log = round(math.log2(ranks))
    return tuple(2**((log + 2 - axis) // 3) for axis in range(3))


def scaled(particles):
    """Cutoff and step of cubes with more particles, at the same distance of each other."""
    edge = (4096 / particles)**(1 / 3)
    return .15 * edge, .02 * edge


def seconds(task, series, ranks, particles):
    """Of a step of a rank: messages, how often one waits, bytes by bandwidth; two reductions for migrate."""
    cutoff, step = scaled(particles)
    messages, size = traffic(task, series, grid_of(ranks), particles, cutoff, step)
    waits = messages if series == "staged" else 1
    if task == "migrate":
        waits += 2 * 2 * math.ceil(math.log2(ranks))
    return messages * OVERHEAD + waits * LATENCY + size / BANDWIDTH


def crossing():
    """How many particles a rank has where both patterns take as long; staged is quicker with fewer."""
    few, many = 1.0, 1e12
    for _ in range(200):
        at = math.sqrt(few * many)
        if seconds("forward", "staged", MANY, at) < seconds("forward", "direct", MANY, at):
            few = at
        else:
            many = at
    return few


# ---------------------------------------------------------------------------------------------------------------
# Charts


def few_ticks(axis):
    from matplotlib.ticker import NullLocator
    plain_ticks(axis)
    axis.set_minor_locator(NullLocator())


def legend_below(figure, axes, columns=2):
    axes.legend(loc="upper center", bbox_to_anchor=(.45, -.58 / figure.get_figheight() / .77), ncol=columns,
                frameon=False, fontsize=8)


def migrate_chart(results, pyplot):
    figure, axes = pyplot.subplots(figsize=(5.6, 3.4))
    percents = results.percents()
    for name, label, shade, line in SERIES:
        points = [(p, t) for p in percents if (t := results.time("migrate", p, name))]
        if not points:
            continue
        axes.errorbar([percents.index(p) for p, _ in points], [t for _, t in points],
                      yerr=[[max(0, t - t.low) for _, t in points], [max(0, t.high - t) for _, t in points]],
                      color=shade, linestyle=line, marker="o", markersize=4, linewidth=1.6, label=label)
        for p, t in points:
            others = [o for s, *_ in SERIES if s != name and (o := results.time("migrate", p, s))]
            is_highest = all(t >= o for o in others)
            axes.annotate(figure_of(t), (percents.index(p), t), xytext=(0, 6 if is_highest else -13), color=shade,
                          textcoords="offset points", ha="center", fontsize=8)
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    axes.set_ylim(low / 1.6, high * 1.6)
    few_ticks(axes.yaxis)
    axes.set_xticks(range(len(percents)), [f"{p} %" for p in percents])
    axes.set_xlim(-.35, len(percents) - .65)
    axes.set_xlabel("of the particles leave")
    axes.set_ylabel("µs")
    axes.grid(True, axis="y")
    axes.set_title(f"migrate, {particles_text(results)}", loc="left")
    legend_below(figure, axes)
    return figure


def particles_text(results):
    row = next((row for (task, _), row in results.fields.items() if "particles" in row), None)
    return f"{power(int(row['particles']))} particles on {results.ranks} ranks" if row else ""


def ghost_chart(results, size, pyplot):
    tasks = [t for t in ("forward", "reverse") if results.series(t, size)]
    present = [s for s in SERIES if any(s in results.series(t, size) for t in tasks)]
    figure, axes = pyplot.subplots(figsize=(5.6, 1.1 + (.22 + .2 * len(present)) * len(tasks)))
    high = .8 / len(present)
    for k, (name, label, shade, _) in enumerate(present):
        for row, task in enumerate(tasks):
            time = results.time(task, size, name)
            if not time:
                continue
            place = row + high * (k - (len(present) - 1) / 2)
            axes.barh(place, time, height=high * .9, color=shade, label=label, zorder=3)
            axes.plot([time.low, time.high], [place, place], color=INK, linewidth=1, zorder=4)
            axes.annotate(figure_of(time), (time.high, place), xytext=(4, 0), textcoords="offset points", va="center",
                          fontsize=8)
            label = None
    axes.set_xlim(0, axes.get_xlim()[1] * 1.08)
    axes.set_yticks(range(len(tasks)), [TASKS[t].replace(", ", ",\n") for t in tasks])
    axes.set_ylim(len(tasks) - .45, -.55)
    axes.set_xlabel("µs")
    axes.grid(True, axis="x")
    ghosts = int(results.fields[(tasks[0], size)]["ghosts"])
    axes.set_title(f"{ghosts} ghosts in all, {results.ranks} ranks", loc="left")
    legend_below(figure, axes)
    return figure


MODEL_SERIES = (  # task, series, label, colour
    ("forward", "direct", "forward, direct", colour("blue")),
    ("forward", "staged", "forward, staged", colour("purple")),
    ("migrate", "tsubu", "migrate", colour("green")),
)


def model_chart(results, which, label, pyplot):
    """Counted: dots; the formula: lines, up to many ranks."""
    figure, axes = pyplot.subplots(figsize=(5.6, 3.4))
    lines = [2**k for k in range(1, 17)] + [MANY]
    for task, series, name, shade in MODEL_SERIES:
        rows = [(ranks, results.model[(task, series, ranks)]) for ranks in results.model_ranks()
                if ranks > 1 and (task, series, ranks) in results.model]
        if not rows:
            continue
        axes.plot(lines, [formula(task, series, rows[0][1], grid_of(n))[which] / (1, 1e3)[which] for n in lines],
                  color=shade, linewidth=1.4, label=name)
        axes.plot([n for n, _ in rows], [row[("messages", "bytes")[which]] / (1, 1e3)[which] for _, row in rows], "o",
                  color=shade, markersize=4.5)
    axes.set_xscale("log")
    axes.set_xlim(1.6, MANY * 1.5)
    axes.set_xticks([10**k for k in range(1, 6)], ["10", "100", "1000", "1e4", "1e5"])
    axes.minorticks_off()
    if which == 0:
        axes.set_ylim(0, None)
    else:
        axes.set_yscale("log")
        few_ticks(axes.yaxis)
    axes.set_xlabel("ranks")
    axes.set_ylabel(label)
    axes.grid(True)
    axes.set_title(f"{label} of a rank and step", loc="left")
    legend_below(figure, axes, 3)
    return figure


# ---------------------------------------------------------------------------------------------------------------
# Sections of the page


def migrate_table(results):
    rows = []
    still = results.time("migrate", 0, "tsubu")
    for percent in results.percents():
        time, raw = results.time("migrate", percent, "tsubu"), results.time("migrate", percent, "raw")
        beyond = quotient(type(time)(time - still, time.low - still.high, time.high - still.low), raw) \
            if still and raw and time > still else None
        leavers = int(results.fields[("migrate", str(percent))]["leavers"])
        rows.append([f"{percent} %", f'<td class="figure">{leavers * results.ranks}</td>', figure_cell(time),
                     figure_cell(results.time("migrate", percent, "hand")), figure_cell(raw),
                     ratio_cell(results.over_hand("migrate", percent, "tsubu")),
                     ratio_cell(results.over_raw("migrate", percent, "tsubu")), ratio_cell(beyond),
                     f'<td class="figure">{results.moved[percent]:.4f}x</td>' if percent in results.moved else ""])
    return table(["Leave", "Particles that leave", "migrate, µs", "by hand, µs", "MPI_Sendrecv, µs",
                  "migrate / by hand", "migrate / MPI_Sendrecv", "beyond the search", "Bytes / leavers' bytes"], rows)


def ghost_table(results):
    rows = []
    for size in results.sizes():
        for task in TASKS:
            for name, label, *_ in results.series(task, size):
                time = results.time(task, size, name)
                rows.append([TASKS[task], f'<td class="figure">{int(results.fields[(task, size)]["ghosts"])}</td>',
                             label, figure_cell(time),
                             ratio_cell(results.over_raw(task, size, name)) if name != "raw" else "",
                             ratio_cell(results.over_hand(task, size, name)) if name in PATTERNS else ""])
    return table(["Task", "Ghosts", "", "µs", "/ MPI_Sendrecv", "/ by hand"], rows)


def model_table(results):
    rows = []
    for task, series, name, _ in MODEL_SERIES:
        for ranks in results.model_ranks():
            row = results.model.get((task, series, ranks))
            if not row or ranks == 1:
                continue
            messages, size = formula(task, series, row)
            grid = " × ".join(str(int(row[f"grid_{axis}"])) for axis in "xyz")
            rows.append([name, str(ranks), grid, f'<td class="figure">{row["messages"]:.1f}</td>',
                         f'<td class="figure">{messages:.1f}</td>', f'<td class="figure">{row["bytes"]:.0f}</td>',
                         f'<td class="figure">{size:.0f}</td>',
                         f'<td class="figure">{row["bytes"] / size:.3f}x</td>' if size else ""])
    return table(["", "Ranks", "Grid", "Messages", "by formula", "Bytes", "by formula", "Bytes / formula"], rows)


def many_table():
    rows = []
    for particles in (1000, 10_000, 100_000, 1_000_000):
        cutoff, step = scaled(particles)
        for task, series, name, _ in MODEL_SERIES:
            messages, size = traffic(task, series, grid_of(MANY), particles, cutoff, step)
            rows.append([power(particles), name, f'<td class="figure">{messages:.1f}</td>',
                         f'<td class="figure">{size / 1e3:.1f}</td>',
                         *(f'<td class="figure">{figure_of(1e6 * seconds(task, series, ranks, particles))}</td>'
                           for ranks in (64, 1000, MANY))])
    return table(["Particles of a rank", "", "Messages", "kB", "µs, 64 ranks", "µs, 1000 ranks",
                  f"µs, {power(MANY)} ranks"], rows)


def choice(results):
    """Which pattern when: of this run, and of the model."""
    texts = []
    for size in results.sizes():
        direct, staged = (results.time("forward", size, p) for p in PATTERNS)
        if direct and staged:
            ratio = quotient(direct, staged)
            ghosts = int(results.fields[("forward", size)]["ghosts"])
            verdict = ("take as long as each other" if ratio.low <= 1 <= ratio.high else
                       f"differ: {'direct' if ratio < 1 else 'staged'} is quicker")
            texts.append(f"For {ghosts} ghosts on {results.ranks} ranks direct ({figure_of(direct)} µs) and staged "
                         f"({figure_of(staged)} µs) {verdict}.")
    at = crossing()
    texts.append(f"In cubes with 26 neighbours, by the assumptions below, staged is quicker with fewer than about "
                 f"{float(f'{at:.1g}'):.0f} particles per rank, where 20 messages more cost more than the larger "
                 "corners and waiting six times; with more, direct. Direct is also what work can be overlapped with: "
                 "all its ghosts are on their way at once; of staged only the first of six steps is.")
    return " ".join(texts)


RANKS_TEXT = (
    "Half of a rank's particles that leave go up, half down, so half are wrapped on two ranks; they are other ones in "
    "each call. MPI_Sendrecv sends the same ready buffers again and again: it neither looks for leavers, nor gathers "
    "them from their arrays, nor writes a buffer that the other core has just read. By hand is what a program would "
    "have for this row of cubes and these fields alone. Migration: who leaves shows in one coordinate, records go by "
    "MPI_Sendrecv, those that come take the places of those that have gone. Ghosts: lists, a gather that adds the "
    "shift, MPI_Irecv into the array, MPI_Isend, MPI_Waitall. Of each turn the lower quartile of its calls; of the "
    "turns the median (at 93 % between the figures in brackets).")


def model_text(results):
    row = next(iter(results.model.values()))
    n, r, s = int(row["particles"]), row["cutoff"], row["step"]
    return ("<p>Unit cubes in a grid, periodic along all axes, "
            f"n = {n} particles in each, cutoff r = {r:g}, and steps evenly between −{s:g} and {s:g} along each axis "
            "for migrate. Dots are counted on simulated ranks, the mean over the ranks; lines are the formulas, which "
            "from 3 ranks along each axis on are, per rank and step:</p><ul>"
            "<li>forward, direct: 26 messages, 24 n (6 r + 3 π r² + 4/3 π r³) bytes</li>"
            "<li>forward, staged: 6 messages, 24 n ((1 + 2 r)³ − 1) bytes</li>"
            "<li>migrate of 64 bytes, s the step: 64 n (1 − (1 − s/2)³) bytes, 6 to 26 messages with 8 bytes more "
            "each, to those ranks that get any; two reductions</li></ul>"
            "<p>On fewer ranks what a rank sends itself is left out, and what goes to one rank from several sides is "
            "one message (staged: one for each side).</p>")


MANY_TEXT = (
    f"Assumptions: a message keeps a core busy for {OVERHEAD * 1e6:g} µs, and takes {LATENCY * 1e6:g} µs, which count "
    "once for messages that are on their way together; the six steps of staged wait for each other; a rank sends "
    f"{BANDWIDTH / 1e9:g} GB/s whatever the others do, so no links are shared; a reduction waits 2 ⌈log₂ ranks⌉ times; "
    "particles are spread evenly; the cutoff is 2.4 times their distance, and one goes at most 0.32 of it along each "
    "axis; gathering and searching are not in it. What a rank sends does "
    "not depend on how many ranks there are; of a step only the reductions of migrate grow, by 6 µs for each doubling.")


def sections(results, pyplot):
    parts = []
    if results.times:
        parts.append(f'<h2 id="ranks">Ranks</h2><p>{RANKS_TEXT}</p>')
        if results.sizes():
            parts.append(f"<p>{html.escape(choice(results))}</p>")
        parts.append('<div class="charts">')
        if results.percents():
            parts.append("<figure>" + svg_of(migrate_chart(results, pyplot), pyplot, "migrate") + "</figure>")
        for size in results.sizes():
            chart = svg_of(ghost_chart(results, size, pyplot), pyplot, f"{size} ghosts")
            parts.append(f"<figure>{chart}</figure>")
        parts.append("</div>")
        sync = results.time("sync", "none", "reduction")
        if results.percents():
            parts.append("<h3>Migration</h3>" +
                         (f"<p>One empty reduction: {figure_of(sync)} µs.</p>" if sync else "") +
                         migrate_table(results))
        if results.sizes():
            parts.append("<h3>Ghosts</h3>" + ghost_table(results))
    if results.model:
        parts.append('<h2 id="many">Many ranks</h2>' + model_text(results) + '<div class="charts">')
        for which, label in enumerate(("Messages", "kB")):
            parts.append("<figure>" + svg_of(model_chart(results, which, label, pyplot), pyplot, label) + "</figure>")
        parts.append(f"</div><h3>Counted</h3>{model_table(results)}<h3>Carried to {power(MANY)} ranks</h3>"
                     f"<p>{MANY_TEXT}</p>{many_table()}")
    return "".join(parts)


# ---------------------------------------------------------------------------------------------------------------
# Tables for the README


def markdown(results):
    context = results.contexts[0]
    lines = [context_text(context, context.get("mpi", "MPI"), f"{results.ranks} ranks"), "",
             f"µs of the slowest rank, medians of {min(results.repetitions())} interleaved turns.", "",
             markdown_row(["task", "tsubu", "by hand", "MPI_Sendrecv of the bytes"]), "|" + "---|" * 4]
    cells = [("migrate", str(p), f"migrate, {p} % leave", ("tsubu",)) for p in results.percents()]
    cells += [(task, size, f"{TASKS[task]}, {size} ghosts, {p}", (p,)) for size in results.sizes() for task in TASKS
              for p in PATTERNS]
    for task, variant, label, names in cells:
        times = [results.time(task, variant, name) for name in (*names, "hand", "raw")]
        if times[0]:
            lines.append(markdown_row([label, *(figure_of(t) if t else "" for t in times)]))
    return "\n".join(lines) + "\n"
