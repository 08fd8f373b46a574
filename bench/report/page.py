# SPDX-License-Identifier: MIT
"""What the pages of all rooms share: medians with their spread, claims, tables, charts, style."""
import html
import io
import math
import re
import statistics

REQUIRED_CONTEXT = ("machine", "compiler", "flags", "commit", "instruction_set", "huge_pages", "date")

INK = "#010203"   # becomes the colour of the page's text
GRID = "#040506"  # becomes the colour of the page's rules


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
    """10000 -> 1e4, 64 -> 64."""
    exponent = math.log10(n) if n > 0 else 0
    return f"1e{round(exponent)}" if n >= 10000 and abs(exponent - round(exponent)) < 1e-9 else str(n)


def figure_of(value):
    """Three digits."""
    if value == 0:
        return "0"
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


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
    """The median, and between which of the values it lies at 93 % or more, whatever their distribution."""
    values = sorted(values)
    count = len(values)
    k, below = 0, 2.0 / 2**count  # the chance that the median lies outside of values[k] .. values[-1 - k]
    while k + 1 < count // 2 and below + 2.0 * math.comb(count, k + 1) / 2**count <= .07:
        k += 1
        below += 2.0 * math.comb(count, k) / 2**count
    return Spread(statistics.median(values), values[k], values[-1 - k])


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


def plotting():
    try:
        import matplotlib
    except ImportError as fault:
        raise Refusal("matplotlib is not installed; on Debian: python3-matplotlib, elsewhere: pip install matplotlib "
                      "(--markdown does without)") from fault
    matplotlib.use("svg")
    matplotlib.rcParams.update({
        "svg.fonttype": "none", "font.size": 9.5, "figure.facecolor": "none", "axes.facecolor": "none",
        "savefig.facecolor": "none", "text.color": INK, "axes.edgecolor": GRID, "axes.labelcolor": INK,
        "xtick.color": INK, "ytick.color": INK, "grid.color": GRID, "grid.linewidth": .6, "axes.titlesize": 10.5,
        "axes.titleweight": "bold", "axes.spines.top": False, "axes.spines.right": False})
    import matplotlib.pyplot as pyplot
    return pyplot


def svg_of(figure, pyplot, title):
    """The figure as an element of the page: scales with it, takes its colours."""
    import matplotlib
    matplotlib.rcParams["svg.hashsalt"] = title  # names inside one picture must not be those of another
    out = io.StringIO()
    figure.savefig(out, format="svg", bbox_inches="tight", pad_inches=.06)
    pyplot.close(figure)
    text = out.getvalue()
    text = re.sub(r"<metadata>.*?</metadata>", "", text[text.index("<svg"):], flags=re.S)
    text = re.sub(r'(<svg[^>]*?) width="([\d.]+)pt" height="[\d.]+pt"', r'\1 style="width:100%;max-width:\2pt"', text,
                  count=1)
    text = text.replace("<svg", f'<svg role="img" aria-label="{html.escape(title, quote=True)}"', 1)
    return text.replace(INK, "currentColor").replace(GRID, "var(--rule)")


def plain_ticks(axis):
    """1, 2, 5, 10, ... as figures, as many as there is room for."""
    from matplotlib.ticker import FuncFormatter, LogLocator
    low, high = axis.get_view_interval()
    wide = math.log10(high / low) > 2.4
    axis.set_major_locator(LogLocator(subs=(1, 3) if wide else (1, 2, 5), numticks=20))
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))


# ---------------------------------------------------------------------------------------------------------------
# Elements of the page


STYLE = """
:root { color-scheme: light dark; --ink: #1c1f23; --paper: #ffffff; --rule: #c9ced4; --soft: #f3f5f7;
        --good: #1d7a3c; --bad: #b3261e; }
@media (prefers-color-scheme: dark) {
    :root { --ink: #e4e7ea; --paper: #15181b; --rule: #454c54; --soft: #1f2428;
        --good: #6fce8d; --bad: #ff8a80; } }
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
"""


def table(head, rows):
    """A cell that is an element already stays; text is escaped."""
    cells = lambda row: "".join(c if c.startswith("<td") else f"<td>{html.escape(c)}</td>" for c in row)
    return ('<div class="scroll"><table><thead><tr>' + "".join(f"<th>{html.escape(h)}</th>" for h in head) +
            "</tr></thead><tbody>" + "".join(f"<tr>{cells(row)}</tr>" for row in rows) + "</tbody></table></div>")


def spread_text(times):
    return f"{figure_of(statistics.median(times))} <small>({figure_of(min(times))}–{figure_of(max(times))})</small>"


def ratio_cell(ratio):
    if ratio is None:
        return "<td></td>"
    low, high = figure_of(ratio.low), figure_of(ratio.high)
    return f'<td class="figure">{figure_of(ratio)}x <small>({low}–{high})</small></td>'


def folded(summary, content):
    return f"<details><summary>{html.escape(summary)}</summary>{content}</details>"


def claim_section(claims, note):
    verdicts = [claim.verdict() for claim in claims]
    rows, unmeasured = [], []
    for claim, verdict in zip(claims, verdicts):
        if verdict == NOT_MEASURED:
            unmeasured.append((claim.text, claim.target_text()))
        else:
            *cells, mark = claim.cells()
            rows.append([*cells, f'<td class="{verdict}">{mark}</td>' if verdict in (HOLDS, FAILS, NOISY) else mark])
    held, failed, noisy = (verdicts.count(verdict) for verdict in (HOLDS, FAILS, NOISY))
    return (f'<h2 id="claims">What must hold</h2><p>{held} of {held + failed} claims that this run can judge hold' +
            (f"; too noisy to tell: {noisy} more, whose target lies between the lowest and the highest ratio that the "
             "repetitions allow, which stand in brackets" if noisy else "") +
            f". A claim holds where it holds at the worst of its points. {note}</p>" + table(CLAIM_HEAD, rows) +
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
    return ["", markdown_row([h or "holds" for h in CLAIM_HEAD]), "|" + "---|" * len(CLAIM_HEAD),
            *(markdown_row(claim.cells()) for claim in claims)]
