# SPDX-License-Identifier: MIT
"""Chart 5: where each method breaks. Error over the time step, up to the limit of stability and past it."""
import math

from ..dem import (LAWS, LOST, THEORY, TOLERANCE, limit_table, log_ticks, settle_limit, settle_rows, stability_limit,
                   verlet_limit, wall_points)
from ..drawing import label_ends, legend, mark_upright, new_panel, panel, panels, shaded, tables
from ..page import colour, figure_of, listed, table
from .precision import LOOKS as INTEGRATORS

ROOM = "dem"
TITLE = "How long may a step be?"
QUESTION = ("Error over the time step, up to the limit of stability and past it; dashed uprights are the limits of "
            "theory, hatched is what lies beyond them. Errors are computed, not timed, and have no noise.")
ABSENT = "bench/run --only dem"
HIGH = 1e2  # of the amplitude: the oscillation is lost


def is_there(results):
    return results.has("walls") or results.has("past") or bool(settle_rows(results))


def limit_of(integrator, zeta):
    """Of ω dt, by theory; 0 if there is none."""
    if zeta > 0:
        return 2.0 if integrator == "implicit_velocity_verlet" else verlet_limit(zeta)
    return stability_limit(THEORY[integrator]) if integrator in THEORY else 0.0


def zetas(results):
    return sorted({key[1] for key in results.rows if key[0] == "walls" and float(key[1]) > 0}, key=float)


def broken_at(results, zeta, integrator):
    """The first ω dt at which the oscillation is lost, or None."""
    return next((w for w, e in wall_points(results, zeta, integrator) if e >= HIGH), None)


def draw_error(axes, points, look, every=9):
    lost = next((k for k, (_, e) in enumerate(points) if e >= HIGH), len(points))
    before, after = points[:lost], [p for p in points[lost:] if p[1] < HIGH]
    axes.plot([w for w, _ in before], [max(e, 1e-8) for _, e in before], **look.style(markevery=every, markersize=4))
    if after:  # some integrators have a second interval of steps that do not grow
        axes.plot(*zip(*after), **look.style(markevery=every, markersize=4, alpha=.45))
    if before and lost < len(points):  # an arrow to what is not shown
        axes.annotate("", (points[lost][0], HIGH), (before[-1][0], max(before[-1][1], 1e-8)),
                      arrowprops={"arrowstyle": "-|>", "color": look.colour, "linewidth": 1})


def walls_panel(results, zeta, pyplot):
    """Undamped: by integrator; damped: how the damping is taken."""
    figure, axes = new_panel(pyplot, box=(.2, .155, .76, .72))
    limits = {}
    for (integrator, number), look in INTEGRATORS.items():
        points = wall_points(results, zeta, integrator) if number == "double" else []
        if points:
            draw_error(axes, points, look)
            if limit_of(integrator, float(zeta)):
                names, _ = limits.setdefault(round(limit_of(integrator, float(zeta)), 2), ([], look.colour))
                names.append("half step" if zeta != "0" and integrator == "velocity_verlet" else look.short)
    for at, (names, shade) in limits.items():
        mark_upright(axes, at, f"{', '.join(names)} {at:.2f}", shade, side="left" if at == max(limits) else "right")
    axes.set(yscale="log", xlim=(0, 4), ylim=(1e-7 if zeta == "0" else 1e-4, HIGH))
    if limits:
        shaded(axes, max(limits), 4)
    axes.set_xlabel("ω dt", fontsize=9, labelpad=1)
    axes.set_ylabel("greatest error in 300 steps, by amplitude", fontsize=8.5, labelpad=1)
    log_ticks(axes.yaxis)
    name = "Oscillator, undamped" if zeta == "0" else f"Oscillator, damped, ζ = {zeta}"
    return panel(figure, pyplot, name)


def past_points(results, law, integrator):
    """[(ω dt, error of the restitution)]"""
    return sorted((math.pi / row["steps"], row["error"]) for row in
                  results.rows.get(("past", law, integrator, "double"), ()))


def impact_panel(results, law, pyplot):
    figure, axes = new_panel(pyplot, box=(.2, .155, .575, .72))
    ends = []
    for (integrator, number), look in INTEGRATORS.items():
        points = past_points(results, law, integrator) if number == "double" else []
        if points:
            axes.plot([w for w, _ in points], [min(e, 20) for _, e in points], **look.style(markevery=4, markersize=4))
            ends.append((points[-1][0], min(points[-1][1], 12), look.short, look.colour))
    axes.set(yscale="log", xlim=(.4, 4), ylim=(1e-4, 12))
    label_ends(axes, ends)
    axes.axhline(TOLERANCE, color=colour("green"), linewidth=1, linestyle=(0, (6, 3)), zorder=1)
    axes.annotate("tolerance", (1, TOLERANCE), xycoords=("axes fraction", "data"), xytext=(-2, 2),
                  textcoords="offset points", fontsize=8, ha="right", color=colour("green"))
    mark_upright(axes, 2, "2: one evaluation per step", line=(0, (5, 2)))
    shaded(axes, 2, 4)
    axes.set_xlabel("π dt / time of contact, which is ω dt", fontsize=9, labelpad=1)
    axes.set_ylabel("error of the restitution, rms", fontsize=9, labelpad=1)
    log_ticks(axes.yaxis)
    return panel(figure, pyplot, f"Impact, {LAWS[law][0]}")


BED = {"coordination": ("contacts per particle", "linear", 1), "kinetic": ("kinetic energy per particle, J", "log", 1),
       "nanoseconds_per_second": ("µs per simulated second and particle", "log", 1e3)}


def bed_panel(results, field, pyplot):
    figure, axes = new_panel(pyplot, box=(.2, .155, .76, .72))
    title, scale, by = BED[field]
    rows = settle_rows(results)
    axes.plot([r["omega_dt"] for r in rows], [r[field] / by for r in rows],
              **INTEGRATORS[("velocity_verlet", "double")].style())
    axes.set_yscale(scale)
    axes.set_xlim(0, max(r["omega_dt"] for r in rows) * 1.04)
    limit = settle_limit(results)
    if limit:
        mark_upright(axes, limit, f"longest_time_step: {limit:.2f}")
        shaded(axes, limit, axes.get_xlim()[1])
    axes.set_xlabel("dt / √(m/k)", fontsize=9, labelpad=1)
    axes.set_ylabel(title, fontsize=9, labelpad=1)
    if scale == "log":
        log_ticks(axes.yaxis)
    return panel(figure, pyplot, f"A bed that settles: {title.split(',')[0]}")


def drawn(results, pyplot):
    parts = []
    if results.has("walls"):
        parts += [walls_panel(results, zeta, pyplot) for zeta in ["0", *zetas(results)]]
    if results.has("past"):
        parts += [impact_panel(results, law, pyplot) for law in LAWS
                  if ("past", law, "velocity_verlet", "double") in results.rows]
    if settle_rows(results):
        parts += [bed_panel(results, field, pyplot) for field in BED]
    shown = [look for (integrator, number), look in INTEGRATORS.items() if number == "double" and
             any(key[2] == integrator for key in results.rows if key[0] in ("walls", "past"))]
    return legend(shown, pyplot) + panels(parts)


def walls_text(results):
    texts = []
    for integrator, look in ((i, l) for (i, n), l in INTEGRATORS.items() if n == "double"):
        broken = broken_at(results, "0", integrator)
        if broken and integrator in THEORY:
            texts.append(f"{limit_of(integrator, 0):.2f} with {look.label.split(', double')[0]} (lost at {broken:.2f})")
    text = f"keep ω dt below {listed(texts)}" if texts else ""
    if wall_points(results, "0", "explicit_euler"):
        text += ", and do not take explicit Euler, which is never stable"
    return text


def damped_text(results):
    found = [(zeta, broken_at(results, zeta, "velocity_verlet"), broken_at(results, zeta, "implicit_velocity_verlet"))
             for zeta in zetas(results)]
    found = [f for f in found if f[1]]
    if not found:
        return ""
    zeta, at, implicit = found[-1]
    text = ("with damping of the half step keep it below 2 (√(1 + ζ²) − ζ), which is "
            f"{verlet_limit(float(zeta)):.2f} at ζ = {zeta} (lost at {at:.2f})")
    if implicit:
        text += f", or choose the implicit damping, which holds to 2 (lost at {implicit:.2f})"
    elif wall_points(results, zeta, "implicit_velocity_verlet"):
        text += ", or choose the implicit damping, which was not lost in these steps"
    return text


def bed_text(results):
    rows, limit = settle_rows(results), settle_limit(results)
    if not rows or not limit:
        return ""
    within = [r for r in rows if r["omega_dt"] <= limit]
    beyond = [r for r in rows if r["omega_dt"] > limit]
    if not within or not beyond:
        return ""
    low, high = min(r["coordination"] for r in within), max(r["coordination"] for r in within)
    text = (f"in a bed choose the step that longest_time_step allows, {limit:.2f} √(m/k): up to it there are {low:.2f} "
            f"to {high:.2f} contacts per particle")
    broken = next((r for r in beyond if not low - .1 <= r["coordination"] <= high + .1), None)
    if broken:
        text += (f", from {broken['omega_dt']:g} on {broken['coordination']:.2f} and less, with no error raised"
                 if broken["coordination"] < low else f", from {broken['omega_dt']:g} on {broken['coordination']:.2f}")
    return text


def sentence(results):
    texts = [t for t in (walls_text(results), damped_text(results), bed_text(results)) if t]
    return texts[0][:1].upper() + "; ".join(texts)[1:] + "." if texts else ""


def past_table(results):
    rows = []
    for law, (name, *_) in LAWS.items():
        for integrator, look in ((i, l) for (i, number), l in INTEGRATORS.items() if number == "double"):
            points = past_points(results, law, integrator)
            if not points:
                continue
            broken = next((k for k, (_, e) in enumerate(points) if e > TOLERANCE), len(points))
            at_two = min(points, key=lambda p: abs(p[0] - 2))[1]
            rows.append([name, look.label,
                         f'<td class="figure">{points[broken - 1][0]:.2f}</td>' if broken else "<td>none</td>",
                         f'<td class="figure">{at_two:.2g}</td>' if at_two < LOST else "<td>lost</td>"])
    return table(["Law", "Integrator", f"Longest ω dt with errors below {TOLERANCE:g}", "Error at ω dt = 2"], rows)


def figures(results):
    parts = []
    if results.has("walls"):
        parts.append(("Limits of the oscillator", limit_table(results)))
    if results.has("past"):
        parts.append(("Impacts past the limit", past_table(results)))
    if settle_rows(results):
        parts.append(("A bed that settles", table(
            ["dt / √(m/k)", "Contacts per particle", "Share of the volume", "Kinetic energy per particle, J",
             "µs per simulated second and particle"],
            [[f"{r['omega_dt']:g}", *(f'<td class="figure">{t}</td>' for t in (
                f"{r['coordination']:.3f}", f"{r['packing']:.4f}", f"{r['kinetic']:.1e}",
                figure_of(r["nanoseconds_per_second"] / 1e3)))] for r in settle_rows(results)])))
    return tables(parts)
