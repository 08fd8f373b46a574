# SPDX-License-Identifier: MIT
"""The elements of the page, and of the tables for the README."""
import html

from .pictures import PALETTE
from .spread import figure_of, limits

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


def escaped(text):
    return html.escape(text, quote=False)


def table(head, rows):
    """A cell that is an element already stays; text is escaped."""
    cells = lambda row: "".join(c if c.startswith("<td") else f"<td>{html.escape(c)}</td>" for c in row)
    return ('<div class="scroll"><table><thead><tr>' + "".join(f"<th>{html.escape(h)}</th>" for h in head) +
            "</tr></thead><tbody>" + "".join(f"<tr>{cells(row)}</tr>" for row in rows) + "</tbody></table></div>")


def spread_text(value, unit=""):
    """A Spread and its limits."""
    low, high = map(figure_of, limits(value))
    return f"{figure_of(value)}{unit} <small>({low}–{high})</small>"


def figure_cell(value, unit=""):
    """Of a Spread; empty if there is none."""
    return f'<td class="figure">{spread_text(value, unit)}</td>' if value else "<td></td>"


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


def context_section(contexts, repetitions):
    """One column per file; `repetitions` of each."""
    keys = [k for k in dict.fromkeys(k for c in contexts for k in c) if k != "file"]
    rows = [[k.replace("_", " ")] + [str(c.get(k, "")) for c in contexts] for k in keys]
    rows.append(["repetitions"] + [", ".join(map(str, r)) for r in repetitions])
    return table([""] + [c["file"] for c in contexts], rows)


def context_text(context, *more):
    """What stands above a table: where its figures come from."""
    return ", ".join([context["machine"], context["compiler"], f"`{context['flags']}`", *more,
                      f"commit {context['commit']}"]) + "."


def markdown_row(cells):
    return "| " + " | ".join(c.replace("|", "\\|") for c in cells) + " |"
