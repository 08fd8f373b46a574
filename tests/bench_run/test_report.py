#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The rule of noise, the sentences under the charts and the comparison of two runs, on figures that are made up."""
import contextlib
import gzip
import importlib.util
import io
import json
import os
import re
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench"))

from report import compare, dem, drawing, front, id_map, pictures, reading, spread, store  # noqa: E402
from report.__main__ import Figures, ROOMS, main  # noqa: E402
from report.charts import layouts, patterns, precision, sparsity, stability  # noqa: E402

CONTEXT = {"date": "2026-01-02T03:04:05Z", "machine": "a machine", "cores": "2", "compiler": "g++ 12", "flags": "-O2",
           "commit": "abc", "instruction_set": "avx2", "huge_pages": "never", "extent": "quick"}
NOISE = (1, .98, 1.02, .99, 1.01)  # five repetitions within 2 %


def repeated(name, nanoseconds, noise=NOISE, **fields):
    return [{"name": name, "repetition_index": k, "items_per_second": 1e9 / (nanoseconds * factor), **fields}
            for k, factor in enumerate(noise)]


def results_of(room, rows):
    results = room.Results()
    results.begin_file({**CONTEXT, "file": "made up"})
    for row in rows:
        results.add(row)
    return results


def map_rows(times, count=100000, pattern="uniform", noise=NOISE, memory=8.0):
    """times: {series: {ratio: ns}}, the same for all operations."""
    return [row for series, by_ratio in times.items() for ratio, t in by_ratio.items()
            for operation in ("find_hit", "find_single", "rebuild")
            for row in repeated(f"{pattern}/N:{count}/ratio:{ratio}/{series}/{operation}", t, noise,
                                bytes_per_particle=memory)]


class Noise(unittest.TestCase):
    def test_the_interval_of_few_repetitions_is_all_of_them(self):
        found = spread.middle([5, 1, 4, 2, 3])
        self.assertEqual((found, found.low, found.high), (3, 1, 5))

    def test_the_interval_of_many_leaves_the_extremes_out(self):
        found = spread.middle([1, 2, 3, 4, 5, 6, 7, 8, 100])  # 1 - 2 * (1 + 9) / 2^9 = 96 %
        self.assertEqual((found, found.low, found.high), (5, 2, 8))
        found = spread.middle(range(1, 16))  # 1 - 2 * (1 + 15 + 105 + 455) / 2^15 = 96 %
        self.assertEqual((found.low, found.high), (4, 12))

    def test_medians_differ_if_their_intervals_do_not_overlap(self):
        a, b, c = spread.Spread(10, 9, 11), spread.Spread(12, 11, 13), spread.Spread(12, 11.1, 13)
        self.assertFalse(spread.apart(a, b))
        self.assertTrue(spread.apart(a, c))
        self.assertTrue(spread.apart(c, a))

    def test_as_good_as_the_best_are_those_within_noise_of_it(self):
        values = {"a": spread.Spread(10, 9, 11), "b": spread.Spread(10.5, 10, 12), "c": spread.Spread(20, 19, 21), "d": None}
        self.assertEqual(spread.as_good(values), ["a", "b"])

    def test_a_choice_changes_only_beyond_noise(self):
        exact = lambda **v: {k: spread.Spread(x, x - 1, x + 1) for k, x in v.items()}
        costs = {1: exact(a=10, b=20), 2: exact(a=15, b=14), 4: exact(a=30, b=14)}
        runs = spread.runs_of_choice([1, 2, 4], costs.get)
        self.assertEqual(runs, [("a", [1, 2]), ("b", [4])])
        self.assertEqual(spread.spans_text(runs, "x = "), "a up to x = 2 and b at 4")

    def test_one_place_is_not_everywhere(self):
        self.assertEqual(spread.spans_text([("a", [8])], "T/N = "), "a at T/N = 8")
        self.assertEqual(spread.spans_text([("a", [1, 8])], "T/N = "), "a everywhere")

    def test_powers(self):
        self.assertEqual([spread.power(n) for n in (1, 64, 10000, 400000, 10**6, 50123)],
                         ["1", "64", "1e4", "4e5", "1e6", "50123"])


class Sentences(unittest.TestCase):
    def test_the_table_changes_where_it_is_worse_beyond_noise(self):
        results = results_of(id_map, map_rows({"dense": {1: 1, 8: 2, 64: 20}, "flat": {1: 3, 8: 3, 64: 4},
                                               "adaptive": {1: 1, 8: 2, 64: 6}, "boost_flat_map": {1: 9, 8: 9, 64: 9}}))
        text = front.sentence(sparsity, results)
        self.assertIn("for batched look-ups dense up to T/N = 8 and flat at 64 (dense 2.00 ns, boost 9.00 at 8; "
                      "flat 4.00 ns, boost 9.00 at 64)", text)
        self.assertIn("within noise of the best of our own tables at 6 of 9 points", text)
        self.assertIn("1.50 times as long at the worst", text)

    def test_a_noisy_difference_is_called_noise(self):
        wild = (1, .5, 2, .7, 1.5)
        results = results_of(id_map, map_rows({"flat": {1: 10, 8: 10}, "boost_flat_map": {1: 11, 8: 11}}, noise=wild))
        self.assertIn("flat everywhere (flat 10.0 ns, boost 11.0 within noise at 8)", front.sentence(sparsity, results))

    def test_a_crossing_within_noise_is_not_marked(self):
        rows = lambda noise: map_rows({"dense": {1: 1, 8: 10}, "flat": {1: 2, 8: 5}}, noise=noise)
        found = id_map.crossings(results_of(id_map, rows(NOISE)), 100000, "find_hit")
        self.assertEqual([names for _, *names in found], [["dense", "flat"]])
        self.assertTrue(1 < found[0][0] < 8)
        self.assertEqual(id_map.crossings(results_of(id_map, rows((1, .2, 5, .5, 2))), 100000, "find_hit"), [])

    def test_patterns_name_the_worst_and_the_degenerate(self):
        rows = map_rows({"adaptive": {8: 2}, "boost_flat_map": {8: 6}}) + \
            map_rows({"adaptive": {8: 5}, "boost_flat_map": {8: 5.1}}, pattern="random_62_bits")
        rows += [{"name": "random_62_bits/N:100000/ratio:8/dense", "refused": "too wide"},
                 {"name": "random_62_bits/N:100000/ratio:8/chained_mod_prime/rebuild", "degenerate": 777.0}]
        text = front.sentence(patterns, results_of(id_map, rows))
        self.assertIn("a batched look-up of 1e5 takes 2.00 to 5.00 ns (uniform, to compare; 62 random bits)", text)
        self.assertIn("1.02 to 3.00 times that, beyond noise in 1 of 2 patterns (62 random bits; uniform", text)
        self.assertIn("for 1 of 2 patterns dense is refused", text)
        self.assertIn("visits 777 nodes", text)

    def test_layouts(self):
        rows = [{"name": f"store/carried/{layout}/{operation}/{size}/N:400000", "repetition_index": k,
                 "real_time": t * f}
                for layout, times in {"soa": (2, 2), "aos": (3, 9)}.items() for size, t in zip((96, 544), times)
                for operation in ("update", "permute", "pack") for k, f in enumerate(NOISE)]
        text = front.sentence(layouts, results_of(store, rows))
        self.assertIn("For 4e5 particles", text)
        self.assertIn("soa where updates count (soa 2.00 and aos 3.00 ns at 96 bytes; soa 2.00 and aos 9.00 ns at "
                      "544 bytes)", text)
        self.assertIn("as long within noise in soa and 3.0 times as long in aos", text)

    @staticmethod
    def scenes(pefrl_cost):
        rows = []
        for integrator, order, cost in (("velocity_verlet", 2, 10), ("pefrl", 4, pefrl_cost)):
            for n in (5.37, 10.37, 20.37, 40.37, 80.37):
                rows.append({"name": f"dem/impact/hooke/{integrator}/double", "steps": n, "time_step": .005 / n,
                             "error": n**-order})
            rows += [{"name": f"dem/cost/hooke/{integrator}/double", "repetition_index": k, "real_time": cost * f}
                     for k, f in enumerate(NOISE)]
        return results_of(dem, rows)

    def test_precision_chooses_the_cheapest_that_reaches_the_tolerance(self):
        # 1e-2 takes Verlet 10.37 steps and PEFRL 5.37 of four evaluations
        text = front.sentence(precision, self.scenes(pefrl_cost=40))
        self.assertIn("below 1 % choose velocity Verlet, within noise or 2 % of the cheapest in 1 of 1 scenes", text)
        self.assertIn("PEFRL costs 2.07 to 2.07 times that", text)
        self.assertIn("below 1e-5 choose PEFRL", text)  # which Verlet does not reach here
        self.assertIn("below 1 % choose PEFRL", front.sentence(precision, self.scenes(pefrl_cost=5)))

    def test_advised_limit_is_never_above_the_limit(self):
        texts = [stability.safe_text(limit) for limit in (2.0, 2.989, 2.828427, .8284)]
        self.assertEqual(texts, ["2.00", "2.98", "2.82", "0.82"])

    def test_stability_tells_theory_and_what_was_lost(self):
        rows = [{"name": "dem/walls/0/velocity_verlet/double", "omega_dt": w, "error": e}
                for w, e in ((1, .1), (1.95, 1), (2.05, 1e9), (2.5, 1e9))]
        rows += [{"name": "dem/settle/bed/velocity_verlet/double", "omega_dt": w, "coordination": c, "kinetic": 1e-6,
                  "packing": .59, "height": 1, "limit": .6, "nanoseconds_per_second": 1} for w, c in
                 ((.3, 4.5), (.5, 4.6), (.7, 4.55), (.9, 2.0), (1.0, 1.5))]
        text = front.sentence(stability, results_of(dem, rows))
        self.assertIn("Keep ω dt below 2.00 with velocity Verlet (lost at 2.05)", text)
        self.assertIn("longest_time_step allows, 0.60", text)
        self.assertIn("4.50 to 4.60 contacts per particle; a longer step is refused by the guards", text)
        self.assertIn("there are 2.00 and less from 0.9 on", text)
        after = {**rows[-1], "omega_dt": 1.1, "coordination": 4.9}
        self.assertIn("there are 2.00 from 0.9 on", front.sentence(stability, results_of(dem, rows + [after])))


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def file(self, name, rows, **context):
        path = os.path.join(self.folder.name, name)
        opened = gzip.open(path, "wt") if name.endswith(".gz") else open(path, "w", encoding="utf-8")
        with opened as out:
            json.dump({"context": {**CONTEXT, **context}, "benchmarks": rows}, out)
        return path


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "no matplotlib in this python")
class Drawing(Folder):
    def test_a_page_has_what_there_is_and_names_the_rest(self):
        maps = self.file("id.json", map_rows({"dense": {1: 1, 8: 2}, "flat": {1: 3, 8: 3, 64: 4},
                                              "adaptive": {1: 1, 8: 2}}))
        out = os.path.join(self.folder.name, "page.html")
        sys.argv = ["report.py", maps, "-o", out]
        self.assertEqual(main("draws"), 0)
        with open(out, encoding="utf-8") as file:
            text = file.read()
        self.assertEqual(text.count('id="chart'), 5)
        self.assertEqual(text.count("<figure><h4>"), 4)  # of chart 1; the others have no figures here
        self.assertIn("Not in these figures: <code>bench/run --only dem</code>", text)
        self.assertIn("Not measured, since not found: Boost 1.81 or later and Abseil", text)
        self.assertNotIn("src=", text)  # nothing from elsewhere
        for stand_in, *_ in pictures.PALETTE.values():
            self.assertNotIn(stand_in, text)  # all colours are those of the page, light or dark

    def test_a_series_of_the_users_own_is_on_the_charts(self):
        times = {"flat": {1: 3, 8: 3}, "tree": {1: 5, 8: 6}, "bush": {1: 7, 8: 7}}
        results = results_of(id_map, map_rows(times) + map_rows({"flat": {8: 3}, "tree": {8: 5}}, pattern="lattice"))
        pyplot = pictures.plotting()
        for chart in (sparsity, patterns):
            drawn, figures = chart.drawn(results, pyplot), chart.figures(results)
            for name in ("tree", "bush"):
                self.assertTrue(f"</svg>{name}</li>" in drawn, "not in the legend")
                self.assertTrue(name in figures, "not in a table")
        self.assertEqual(sparsity.drawn(results, pyplot).count(">tree</text>"), 4)  # at the end of its line
        looks = [results.looks()[name] for name in ("tree", "bush")]
        self.assertEqual(len({(look.marker, look.line) for look in looks}), 2)
        self.assertEqual(list(results_of(id_map, map_rows({"flat": {1: 1}})).looks()), ["flat"])  # nothing is kept

    def test_a_picture_keeps_its_texts(self):
        """Those with powers and with several lines are drawn in parts."""
        pyplot = pictures.plotting()
        figure, axes = pyplot.subplots()
        axes.set(xscale="log", xlim=(1, 1e8), title="one line\nand another")
        picture = xml.etree.ElementTree.fromstring(pictures.svg_of(figure, pyplot, "powers"))
        words = ["".join(text.itertext()).strip() for text in picture.iter("{http://www.w3.org/2000/svg}text")]
        for word in ("one line", "and another", "0.4", "1.0"):
            self.assertIn(word, words)
        self.assertTrue(any(word.replace(" ", "") in ("108", "10⁸") for word in words), words)

    def test_no_name_on_the_page_is_there_twice(self):
        rows = map_rows({"dense": {1: 1, 8: 2}, "flat": {1: 3, 8: 3}, "adaptive": {1: 1, 8: 2}})
        out = os.path.join(self.folder.name, "page.html")
        sys.argv = ["report.py", self.file("id.json", rows), "-o", out]
        self.assertEqual(main("draws"), 0)
        with open(out, encoding="utf-8") as file:
            names = re.findall(r'\bid="([^"]+)"', file.read())
        self.assertEqual(len(names), len(set(names)))
        self.assertGreater(len(names), 20)


class Labels(unittest.TestCase):
    def test_they_are_moved_apart_in_their_order(self):
        moved = drawing.spread_out([.5, .51, .52, .9], .1)
        self.assertEqual(moved, sorted(moved))
        self.assertTrue(all(b - a > .099 for a, b in zip(moved, moved[1:])), moved)


class Front(Folder):
    def test_what_is_missing_is_named(self):
        figures = Figures([self.file("id.json", map_rows({"flat": {1: 1}, "std_unordered_map": {1: 2}}))])
        text = front.missing(figures, ROOMS)
        self.assertIn("Boost", text)
        self.assertIn("Abseil", text)
        self.assertIn("the room dem", text)
        self.assertIn("A quick run", front.warnings(figures))
        whole = Figures([self.file("id.json", map_rows({"flat": {1: 1}}), extent="standard")])
        self.assertEqual(front.warnings(whole), "")

    def test_lammps_is_missing_by_its_reason(self):
        figures = Figures([self.file("dem.json", [{"name": "dem/missing/LAMMPS/no lmp here/-"}])])
        self.assertIn("LAMMPS (would stand in the appendix on scenes; no lmp here)", front.missing(figures, ROOMS))

    def test_a_chart_is_missing_though_its_room_is_there(self):
        pairs = [{"name": "store/pair/soa/update/N:10000", "repetition_index": k, "store_ns": 2 * f, "by_hand_ns": 2,
                  "ratio": f, "bytes_per_place": 96, "bytes_per_particle": 96} for k, f in enumerate(NOISE)]
        figures = Figures([self.file("store.json", pairs)])
        self.assertIn("chart 3 (bench/run --only store)", front.missing(figures, ROOMS))
        self.assertIn("- **Chart 3. Which layout, and what does another field cost?** Not in these figures.",
                      list(front.sentences(figures)))

    def test_sentences_of_the_readme_have_no_figures_in_brackets(self):
        figures = Figures([self.file("id.json", map_rows({"dense": {1: 1, 8: 9}, "flat": {1: 3, 8: 3}}))])
        lines = list(front.sentences(figures))
        self.assertIn("- **Chart 1. Which table for which ids?** For 1e5 particles choose", lines)
        self.assertIn("  - for batched look-ups dense at T/N = 1 and flat at 8", lines)

    def test_few_repetitions_are_told(self):
        few = Figures([self.file("id.json", map_rows({"flat": {1: 1}}, noise=(1, 1.1, 1.2)))])
        self.assertIn("with fewer, of which there are some in id", front.introduction(few))
        enough = Figures([self.file("id.json", map_rows({"flat": {1: 1}}))])
        self.assertNotIn("with fewer", front.introduction(enough))

    def test_claims_that_all_hold_need_no_table(self):
        maps = self.file("id.json", map_rows({"dense": {1: 1}, "plain_array": {1: 1}}))
        sys.argv = ["report.py", "--shortfalls", maps]
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(main("prints"), 0)
        self.assertRegex(said.getvalue(), r"^Of 2 claims with a target 2 hold, 0 are .*, and none fails\.\n$")

    def test_several_runs_are_told(self):
        figures = Figures([self.file("id.json", map_rows({"flat": {1: 1}})),
                           self.file("dem.json", [{"name": "dem/missing/LAMMPS/no lmp here/-"}], commit="def-dirty")])
        text = front.warnings(figures)
        self.assertIn("different commits", text)
        self.assertIn("id: abc of 2026-01-02", text)
        self.assertIn("changes that no commit holds: dem", text)

    def test_marks_of_finished_groups_are_no_rows(self):
        path = self.file("id.json.gz", map_rows({"flat": {1: 1}}) + [{"name": "uniform", "group_seconds": 3.0}])
        self.assertEqual(Figures([path]).results["id"].counts(), [100000])

    def test_rows_that_are_no_figures_are_refused(self):
        good = map_rows({"flat": {1: 10}})[0]
        for bad in ("a text", None, {"items_per_second": 1}, {**good, "name": 7},
                    *({**good, "items_per_second": x} for x in (0, -1, float("nan"), float("inf"), "1", None, True))):
            with self.subTest(bad), self.assertRaisesRegex(reading.Refusal, "row 2"):
                reading.contents_of(self.file("rows.json", [good, bad]))

    def test_what_is_no_run_is_refused(self):
        path = os.path.join(self.folder.name, "half.json")
        with open(path, "w", encoding="utf-8") as file:
            file.write('{"context": {')
        cut = self.file("cut.json.gz", map_rows({"flat": {1: 1}}))
        with open(cut, "rb+") as file:
            file.truncate(os.path.getsize(cut) // 2)
        no_rows = os.path.join(self.folder.name, "no_rows.json")
        with open(no_rows, "w", encoding="utf-8") as file:
            json.dump({"context": CONTEXT}, file)
        for bad in (path, cut, no_rows, self.file("no_machine.json", [], machine="")):
            with self.assertRaises(reading.Refusal):
                Figures([bad])


class Comparison(Folder):
    def compared(self, old, new, **context):
        return compare.Comparison(compare.Run(self.file("old.json", old)),
                                  compare.Run(self.file("new.json.gz", new, **context)))

    def test_only_what_is_beyond_the_noise_is_marked(self):
        old = map_rows({"flat": {1: 10, 8: 10, 64: 10}})
        new = map_rows({"flat": {1: 10.1, 8: 5, 64: 20}})
        found = self.compared(old, new)
        marks = {row.name: row.mark for row in found.rooms["id"].rows}
        self.assertEqual([marks[f"uniform/N:100000/ratio:{r}/flat/rebuild"] for r in (1, 8, 64)],
                         ["same", "faster", "slower"])
        self.assertIn("9 times in both, 3 faster, 3 slower, 3 same", found.text())
        self.assertIn("2.00  faster", found.text())
        self.assertNotIn("ratio:1/", found.text())
        self.assertIn("ratio:1/", found.text(everything=True))
        self.assertIn("▼ slower", found.page())

    def test_what_the_rivals_do_as_well_is_the_machine(self):
        rivals = lambda t: {"std_unordered_map": {k: t for k in range(1, 7)}}
        found = self.compared(map_rows({"flat": {1: 10, 8: 10}, **rivals(10)}),
                              map_rows({"flat": {1: 12, 8: 40}, **rivals(15)})).rooms["id"]
        notes = {row.name: row.note() for row in found.rows}
        self.assertEqual([notes[f"uniform/N:100000/ratio:{r}/{s}/rebuild"]
                          for s, r in (("flat", 1), ("flat", 8), ("std_unordered_map", 1))],
                         [", as rivals are", "", ", a rival"])
        self.assertEqual(found.drift, (10 / 15, 1))
        self.assertIn("lie between 0.67 and 1.00, so much the machine has drifted: beyond that 3 rows of ours",
                      found.summary())
        self.assertIn("ratio:8/flat", found.changed()[0].name)

    def test_few_repetitions_tell_nothing(self):
        for noise, mark in (((1,), compare.TOO_FEW), (NOISE[:4], compare.TOO_FEW), (NOISE, compare.SLOWER)):
            found = self.compared(repeated("uniform/N:10/ratio:1/flat/rebuild", 10, noise, bytes_per_particle=8),
                                  repeated("uniform/N:10/ratio:1/flat/rebuild", 90, noise, bytes_per_particle=8))
            self.assertEqual(found.rooms["id"].rows[0].mark, mark)

    def test_our_own_rows_beside_loops_by_hand_are_no_rivals(self):
        is_rival = lambda name: compare.Row(name, [1] * 5, [1] * 5).is_rival
        self.assertFalse(is_rival("dem/hand/forces/tsubu/double"))
        self.assertTrue(is_rival("dem/hand/forces/plain/double"))
        self.assertTrue(is_rival("dem/beside/gas/lammps/double"))

    def test_one_disturbed_rival_hides_nothing(self):
        self.assertEqual(compare.drift_of([1, 1, 1.01, 1.02, .3]), (1, 1.01))

    def test_all_files_of_a_room_are_looked_at(self):
        rows = map_rows({"flat": {1: 10}})
        folder = os.path.join(self.folder.name, "two")
        os.mkdir(folder)
        os.rename(self.file("a.json", rows, commit="first"), os.path.join(folder, "a.json"))
        os.rename(self.file("b.json", map_rows({"flat": {8: 10}}), commit="second", machine="another"),
                  os.path.join(folder, "b.json"))
        text = compare.Comparison(compare.Run(self.file("old.json", rows)), compare.Run(folder)).text()
        self.assertIn("DIFFERENT MACHINES: a machine and a machine, another", text)
        self.assertIn("first, second", text)

    def test_counted_figures_must_be_equal(self):
        rows = lambda error: [{"name": "dem/impact/hooke/pefrl/double", "steps": 5.37, "error": error}]
        self.assertIn("1 counted figures differ", self.compared(rows(.1), rows(.2)).text())
        self.assertNotIn("differ", self.compared(rows(.1), rows(.1)).text())
        more = [{"name": "dem/impact/hooke/pefrl/double", "steps": 10.37, "error": .05}]
        self.assertNotIn("differ", self.compared(rows(.1), rows(.1) + more).text())  # a longer sweep

    def test_another_machine_is_told_loudly(self):
        rows = map_rows({"flat": {1: 10}})
        self.assertIn("DIFFERENT MACHINES: a machine and another", self.compared(rows, rows, machine="another").text())
        self.assertIn("DIFFERENT MACHINES", self.compared(rows, rows, machine="another").page())
        self.assertNotIn("DIFFERENT", self.compared(rows, rows).text())

    def test_nothing_in_common_is_refused(self):
        with self.assertRaises(reading.Refusal):
            self.compared(map_rows({"flat": {1: 10}}),
                          [{"name": "dem/walls/0/pefrl/double", "omega_dt": 1, "error": 1}])
        empty = os.path.join(self.folder.name, "empty")
        os.mkdir(empty)
        with self.assertRaises(reading.Refusal):
            compare.Run(empty)

    def test_all_kinds_of_rows_have_a_cost(self):
        for row, cost in (({"store_ns": 3, "real_time": 9, "repetition_index": 0}, 3), ({"ns_per_append": 4}, 4),
                          ({"bytes_per_second": 1e9}, 1), ({"real_time": 7, "repetition_index": 0}, 7),
                          ({"error": .1}, None), ({"refused": "too wide"}, None)):
            self.assertEqual(compare.cost_of(row), cost)

    def test_the_command_writes_a_page_and_a_text(self):
        rows = map_rows({"flat": {1: 10}})
        old, new = self.file("a.json", rows), self.file("b.json", rows)
        with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit):
            sys.argv = ["report.py", "--compare", old, new, "-o", os.path.join(self.folder.name, "compare.txt")]
            main("would write the text upon the page")
        out = os.path.join(self.folder.name, "out", "compare.html")
        sys.argv = ["report.py", "--compare", old, new, "-o", out]
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(main("compares"), 0)
        self.assertIn("3 times in both, 0 faster, 0 slower, 3 same", said.getvalue())
        with open(out, encoding="utf-8") as file:
            self.assertIn("All rows: 3", file.read())
        with open(out.replace(".html", ".txt"), encoding="utf-8") as file:
            self.assertIn("uniform/N:100000/ratio:1/flat/rebuild", file.read())


if __name__ == "__main__":
    if not importlib.util.find_spec("matplotlib"):
        pictures.go_on_with_system_python()  # which may have it; else what draws is skipped, and said to be
    unittest.main()
