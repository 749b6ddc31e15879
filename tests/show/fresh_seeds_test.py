#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/fresh_seeds.py: intervals against published ones, verdicts on scores made by hand."""
import random
import statistics
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "tools"))
import fresh_seeds  # noqa: E402

LIMITS = fresh_seeds.Limits(found=0.9, dice=0.8, false_per_200=0.5, backscatter_db=0.2, size=0.05, purity=1.0)


def school(**changed):
    return {"counted": True, "found_id": "obs-0001/1", "merged": False, "dice": 0.9, "purity": 1.0, "range_m": 50.0,
            "elevation_deg": -5.0, "n_unclipped": 9, "backscatter_error_db": 0.1, "total_backscatter_error_db": 0.1, "body_backscatter_error_db": -0.5,
            "sv_error_db": 0.0, "speed_error_mps": 0.01, "volume_ratio": 1.1, "volume_corrected_ratio": 1.0,
            "length_corrected_ratio": 1.0, "width_corrected_ratio": 1.0, "height_corrected_ratio": 1.0, **changed}


def survey(schools, false=(), pings=200):
    return {"schools": schools, "false_schools": list(false),
            "summary": {"pings": pings, "false_by_cause": {cause: list(false).count(cause) for cause in set(false)},
                        "by_range_third": [{"from_m": 100.0 * i, "to_m": 100.0 * (i + 1)} for i in range(3)],
                        "by_elevation_third": [{"from_deg": 15.0 * i - 45, "to_deg": 15.0 * i - 30} for i in range(3)]}}


def verdicts(surveys):
    lines, _, causes = fresh_seeds.judge(LIMITS, surveys)
    return {line.title: line for line in lines}, causes


class Intervals(unittest.TestCase):
    def test_wilson_as_published(self):
        """R. G. Newcombe, Statistics in Medicine 17 (1998) 857-872, table I, method 3."""
        for hits, of, low, high in ((81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611),
                                    (1, 29, 0.0061, 0.1718)):
            told = fresh_seeds.wilson(hits, of)
            self.assertAlmostEqual(told[0], low, 4)
            self.assertAlmostEqual(told[1], high, 4)
        self.assertEqual(fresh_seeds.wilson(20, 20)[1], 1.0)
        self.assertIsNone(fresh_seeds.wilson(0, 0))

    def test_poisson_as_published(self):
        """F. Garwood, Biometrika 28 (1936) 437-442: the exact limits, as tables of them print these."""
        for count, low, high in ((0, 0.0, 3.689), (1, 0.0253, 5.572), (5, 1.623, 11.668), (10, 4.795, 18.390)):
            told = fresh_seeds.poisson(count)
            self.assertAlmostEqual(told[0], low, 3)
            self.assertAlmostEqual(told[1], high, 3)

    def test_median_by_order_statistics(self):
        """Ranks as tables of the sign test have them: 6: 1 and 6; 8: 1 and 8; 9: 2 and 8; 10: 2 and 9; 20: 6 and 15."""
        for n, low, high in ((6, 1, 6), (8, 1, 8), (9, 2, 8), (10, 2, 9), (20, 6, 15)):
            self.assertEqual(fresh_seeds.median_interval(list(range(n, 0, -1))), (low, high))
        self.assertIsNone(fresh_seeds.median_interval([1, 2, 3, 4, 5]))

    def test_median_is_held_as_often_as_said(self):
        source = random.Random(7)
        held = 0
        for _ in range(2000):
            low, high = fresh_seeds.median_interval([source.gauss(0, 1) for _ in range(15)])
            held += low <= 0 <= high
        self.assertGreater(held / 2000, 0.95)  # 96.5 % for fifteen

    def test_mean(self):
        self.assertEqual(fresh_seeds.mean_interval([1.0, 1.0, 1.0]), (1.0, 1.0))
        self.assertIsNone(fresh_seeds.mean_interval([1.0]))


class Verdicts(unittest.TestCase):
    def test_all_good(self):
        lines, causes = verdicts([survey([school() for _ in range(10)]), survey([school() for _ in range(10)])])
        for line in lines.values():
            self.assertIsNot(line.good, False, line)
        self.assertEqual(lines["counted schools found"].n, 20)
        self.assertEqual(lines["false schools in 200 pings"].n, 400)
        self.assertEqual(causes, {})

    def test_schools_are_pooled_by_third_with_their_sign(self):
        near = [school(total_backscatter_error_db=-0.3, range_m=20.0, elevation_deg=-40.0) for _ in range(6)]
        far = [school(total_backscatter_error_db=0.15, range_m=400.0, elevation_deg=5.0) for _ in range(6)]
        lines, _ = verdicts([survey(near[:3] + far[:3]), survey(near[3:] + far[3:])])
        self.assertEqual(lines["backscatter_total, dB, range 0 .. 100 m"].figure, -0.3)
        self.assertIs(lines["backscatter_total, dB, range 0 .. 100 m"].good, False)
        self.assertIs(lines["backscatter_total, dB, range 200 .. 300 m"].good, True)
        self.assertIsNone(lines["backscatter_total, dB, range 100 .. 200 m"].good, "nothing there to judge")
        self.assertIs(lines["backscatter_total, dB, elevation -45 .. -30 deg"].good, False)
        self.assertIs(lines["backscatter_total, dB, elevation -15 .. 0 deg"].good, True)

    def test_what_the_interval_leaves_open(self):
        def of(values):
            lines, _ = verdicts([survey([school(total_backscatter_error_db=v) for v in values])])
            line = lines["backscatter_total, dB, range 0 .. 100 m"]
            return line.good, line.open

        self.assertEqual(of([0.1] * 6), (True, False))
        self.assertEqual(of([-0.1, -0.1, -0.1, -0.1, -0.1, -0.9]), (True, True))
        self.assertEqual(of([0.1, 0.3, 0.3, 0.3, 0.3, 0.3]), (False, True))
        self.assertEqual(of([0.3] * 6), (False, False))

    def test_few_are_not_judged(self):
        lines, _ = verdicts([survey([school(total_backscatter_error_db=-3.0, length_corrected_ratio=2.0) for _ in range(5)])])
        self.assertIsNone(lines["backscatter_total, dB, range 0 .. 100 m"].good)
        self.assertIsNone(lines["corrected length, share"].good)
        self.assertTrue(str(lines["corrected length, share"]).startswith("few"))

    def test_sizes_of_both_signs(self):
        lines, _ = verdicts([survey([school(length_corrected_ratio=0.9, width_corrected_ratio=1.04) for _ in range(6)])])
        self.assertAlmostEqual(lines["corrected length, share"].figure, -0.1)
        self.assertIs(lines["corrected length, share"].good, False)
        self.assertIs(lines["corrected width, share"].good, True)

    def test_what_was_not_found_or_shares_a_track_is_missed_and_gives_no_errors(self):
        lost = school(found_id=None, dice=0.0, purity=None, total_backscatter_error_db=None)
        lines, _ = verdicts([survey([school() for _ in range(8)] + [lost, school(merged=True, purity=0.4, sv_error_db=9.0),
                                                                     school(counted=False, sv_error_db=9.0)])])
        self.assertEqual(lines["counted schools found"].figure, 0.8)
        self.assertIs(lines["counted schools found"].good, False)
        self.assertTrue(lines["counted schools found"].open, "0.9 is within Wilson's interval for 8 of 10")
        self.assertAlmostEqual(lines["mean Dice with the expected -10 dB mask"].figure, 9 * 0.9 / 10)
        self.assertEqual(lines["told only: mean Sv, dB"].n, 8)

    def test_false_schools_by_cause(self):
        lines, causes = verdicts([survey([school()], ["seabed", "plume"], 60), survey([school()], ["seabed"], 60)])
        self.assertAlmostEqual(lines["false schools in 200 pings"].figure, 5.0)
        self.assertIs(lines["false schools in 200 pings"].good, False)
        self.assertEqual(causes, {"seabed": 2, "plume": 1})

    def test_nothing_found_is_a_miss(self):
        lost = school(found_id=None, dice=None, purity=None)
        lines, _ = verdicts([survey([lost, lost])])
        self.assertIs(lines["counted schools found"].good, False)
        self.assertIs(lines["mean Dice with the expected -10 dB mask"].good, False)

    def test_seeds_are_new_each_time(self):
        self.assertNotEqual(fresh_seeds.draw(8), fresh_seeds.draw(8))
        self.assertEqual(len(set(fresh_seeds.draw(50))), 50)


if __name__ == "__main__":
    unittest.main()
