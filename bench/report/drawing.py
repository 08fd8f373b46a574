# SPDX-License-Identifier: MIT
"""Small charts beside one another: each one a picture that is legible at the width of a phone."""
import html

from .page import folded
from .pictures import GRID, INK, PALETTE, PAPER, svg_of

SIZE = (4.1, 3.0)  # inches, so that text of 9 points is 11 pixels high on a phone
BOX = (.135, .155, .64, .72)  # left, bottom, width, height of what the axes enclose; labels stand on the right of it
LOW_BOX = (.2, .155, .575, .8)  # with a label on the left, and nothing above


class Look:
    """How a series is drawn, in all charts alike. Colour, marker and line each tell it apart."""

    def __init__(self, label, colour, marker="o", line="-", width=1.5, short=None, is_hollow=False):
        self.label, self.marker, self.line, self.width = label, marker, line, width
        self.colour = PALETTE[colour][0] if colour in PALETTE else INK
        self.short = short or label
        self.is_hollow = is_hollow

    def style(self, **other):
        return {"color": self.colour, "marker": self.marker, "linestyle": self.line, "linewidth": self.width,
                "markersize": 4.6, "markerfacecolor": "none" if self.is_hollow else self.colour,
                "markeredgewidth": 1.1, **other}


def new_panel(pyplot, size=SIZE, box=BOX):
    figure = pyplot.figure(figsize=size)
    axes = figure.add_axes(box)
    axes.grid(True)
    axes.tick_params(labelsize=9)
    return figure, axes


def panel(figure, pyplot, title):
    """A chart under its heading, which wraps, unlike text in a picture."""
    return f"<figure><h4>{html.escape(title)}</h4>{svg_of(figure, pyplot, title, cropped=False)}</figure>"


def panels(parts):
    return f'<div class="panels">{"".join(parts)}</div>'


def legend(looks, pyplot):
    """[Look] as a list of the page, which wraps as text does."""
    entries = []
    for look in looks:
        figure = pyplot.figure(figsize=(.5, .17))
        axes = figure.add_axes((0, 0, 1, 1))
        axes.plot([0, .5, 1], [0, 0, 0], **look.style(markevery=[1]))
        axes.set(xlim=(-.05, 1.05), ylim=(-1, 1))
        axes.axis("off")
        entries.append(f"<li>{svg_of(figure, pyplot, look.label, cropped=False)}{html.escape(look.label)}</li>")
    return f'<ul class="legend">{"".join(entries)}</ul>'


def spread_out(places, gap, low=0.0, high=1.0):
    """The places moved as little as needed so that neighbours are `gap` apart, between low and high if they fit."""
    order = sorted(range(len(places)), key=lambda k: places[k])
    moved = list(places)
    for _ in range(60):  # pushes neighbours apart by half of what lacks; a few dozen rounds settle a dozen labels
        for a, b in zip(order, order[1:]):
            lack = gap - (moved[b] - moved[a])
            if lack > 1e-9:
                moved[a] -= lack / 2
                moved[b] += lack / 2
        for k in order:
            moved[k] = min(max(moved[k], low), high)
    return moved


def label_ends(axes, ends, size=8.0):
    """Names at the right ends of lines: [(x, y, text, colour)], moved apart, each with a thread to its line."""
    if not ends:
        return
    figure = axes.figure
    figure.canvas.draw()
    inside = axes.transAxes.inverted()
    height = axes.get_window_extent().height * 72 / figure.dpi
    at = [inside.transform(axes.transData.transform((x, y))) for x, y, *_ in ends]
    places = spread_out([min(max(y, 0), 1) for _, y in at], 1.12 * size / height, -.02, 1.02)
    for (x, y), place, (_, _, text, colour) in zip(at, places, ends):
        axes.annotate(text, (min(x, 1), min(max(y, 0), 1)), (1.055, place), xycoords="axes fraction",
                      textcoords="axes fraction",
                      fontsize=size, color=colour, va="center", annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "color": colour, "linewidth": .5, "shrinkA": 0, "shrinkB": 2,
                                  "alpha": .7, "relpos": (0, .5)})


def label_at(axes, point, text, colour, size=8.0):
    """A name beside a point, on a patch of paper, so that lines do not strike it out."""
    axes.annotate(text, point, xytext=(6, 5), textcoords="offset points", fontsize=size, color=colour, va="center",
                  zorder=6, annotation_clip=False,
                  bbox={"facecolor": PAPER, "edgecolor": "none", "alpha": .75, "pad": .6})


def mark_upright(axes, at, text, colour=INK, row=0, side="center", line=(0, (5, 2))):
    """A dashed line across, with its name above the chart."""
    axes.axvline(at, color=colour, linewidth=1, linestyle=line, zorder=2)
    axes.annotate(text, (at, 1 + .055 * row), xycoords=("data", "axes fraction"), xytext=(0, 2),
                  textcoords="offset points", ha=side, va="bottom", fontsize=8, color=colour, annotation_clip=False)


def shaded(axes, low, high):
    """What lies beyond a limit: hatched, since a tint is lost in print."""
    axes.axvspan(low, high, facecolor="none", edgecolor=GRID, hatch="////", linewidth=0, zorder=0)


def tables(parts):
    """[(summary, table)]: the first is open, the others are folded."""
    if not parts:
        return ""
    (summary, first), *others = parts
    return (f"<details open><summary>{html.escape(summary)}</summary>{first}</details>" +
            "".join(folded(text, content) for text, content in others))
