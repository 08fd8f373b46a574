# SPDX-License-Identifier: MIT
"""Charts as vector graphics, in the colours of the page: light, dark and grey."""
import html
import io
import itertools
import math
import os
import re
import subprocess
import sys

from .reading import Refusal

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
