# SPDX-License-Identifier: MIT
"""Chart 4: what precision costs. Error over cost, a curve per integrator, law and coordinates."""
import math

from ..dem import FLOORS, LAWS, TOLERANCE, cheapest, cost_table, label_of, log_ticks, order_table, per_step_of
from ..drawing import LOW_BOX, Look, label_ends, legend, new_panel, panel, panels, tables
from ..page import INK, apart, figure_cell, figure_of, quotient, scaled, short_power, table

ROOM = "dem"
TITLE = "What does precision cost?"
QUESTION = ("Error against the exact solution over the cost of a simulated second, a mark per time step; the lower "
            "left is best. Each panel is a scene with its contact law; a curve is an integrator, or velocity Verlet "
            "with other numbers or coordinates.")
ABSENT = "bench/run --only dem"
FINE = 1e-5  # the second tolerance of the sentence
LOOKS = {
    ("velocity_verlet", "double"): Look("velocity Verlet, double", "blue", "o", width=2, short="Verlet"),
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


class Scene:
    """A panel: rows of errors, those of costs, and the simulated time that a step of a contact is."""

    def __init__(self, task, case, name, cost_task, cost_case, per_step, what, tolerance=TOLERANCE):
        self.task, self.case, self.name, self.cost = task, case, name, (cost_task, cost_case)
        self.per_step, self.what, self.tolerance = per_step, what, tolerance

    def curve(self, results, series):
        """[(cost, error)] in µs of a core per simulated second and particle."""
        step = results.time(*self.cost, *series)
        if not step:
            return []
        return [(scaled(step, n * self.per_step), e) for n, e in results.errors(self.task, self.case, *series)
                if e < 10]

    def costs(self, results, tolerance):
        """{series: cost of the longest step from which on no error is above the tolerance}"""
        found = {}
        for series in LOOKS:
            step = results.time(*self.cost, *series)
            steps = cheapest(results.errors(self.task, self.case, *series), tolerance)
            if step and steps:
                found[series] = scaled(step, steps * self.per_step)
        return found


def scenes(results):
    found = [Scene("impact", law, f"Impact, {label}", "cost", law, per_step_of(results, law), "restitution")
             for law, (label, *_) in LAWS.items() if ("impact", law, "velocity_verlet", "double") in results.rows]
    step = 1e-3 / (math.pi / math.sqrt(2e5))
    found += [Scene("oblique", case, name, "oblique_cost", "all", step, "velocities")
              for case, name in (("rolls", "Oblique impact that sticks, history"),
                                 ("slides", "Oblique impact that slides, history"))
              if ("oblique", case, "velocity_verlet", "double") in results.rows]
    if ("gas", "hooke", "velocity_verlet", "double") in results.rows:
        found.append(Scene("gas", "hooke", "Elastic gas of 1000, Hooke", "gas_cost", "hooke",
                           1e-3 / (math.pi / math.sqrt(4e5)), "energy", 1e-4))
    return found


def is_there(results):
    return bool(scenes(results))


def scene_panel(results, scene, pyplot):
    figure, axes = new_panel(pyplot, box=LOW_BOX)
    every, ends = [], []
    for series, look in LOOKS.items():
        points = scene.curve(results, series)
        if points:
            axes.plot([float(c) for c, _ in points], [e for _, e in points], **look.style(markersize=3.8))
            every += points
            ends.append((float(points[-1][0]), points[-1][1], look.short, look.colour))
    axes.set(xscale="log", yscale="log")
    axes.set_xlabel("µs of a core per simulated second and particle", fontsize=9, labelpad=1)
    axes.set_ylabel(f"error of the {scene.what}", fontsize=9, labelpad=1)
    low = min(e for _, e in every)
    axes.set_ylim(low / 3, min(10, max(e for _, e in every)) * 2)
    axes.axhline(scene.tolerance, color=INK, linewidth=.9, linestyle=(0, (6, 3)), zorder=1)
    axes.annotate("tolerance", (1, scene.tolerance), xycoords=("axes fraction", "data"), xytext=(-2, 2),
                  textcoords="offset points", fontsize=8, ha="right")
    if scene.task == "impact":
        for name, floor in FLOORS.items():
            if floor > axes.get_ylim()[0]:
                axes.axhline(floor, color=INK, linewidth=.8, linestyle=(0, (1, 3)), zorder=1)
                axes.annotate(f"rounding, {name}", (0, floor), xycoords=("axes fraction", "data"), xytext=(3, 2),
                              textcoords="offset points", fontsize=7.5)
    log_ticks(axes.xaxis)
    log_ticks(axes.yaxis)
    label_ends(axes, ends)
    return panel(figure, pyplot, scene.name)


def drawn(results, pyplot):
    shown = [look for series, look in LOOKS.items() if any(s.curve(results, series) for s in scenes(results))]
    return legend(shown, pyplot) + panels(scene_panel(results, s, pyplot) for s in scenes(results))


SAME = 1.02  # costs closer than this are called equal, even where the noise is less


def compared(results, tolerance_of):
    """(the integrator that is the cheapest in most scenes, [(scene, its cost)] of these, texts where another is
    cheaper, {scene: costs})"""
    costs_of = {}
    for scene in scenes(results):
        costs = {s: c for s, c in scene.costs(results, tolerance_of(scene)).items() if s[1] == "double"}
        if costs:
            costs_of[scene] = costs
    is_good = lambda costs, s: s in costs and (costs[s] <= SAME * min(costs.values()) or
                                               not apart(costs[s], min(costs.values())))
    wins = {s: [scene for scene, costs in costs_of.items() if is_good(costs, s)] for s in LOOKS}
    chosen = max(wins, key=lambda s: len(wins[s]))  # of equals the first, which is velocity Verlet
    elsewhere = []
    for scene, costs in costs_of.items():
        if scene not in wins[chosen]:
            cost, best = min((c, s) for s, c in costs.items())
            against = f", against {figure_of(costs[chosen])}" if chosen in costs else ""
            elsewhere.append(f"{label_of(*best)} in {scene.name}, {figure_of(cost)} µs{against}")
    return chosen, [(scene, costs_of[scene][chosen]) for scene in wins[chosen]], elsewhere, costs_of


def choice_text(results, tolerance_of, with_rivals):
    chosen, good, elsewhere, costs_of = compared(results, tolerance_of)
    if not good:
        return ""
    costs = [c for _, c in good]
    text = (f"{label_of(*chosen)}, which is within noise or 2 % of the cheapest in {len(good)} of {len(costs_of)} "
            f"scenes, at {figure_of(min(costs))} to {figure_of(max(costs))} µs of a core per simulated second and "
            "particle")
    if elsewhere:
        text += f" ({'; '.join(elsewhere)})"
    for rival in (("pefrl", "double"),) if with_rivals else ():
        ratios = [quotient(c[rival], c[chosen]) for c in costs_of.values() if rival in c and chosen in c]
        if ratios:
            text += f"; {label_of(*rival)} costs {figure_of(min(ratios))} to {figure_of(max(ratios))} times that"
    return text


def numbers_text(results):
    """How much other numbers save where they still reach the tolerance, in the panel where each saves most. Not plain
    float: it holds near the origin only."""
    gains = {}
    for scene in scenes(results):
        costs = scene.costs(results, scene.tolerance)
        plain = costs.get(("velocity_verlet", "double"))
        for series, cost in costs.items():
            if plain and series[1] not in ("double", "float") and apart(plain, cost) and cost < plain:
                gains[series] = max(gains.get(series, (0, "")), (plain / cost, scene.name))
    if not gains:
        return "other numbers than double save nothing beyond noise"
    series, (gain, where) = max(gains.items(), key=lambda g: g[1])
    return f"of other numbers {label_of(*series)} saves most, {figure_of(gain)} times ({where})"


def sentence(results):
    coarse = choice_text(results, lambda scene: scene.tolerance, True)
    fine = choice_text(results, lambda scene: FINE, False)
    if not coarse:
        return "No curve reaches the tolerance."
    text = f"For errors below the tolerance that is drawn in choose {coarse}"
    if fine:
        text += f"; below {short_power(FINE)} {fine}"
    return text + f"; {numbers_text(results)}."


def tolerance_table(results):
    present = scenes(results)
    costs = [scene.costs(results, scene.tolerance) for scene in present]
    rows = [[look.label] + [figure_cell(c.get(series)) if series in c else "<td>–</td>" for c in costs]
            for series, look in LOOKS.items() if any(series in c for c in costs)]
    head = ["µs per simulated second and particle"]
    return table(head + [f"{s.name}, {short_power(s.tolerance)}" for s in present], rows)


def figures(results):
    parts = [("What the tolerance costs, with the longest step from which on no error is above it; –: never reached, "
              "or not possible there", tolerance_table(results)),
             ("Order, and steps of a contact for the tolerance: impacts",
              order_table(results, "impact", [(law, label) for law, (label, *_) in LAWS.items()]))]
    if results.has("oblique"):
        parts.append(("The same: oblique impacts",
                      order_table(results, "oblique", [("rolls", "sticks"), ("slides", "slides")])))
    if results.has("gas"):
        parts.append(("The same: elastic gas", order_table(results, "gas", [("hooke", "Hooke")], 1e-4)))
    return tables(parts + [("What a step costs: ns per particle-step, median (limits of the median)",
                            cost_table(results))])
