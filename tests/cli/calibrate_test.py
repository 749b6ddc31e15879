# SPDX-License-Identifier: Apache-2.0
"""A calibration from a simulated sphere run, held against the truth that the simulator wrote."""
import csv
import json
import re

import sonarx
from sonarx import Case, run

# Some beams around -9 degrees, which a sphere at 35 m crosses in pings enough.
PATCH = {"sphere": {"range_m": 35, "elevation_from_deg": -14, "elevation_to_deg": -5, "azimuth_from_deg": -6,
                    "azimuth_to_deg": 6}}


def rows(path):
    with open(path, newline="", encoding="ascii") as file:
        return {int(row["channel"]): row for row in csv.DictReader(file)}


class Calibrate(Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.fresh("calibrate")
        cls.survey, cls.table = cls.folder / "sphere", cls.folder / "calibration.csv"
        (cls.folder / "patch.json").write_text(json.dumps(PATCH))
        code, _, err = run("simulate", cls.survey, "--physics", "array", "--sphere", "wc38.1", "--pings", 130, "--seed", 4,
                           "--params", cls.folder / "patch.json")
        assert code == 0, err
        code, cls.said, err = run("calibrate", cls.survey, "--sphere", "wc38.1", "--out", cls.table)
        assert code == 0, err

    def test_the_table_has_the_true_figures_of_the_beams_that_were_crossed(self):
        truth, made = rows(self.survey / "truth" / "beams.csv"), rows(self.table)
        self.assertGreaterEqual(len(made), 4)
        self.assertLess(len(made), 60)
        for channel, row in made.items():
            is_ = truth[channel]
            number = lambda name: float(row[name])
            self.assertAlmostEqual(number("gain_db"), float(is_["gain_db"]), delta=0.1)
            self.assertAlmostEqual(number("sa_correction_db"), float(is_["sa_correction_db"]), delta=0.06)
            self.assertAlmostEqual(number("psi_db"), float(is_["psi_true_db"]), delta=0.6)
            self.assertLess(abs(number("gain_db") - float(is_["gain_db"])), 4 * number("gain_db_se"))
            for name in ("sa_correction_db_se", "psi_db_se", "width_along_deg_se", "width_athwart_deg_se"):
                self.assertGreater(number(name), 0, name)

    def test_the_report_says_what_was_left(self):
        crossed = int(re.search(r"(\d+) of 500 beams crossed", self.said).group(1))
        self.assertEqual(crossed, len(rows(self.table)))
        self.assertIn("tungsten carbide", self.said)
        self.assertRegex(self.said, r"not crossed, as they were: .*all of fan 0-")

    def test_json_has_every_beam_before_and_after(self):
        told = json.loads(self.sonarx("calibrate", self.survey, "--sphere", "WC38.1", "--json", "--out",
                                      self.folder / "again.csv"))
        self.assertEqual((self.folder / "again.csv").read_text(), self.table.read_text())
        self.assertEqual(len(told["beams"]), 500)
        self.assertEqual(told["pings"], 130)
        self.assertEqual([b["channel"] for b in told["beams"] if b["crossed"]], sorted(rows(self.table)))
        for beam in told["beams"]:
            self.assertEqual("after" in beam, beam["crossed"])
            self.assertIn("gain_db", beam["before"])

    def test_a_run_takes_the_table(self):
        recipe = json.loads(self.sonarx("recipe", "--calibration", self.table))
        self.assertEqual(recipe["calibration"]["psi"], "table")
        taken = {b["channel"]: b for b in recipe["beam_calibration"]}
        for channel, row in rows(self.table).items():
            self.assertEqual(taken[channel]["gain_db"], float(row["gain_db"]))
            self.assertEqual(taken[channel]["psi_db_se"], float(row["psi_db_se"]))
        self.sonarx("run", self.survey, "--out", self.folder / "out", "--calibration", self.table)

    def test_what_cannot_be_done_is_told_in_a_line(self):
        out = self.folder / "none.csv"
        self.one_line_error("calibrate", self.survey, "--sphere", "fe20", "--out", out, code=2, names="wc38.1")
        self.one_line_error("calibrate", self.survey, "--sphere", "wc38.1", "--range", "50,60", "--out", out, code=1,
                            names="crossed no beam")
        self.one_line_error("calibrate", self.survey, "--sphere", "wc38.1", "--range", "60,50", "--out", out, code=2,
                            names="--range")
        self.one_line_error("calibrate", self.survey, "--sphere", "wc38.1", "--water", "8,99,10", "--out", out, code=2,
                            names="--water")
        self.one_line_error("simulate", self.folder / "x", "--sphere", "wc38.1", code=2, names="--physics array")
        self.one_line_error("calibrate", self.survey, "--sphere", "wc38.1", "--out", self.survey / "c.csv", code=2)
        self.assertFalse(out.exists())


if __name__ == "__main__":
    sonarx.main()
