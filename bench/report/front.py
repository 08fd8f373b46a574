# SPDX-License-Identifier: MIT
"""What the page begins with: what was measured and where, what is missing, and the five charts."""
from .charts import CHARTS
from .page import escaped
from .spread import FEWEST, listed

ALIGNED = " -falign-loops=64"  # of the room store alone, by intention: see bench/CMakeLists.txt
# What has to be the same in all files of one page: key, how it is called
SAME = (("machine", "machines"), ("instruction_set", "instruction sets"), ("compiler", "compilers"), ("flags", "flags"),
        ("commit", "commits"))


def values_of(contexts, key):
    """The different ones, in the order of the files."""
    return list(dict.fromkeys(str(c.get(key, "unknown")).replace(ALIGNED, "") for c in contexts))


def introduction(figures):
    contexts = [context for _, context in figures.contexts]
    repetitions = sorted({n for results in figures.results.values() for n in results.repetitions() if n > 1})
    every = lambda key: escaped(listed(values_of(contexts, key)))
    return (
        '<p class="lead">tsubu is a C++ library of what every particle code needs beside its physics: maps from ids '
        "to indices, domains, particle stores, files, ranks, and a thin layer of discrete elements. This page says "
        "what its policies cost on one machine, beside those of other libraries, and which to choose. Measured on "
        f"{every('machine')} ({every('cores')} cores, {every('instruction_set')}) with {every('compiler')}, "
        f"<code>{every('flags')}</code>, {commit_text(contexts)}, {escaped(date_text(contexts))}.</p>"
        f"<p>Each time is a median of {span(repetitions)} repetitions, in which all contenders of a group took turns "
        "in random order; its spread is the interval in which the median lies at 93 % or more: with five repetitions "
        f"from the lowest to the highest{few_text(figures)}. Two times are called different only if their spreads do "
        "not overlap; else the text says “within noise”. Seeds and scenes are fixed; answers are compared before they "
        "are timed.</p>")


def few_text(figures):
    """Which rooms have times of too few repetitions for that."""
    rooms = [name for name, results in figures.results.items() if any(1 < n < FEWEST for n in results.repetitions())]
    return f"; with fewer, of which there are some in {listed(rooms)}, that interval says less" if rooms else ""


def span(numbers):
    return "1" if not numbers else str(numbers[0]) if len(numbers) == 1 else f"{numbers[0]} to {numbers[-1]}"


def commit_text(contexts):
    commits = values_of(contexts, "commit")
    return f"at commit {escaped(commits[0])}" if len(commits) == 1 else f"at {len(commits)} commits, which stand below"


def date_text(contexts):
    days = sorted({c["date"][:10] for c in contexts})
    return days[0] if len(days) == 1 else f"{days[0]} to {days[-1]}"


def warnings(figures):
    """Figures of several runs on one page; changes that no commit holds."""
    contexts = [context for _, context in figures.contexts]
    texts = []
    if any(c.get("extent") == "quick" for c in contexts):
        texts.append("A quick run: fewer sizes, time steps and repetitions than bench/run has without --quick.")
    different = [name for key, name in SAME if len(values_of(contexts, key)) > 1]
    if different:
        runs = [f"{name}: {c['commit']} of {c['date'][:10]}" + (f" ({c['extent']})" if c.get("extent") else "")
                for name, c in figures.contexts]
        texts.append(f"These figures come from several runs, of different {listed(different)}: compare those of "
                     f"different rooms with care. {'; '.join(runs)}.")
    dirty = [name for name, c in figures.contexts if c["commit"].endswith("-dirty")]
    if dirty:
        texts.append(f"Measured with changes that no commit holds: {listed(dirty)}.")
    if any(c.get("assertions") == "on" for c in contexts):
        texts.append("Assertions were on: times are longer than in a release.")
    return "".join(f'<p class="warning">{escaped(text)}</p>' for text in texts)


def missing_rivals(figures):
    """[(what, where it would stand, how to get it)]"""
    found = []
    maps = figures.results.get("id")
    if maps:
        present = {key[3] for key in maps.times}
        for series, what, package in (("boost_flat_map", "Boost 1.81 or later", "libboost1.81-dev"),
                                      ("absl_flat_hash_map", "Abseil", "libabsl-dev")):
            if series not in present:
                found.append((what, "charts 1 and 2", f"not found when this was built; Debian: {package}"))
    scenes = figures.results.get("dem")
    if scenes:
        found += [(what, "the appendix on scenes", why) for what, why in scenes.missing()]
    return found


def missing_rooms(figures, rooms):
    return [(name, f"bench/run --only {name}" + (", with an MPI library" if name == "comm" else ""))
            for name in rooms if name not in figures.results]


def missing_charts(figures):
    """Of rooms that have figures, but not those."""
    return [f"chart {k} ({chart.ABSENT})" for k, chart in enumerate(CHARTS, 1)
            if chart.ROOM in figures.results and not chart.is_there(figures.results[chart.ROOM])]


def missing(figures, rooms):
    parts = [f"{what} (would stand in {where}; {why})" for what, where, why in missing_rivals(figures)]
    parts += [f"the room {name} ({remedy})" for name, remedy in missing_rooms(figures, rooms)]
    parts += missing_charts(figures)
    if not parts:
        return "<p>Nothing is missing: Boost, Abseil, LAMMPS and MPI were found.</p>" if "id" in figures.results else ""
    return f'<p class="warning"><strong>Missing on this page:</strong> {escaped("; ".join(parts))}.</p>'


def absent_here(figures, chart):
    """The rivals that would stand in this chart."""
    if chart.ROOM != "id":
        return ""
    names = [what for what, where, _ in missing_rivals(figures) if where.startswith("charts")]
    return f"<p>Not measured, since not found: {escaped(listed(names))}.</p>" if names else ""


def capital(text):
    return text[:1].upper() + text[1:]


def sentence(chart, results):
    """All advice of a chart, with its figures."""
    opening, parts = chart.advice(results)
    texts = "; ".join(f"{text} ({numbers})" if numbers else text for text, numbers in parts)
    return capital(f"{opening} {texts}." if opening else f"{texts}.") if parts else ""


def chart_section(figures, number, chart, pyplot):
    results = figures.results.get(chart.ROOM)
    head = (f'<section><h2 id="chart{number}">{number}. {escaped(chart.TITLE)}</h2>'
            f'<p class="question">{escaped(chart.QUESTION)}</p>')
    if results is None or not chart.is_there(results):
        return head + (f'<p class="warning">Not in these figures: <code>{escaped(chart.ABSENT)}</code> '
                       "measures them.</p></section>")
    return (head + chart.drawn(results, pyplot) + f'<p class="sentence">{escaped(sentence(chart, results))}</p>' +
            absent_here(figures, chart) + chart.figures(results) + "</section>")


def chart_links():
    return [(f"chart{k}", f"{k}. {chart.TITLE}") for k, chart in enumerate(CHARTS, 1)]


def chart_sections(figures, pyplot):
    return "".join(chart_section(figures, k, chart, pyplot) for k, chart in enumerate(CHARTS, 1))


def sentences(figures):
    """Lines of a list for the README: what each chart advises, without its figures, and which charts are not there."""
    for k, chart in enumerate(CHARTS, 1):
        results = figures.results.get(chart.ROOM)
        if results is None or not chart.is_there(results):
            yield f"- **Chart {k}. {chart.TITLE}** Not in these figures."
            continue
        opening, parts = chart.advice(results)
        yield f"- **Chart {k}. {chart.TITLE}**" + (f" {opening}" if opening else "")
        for text, _ in parts:
            yield f"  - {text if opening else capital(text)}"
