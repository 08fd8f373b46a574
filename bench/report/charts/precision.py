# SPDX-License-Identifier: MIT
"""Chart 4: what precision costs. Error over cost, a curve per integrator, law and coordinates."""
import math

from ..dem import LAWS, LOOKS, TOLERANCE, order_of
from ..drawing import LOW_BOX, label_ends, legend, new_panel, panel, panels, tables
from ..page import figure_cell, table
from ..pictures import INK, log_ticks
from ..spread import apart, figure_of, quotient, scaled, short_power

ROOM = "dem"
TITLE = "What does precision cost?"
QUESTION = ("Error against the exact solution over the cost of a simulated second, a mark per time step; the lower "
            "left is best. Each panel is a scene with its contact law; a curve is an integrator, or velocity Verlet "
            "with other numbers or coordinates.")
ABSENT = "bench/run --only dem"
METHOD = (
    "Impacts: two spheres meet at 1 m/s, at 16 phases of a step, with N = 5 · 2<sup>k</sup> + 0.37 steps of a "
    "contact, since whole numbers would let the errors of entry and exit cancel; all laws have about the same time of "
    "contact, 5 ms. Oblique: a sphere hits a floor at 45 degrees and sticks (μ = 0.5) or slides (μ = 0.2); rms error "
    "of its velocity and of that of its surface. Gas: elastic spheres (φ = 0.05), by how much the energy changes in a "
    "quarter of a time unit, rms, relative. What a step costs is measured of the same simulation with 4096 spheres in "
    "a row. Dotted: the rounding floor of float and of lattice&lt;int32&gt;, five units in the last place by the "
    "overlap. Implicit damping needs a damped law; integrators with several stages, and those that move no spins, do "
    "not compile with a contact that remembers; a lattice is periodic, and a floor is not; Hertz and Mindlin have no "
    "closed form. Other numbers than double are shown with velocity Verlet only, since rounding does not depend on "
    "the integrator.")
FINE = 1e-5  # the second tolerance of the sentence
# 5 units in the last place of a coordinate, by the greatest overlap of 1.58e-3 m: at 0.5 m, and in a box of 4 m
FLOORS = {"float": 5 * 2.0**-24 / 1.58e-3, "lattice<int32>": 5 * 4 * 2.0**-32 / 1.58e-3}


def cheapest(points, tolerance):
    """The fewest steps from which on no error is above the tolerance; None if there are none."""
    fewest = None
    for steps, error in reversed(points):
        if error > tolerance:
            break
        fewest = steps
    return fewest


def per_step_of(results, law):
    """Simulated seconds that a contact lasts, turned round, in µs per ns."""
    rows = results.rows[("impact", law, "velocity_verlet", "double")]
    return 1e-3 / (rows[0]["time_step"] * rows[0]["steps"])


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
    found = [Scene("impact", law, f"Impact: {label}", "cost", law, per_step_of(results, law), "restitution")
             for law, (label, *_) in LAWS.items() if ("impact", law, "velocity_verlet", "double") in results.rows]
    step = 1e-3 / (math.pi / math.sqrt(2e5))
    found += [Scene("oblique", case, name, "oblique_cost", "all", step, "velocities")
              for case, name in (("rolls", "Oblique impact that sticks"),
                                 ("slides", "Oblique impact that slides"))
              if ("oblique", case, "velocity_verlet", "double") in results.rows]
    if ("gas", "hooke", "velocity_verlet", "double") in results.rows:
        found.append(Scene("gas", "hooke", "Elastic gas of 1000 spheres", "gas_cost", "hooke",
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
    if every:
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


def costs_by_scene(results, tolerance_of):
    """{scene: {integrator: cost}} of those scenes in which any reaches the tolerance, with doubles"""
    found = {}
    for scene in scenes(results):
        costs = {s: c for s, c in scene.costs(results, tolerance_of(scene)).items() if s[1] == "double"}
        if costs:
            found[scene] = costs
    return found


def is_good(costs, series):
    least = min(costs.values())
    return series in costs and (costs[series] <= SAME * least or not apart(costs[series], least))


def cheapest_in_most(costs_of):
    """(the integrator, the scenes in which it is as cheap as any)"""
    wins = {series: [scene for scene, costs in costs_of.items() if is_good(costs, series)] for series in LOOKS}
    chosen = max(wins, key=lambda series: len(wins[series]))  # of equals the first, which is velocity Verlet
    return chosen, wins[chosen]


def choice_advice(results, tolerance, tolerance_of):
    """[(text, figures)], of errors below the tolerance, which is named."""
    costs_of = costs_by_scene(results, tolerance_of)
    if not costs_of:
        return []
    chosen, good = cheapest_in_most(costs_of)
    elsewhere = []
    for scene, costs in costs_of.items():
        if scene not in good:
            cost, best = min((c, s) for s, c in costs.items())
            against = f" against {figure_of(costs[chosen])}" if chosen in costs else ""
            elsewhere.append(f"{LOOKS[best].label} in “{scene.name}”, {figure_of(cost)}{against} µs")
    paid = [costs_of[scene][chosen] for scene in good]
    return [(f"for errors below {tolerance} choose {LOOKS[chosen].label}, within noise or 2 % of the cheapest in "
             f"{len(good)} of {len(costs_of)} scenes, at {figure_of(min(paid))} to {figure_of(max(paid))} µs of a core "
             "per simulated second and particle", "; ".join(elsewhere))]


def rival_advice(results, rival=("pefrl", "double")):
    costs_of = costs_by_scene(results, lambda scene: scene.tolerance)
    chosen, _ = cheapest_in_most(costs_of)
    ratios = [quotient(c[rival], c[chosen]) for c in costs_of.values() if rival in c and chosen in c]
    if not ratios or rival == chosen:
        return []
    return [(f"{LOOKS[rival].label} costs {figure_of(min(ratios))} to {figure_of(max(ratios))} times that", "")]


def numbers_advice(results):
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
        return [("other numbers than double save nothing beyond noise", "")]
    series, (gain, where) = max(gains.items(), key=lambda g: g[1])
    return [(f"of other numbers “{LOOKS[series].label}” saves most: double takes up to {figure_of(gain)} times as "
             "long", where)]


def tolerance_text(results):
    """1 % (1e-4 of the energy)"""
    special = [f"{short_power(scene.tolerance)} of the {scene.what}" for scene in scenes(results)
               if scene.tolerance != TOLERANCE]
    return f"{100 * TOLERANCE:g} %" + (f" ({', '.join(special)})" if special else "")


def advice(results):
    coarse = choice_advice(results, tolerance_text(results), lambda scene: scene.tolerance)
    if not coarse:
        return "", [("no curve reaches the tolerance", "")]
    return "", (coarse + rival_advice(results) + choice_advice(results, short_power(FINE), lambda scene: FINE) +
                numbers_advice(results))


def order_table(results, task, cases, tolerance=TOLERANCE):
    rows = []
    for case, label in cases:
        for integrator, number in results.series(task, case):
            points = results.errors(task, case, integrator, number)
            found = order_of([p for p in points if p[0] < 700] if number != "double" else points)
            finest = points[-1]
            steps = cheapest(points, tolerance)
            rows.append([label, LOOKS[(integrator, number)].label,
                         f'<td class="figure">{found:.2f}</td>' if found else "",
                         f'<td class="figure">{finest[1]:.1e}</td>', f'<td class="figure">{finest[0]:.0f}</td>',
                         f'<td class="figure">{steps:.0f}</td>' if steps else "<td>never</td>"])
    return table(["Law", "Integrator and number", "Order", "Error at the shortest step", "Steps of a contact there",
                  f"Steps for {tolerance:g}"], rows)


def cost_table(results):
    laws = [law for law in LAWS if ("cost", law, "velocity_verlet", "double") in results.rows]
    rows = []
    for (integrator, number), look in LOOKS.items():
        cells = [figure_cell(results.time("cost", law, integrator, number)) for law in laws]
        if any(c != "<td></td>" for c in cells):
            rows.append([look.label, *cells])
    return table(["ns per particle-step, a row of 4096 spheres that touch"] + [LAWS[law][0] for law in laws], rows)


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
    return tables(parts + [("What a step costs: ns per particle-step, median (its limits)",
                            cost_table(results)), ("How it was measured", f"<p>{METHOD}</p>")])
