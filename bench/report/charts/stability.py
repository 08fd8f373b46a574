# SPDX-License-Identifier: MIT
"""Chart 5: where each method breaks. Error over the time step, up to the limit of stability and past it."""
import math

from ..dem import LAWS, LOOKS, LOST, TOLERANCE
from ..drawing import label_ends, legend, mark_upright, new_panel, panel, panels, shaded, tables
from ..page import table
from ..pictures import colour, log_ticks
from ..spread import figure_of, listed

ROOM = "dem"
TITLE = "How long may a step be?"
QUESTION = ("Error over the time step, up to the limit of stability and past it; dashed uprights are the limits of "
            "theory, hatched is what lies beyond them. Errors are computed, not timed, and have no noise.")
METHOD = (
    "A sphere between two walls is an oscillator that does not lose its contacts. Limits of theory: 2 for Verlet and "
    "symplectic Euler, 2 (√(1 + ζ²) − ζ) for damping from the half step, and for PEFRL and Runge–Kutta the least ω dt "
    "at which the matrix of a step has an eigenvalue above 1. An impact with fewer than π/2 steps of a contact still "
    "ends, but the sphere leaves faster than it came. The bed settles with the guards off, which would refuse a step "
    "above longest_time_step at the start.")
ABSENT = "bench/run --only dem"
HIGH = 1e2  # of the amplitude: the oscillation is lost


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


def wall_points(results, zeta, integrator):
    rows = results.rows.get(("walls", zeta, integrator, "double"), ())
    return sorted((row["omega_dt"], row["error"]) for row in rows)


def settle_rows(results):
    rows = results.rows.get(("settle", "bed", "velocity_verlet", "double"), [])
    return sorted((row for row in rows if row["kinetic"] < LOST), key=lambda r: r["omega_dt"])


def settle_limit(results):
    found = [row["limit"] for row in settle_rows(results) if "limit" in row]
    return min(found) if found else None


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
    for (integrator, number), look in LOOKS.items():
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
    for (integrator, number), look in LOOKS.items():
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
    return panel(figure, pyplot, f"Impact: {LAWS[law][0]}")


BED = {"coordination": ("contacts per particle", "linear", 1), "kinetic": ("kinetic energy per particle, J", "log", 1),
       "nanoseconds_per_second": ("µs per simulated second and particle", "log", 1e3)}


def bed_panel(results, field, pyplot):
    figure, axes = new_panel(pyplot, box=(.2, .155, .76, .72))
    title, scale, by = BED[field]
    rows = settle_rows(results)
    axes.plot([r["omega_dt"] for r in rows], [r[field] / by for r in rows],
              **LOOKS[("velocity_verlet", "double")].style())
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
    shown = [look for (integrator, number), look in LOOKS.items() if number == "double" and
             any(key[2] == integrator for key in results.rows if key[0] in ("walls", "past"))]
    return legend(shown, pyplot) + panels(parts)


def safe_text(limit):
    """Two digits that are not above the limit."""
    return f"{math.floor(limit * 100 + 1e-9) / 100:.2f}"


def walls_advice(results):
    """Integrators of the same limit together."""
    limits, lost = {}, []
    for (integrator, number), look in LOOKS.items():
        broken = broken_at(results, "0", integrator) if number == "double" and integrator in THEORY else None
        if broken:
            limits.setdefault(safe_text(limit_of(integrator, 0)), []).append(look.label)
            lost.append(f"{broken:.2f}")
    found = []
    if limits:
        texts = [f"{limit} with {listed(names)}" for limit, names in limits.items()]
        found.append((f"keep ω dt below {listed(texts)}", f"lost at {listed(lost)}"))
    if wall_points(results, "0", "explicit_euler"):
        found.append(("do not take explicit Euler, which is never stable", ""))
    return found


def damped_advice(results):
    found = [(zeta, broken_at(results, zeta, "velocity_verlet"), broken_at(results, zeta, "implicit_velocity_verlet"))
             for zeta in zetas(results)]
    found = [f for f in found if f[1]]
    if not found:
        return []
    zeta, at, implicit = found[-1]
    text = ("with damping of the half step keep it below 2 √(1 + ζ²) − 2 ζ, which is "
            f"{safe_text(verlet_limit(float(zeta)))} at ζ = {zeta}")
    numbers = f"lost at {at:.2f}"
    if implicit:
        text += ", or choose the implicit damping, which holds to 2"
        numbers += f" and {implicit:.2f}"
    elif wall_points(results, zeta, "implicit_velocity_verlet"):
        text += ", or choose the implicit damping, which was not lost in these steps"
    return [(text, numbers)]


def bed_advice(results):
    rows, limit = settle_rows(results), settle_limit(results)
    within = [r["coordination"] for r in rows if limit and r["omega_dt"] <= limit]
    beyond = [r for r in rows if limit and r["omega_dt"] > limit]
    if not within or not beyond:
        return []
    low, high = min(within), max(within)
    found = [(f"in a bed choose the step that longest_time_step allows, {safe_text(limit)} √(m/k): up to it there are "
              f"{low:.2f} to {high:.2f} contacts per particle", "")]
    broken = next((r for r in beyond if not low - .1 <= r["coordination"] <= high + .1), None)
    if broken:
        after = [r["coordination"] for r in beyond if r["omega_dt"] >= broken["omega_dt"]]
        fall = " and less" if len(after) > 1 and max(after) <= broken["coordination"] else ""
        found.append(("a longer step is refused by the guards, which are on by default; without them it goes unnoticed "
                      f"that there are {broken['coordination']:.2f}{fall} from {broken['omega_dt']:g} on", ""))
    return found


def advice(results):
    return "", walls_advice(results) + damped_advice(results) + bed_advice(results)


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
        rows.append([zeta, LOOKS[(integrator, "double")].label, f'<td class="figure">{theory:.3f}</td>',
                     f'<td class="figure">{stable:.3f}</td>',
                     f'<td class="figure">{lost[0]:.3f}</td>' if lost else "<td>none</td>"])
    return table(["ζ", "Integrator", "Limit of ω dt by theory", "Last that stays", "First that grows"], rows)


def past_table(results):
    rows = []
    for law, (name, *_) in LAWS.items():
        for integrator, look in ((i, l) for (i, number), l in LOOKS.items() if number == "double"):
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
    return tables(parts + [("How it was measured", f"<p>{METHOD}</p>")])
