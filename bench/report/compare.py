# SPDX-License-Identifier: MIT
"""Two runs side by side: what became faster or slower beyond the noise.

A row differs if the intervals in which its two medians lie, each at 93 % or more, do not overlap. That is the noise
within a run. Between runs a machine drifts besides: other pages of memory, other neighbours. What it does to code that
is none of the library's, the rivals and plain loops that were measured in the same runs, tells how much: a change that
is no greater than most of theirs has a mark of its own."""
import html
from collections import defaultdict

from .page import document, folded, table
from .reading import ROOMS, Refusal, contents_of, files_of, room_of
from .spread import FEWEST, apart, figure_of, middle, quotient

FASTER, SLOWER, SAME, TOO_FEW = "faster", "slower", "same", "too few repetitions"
SHOWN = 40  # changed rows of a room on the terminal; the files have all
# Fields that are times, or depend on them; the others are counted, and should not differ at all
TIMES = {"real_time", "cpu_time", "items_per_second", "bytes_per_second", "iterations", "repetition_index", "store_ns",
         "by_hand_ns", "ratio", "ns_per_append", "nanoseconds", "nanoseconds_per_second", "resident", "time_unit",
         "run_type", "name"}
# Whoever is named by one of these in a row is none of the library's code
RIVALS = {"std_unordered_map", "boost_flat_map", "absl_flat_hash_map", "absl_prefetched", "oracle", "plain_array",
          "plain_read", "std_vector", "fscanf", "fprintf", "plain", "hand", "raw", "reduction", "lammps", "lanes"}
FEWEST_RIVALS = 5  # rows, below which they say nothing about the machine
LOUD = (("machine", "machines"), ("instruction_set", "instruction sets"), ("cores", "numbers of cores"))
QUIET = (("compiler", "compiler"), ("flags", "flags"), ("commit", "commit"), ("extent", "extent"), ("date", "date"))


def cost_of(row):
    """ns for whatever the row counts; None if it is no time."""
    for field in ("store_ns", "ns_per_append"):
        if field in row:
            return row[field]
    for field in ("items_per_second", "bytes_per_second"):
        if field in row:
            return 1e9 / row[field]
    return row["real_time"] if "repetition_index" in row and "real_time" in row else None


class Run:
    """The rows of one run, by room and name."""

    def __init__(self, path):
        self.path = path
        self.contexts = defaultdict(list)                        # room: those of its files
        self.costs = defaultdict(lambda: defaultdict(list))      # room: name: [ns]
        self.counted = defaultdict(dict)                         # room: (name, step): fields that are no times
        for file in files_of(self.path):
            self.read(file)

    def read(self, file):
        context, rows = contents_of(file)
        room = room_of(rows)
        self.contexts[room].append(context)
        already = set(self.costs[room]) | {name for name, _ in self.counted[room]}  # of two runs of one row the first
        for row in rows:
            if row["name"] in already:
                continue
            cost = cost_of(row)
            if cost is not None:
                self.costs[room][row["name"]].append(cost)
            fields = {k: v for k, v in row.items() if k not in TIMES}
            if fields:  # of a sweep each step is a row of the same name
                self.counted[room].setdefault((row["name"], row.get("steps", row.get("omega_dt"))), fields)

    def values(self, key):
        return list(dict.fromkeys(str(c.get(key, "unknown")) for found in self.contexts.values() for c in found))


class Row:
    def __init__(self, name, old, new):
        self.name, self.old, self.new = name, middle(old), middle(new)
        words = name.split("/")
        self.is_rival = "tsubu" not in words and not RIVALS.isdisjoint(words)
        self.is_drift = False  # no greater a change than most rivals have
        self.ratio = quotient(self.old, self.new)
        if min(len(old), len(new)) < FEWEST:
            self.mark = TOO_FEW
        elif not apart(self.old, self.new):
            self.mark = SAME
        else:
            self.mark = FASTER if self.new < self.old else SLOWER

    def texts(self):
        """(name, old, new, old / new, mark)"""
        spread = lambda t: f"{figure_of(t)} ({figure_of(t.low)}–{figure_of(t.high)})"
        return self.name, spread(self.old), spread(self.new), f"{self.ratio:.2f}", self.mark + self.note()

    def note(self):
        if self.mark not in (FASTER, SLOWER):
            return ""
        return ", a rival" if self.is_rival else ", as rivals are" if self.is_drift else ""


class Room:
    def __init__(self, old_costs, new_costs, old_counted, new_counted):
        self.rows = [Row(name, old_costs[name], new_costs[name]) for name in old_costs if name in new_costs]
        self.drift = drift_of([row.ratio for row in self.rows if row.is_rival])
        for row in self.rows:
            row.is_drift = self.drift is not None and self.drift[0] <= row.ratio <= self.drift[1]
        self.only_old = [name for name in old_costs if name not in new_costs]
        self.only_new = [name for name in new_costs if name not in old_costs]
        both = [key for key in old_counted if key in new_counted]
        different = [name for name, step in both if old_counted[(name, step)] != new_counted[(name, step)]]
        self.other_counts = list(dict.fromkeys(different))  # names of the rows
        self.same_counts = len(both) - len(different)

    def changed(self):
        """What is beyond the machine's drift first, the greatest change first; rivals last."""
        found = [row for row in self.rows if row.mark in (FASTER, SLOWER)]
        return sorted(found, key=lambda row: (row.is_rival, row.is_drift, -max(row.ratio, 1 / row.ratio)))

    def is_empty(self):
        return not self.rows and not self.other_counts and not self.same_counts

    def summary(self):
        marks = [row.mark for row in self.rows]
        ratios = sorted(row.ratio for row in self.rows)
        texts = [f"{len(self.rows)} times in both", f"{marks.count(FASTER)} faster", f"{marks.count(SLOWER)} slower",
                 f"{marks.count(SAME)} same"]
        if marks.count(TOO_FEW):
            texts.append(f"{marks.count(TOO_FEW)} of too few repetitions")
        if ratios:
            texts.append(f"old / new in the middle {ratios[len(ratios) // 2]:.2f}")
        sentences = [", ".join(texts)]
        if self.drift:
            own = [row for row in self.rows if row.mark in (FASTER, SLOWER) and not row.is_rival and not row.is_drift]
            sentences.append(f"Most rivals, whose code is the same, lie between {self.drift[0]:.2f} and "
                             f"{self.drift[1]:.2f}, so much the machine has drifted: beyond that {len(own)} rows of "
                             "ours")
        if self.only_old or self.only_new:
            sentences.append(f"Only in the old {len(self.only_old)}, only in the new {len(self.only_new)}")
        if self.other_counts:
            sentences.append(f"{len(self.other_counts)} counted figures differ (errors, bytes), such as "
                             f"{self.other_counts[0]}")
        return ". ".join(sentences)


def drift_of(ratios):
    """Between which ratios nine of ten rivals lie, and 1, or all but two where that is fewer; None of too few."""
    if len(ratios) < FEWEST_RIVALS:
        return None
    ratios = sorted(ratios)
    left_out = max(1, len(ratios) // 20)  # at each end: one that was disturbed must not hide what became slower here
    return min(1, ratios[left_out]), max(1, ratios[-1 - left_out])


class Comparison:
    def __init__(self, old, new):
        self.old, self.new = old, new
        self.rooms = {room: Room(old.costs[room], new.costs[room], old.counted[room], new.counted[room])
                      for room in ROOMS if room in old.contexts and room in new.contexts}
        self.rooms = {name: room for name, room in self.rooms.items() if not room.is_empty()}
        if not self.rooms:
            raise Refusal(f"{old.path} and {new.path} have no row in common: nothing to compare "
                          f"({', '.join(old.contexts)} there, {', '.join(new.contexts)} here)")

    def warnings(self):
        return [f"DIFFERENT {name.upper()}: {', '.join(self.old.values(key))} and {', '.join(self.new.values(key))}. "
                "What follows compares these, not the library." for key, name in LOUD
                if self.old.values(key) != self.new.values(key)]

    def conditions(self):
        """[(what, old, new)]"""
        return [(name, ", ".join(self.old.values(key)), ", ".join(self.new.values(key))) for key, name in QUIET]

    def text(self, everything=False):
        lines = [f"old: {self.old.path}", f"new: {self.new.path}"]
        lines += [f"{name:9} {old}  |  {new}" for name, old, new in self.conditions()]
        bar = "!" * 100
        for warning in self.warnings():
            lines += [bar, warning, bar]
        lines.append("")
        lines += [f"{name}: {room.summary()}" for name, room in self.rooms.items()]
        for name, room in self.rooms.items():
            changed = room.changed()
            rows = room.rows if everything else changed[:SHOWN]
            if not rows:
                continue
            lines += ["", f"{name}, {'all rows' if everything else 'beyond the noise'}: ns, medians (their intervals)"]
            lines += in_columns([("row", "old", "new", "old/new", "")] + [row.texts() for row in rows])
            if not everything and len(changed) > SHOWN:
                lines.append(f"... and {len(changed) - SHOWN} more")
        return "\n".join(lines) + "\n"

    def page(self):
        escaped = lambda text: html.escape(text, quote=False)
        parts = [f"<p>Old: <code>{escaped(self.old.path)}</code>, new: <code>{escaped(self.new.path)}</code>. Times "
                 "are medians, with the interval in which each lies at 93 % or more; where two intervals overlap the "
                 "row is called the same. Old / new above 1: the new one is faster. Between runs the machine drifts "
                 "besides: “as rivals are” marks changes no greater than those of most rivals and plain loops, "
                 "which are none of the library's code.</p>"]
        parts += [f'<p class="warning"><strong>{escaped(warning)}</strong></p>' for warning in self.warnings()]
        parts.append(table(["", "old", "new"], self.conditions()))
        parts.append("<ul>" + "".join(f"<li><strong>{name}</strong>: {escaped(room.summary())}</li>"
                                      for name, room in self.rooms.items()) + "</ul>")
        for name, room in self.rooms.items():
            changed = room.changed()
            parts.append(f"<h2>{name}</h2>" + (rows_table(changed) if changed else
                                               "<p>Nothing differs beyond the noise.</p>"))
            if room.other_counts:
                parts.append(folded(f"Counted figures that differ: {len(room.other_counts)}",
                                    "<ul>" + "".join(f"<li>{escaped(n)}</li>" for n in room.other_counts) + "</ul>"))
            parts.append(folded(f"All rows: {len(room.rows)}", rows_table(room.rows)))
        return document("tsubu, two runs", "".join(parts))


def rows_table(rows):
    classes = {FASTER: "holds", SLOWER: "fails", TOO_FEW: "noisy"}
    arrows = {FASTER: "▲ faster", SLOWER: "▼ slower"}
    cells = []
    for row in rows:
        name, old, new, ratio, _ = row.texts()
        numbers = [f'<td class="figure">{html.escape(text)}</td>' for text in (old, new, ratio)]
        style = "" if row.is_rival or row.is_drift else classes.get(row.mark, "")
        cells.append([name, *numbers, f'<td class="{style}">{arrows.get(row.mark, row.mark)}{row.note()}</td>'])
    return table(["Row", "Old, ns", "New, ns", "Old / new", ""], cells)


def in_columns(rows):
    """Numbers to the right, names to the left."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return ["  ".join([row[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(row[1:4], widths[1:4])), row[4]]).rstrip()
            for row in rows]
