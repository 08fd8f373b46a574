# SPDX-License-Identifier: MIT
"""Scenes of spheres: work against precision, errors past the limit of stability, what each model costs, and LAMMPS."""
import html
import math
from collections import defaultdict

from .page import (GRID, INK, Claim, Refusal, figure_cell, figure_of, limits, listed, markdown_row,
                   middle, plain_ticks, quotient, ratio_cell, svg_of, table)
from .reading import RoomResults

LAWS = {  # name: label, order of the restitution's error, with which integrator
    "hooke": ("Hooke", 2, "velocity_verlet"), "dashpot": ("Hooke and dashpot", 1, "velocity_verlet"),
    "hertz": ("Hertz", 2.5, "velocity_verlet"), "tsuji": ("Hertz and Tsuji", 1.25, "implicit_velocity_verlet")}
SERIES = (  # integrator, number, label, colour, line, marker
    ("velocity_verlet", "double", "velocity Verlet", "#2a8fd0", "-", "o"),
    ("implicit_velocity_verlet", "double", "… with implicit damping", "#7b52ab", "-", "s"),
    ("symplectic_euler", "double", "symplectic Euler", "#3a9a5b", (0, (4, 3)), "^"),
    ("pefrl", "double", "PEFRL", "#d1603d", "-", "D"),
    ("runge_kutta_4", "double", "Runge–Kutta 4", "#c9a227", "-", "v"),
    ("explicit_euler", "double", "explicit Euler", "#888888", "-", "x"),
    ("velocity_verlet", "mixed", "Verlet, double x, float v and f", "#0b5a8f", "--", "."),
    ("velocity_verlet", "float", "Verlet, float", "#e377a2", "--", "."),
    ("velocity_verlet", "in_cells", "Verlet, in_cells<float>", "#5f6f1f", "-.", "."),
    ("velocity_verlet", "lattice64", "Verlet, lattice<int64>", "#16a3a3", ":", "."),
    ("velocity_verlet", "lattice32", "Verlet, lattice<int32>", "#8a5a2b", ":", "."))
ORDERS = (1, 1.25, 1.5, 2, 2.5, 4)
TOLERANCE = 1e-2  # restitutions are not known better
LOST = 1e9        # an error that is none any more
# 5 units in the last place of a coordinate, by the greatest overlap of 1.58e-3 m: at 0.5 m, and in a box of 4 m
FLOORS = {"float": 5 * 2.0**-24 / 1.58e-3, "lattice<int32>": 5 * 4 * 2.0**-32 / 1.58e-3}
FLOOR_COLOURS = {"float": "#e377a2", "lattice<int32>": "#8a5a2b"}

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
OURS, THEIRS = "#2a8fd0", "#d1603d"
BYTES_PROMISE, RANKS_PROMISE, HAND_PROMISE, ORDER_PROMISE, SAME_PROMISE = 2, 1.8, 1.05, .15, 6
RANK_SCENES = {"settle_1e5": "falling", "bed_1e5": "at rest"}

TITLE = "scenes"
INTRODUCTION = (
    "Scenes: what a step of spheres costs, how exact it is, and where it breaks. All contenders take turns; LAMMPS, "
    "where it is installed, runs the same scene from the same numbers on the same core.")
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
        return [s for s in SERIES if (task, case, s[0], s[1]) in self.rows]

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


def cheapest(points, tolerance):
    """The fewest steps from which on no error is above the tolerance; None if there are none."""
    fewest = None
    for steps, error in reversed(points):
        if error > tolerance:
            break
        fewest = steps
    return fewest


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


def log_ticks(axis):
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
    low, high = axis.get_view_interval()
    if high / low < 30:
        plain_ticks(axis)
        axis.set_minor_formatter(NullFormatter())
        return
    axis.set_major_locator(LogLocator(base=10, numticks=9))
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}" if .01 <= v < 1e4 else f"1e{round(math.log10(v))}"))
    axis.set_minor_formatter(NullFormatter())


def legend_below(figure, axes, columns, at=-.01):
    found = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels()):
            found.setdefault(label, handle)
    figure.legend(found.values(), found.keys(), loc="upper center", bbox_to_anchor=(.5, at), ncol=columns,
                  frameon=False, fontsize=8.5)


def legend_above(axes, handles, labels):
    axes.legend(handles, labels, loc="lower right", bbox_to_anchor=(1.01, .985), ncol=2, frameon=False, fontsize=8.5)


def hatched(axes, low, high, upright, label, where=None):
    """The unstable side of an axis."""
    span = axes.axvspan if upright else axes.axhspan
    span(low, high, facecolor="none", edgecolor="#b3261e", alpha=.4, hatch="///", linewidth=0, zorder=0)
    if label:
        x, y = where
        axes.annotate(label, (x, y), xycoords="axes fraction", fontsize=8, color="#b3261e",
                      ha="right" if x > .5 else "left")


def guides(axes, start):
    """A fan of the orders from a point on, to the border of the chart on the left."""
    x0, y0 = start
    left, top = axes.get_xlim()[0], axes.get_ylim()[1]
    for order in ORDERS:
        end_y = y0 * (left / x0)**(-1 / order)
        end_x = left
        if end_y > top:
            end_x, end_y = x0 * (top / y0)**(-order), top
        axes.plot([x0, end_x], [y0, end_y], color=GRID, linewidth=.9, zorder=1)
        on_top = end_y == top
        axes.annotate(f"{order:g}", (end_x, end_y), xytext=(0, 3) if on_top else (3, 1), textcoords="offset points",
                      fontsize=7.5, ha="center" if on_top else "left", va="bottom", annotation_clip=False)


def work_precision(results, task, case, title, pyplot, cost_task=None, cost_case=None, per_step=None, floors=True,
                   tolerance=TOLERANCE, what="error of the restitution, rms"):
    """Error against cost in time, and in force evaluations."""
    figure, (by_time, by_force) = pyplot.subplots(1, 2, figsize=(11, 4.1), gridspec_kw={"wspace": .3})
    every = []
    for integrator, number, label, colour, line, marker in results.series(task, case):
        points = [(n, e) for n, e in results.errors(task, case, integrator, number) if e < 10]
        if not points:
            continue
        every += points
        look = {"color": colour, "linestyle": line, "marker": marker, "markersize": 4, "linewidth": 1.4, "zorder": 3}
        step = results.time(cost_task or "cost", cost_case or case, integrator, number)
        if step:
            by_time.plot([e for _, e in points], [step * n * per_step for n, _ in points], label=label, **look)
        by_force.plot([e for _, e in points], [n * results.evaluations(integrator) for n, _ in points], label=label,
                      **look)
    for axes in (by_time, by_force):
        axes.set_xscale("log")
        axes.set_yscale("log")
        low = min(e for _, e in every)
        axes.set_xlim(low / 2.5, max(e for _, e in every) * 2)
        axes.grid(True)
        axes.set_xlabel(what)
        if tolerance:
            axes.axvline(tolerance, color="#1d7a3c", linewidth=1.1, linestyle=(0, (6, 3)), zorder=2)
        for name, floor in FLOORS.items() if floors else ():
            if floor > axes.get_xlim()[0]:
                axes.axvline(floor, color=FLOOR_COLOURS[name], linewidth=1, linestyle=(0, (1, 2)), zorder=2)
    by_time.set_ylabel("µs of a core per simulated second and particle")
    by_force.set_ylabel("force evaluations of a contact")
    by_force.set_ylim(1, by_force.get_ylim()[1])
    if task == "impact":
        hatched(by_force, 1, math.pi / 2, False, "one evaluation per step: unstable", (.98, .015))
        start = min(results.errors(task, case, "velocity_verlet", "double"))
        guides(by_force, (start[1] * 1.6, start[0]))
    for axes in (by_time, by_force):
        top = axes.get_ylim()[1]
        marks = [(tolerance, "tolerance", "#1d7a3c")] if tolerance else []
        marks += [(f, n.replace("lattice<int32>", "int32"), FLOOR_COLOURS[n]) for n, f in FLOORS.items()
                  if floors and f > axes.get_xlim()[0]]
        if axes is by_time:
            for x, text, colour in marks:
                axes.annotate(text, (x, top), xytext=(0, 2), textcoords="offset points", ha="center", va="bottom",
                              fontsize=7.5, color=colour, annotation_clip=False)
        log_ticks(axes.xaxis)
        log_ticks(axes.yaxis)
    by_time.set_title(title, loc="left", pad=16)
    by_force.set_title("in force evaluations", loc="left", pad=16)
    legend_below(figure, (by_time, by_force), 5, .0)
    return figure


def verlet_limit(zeta):
    """Of w dt, where damping sees the velocity of the half step."""
    return 2 * (math.sqrt(1 + zeta * zeta) - zeta)


def stability_limit(step):
    """The least w dt at which the map (x, v) -> step(x, v, w dt) of an undamped oscillator grows, by its trace and
    determinant."""
    previous = 0
    for k in range(1, 4001):
        h = k / 1000
        (a, c), (b, d) = step(1, 0, h), step(0, 1, h)
        trace, determinant = a + d, a * d - b * c
        root = trace * trace / 4 - determinant
        size = math.sqrt(determinant) if root < 0 else abs(trace / 2) + math.sqrt(root)
        if size > 1 + 1e-9:
            return previous
        previous = h
    return previous


def verlet_step(x, v, h):
    v -= h / 2 * x
    x += h * v
    return x, v - h / 2 * x


def pefrl_step(x, v, h):
    xi, la, chi = .1786178958448091, -.2123418310626054, -.06626458266981849
    for drift, kick in ((xi, (1 - 2 * la) / 2), (chi, la), (1 - 2 * (chi + xi), la), (chi, (1 - 2 * la) / 2)):
        x += drift * h * v
        v -= kick * h * x
    return x + xi * h * v, v


def runge_kutta_step(x, v, h):
    # exp(h A) to fourth order, A = (0, 1; -1, 0)
    c, s = 1 - h**2 / 2 + h**4 / 24, h - h**3 / 6
    return c * x + s * v, -s * x + c * v


THEORY = {"velocity_verlet": verlet_step, "symplectic_euler": verlet_step, "pefrl": pefrl_step,
          "runge_kutta_4": runge_kutta_step}


def with_limit(axes, at, colour, text, high, side="center"):
    axes.axvline(at, color=colour, linewidth=1, linestyle=(0, (4, 2)), zorder=2)
    axes.annotate(text, (at, high), xytext=(0, 2), textcoords="offset points", ha=side, va="bottom", fontsize=7.5,
                  color=colour, annotation_clip=False)


def wall_points(results, zeta, integrator):
    rows = results.rows.get(("walls", zeta, integrator, "double"), ())
    return sorted((row["omega_dt"], row["error"]) for row in rows)


def past_limit_chart(results, pyplot):
    """A sphere between two walls: undamped by integrator, damped by how the damping is taken."""
    figure, (plain, damped) = pyplot.subplots(1, 2, figsize=(11, 3.9), gridspec_kw={"wspace": .22})
    high = 1e2

    def draw(axes, points, label, colour, line="-"):
        axes.plot([w for w, _ in points], [max(e, 1e-8) if e < high else math.nan for _, e in points], color=colour,
                  linestyle=line, linewidth=1.5, label=label, zorder=3)
        lost = [w for w, e in points if e >= high]
        axes.plot(lost, [high * 10**(-.12)] * len(lost), linestyle="", marker="|", markersize=5, color=colour, zorder=3)

    lifts = {}
    for integrator, number, label, colour, line, _ in SERIES:
        points = wall_points(results, "0", integrator) if number == "double" else []
        if not points:
            continue
        draw(plain, points, label, colour, line)
        if integrator in THEORY:
            lifts.setdefault(round(stability_limit(THEORY[integrator]), 2), colour)
    for at, colour in lifts.items():
        close = [o for o in lifts if o != at and abs(o - at) < .3]
        side = "center" if not close else "right" if at < close[0] else "left"
        with_limit(plain, at, colour, f"{at:.2f}", high, side)
    zetas = sorted({key[1] for key in results.rows if key[0] == "walls" and float(key[1]) > 0}, key=float)
    for zeta, colour in zip(zetas, ("#3a9a5b", "#c9a227", "#d1603d", "#7b52ab")):
        draw(damped, wall_points(results, zeta, "velocity_verlet"), f"half step, ζ = {zeta}", colour)
        draw(damped, wall_points(results, zeta, "implicit_velocity_verlet"), f"implicit, ζ = {zeta}", colour, ":")
        with_limit(damped, verlet_limit(float(zeta)), colour, f"{verlet_limit(float(zeta)):.2f}", high,
                   "right" if verlet_limit(float(zeta)) > 1.7 else "center")
    with_limit(damped, 2, INK, "2 implicit", high, "left")
    for axes in (plain, damped):
        axes.set_yscale("log")
        axes.set_xlim(0, 4)
        axes.set_ylim(1e-7 if axes is plain else 1e-4, high)
        log_ticks(axes.yaxis)
        axes.grid(True)
        axes.set_xlabel("ω dt")
        axes.set_ylabel("greatest error of 300 steps, by the amplitude")
        axes.legend(loc="lower right", fontsize=8, frameon=True, facecolor="white", edgecolor="none",
                    labelcolor="#222222", framealpha=.85)
    hatched(plain, 2, 4, True, "", None)
    hatched(damped, 2, 4, True, "", None)
    plain.set_title("Between two walls, undamped", loc="left", pad=16)
    damped.set_title("damped: half-step and implicit", loc="left", pad=16)
    return figure


def impact_past_chart(results, pyplot):
    figure, axes = pyplot.subplots(1, 4, figsize=(11, 3.2), sharey=True, gridspec_kw={"wspace": .1})
    for place, (law, (label, _, _)) in zip(axes, LAWS.items()):
        for integrator, number, name, colour, line, _ in SERIES:
            rows = results.rows.get(("past", law, integrator, number), ()) if number == "double" else ()
            rows += results.rows.get(("impact", law, integrator, number), [])[:2] if rows else type(rows)()
            points = sorted((math.pi / row["steps"], row["error"]) for row in rows)
            if points:
                place.plot([w for w, _ in points], [min(e, 20) for _, e in points], color=colour, linestyle=line,
                           linewidth=1.4, label=name, zorder=3)
        place.set_yscale("log")
        place.set_ylim(1e-4, 12)
        place.set_xlim(.3, 4)
        place.axhline(TOLERANCE, color="#1d7a3c", linewidth=1, linestyle=(0, (6, 3)))
        hatched(place, 2, 4, True, "", None)
        with_limit(place, 2, INK, "", 12)
        place.grid(True)
        place.set_xlabel("π dt / t_c")
        place.set_title(label, loc="left", fontsize=10)
        log_ticks(place.yaxis)
    axes[0].set_ylabel("error of the restitution, rms")
    legend_below(figure, axes, 6, -.04)
    return figure


def settle_rows(results):
    rows = results.rows.get(("settle", "bed", "velocity_verlet", "double"), [])
    return sorted((row for row in rows if row["kinetic"] < LOST), key=lambda r: r["omega_dt"])


def settle_limit(results):
    found = [row["limit"] for row in settle_rows(results) if "limit" in row]
    return min(found) if found else None


def cliff_chart(results, pyplot):
    rows = settle_rows(results)
    figure, axes = pyplot.subplots(1, 4, figsize=(11, 3.1), gridspec_kw={"wspace": .42})
    limit = settle_limit(results)
    # What is measured of beds that have settled, of 1e4 spheres
    known = {"coordination": (4.65, .03), "packing": (.591, .0015)}
    for place, (field, title, scale) in zip(axes, (
            ("coordination", "contacts per particle", "linear"), ("packing", "share of the volume", "linear"),
            ("kinetic", "kinetic energy per particle, J", "log"),
            ("nanoseconds_per_second", "µs per simulated second\nand particle", "log"))):
        by = 1e3 if field.startswith("nano") else 1
        place.plot([r["omega_dt"] for r in rows], [r[field] / by for r in rows], "o-", color="#2a8fd0", markersize=4,
                   linewidth=1.4, zorder=3)
        place.set_yscale(scale)
        if field in known:
            value, spread = known[field]
            place.axhspan(value - spread, value + spread, color="#1d7a3c", alpha=.25, zorder=1)
        place.set_xlim(0, max(r["omega_dt"] for r in rows) * 1.04)
        if limit:
            hatched(place, limit, place.get_xlim()[1], True, "", None)
            with_limit(place, limit, "#b3261e", f"{limit:.2f}", place.get_ylim()[1])
        place.grid(True)
        place.set_xlabel("dt / √(m/k)")
        place.set_title(title, loc="left", fontsize=9.5, pad=16)
        if scale == "log":
            log_ticks(place.yaxis)
    return figure


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
        colour = OURS if number == "double" else "#7b52ab"
        times.barh(k, time, height=.62, color=colour, zorder=3)
        times.plot([time.low, time.high], [k, k], color=INK, linewidth=1, zorder=4)
        sizes.barh(k, size, height=.62, color=colour, zorder=3)
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
        for who, colour, label, up in (("tsubu", OURS, "tsubu", -.19), ("lammps", THEIRS, "LAMMPS", .19)):
            time = results.time("beside", scene, who, "double")
            if not time:
                continue
            size = results.field("resident", "beside", scene, who, "double")
            times.barh(k + up, time, height=.36, color=colour, zorder=3, label=label if k == 0 else None)
            times.plot([time.low, time.high], [k + up, k + up], color=INK, linewidth=1, zorder=4)
            ratio = results.speedup(scene)
            text = figure_of(time) + (f" · {figure_of(ratio)} times ours" if who == "lammps" and ratio else "")
            times.annotate(text, (time.high, k + up), xytext=(4, 0), textcoords="offset points", va="center",
                           fontsize=8)
            sizes.barh(k + up, size, height=.36, color=colour, zorder=3)
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


def label_of(integrator, number):
    return next((s[2].replace("… with", "velocity Verlet with") for s in SERIES if s[:2] == (integrator, number)),
                integrator)


def costs_at(results, task, case, tolerance, cost_task, cost_case, per_step):
    """[(µs per simulated second and particle, steps, integrator, number)], the cheapest first."""
    found = []
    for integrator, number, *_ in results.series(task, case):
        if number == "float":  # holds near the origin only: never a first choice
            continue
        steps = cheapest(results.errors(task, case, integrator, number), tolerance)
        time = results.time(cost_task, cost_case, integrator, number)
        if steps and time:
            found.append((time * steps * per_step, steps, integrator, number))
    return sorted(found)


def choice_of(results, task, case, tolerance, cost_task, cost_case, per_step, what):
    found = costs_at(results, task, case, tolerance, cost_task, cost_case, per_step)
    if not found:
        return f"No curve reaches {what} of {tolerance:g}."
    best = found[0]
    others = [f for f in found if f[3] == "double" and f[2] not in (best[2],)]
    text = (f"For {what} below {tolerance:g}, choose {label_of(*best[2:])} with about {best[1]:.0f} steps of a "
            f"contact: {figure_of(best[0])} µs per simulated second and particle")
    if others:
        ratio = others[0][0] / best[0]
        text += (f"; {label_of(*others[0][2:])} costs the same" if limits(ratio)[0] < 1.05 else
                 f"; next is {label_of(*others[0][2:])}, {figure_of(ratio)} times that")
    return text + "."


def per_step_of(results, law):
    """Simulated seconds that a contact lasts, turned round, in µs per ns."""
    rows = results.rows[("impact", law, "velocity_verlet", "double")]
    return 1e-3 / (rows[0]["time_step"] * rows[0]["steps"])


def order_table(results, task, cases, tolerance=TOLERANCE):
    rows = []
    for case, label in cases:
        for integrator, number, name, *_ in results.series(task, case):
            points = results.errors(task, case, integrator, number)
            found = order_of([p for p in points if p[0] < 700] if number != "double" else points)
            finest = points[-1]
            steps = cheapest(points, tolerance)
            rows.append([label, label_of(integrator, number),
                         f'<td class="figure">{found:.2f}</td>' if found else "",
                         f'<td class="figure">{finest[1]:.1e}</td>', f'<td class="figure">{finest[0]:.0f}</td>',
                         f'<td class="figure">{steps:.0f}</td>' if steps else "<td>never</td>"])
    return table(["Law", "Integrator and number", "Order", "Error at the shortest step", "Steps of a contact there",
                  f"Steps for {tolerance:g}"], rows)


def cost_table(results):
    laws = [law for law in LAWS if ("cost", law, "velocity_verlet", "double") in results.rows]
    rows = []
    for integrator, number, *_ in SERIES:
        cells = [figure_cell(results.time("cost", law, integrator, number)) for law in laws]
        if any(c != "<td></td>" for c in cells):
            rows.append([label_of(integrator, number), *cells])
    return table(["ns per particle-step, a row of 4096 spheres that touch"] + [LAWS[law][0] for law in laws], rows)


def limit_table(results):
    rows = []
    for key in sorted((k for k in results.rows if k[0] == "walls"), key=lambda k: (float(k[1]), k[2])):
        _, zeta, integrator, _ = key
        points = wall_points(results, zeta, integrator)
        lost = [w for w, e in points if e >= 1e2]
        stable = max((w for w, e in points if e < 1e2 and (not lost or w < lost[0])), default=0)
        if integrator == "explicit_euler":
            theory = 0.0
        elif integrator in ("pefrl", "runge_kutta_4"):
            theory = stability_limit(THEORY[integrator])
        else:
            theory = verlet_limit(float(zeta)) if integrator == "velocity_verlet" else 2.0
        rows.append([zeta, label_of(integrator, "double"), f'<td class="figure">{theory:.3f}</td>',
                     f'<td class="figure">{stable:.3f}</td>',
                     f'<td class="figure">{lost[0]:.3f}</td>' if lost else "<td>none</td>"])
    return table(["ζ", "Integrator", "Limit of ω dt by theory", "Last that stays", "First that grows"], rows)


def limit_sentence(results):
    points = {i: wall_points(results, "0", i) for i in THEORY}
    texts = []
    for integrator in ("velocity_verlet", "pefrl", "runge_kutta_4"):
        stays = [w for w, e in points[integrator] if e < 1e2]
        lost = [w for w, e in points[integrator] if e >= 1e2]
        if stays and lost:
            texts.append((lost[0] / results.evaluations(integrator), label_of(integrator, "double"), lost[0]))
    if not texts:
        return ""
    best = max(texts)
    return (f"The longest stable step per force evaluation is that of {best[1]}: choose it where stability decides. " +
            "; ".join(f"{name} breaks at ω dt = {at:.2f}, {per:.2f} per evaluation" for per, name, at in texts) + ".")


def settle_sentence(results):
    rows = settle_rows(results)
    if len(rows) < 4:
        return ""
    flat = [r for r in rows if r["omega_dt"] <= .6]
    mean = sum(r["coordination"] for r in flat) / len(flat)
    spread = max(abs(r["coordination"] - mean) for r in flat)
    broken = next((r for r in rows if abs(r["coordination"] - mean) > max(3 * spread, .1)), None)
    good = [r for r in rows if not broken or r["omega_dt"] < broken["omega_dt"]]
    text = (f"Up to dt = {good[-1]['omega_dt']:g} √(m/k) the bed has {mean:.2f} contacts per particle, to within "
            f"{max(spread, .01):.2f}, however short the step is: choose {min(.7, good[-1]['omega_dt']):g}, which costs "
            f"{good[0]['nanoseconds_per_second'] / good[-1]['nanoseconds_per_second']:.1f} times less than "
            f"{good[0]['omega_dt']:g}. ")
    if broken:
        text += (f"At {broken['omega_dt']:g} there are {broken['coordination']:.2f}, and at {rows[-1]['omega_dt']:g} "
                 f"there are {rows[-1]['coordination']:.2f}: nothing is lost and no error is raised, but "
                 "the bed does not come to rest.")
    return text


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


WORK_TEXT = (
    "Two spheres meet at 1 m/s, at 16 phases of a step; N = 5 · 2^k + 0.37 steps of a contact, since whole numbers "
    "would let the errors of entry and exit cancel. All laws have about the same time of contact, 5 ms. What a step "
    "costs is measured of the same simulation with 4096 spheres in a row. Lower left is best. Green dashes: the "
    "tolerance of 1e-2, to which restitutions are known; dots: the rounding floor of float coordinates and of "
    "lattice<int32>, five units in the last place by the overlap. On the right, thin lines are the orders that stand "
    "at their ends; where fewer than π/2 evaluations fall on a contact (hatched), ω dt is above 2. Implicit damping "
    "needs a damped law, and is left out of the others; numbers other than double are shown with velocity Verlet "
    "only, since rounding does not depend on the integrator.")
OBLIQUE_TEXT = (
    "A sphere hits a floor at 45 degrees, and sticks (μ = 0.5) or slides (μ = 0.2): rms error of its velocity and "
    "of the velocity of its surface. Integrators with several stages and those that move no spins do not compile with "
    "a contact that remembers; a lattice is periodic, and a floor is not; Hertz and Mindlin have no closed form.")
GAS_TEXT = (
    "1000 elastic spheres (φ = 0.05): by how much the energy changes in a quarter of a time unit, rms, relative. "
    "Collisions win or lose energy with the phase of the step in which they begin, so the drift is a sum of as many "
    "small errors.")
PAST_TEXT = (
    "A sphere between two walls is an oscillator that does not lose its contacts: marks at the upper border are runs "
    "whose error has left the chart. Dashed lines and hatching are theory: 2 for Verlet and symplectic Euler, 2 (√(1 "
    "+ ζ²) − ζ) for damping from the half step, and for PEFRL and Runge–Kutta the least ω dt at which the matrix of a "
    "step has an eigenvalue above 1; explicit Euler is never stable. Hatched is what lies beyond 2.")
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


def links(results):
    found = []
    if results.has("impact"):
        found.append(("work", "Work and precision"))
    if results.has("walls") or results.has("settle"):
        found.append(("limits", "Past the limit"))
    if results.has("ladder") or results.has("beside"):
        found.append(("ladder", "Models and LAMMPS"))
    return found


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
    if results.has("impact"):
        parts.append('<h2 id="work">Work and precision</h2>' + text(WORK_TEXT))
        for law, (label, *_) in LAWS.items():
            if not results.series("impact", law):
                continue
            step = per_step_of(results, law)
            chosen = choice_of(results, "impact", law, TOLERANCE, "cost", law, step, "an error of the restitution")
            parts.append(f"<h3>Impact: {label}</h3>" + text(chosen) +
                         figure_element(work_precision(results, "impact", law, label, pyplot, per_step=step), pyplot,
                                        label))
        parts.append(order_table(results, "impact", [(law, label) for law, (label, *_) in LAWS.items()]) +
                     cost_table(results))
    if results.has("oblique"):
        parts.append("<h3>Oblique impact</h3>" + text(OBLIQUE_TEXT))
        step = 1e-3 / (math.pi / math.sqrt(2e5))
        for case, label in (("rolls", "it sticks"), ("slides", "it slides")):
            parts.append(text(choice_of(results, "oblique", case, TOLERANCE, "oblique_cost", "all", step,
                                        f"an error ({label})")) +
                         figure_element(work_precision(results, "oblique", case, f"Oblique impact, {label}", pyplot,
                                                       "oblique_cost", "all", step, False, TOLERANCE,
                                                       "error of velocities, rms"), pyplot, label))
        parts.append(order_table(results, "oblique", [("rolls", "rolls"), ("slides", "slides")]))
    if results.has("gas"):
        step = 1e-3 / (math.pi / math.sqrt(4e5))
        parts.append("<h3>Elastic gas</h3>" + text(GAS_TEXT) +
                     text(choice_of(results, "gas", "hooke", 1e-4, "gas_cost", "hooke", step,
                                    "a change of the energy in a quarter of a time unit")) +
                     figure_element(work_precision(results, "gas", "hooke", "Gas, drift of the energy", pyplot,
                                                   "gas_cost", "hooke", step, False, 1e-4,
                                                   "change of the energy in a quarter of a time unit, rms"),
                                    pyplot, "gas") +
                     order_table(results, "gas", [("hooke", "Hooke")], 1e-4))
    if results.has("walls") or results.has("settle"):
        parts.append('<h2 id="limits">Past the limit</h2>')
    if results.has("walls"):
        parts.append(text(PAST_TEXT) + text(limit_sentence(results)) +
                     figure_element(past_limit_chart(results, pyplot), pyplot, "stability") + limit_table(results))
    if results.has("past"):
        parts.append("<h3>An impact with too long a step</h3>" +
                     text("Hatched: fewer than π/2 steps of a contact, where a spring is unstable. A sphere still "
                          "leaves, but faster than it came.") +
                     figure_element(impact_past_chart(results, pyplot), pyplot, "impacts past the limit"))
    if settle_rows(results):
        parts.append("<h3>A bed that settles with too long a step</h3>" + text(settle_sentence(results)) +
                     figure_element(cliff_chart(results, pyplot), pyplot, "settle"))
        parts.append(table(["dt / √(m/k)", "Contacts per particle", "Share of the volume", "Mean height, m",
                            "Kinetic energy per particle, J", "µs per simulated second and particle"],
                           [[f"{r['omega_dt']:g}", *(f'<td class="figure">{t}</td>' for t in (
                               f"{r['coordination']:.3f}", f"{r['packing']:.4f}", f"{r['height']:.3f}",
                               f"{r['kinetic']:.1e}", figure_of(r["nanoseconds_per_second"] / 1e3)))]
                            for r in settle_rows(results)]))
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
    lines = [f"{context['machine']}, {context['compiler']}, `{context['flags']}`, commit {context['commit']}.", ""]
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
