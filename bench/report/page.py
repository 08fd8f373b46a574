# SPDX-License-Identifier: MIT
"""What the pages of all rooms share: medians with their spread, claims, tables, charts, style."""
import html
import io
import itertools
import math
import os
import re
import statistics
import subprocess
import sys

INK = "#010203"   # becomes the colour of the page's text
GRID = "#040506"  # becomes the colour of the page's rules
PAPER = "#070809"  # becomes the colour behind all
# name: (what is drawn with, on a light page, on a dark one). Those of Okabe and Ito, which the colour-blind tell apart,
# darker or lighter where they would be faint. Markers and lines differ as well, for pages without colour.
PALETTE = {
    "blue": ("#0a0b01", "#0072b2", "#56a8e0"), "vermilion": ("#0a0b02", "#c8500a", "#f08a4b"),
    "green": ("#0a0b03", "#00805c", "#3cc79a"), "purple": ("#0a0b04", "#a94f86", "#e09ac4"),
    "yellow": ("#0a0b05", "#8f7400", "#e6d544"), "sky": ("#0a0b06", "#3a8fc4", "#93d2f7"),
    "orange": ("#0a0b07", "#b97a00", "#f0b84a"), "grey": ("#0a0b08", "#6b7075", "#a5abb1"),
    "red": ("#0a0b09", "#b3261e", "#ff8a80"),
}


def colour(name):
    return PALETTE[name][0]


class Refusal(Exception):
    """The input is not what the report can be made from."""


# ---------------------------------------------------------------------------------------------------------------
# Figures


class Spread(float):
    """A median, or a ratio of two, that knows the lowest and the highest it may be taken for."""

    def __new__(cls, median, low, high):
        made = super().__new__(cls, median)
        made.low, made.high = low, high
        return made


def power(n):
    """10000 -> 1e4, 400000 -> 4e5, 64 -> 64."""
    digits = str(n)
    return f"{digits[0]}e{len(digits) - 1}" if n >= 10000 and not digits[1:].strip("0") else digits


def figure_of(value):
    """Three digits."""
    if value == 0:
        return "0"
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def short_power(value):
    """0.01, but 1e-4"""
    return f"{value:g}" if value >= .001 else f"{value:.0e}".replace("e-0", "e-")


def limits(value):
    """(lowest, highest); twice the value if it is exact."""
    return (value.low, value.high) if isinstance(value, Spread) else (value, value)


def quotient(a, b):
    """Of the medians; from the lowest a by the highest b to the highest a by the lowest b."""
    if not a or not b:
        return None
    (a_low, a_high), (b_low, b_high) = limits(a), limits(b)
    return Spread(a / b, a_low / b_high, a_high / b_low)


def middle(values):
    """The median, and between which of the values it lies at 93 % or more, whatever their distribution; of fewer than
    FEWEST the lowest and the highest."""
    values = sorted(values)
    count = len(values)
    k, below = 0, 2.0 / 2**count  # the chance that the median lies outside of values[k] .. values[-1 - k]
    while k + 1 < count // 2 and below + 2.0 * math.comb(count, k + 1) / 2**count <= .07:
        k += 1
        below += 2.0 * math.comb(count, k) / 2**count
    return Spread(statistics.median(values), values[k], values[-1 - k])


FEWEST = 5  # values, with which the interval of middle() holds the median at 93 %; of 3 it does at 75 %


def scaled(value, factor):
    """The Spread of what is proportional."""
    return Spread(value * factor, *(x * factor for x in limits(value)))


def apart(a, b):
    """The rule of noise, of all sentences and comparisons: two medians differ if the intervals in which they lie do
    not overlap."""
    (a_low, a_high), (b_low, b_high) = limits(a), limits(b)
    return a_high < b_low or b_high < a_low


def as_good(values):
    """Of {name: cost} those names that are within noise of the least, the least first."""
    found = sorted((value, name) for name, value in values.items() if value)
    return [name for value, name in found if not apart(value, found[0][0])]


def runs_of_choice(places, values_at, weights_at=lambda place: {}):
    """[(name, [places])]: what to choose along an axis, changed only where it is worse than the best beyond noise.

    values_at(place): {name: cost}; of those within noise of the best the one of the least weight is taken, if it has
    one, else the best."""
    runs = []
    for place in places:
        good = as_good(values_at(place))
        weights = weights_at(place)
        if good and runs and runs[-1][0] in good:
            runs[-1][1].append(place)
        elif good:
            runs.append((min(good, key=lambda name: weights.get(name, math.inf)), [place]))
    return runs


def spans_text(runs, at, label=str, place=str):
    """dense up to T/N = 8, flat from 64 on"""
    parts = []
    for k, (name, places) in enumerate(runs):
        first, last = place(places[0]), place(places[-1])
        if len(runs) == 1:
            span = "everywhere" if len(places) > 1 else f"at {at}{first}"
        elif k == 0:
            span = f"at {at}{first}" if first == last else f"up to {at}{last}"
        elif k == len(runs) - 1:
            span = f"from {first} on" if first != last else f"at {first}"
        else:
            span = f"at {first}" if first == last else f"from {first} to {last}"
        parts.append(f"{label(name)} {span}")
    return listed(parts)


def listed(words):
    """a, b and c"""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


# ---------------------------------------------------------------------------------------------------------------
# What must be shown: each claim of the project, with what was measured


HOLDS, FAILS, NOISY, NO_TARGET, NOT_MEASURED = "holds", "fails", "noisy", "no target", "not measured"
MARKS = {HOLDS: "✓ holds", FAILS: "✗ fails", NO_TARGET: "–", NOT_MEASURED: NOT_MEASURED}


class Claim:
    """One line of the table. A claim over several points holds where it holds at each of them."""

    def __init__(self, text, target, unit="x", at_least=True):
        self.text, self.target, self.unit, self.at_least = text, target, unit, at_least
        self.values = []  # (value, portable value or None, where)

    def add(self, value, where, portable=None):
        if value is not None:
            self.values.append((value, portable, where))
        return self

    def worst(self):
        return self.worst_of(self.values)

    def worst_of(self, values):
        return (min if self.at_least else max)(values, key=lambda v: v[0])

    def verdict_at(self, value):
        """The repetitions tell nothing where the target lies between the lowest and the highest ratio."""
        target = self.target * (.995 if self.at_least else 1.005)  # as it is printed
        holding = [x >= target if self.at_least else x <= target for x in limits(value)]
        return HOLDS if all(holding) else NOISY if any(holding) else FAILS

    def verdict(self):
        if not self.values:
            return NOT_MEASURED
        if self.target is None:
            return NO_TARGET
        found = {self.verdict_at(v[0]) for v in self.values}
        return next(verdict for verdict in (FAILS, NOISY, HOLDS) if verdict in found)

    def target_text(self):
        if self.target is None:
            return "none"
        return f"{'at least' if self.at_least else 'at most'} {self.target:g}{self.unit}"

    def mark(self):
        verdict = self.verdict()
        if verdict != NOISY:
            return MARKS[verdict]
        low, high = limits(self.worst_of(v for v in self.values if self.verdict_at(v[0]) == NOISY)[0])
        return f"too noisy to tell ({figure_of(low)}–{figure_of(high)}{self.unit})"

    def cells(self):
        """(claim, target, median, worst, where, portable worst, mark)"""
        if not self.values:
            return self.text, self.target_text(), "", "", "", "", self.mark()
        worst = self.worst()
        portables = [v[1] for v in self.values if v[1]]
        portable = (min if self.at_least else max)(portables) if portables else None
        middle = statistics.median(v[0] for v in self.values)
        where = worst[2] + (f" (of {len(self.values)})" if len(self.values) > 1 else "")
        return (self.text, self.target_text(), figure_of(middle) + self.unit, figure_of(worst[0]) + self.unit, where,
                figure_of(portable) + self.unit if portable else "", self.mark())


CLAIM_HEAD = ("Claim", "Target", "Median", "Worst", "Where", "Portable, worst", "")


# ---------------------------------------------------------------------------------------------------------------
# Charts


SYSTEM_PYTHON = "/usr/bin/python3"  # where the packages of Linux distributions put matplotlib


def go_on_with_system_python():
    """Replaces this program by itself under the system's python, if that is another one and has matplotlib."""
    if not os.access(SYSTEM_PYTHON, os.X_OK) or os.path.realpath(SYSTEM_PYTHON) == os.path.realpath(sys.executable):
        return
    probe = subprocess.run([SYSTEM_PYTHON, "-c", "import matplotlib"], stderr=subprocess.DEVNULL, check=False)
    if probe.returncode == 0:
        print(f"{os.path.basename(sys.argv[0])}: {sys.executable} has no matplotlib; going on with {SYSTEM_PYTHON}, "
              "which has it", file=sys.stderr, flush=True)
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])


def plotting():
    try:
        import matplotlib
    except ImportError as fault:
        go_on_with_system_python()
        raise Refusal(f"neither {sys.executable} nor {SYSTEM_PYTHON} has matplotlib; on Debian: apt-get install "
                      "python3-matplotlib, elsewhere: python3 -m pip install matplotlib; --markdown and --compare do "
                      "without") from fault
    matplotlib.use("svg")
    matplotlib.rcParams.update({
        "svg.fonttype": "none", "font.size": 9.5, "figure.facecolor": "none", "axes.facecolor": "none",
        "savefig.facecolor": "none", "text.color": INK, "axes.edgecolor": GRID, "axes.labelcolor": INK,
        "xtick.color": INK, "ytick.color": INK, "grid.color": GRID, "grid.linewidth": .6, "axes.titlesize": 10.5,
        "axes.titleweight": "bold", "axes.spines.top": False, "axes.spines.right": False})
    import matplotlib.pyplot as pyplot
    return pyplot


def write_picture(path, figure):
    """The figure as a file, on white: for pages that show pictures as they are."""
    import matplotlib
    matplotlib.rcParams["svg.hashsalt"] = os.path.basename(path)  # the same figures, the same file
    out = io.StringIO()
    figure.savefig(out, format="svg", bbox_inches="tight", facecolor="white", metadata={"Date": None})
    text = out.getvalue()
    on_white = {INK: "#1c1f23", GRID: "#d8dce2", PAPER: "#ffffff",
                **{stand_in: light for stand_in, light, _ in PALETTE.values()}}
    for stand_in, shown in on_white.items():
        text = text.replace(stand_in, shown)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


PICTURES = itertools.count()


def svg_of(figure, pyplot, title, cropped=True):
    """The figure as an element of the page: scales with it, takes its colours."""
    import matplotlib
    matplotlib.rcParams["svg.hashsalt"] = f"{title} {next(PICTURES)}"  # no name is that of another on the page
    out = io.StringIO()
    figure.savefig(out, format="svg", **({"bbox_inches": "tight", "pad_inches": .06} if cropped else {}))
    pyplot.close(figure)
    text = out.getvalue()
    text = re.sub(r"<metadata>.*?</metadata>", "", text[text.index("<svg"):], flags=re.S)
    text = re.sub(r'(<svg[^>]*?) width="([\d.]+)pt" height="[\d.]+pt"', r'\1 style="width:100%;max-width:\2pt"', text,
                  count=1)
    used = set(re.findall(r"#(\w+)", text))
    text = re.sub(r' id="([^"]*)"', lambda found: found[0] if found[1] in used else "", text)
    text = re.sub(r' (?:d|x|y|transform)="[^"]*"', lambda found: re.sub(r"(\.\d\d)\d+", r"\1", found[0]),
                  text)  # hundredths of a point are enough
    text = re.sub(r"(px|pt) 'DejaVu Sans'[^;\"]*", r"\1 sans-serif", text)  # the page has its own font
    text = re.sub(r"\s*\n\s*", " ", text).replace("> <", "><").strip()
    text = text.replace("<svg", f'<svg role="img" aria-label="{html.escape(title, quote=True)}"', 1)
    for name, (stand_in, *_) in PALETTE.items():
        text = text.replace(stand_in, f"var(--{name})")
    return text.replace(INK, "currentColor").replace(GRID, "var(--rule)").replace(PAPER, "var(--paper)")


def plain_ticks(axis):
    """1, 2, 5, 10, ... as figures, as many as there is room for."""
    from matplotlib.ticker import FuncFormatter, LogLocator
    low, high = axis.get_view_interval()
    wide = math.log10(high / low) > 2.4
    axis.set_major_locator(LogLocator(subs=(1, 3) if wide else (1, 2, 5), numticks=20))
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))


def log_ticks(axis):
    """Powers of ten, or as plain_ticks where there is not one for each."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
    low, high = axis.get_view_interval()
    if high / low < 30:
        plain_ticks(axis)
        axis.set_minor_formatter(NullFormatter())
        return
    axis.set_major_locator(LogLocator(base=10, numticks=9))
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}" if .01 <= v < 1e4 else f"1e{round(math.log10(v))}"))
    axis.set_minor_formatter(NullFormatter())


# ---------------------------------------------------------------------------------------------------------------
# Elements of the page


STYLE = """
:root { color-scheme: light dark; --ink: #1c1f23; --paper: #ffffff; --rule: #c9ced4; --soft: #f3f5f7;
        --good: #1d7a3c; --bad: #b3261e;
        LIGHT }
@media (prefers-color-scheme: dark) {
    :root { --ink: #e4e7ea; --paper: #15181b; --rule: #454c54; --soft: #1f2428;
        --good: #6fce8d; --bad: #ff8a80;
        DARK } }
body { color: var(--ink); background: var(--paper); font: 15px/1.5 system-ui, sans-serif; max-width: 1240px;
       margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.6rem; } h2 { margin-top: 2.6rem; border-bottom: 1px solid var(--rule); padding-bottom: .2rem; }
p, li { max-width: 78ch; } nav a { margin-right: 1em; } a { color: inherit; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(560px, 100%), 1fr)); gap: 1.4rem 2rem;
          align-items: start; }
figure { margin: 0; min-width: 0; overflow-x: auto; } svg { height: auto; display: block; min-width: 34rem; }
.scroll { overflow-x: auto; } details { margin: .3rem 0 0; } summary { cursor: pointer; font-size: 13px; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; margin: .5rem 0; }
th, td { padding: .2rem .6rem; text-align: left; border-bottom: 1px solid var(--rule); vertical-align: top; }
thead th { background: var(--soft); } td small { opacity: .75; white-space: nowrap; } td.figure { text-align: right; }
.holds { color: var(--good); font-weight: 600; white-space: nowrap; }
.fails { color: var(--bad); font-weight: 600; white-space: nowrap; }
.noisy { font-style: italic; }
svg text { font-family: system-ui, sans-serif !important; }
.lead { font-size: 1.05rem; } .sentence { font-size: 1.05rem; max-width: 88ch; border-left: 4px solid var(--blue);
        padding-left: .8rem; } .warning { border-left: 4px solid var(--red); padding: .1rem .8rem; max-width: 88ch; }
.question { opacity: .85; }
.panels { display: grid; gap: .6rem 1.2rem; grid-template-columns: repeat(auto-fit, minmax(min(340px, 100%), 1fr)); }
.panels h4 { margin: .4rem 0 0; font-size: .95rem; } .panels svg { min-width: 0; }
.legend { list-style: none; display: flex; flex-wrap: wrap; gap: .1rem 1.1rem; padding: 0; margin: .4rem 0;
          font-size: 13px; max-width: none; }
.legend li { display: flex; align-items: center; gap: .4rem; } .legend svg { width: 40px !important; min-width: 40px; }
details.appendix { border-top: 1px solid var(--rule); padding: .5rem 0; }
details.appendix h2 { font-size: 1.2rem; } details.appendix > summary { font-size: 1.15rem; font-weight: 600; }
@media (max-width: 600px) { body { padding: 0 .7rem; margin: 1rem auto; } h1 { font-size: 1.35rem; } }
@media print { details.appendix { display: none; } }
"""
STYLE = STYLE.replace("LIGHT", " ".join(f"--{name}: {light};" for name, (_, light, _) in PALETTE.items()))
STYLE = STYLE.replace("DARK", " ".join(f"--{name}: {dark};" for name, (*_, dark) in PALETTE.items()))


def table(head, rows):
    """A cell that is an element already stays; text is escaped."""
    cells = lambda row: "".join(c if c.startswith("<td") else f"<td>{html.escape(c)}</td>" for c in row)
    return ('<div class="scroll"><table><thead><tr>' + "".join(f"<th>{html.escape(h)}</th>" for h in head) +
            "</tr></thead><tbody>" + "".join(f"<tr>{cells(row)}</tr>" for row in rows) + "</tbody></table></div>")


def spread_text(times):
    return f"{figure_of(statistics.median(times))} <small>({figure_of(min(times))}–{figure_of(max(times))})</small>"


def figure_cell(value, unit=""):
    """A Spread with its limits; empty if there is none."""
    if not value:
        return "<td></td>"
    low, high = figure_of(value.low), figure_of(value.high)
    return f'<td class="figure">{figure_of(value)}{unit} <small>({low}–{high})</small></td>'


def ratio_cell(ratio):
    return figure_cell(ratio, "x")


def folded(summary, content):
    return f"<details><summary>{html.escape(summary)}</summary>{content}</details>"


def document(title, body):
    return (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title>'
            '<meta name="viewport" content="width=device-width, initial-scale=1">'
            f"<style>{STYLE}</style></head><body><h1>{html.escape(title)}</h1>{body}</body></html>\n")


def appendix(title, content):
    return f'<details class="appendix"><summary>{html.escape(title)}</summary>{content}</details>'


def claim_section(claims, note):
    verdicts = [claim.verdict() for claim in claims]
    rows, unmeasured = [], []
    for claim, verdict in zip(claims, verdicts):
        if verdict == NOT_MEASURED:
            unmeasured.append((claim.text, claim.target_text()))
        else:
            *cells, mark = claim.cells()
            rows.append([*cells, f'<td class="{verdict}">{mark}</td>' if verdict in (HOLDS, FAILS, NOISY) else mark])
    failing = [row for row, verdict in zip(rows, (v for v in verdicts if v != NOT_MEASURED)) if verdict == FAILS]
    held, failed, noisy = (verdicts.count(verdict) for verdict in (HOLDS, FAILS, NOISY))
    return (f'<h2 id="claims">What must hold</h2><p>{held} of {held + failed} claims that this run can judge hold' +
            (f"; too noisy to tell: {noisy} more, whose target lies between the lowest and the highest ratio that the "
             "repetitions allow, which stand in brackets" if noisy else "") +
            f". A claim holds where it holds at the worst of its points. {note}</p>" +
            (f"<p>Those that do not:</p>{table(CLAIM_HEAD, failing)}" if failing else "") +
            folded(f"All claims that were measured: {len(rows)}", table(CLAIM_HEAD, rows)) +
            (folded(f"Claims not measured in this run: {len(unmeasured)}", table(CLAIM_HEAD[:2], unmeasured))
             if unmeasured else ""))


def context_section(contexts, repetitions):
    """One column per file; `repetitions` of each."""
    keys = [k for k in dict.fromkeys(k for c in contexts for k in c) if k != "file"]
    rows = [[k.replace("_", " ")] + [str(c.get(k, "")) for c in contexts] for k in keys]
    rows.append(["repetitions"] + [", ".join(map(str, r)) for r in repetitions])
    return table([""] + [c["file"] for c in contexts], rows)


# ---------------------------------------------------------------------------------------------------------------
# Tables for the README


def markdown_row(cells):
    return "| " + " | ".join(c.replace("|", "\\|") for c in cells) + " |"


def markdown_claims(claims):
    """The lines of a table, after an empty one."""
    return ["", markdown_row([h or "verdict" for h in CLAIM_HEAD]), "|" + "---|" * len(CLAIM_HEAD),
            *(markdown_row(claim.cells()) for claim in claims)]
