# SPDX-License-Identifier: MIT
"""Scenes of spheres: what each model costs, and LAMMPS beside it. What precision costs, and how long a step may be, are
charts 4 and 5."""
import html
import math
from collections import defaultdict

from .claims import Claim
from .drawing import Look
from .page import context_text, figure_cell, markdown_row, ratio_cell, table
from .pictures import INK, colour, svg_of
from .reading import Refusal, RoomResults
from .spread import figure_of, listed, middle, quotient

LAWS = {  # name: label, order of the restitution's error, with which integrator
    "hooke": ("Hooke", 2, "velocity_verlet"), "dashpot": ("Hooke and dashpot", 1, "velocity_verlet"),
    "hertz": ("Hertz", 2.5, "velocity_verlet"), "tsuji": ("Hertz and Tsuji", 1.25, "implicit_velocity_verlet")}
LOOKS = {  # (integrator, number)
    ("velocity_verlet", "double"): Look("velocity Verlet", "blue", "o", width=2, short="Verlet"),
    ("implicit_velocity_verlet", "double"): Look("velocity Verlet, implicit damping", "purple", "s", short="implicit"),
    ("symplectic_euler", "double"): Look("symplectic Euler", "green", "^", "--", short="sympl. Euler"),
    ("pefrl", "double"): Look("PEFRL", "vermilion", "D"),
    ("runge_kutta_4", "double"): Look("Runge–Kutta 4", "yellow", "v", "-.", short="RK4"),
    ("explicit_euler", "double"): Look("explicit Euler", "grey", "x", "--", 1.1, short="expl. Euler"),
    ("velocity_verlet", "mixed"): Look("Verlet, double x, float v and f", "sky", "P", ":", 1.2, short="mixed"),
    ("velocity_verlet", "float"): Look("Verlet, float", "purple", "1", ":", 1.2, short="float"),
    ("velocity_verlet", "in_cells"): Look("Verlet, in_cells<float>", "orange", "+", ":", 1.2, short="in_cells"),
    ("velocity_verlet", "lattice64"): Look("Verlet, lattice<int64>", "ink", "2", ":", 1.2, short="int64"),
    ("velocity_verlet", "lattice32"): Look("Verlet, lattice<int32>", "red", "|", ":", 1.2, short="int32"),
}
TOLERANCE = 1e-2  # restitutions are not known better
LOST = 1e9        # an error that is none any more

RUNGS = {  # name: label; base: which rung it is compared with stands in the rows
    "motion": "motion alone, no contacts", "hooke": "Hooke", "dashpot": "+ dashpot", "coulomb": "+ rotation, Coulomb",
    "history": "+ history", "hertz": "Hertz", "hertz_dashpot": "+ dashpot", "mindlin": "+ rotation, Mindlin, history",
    "tsuji": "Tsuji for the dashpot", "rolling": "+ rolling resistance", "dmt": "+ DMT cohesion",
    "own_sizes": "history, each its own size", "implicit": "dashpot, implicit damping"}
NUMBERS = {"double": "double", "mixed": "double x, float v and f", "float": "float", "in_cells": "in_cells<float>",
           "lattice64": "lattice<int64>", "lattice32": "lattice<int32>",
           "lattice64_float": "lattice<int64>, float v and f"}
SCENES = {  # name: label, promise over LAMMPS, the rung of the same law in the same bed
    "gas": ("gas, 10648", 2, None), "bed_frictionless": ("bed, frictionless, 1e4", 2, "dashpot"),
    "settle_1e4": ("settle, falling, 1e4", 1.5, None), "settle_bed_1e4": ("settle, settled bed, 1e4", 1.5, "history"),
    "settle_1e5": ("settle, falling, 1e5", 1.5, None), "bed_hertz": ("bed, Hertz and Mindlin, 1e4", 1.5, "mindlin"),
    "bed_hertz_mindlin": ("bed, Hertz, Mindlin, Tsuji, 1e4", 1.5, "tsuji")}
# LAMMPS turns the spring of a contact before it is lengthened there, and not after.
OTHER_ORDER = ("bed_hertz_mindlin",)
OURS, THEIRS, OTHER_NUMBERS = colour("blue"), colour("vermilion"), colour("purple")
BYTES_PROMISE, RANKS_PROMISE, HAND_PROMISE, ORDER_PROMISE, SAME_PROMISE = 2, 1.8, 1.05, .15, 6
RANK_SCENES = {"settle_1e5": "falling", "bed_1e5": "at rest"}

TITLE = "scenes"
INTRODUCTION = (
    "What a step of spheres costs, model by model, and beside LAMMPS; how exact it is and where it breaks stands in "
    "charts 4 and 5. All contenders take turns; LAMMPS, where it is installed, runs the same scene from the same "
    "numbers on the same core.")
CLAIM_NOTE = ""


class Results(RoomResults):
    """Rows by the name of their task and what follows it."""

    def __init__(self):
        super().__init__()
        self.rows = defaultdict(list)  # (task, a, b, c)

    def measured(self):
        return (self.rows,)

    def add(self, row):
        _, task, *rest = row["name"].split("/")
        key = (task, *rest)
        if key not in self.already:  # of two runs of one cell the first counts
            self.rows[key].append(row)

    def is_empty(self):
        return not self.rows

    def repetitions(self):
        return {len(rows) for rows in self.rows.values() if "repetition_index" in rows[0]} or {1}

    def missing(self):
        """[(what, why)] of what could not be measured, as the program tells it."""
        return [key[1:3] for key in self.rows if key[0] == "missing"]

    def has(self, task):
        return any(key[0] == task for key in self.rows)

    def time(self, *key):
        """ns per particle-step, a Spread; None if not measured."""
        rows = self.rows.get(key)
        return middle([row["real_time"] for row in rows]) if rows else None

    def field(self, name, *key):
        rows = self.rows.get(key)
        return rows[-1].get(name) if rows else None

    def errors(self, task, case, integrator, number):
        """[(steps of a contact, error)], the fewest steps first."""
        return sorted((row["steps"], row["error"]) for row in self.rows.get((task, case, integrator, number), ()))

    def evaluations(self, integrator):
        return 4 if integrator in ("pefrl", "runge_kutta_4") else 1

    def series(self, task, case):
        """[(integrator, number)]"""
        return [s for s in LOOKS if (task, case, *s) in self.rows]

    def rungs(self):
        """[(name, base, number)] in the order of the ladder."""
        order = {name: k for k, name in enumerate(RUNGS)}
        found = [key[1:] for key in self.rows if key[0] == "ladder"]
        return sorted(found, key=lambda r: (order.get(r[0], 99), list(NUMBERS).index(r[2])))

    def rung_time(self, name):
        return next((self.time("ladder", *r) for r in self.rungs() if r[0] == name and r[2] == "double"), None)

    def base_of(self, rung):
        name, base, number = rung
        return next((r for r in self.rungs() if r[0] == base and r[2] == "double"), None) if base != "-" else None

    def over_base(self, rung):
        base = self.base_of(rung)
        return quotient(self.time("ladder", *rung), self.time("ladder", *base)) if base and base != rung else None

    def scenes(self):
        return [s for s in SCENES if ("beside", s, "tsubu", "double") in self.rows]

    def speedup(self, scene):
        return quotient(self.time("beside", scene, "lammps", "double"), self.time("beside", scene, "tsubu", "double"))

    def over_hand(self, task):
        """The library by the quickest loop that was written by hand."""
        by_hand = [t for who in ("plain", "lanes") if (t := self.time("hand", task, who, "double"))]
        return quotient(self.time("hand", task, "tsubu", "double"), min(by_hand)) if by_hand else None


def order_of(points):
    """The slope of log error over log steps, least squares, where rounding does not show; None of too few."""
    used = [(math.log(n), math.log(e)) for n, e in points if n > 8 and e > 1e-8]
    if len(used) < 3:
        return None
    mean_x, mean_y = (sum(p[k] for p in used) / len(used) for k in (0, 1))
    return -sum((x - mean_x) * (y - mean_y) for x, y in used) / sum((x - mean_x)**2 for x, _ in used)


def all_claims(results):
    claims = []
    frictionless, others = (Claim(f"LAMMPS / tsubu, time of a step, {text}", promise) for text, promise in
                            (("frictionless", 2), ("with friction", 1.5)))
    memory = Claim("LAMMPS / tsubu, resident bytes per particle", BYTES_PROMISE)
    same = Claim("Digits of the kinetic energy that are those of LAMMPS", SAME_PROMISE, "")
    for scene in results.scenes():
        label, promise, _ = SCENES[scene]
        (frictionless if promise == 2 else others).add(results.speedup(scene), label)
        ours, theirs = (results.field("resident", "beside", scene, who, "double") for who in ("tsubu", "lammps"))
        if ours and theirs:
            memory.add(theirs / ours, label)
        difference = results.field("difference", "same", scene, "kinetic", "double")
        if difference is not None and scene not in OTHER_ORDER:
            same.add(min(16, -math.log10(max(difference, 1e-16))), label)
    ranks = Claim("1 rank / 2 ranks, time of a step, 1e5", RANKS_PROMISE)
    for scene, state in RANK_SCENES.items():
        ranks.add(quotient(*(results.time("ranks", scene, n, "double") for n in "12")), state)
    by_hand = Claim("tsubu / loops by hand, frictionless", HAND_PROMISE, at_least=False)
    for task in ("forces", "motion"):
        by_hand.add(results.over_hand(task), task)
    orders = Claim("Order of the restitution's error less that of theory", ORDER_PROMISE, "", at_least=False)
    for law, (label, order, integrator) in LAWS.items():
        found = order_of(results.errors("impact", law, integrator, "double"))
        if found:
            orders.add(abs(found - order), f"{label}: {found:.2f}, {order:g}")
    return claims + [frictionless, others, memory, same, ranks, by_hand, orders]


# ---------------------------------------------------------------------------------------------------------------
# Charts


def legend_above(axes, handles, labels):
    axes.legend(handles, labels, loc="lower right", bbox_to_anchor=(1.01, .985), ncol=2, frameon=False, fontsize=8.5)


def ladder_chart(results, pyplot):
    rungs = results.rungs()
    figure, (times, sizes) = pyplot.subplots(1, 2, figsize=(11, .9 + .3 * len(rungs)), sharey=True,
                                             gridspec_kw={"wspace": .06, "width_ratios": (1.7, 1)})
    rivals = {rung: scene for scene, (_, _, rung) in SCENES.items() if rung and scene in results.scenes()}
    longest = max(results.time("ladder", *rung) for rung in rungs)
    for k, rung in enumerate(rungs):
        name, _, number = rung
        time = results.time("ladder", *rung)
        size = results.field("bytes", "ladder", *rung)
        shade = OURS if number == "double" else OTHER_NUMBERS
        times.barh(k, time, height=.62, color=shade, zorder=3)
        times.plot([time.low, time.high], [k, k], color=INK, linewidth=1, zorder=4)
        sizes.barh(k, size, height=.62, color=shade, zorder=3)
        sizes.annotate(f"{size:.0f}", (size, k), xytext=(4, 0), textcoords="offset points", va="center", fontsize=8)
        text_at = time.high
        if number == "double" and name in rivals:
            theirs = results.time("beside", rivals[name], "lammps", "double")
            their_size = results.field("bytes", "beside", rivals[name], "lammps", "double")
            if theirs:
                times.plot([theirs, theirs], [k - .38, k + .38], color=THEIRS, linewidth=2.4, zorder=5,
                           label="LAMMPS, same law and bed")
                sizes.plot([their_size, their_size], [k - .38, k + .38], color=THEIRS, linewidth=2.4, zorder=5)
                if 0 <= theirs - text_at < .12 * longest:  # in the way of the figure
                    text_at = theirs
        times.annotate(figure_of(time), (text_at, k), xytext=(5, 0), textcoords="offset points", va="center",
                       fontsize=8)
    labels = [RUNGS.get(n, n) if number == "double" else f"history, {NUMBERS[number]}" for n, _, number in rungs]
    times.set_yticks(range(len(rungs)), labels)
    times.set_ylim(len(rungs) - .4, -.6)
    times.set_xlabel("ns per particle-step")
    sizes.set_xlabel("bytes per particle")
    for axes in (times, sizes):
        axes.set_xlim(0, axes.get_xlim()[1] * 1.06)
        axes.grid(True, axis="x")
    sizes.tick_params(left=False)
    contacts = next((results.field("contacts", "ladder", *r) for r in rungs if r[0] == "history"), 0)
    times.set_title(f"Dense bed, {contacts:.2f} contacts per particle", loc="left")
    handles, names = times.get_legend_handles_labels()
    if names:
        legend_above(times, handles[:1], names[:1])
    return figure


def beside_chart(results, pyplot):
    scenes = results.scenes()
    figure, (times, sizes) = pyplot.subplots(1, 2, figsize=(11, .9 + .5 * len(scenes)), sharey=True,
                                             gridspec_kw={"wspace": .06, "width_ratios": (1.7, 1)})
    for k, scene in enumerate(scenes):
        for who, shade, label, up in (("tsubu", OURS, "tsubu", -.19), ("lammps", THEIRS, "LAMMPS", .19)):
            time = results.time("beside", scene, who, "double")
            if not time:
                continue
            size = results.field("resident", "beside", scene, who, "double")
            times.barh(k + up, time, height=.36, color=shade, zorder=3, label=label if k == 0 else None)
            times.plot([time.low, time.high], [k + up, k + up], color=INK, linewidth=1, zorder=4)
            ratio = results.speedup(scene)
            text = figure_of(time) + (f" · {figure_of(ratio)} times ours" if who == "lammps" and ratio else "")
            times.annotate(text, (time.high, k + up), xytext=(4, 0), textcoords="offset points", va="center",
                           fontsize=8)
            sizes.barh(k + up, size, height=.36, color=shade, zorder=3)
            sizes.annotate(f"{size:.0f}", (size, k + up), xytext=(4, 0), textcoords="offset points", va="center",
                           fontsize=8)
    times.set_yticks(range(len(scenes)), [SCENES[s][0] for s in scenes])
    times.set_ylim(len(scenes) - .4, -.6)
    times.set_xlabel("ns per particle-step")
    sizes.set_xlabel("resident bytes per particle")
    times.set_xlim(0, times.get_xlim()[1] * 1.3)
    sizes.set_xlim(0, sizes.get_xlim()[1] * 1.1)
    for axes in (times, sizes):
        axes.grid(True, axis="x")
    sizes.tick_params(left=False)
    times.set_title("Beside LAMMPS, one core", loc="left")
    legend_above(times, *times.get_legend_handles_labels())
    return figure


def readme_chart(results, pyplot):
    if not results.scenes():
        raise Refusal("no scene beside LAMMPS in these results: nothing to draw")
    return beside_chart(results, pyplot)


# ---------------------------------------------------------------------------------------------------------------
# Sentences


def ladder_sentence(results):
    prices = [(ratio, r) for r in results.rungs() if r[2] == "double" and (ratio := results.over_base(r))
              and r[0] not in ("hooke", "hertz")]
    if not prices:
        return ""
    dearest, cheap = max(prices), min(prices)
    text = (f"The dearest step is {RUNGS[dearest[1][0]].lstrip('+ ')} ({figure_of(dearest[0])} times "
            f"{RUNGS[dearest[1][1]].lstrip('+ ')}), the cheapest {RUNGS[cheap[1][0]].lstrip('+ ')} "
            f"({figure_of(cheap[0])} times).")
    numbers = sorted((results.time("ladder", *r), r[2]) for r in results.rungs() if r[0] == "history")
    if len(numbers) > 1:
        double = results.rung_time("history")
        text += (f" Of the numbers, {NUMBERS[numbers[0][1]]} is the quickest with history, "
                 f"{figure_of(double / numbers[0][0])} times as fast as double.")
    return text


def ladder_table(results):
    rows = []
    for rung in results.rungs():
        name, base, number = rung
        label = RUNGS.get(name, name) if number == "double" else f"history, {NUMBERS[number]}"
        over = results.base_of(rung)
        over_label = "" if not over or over == rung else RUNGS[over[0]].lstrip("+ ")
        rows.append([label, figure_cell(results.time("ladder", *rung)), over_label,
                     ratio_cell(results.over_base(rung)) if over != rung else "",
                     f'<td class="figure">{results.field("bytes", "ladder", *rung):.0f}</td>',
                     f'<td class="figure">{results.field("carried", "ladder", *rung):.0f}</td>'])
    return table(["Models", "ns per particle-step", "compared with", "times", "Bytes per particle",
                  "of them fields"], rows)


def beside_table(results):
    rows = []
    for scene in results.scenes():
        ours, theirs = (results.time("beside", scene, who, "double") for who in ("tsubu", "lammps"))
        sizes = [results.field(what, "beside", scene, who, "double") for what in ("bytes", "resident")
                 for who in ("tsubu", "lammps")]
        difference = results.field("difference", "same", scene, "kinetic", "double")
        cells = [SCENES[scene][0], figure_cell(ours), figure_cell(theirs), ratio_cell(results.speedup(scene)),
                 f'<td class="figure">{1e3 / ours:.1f}</td>',
                 f'<td class="figure">{1e3 / theirs:.1f}</td>' if theirs else ""]
        cells += [f'<td class="figure">{s:.0f}</td>' if s else "" for s in sizes]
        cells.append(f'<td class="figure">{difference:.0e}</td>' if difference is not None else "")
        rows.append(cells)
    return table(["Scene", "tsubu, ns", "LAMMPS, ns", "LAMMPS / tsubu", "tsubu, M/s", "LAMMPS, M/s", "Bytes, tsubu",
                  "Bytes, LAMMPS", "resident, tsubu", "resident, LAMMPS", "Energies differ by"], rows)


def beside_sentence(results):
    found = [(ratio, scene) for scene in results.scenes() if (ratio := results.speedup(scene))]
    if not found:
        return ""
    low, high = min(found), max(found)
    return (f"A step takes LAMMPS {figure_of(low[0])} times ({SCENES[low[1]][0]}) to {figure_of(high[0])} times "
            f"({SCENES[high[1]][0]}) as long as tsubu.")


def hand_table(results):
    rows = []
    for task in ("forces", "motion"):
        times = [results.time("hand", task, who, "double") for who in ("tsubu", "plain", "lanes")]
        if times[0]:
            rows.append([task, *map(figure_cell, times), ratio_cell(results.over_hand(task))])
    return table(["", "tsubu, ns per particle", "by hand, one after the other", "by hand, in lanes",
                  "tsubu / quickest by hand"], rows)


LADDER_TEXT = (
    "A bed of 10000 spheres that has settled once, and in which steps are so short that nothing moves: all models see "
    "the same contacts, and no list is made anew. Marks of LAMMPS are of the same bed in motion, below.")
BESIDE_TEXT = (
    "Both begin from the same doubles and do the same steps, each turn anew. With Hertz, Mindlin and Tsuji LAMMPS "
    "turns the spring of a contact before it lengthens it, and not after, so that energies differ in more than "
    "rounding. Bytes are those that each program tells, of particles and lists; resident is by how much its memory "
    "grew in all.")


def figure_element(figure, pyplot, title):
    return "<figure>" + svg_of(figure, pyplot, title) + "</figure>"


def rank_sentences(results):
    sentences = []
    for scene, state in RANK_SCENES.items():
        one, two = (results.time("ranks", scene, n, "double") for n in "12")
        if one and two:
            sentences.append(f"100000 spheres, {state}: {figure_of(one)} ns per particle-step on one rank, "
                             f"{figure_of(two)} on two, {figure_of(quotient(one, two))} times as fast.")
    return " ".join(sentences)


def sections(results, pyplot):
    parts = []
    text = lambda words: f"<p>{html.escape(words)}</p>" if words else ""
    if results.has("ladder") or results.has("beside"):
        parts.append('<h2 id="ladder">Models and LAMMPS</h2>')
    if results.has("ladder"):
        parts.append(text(LADDER_TEXT) + text(ladder_sentence(results)) +
                     figure_element(ladder_chart(results, pyplot), pyplot, "ladder") + ladder_table(results))
    half, full = (results.time("lists", "bed", which, "double") for which in ("half", "full"))
    if half and full:
        parts.append(text(f"To build a list of neighbours of that bed takes {figure_of(half)} ns per particle if each "
                          f"pair is in it once, and {figure_of(full)} ns if both sides have it."))
    if results.has("hand"):
        parts.append("<h3>Loops by hand</h3>" + text(
            "Spheres of the same bed, with a spring and a dashpot, and nothing around them: what one would write for "
            "that alone, over the same list.") + hand_table(results))
    if results.scenes():
        parts.append("<h3>Beside LAMMPS</h3>" + text(beside_sentence(results)) + text(BESIDE_TEXT) +
                     figure_element(beside_chart(results, pyplot), pyplot, "LAMMPS") + beside_table(results))
    if results.has("ranks"):
        parts.append("<h3>Ranks</h3>" + text(rank_sentences(results)))
    if results.missing():
        parts.append(text("Not measured: " + listed([f"{what} ({why})" for what, why in results.missing()]) + "."))
    return "".join(parts)


# ---------------------------------------------------------------------------------------------------------------
# Tables for the README


def markdown(results):
    context = results.contexts[0]
    lines = [context_text(context), ""]
    if results.scenes():
        lines += [markdown_row(["scene", "tsubu, ns per particle-step", "LAMMPS", "LAMMPS / tsubu",
                                "resident bytes per particle", "LAMMPS"]), "|" + "---|" * 6]
        for scene in results.scenes():
            ours, theirs = (results.time("beside", scene, who, "double") for who in ("tsubu", "lammps"))
            sizes = [results.field("resident", "beside", scene, who, "double") for who in ("tsubu", "lammps")]
            lines.append(markdown_row([SCENES[scene][0], figure_of(ours), figure_of(theirs) if theirs else "",
                                       f"{figure_of(results.speedup(scene))}x" if theirs else "",
                                       *(f"{s:.0f}" if s else "" for s in sizes)]))
        lines.append("")
    if results.rungs():
        lines += [markdown_row(["models in the dense bed", "ns per particle-step", "times what it adds to",
                                "bytes per particle"]), "|" + "---|" * 4]
        for rung in results.rungs():
            name, _, number = rung
            ratio = results.over_base(rung)
            lines.append(markdown_row([
                RUNGS.get(name, name) if number == "double" else f"history, {NUMBERS[number]}",
                figure_of(results.time("ladder", *rung)), f"{figure_of(ratio)}x" if ratio else "",
                f"{results.field('bytes', 'ladder', *rung):.0f}"]))
    return "\n".join(lines) + "\n"
