# SPDX-License-Identifier: Apache-2.0
"""One click on a school of the truth, in both modes."""
import json
import unittest

import sonarx
from sonarx import SURVEY, TRUTH, Case

try:
    import netCDF4
except ImportError:
    netCDF4 = None


def seed():
    """PING,FAN,BEAM,SAMPLE in the middle of the longest run of the largest school's middle ping."""
    product = netCDF4.Dataset(TRUTH / "obs-0001.nc")
    mask = {name: product["mask"][name][:].tolist()
            for name in ("school_id", "ping_index", "channel", "first_sample", "sample_count")}
    place = {int(channel): (fan, beam) for fan, row in enumerate(product["grid"]["channel"][:].tolist())
             for beam, channel in enumerate(row)}
    product.close()
    size = {}
    for school, count in zip(mask["school_id"], mask["sample_count"]):
        size[school] = size.get(school, 0) + count
    school = max(sorted(size), key=size.get)
    pings = sorted({p for s, p in zip(mask["school_id"], mask["ping_index"]) if s == school})
    ping = pings[len(pings) // 2]
    runs = [(n, c, f) for s, p, c, f, n in zip(*(mask[k] for k in ("school_id", "ping_index", "channel", "first_sample",
                                                                  "sample_count"))) if (s, p) == (school, ping)]
    count, channel, first = max(runs)
    fan, beam = place[channel]
    return f"{ping},{fan},{beam},{first + count // 2}", len(pings)


def shape():
    """Fans and beams of the survey's grid."""
    product = netCDF4.Dataset(TRUTH / "obs-0001.nc")
    fans, beams = product["grid"]["channel"].shape
    product.close()
    return fans, beams


class Propagate(Case):
    def setUp(self):
        if netCDF4 is None:
            self.skipTest("python3-netcdf4 is not installed")

    def test_both_modes_follow_the_school(self):
        place, pings = seed()
        for mode, tolerance in (("tracked", ("--tolerance-db", "10")), ("paper", ("--tolerance-opacity", "0.3"))):
            with self.subTest(mode):
                out = self.fresh(f"propagate-{mode}")
                self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, *tolerance, "--mode", mode,
                            "--out", out)
                schools = sonarx.read_csv(out / "schools.csv")
                self.assertEqual(len(schools), 1)
                self.assertEqual(schools[0]["origin"], "manual")
                rows = sonarx.read_csv(out / "school_pings.csv")
                self.assertEqual(len(rows), int(schools[0]["n_pings"]))
                if mode == "tracked":
                    self.assertGreaterEqual(len(rows), pings // 2)

    def test_without_a_tolerance_the_recipes_holds(self):
        place, _ = seed()
        tables = []
        for name, tolerance in (("told", ("--tolerance-db", "10")), ("untold", ())):
            out = self.fresh(f"propagate-{name}")
            self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, *tolerance, "--reach", "2",
                        "--out", out)
            tables.append(sonarx.read_csv(out / "school_pings.csv"))
        self.assertEqual(*tables)

    def test_a_school_that_goes_on_beyond_the_reach_is_told_so(self):
        place, pings = seed()
        self.assertGreaterEqual(pings, 5)
        for reach, expected in (("1", "both"), (str(10 * pings), "")):
            out = self.fresh(f"propagate-reach-{reach}")
            said = self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, "--reach", reach, "--out",
                               out)
            lines = [line for line in said.splitlines() if line.startswith("goes on beyond ")]
            self.assertEqual(sonarx.read_csv(out / "schools.csv")[0]["ended_at_reach"], expected)
            notes = json.loads((out / "survey.json").read_text())["observations"][0]["notes"]
            if expected:
                self.assertEqual(len(lines), 1, said)
                self.assertIn("beyond 1 ping both ways: continue?", lines[0])
                self.assertEqual(notes["ended-at-reach"], 2)
            else:
                self.assertEqual(lines, [])
                self.assertNotIn("ended-at-reach", notes)

    def test_a_seed_in_the_noise_is_refused_in_one_line(self):
        # A side of the sector, towards the record's end; a curve that lets noise be grown from.
        _, beams = shape()
        curve = self.fresh("propagate-noise-curve") / "c.json"
        curve.write_text(json.dumps({"tf_version": 1, "points": [{"sv_db": -140, "opacity": 0, "rgb": [0, 0, 0]},
                                                                 {"sv_db": -30, "opacity": 1, "rgb": [1, 1, 1]}]}))
        code, _, err = sonarx.run("propagate", SURVEY, "--observation", "obs-0001", "--seed", f"0,15,{beams - 1},1250",
                                  "--transfer-function", curve, "--out", self.fresh("propagate-noise"))
        self.assertEqual(code, 2, err)
        self.assertEqual(len(err.strip().splitlines()), 1, err)
        self.assertRegex(err, r"^sonarx: --seed 0,15,\d+,1250: .* is less than 3 dB above the noise")

    def test_what_is_grown_with_26_neighbours_is_followed_with_them(self):
        place, _ = seed()
        recipe = self.fresh("propagate-26-recipe") / "r.json"
        recipe.write_text('{"recipe_version": 1, "grow": {"connectivity": "26"}}')
        out = self.fresh("propagate-26")
        self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, "--tolerance-db", "10", "--recipe",
                    recipe, "--reach", "1", "--out", out)
        said = json.loads((out / "session.jsonl").read_text().splitlines()[1])["args"]
        for part in ("grow", "propagate_paper", "propagate_tracked"):
            self.assertEqual(said[part]["connectivity"], "26")

    def test_a_calibration_reaches_the_click_and_stands_in_the_recipe(self):
        place, _ = seed()
        fans, beams = shape()
        table = self.fresh("propagate-calibration") / "c.csv"
        table.write_text("channel,gain_db,sa_correction_db,extra_factor_db\n" +
                         "".join(f"{channel},,,1\n" for channel in range(fans * beams)))
        recipe = json.loads(self.sonarx("recipe", "--calibration", table))
        self.assertEqual(len(recipe["beam_calibration"]), fans * beams)
        rows = {}
        for name, calibration in (("plain", ()), ("calibrated", ("--calibration", table))):
            out = self.fresh(f"propagate-{name}")
            self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, "--tolerance-db", "10", "--reach",
                        "0", *calibration, "--out", out)
            rows[name] = sonarx.read_csv(out / "school_pings.csv")[0]
        self.assertEqual(rows["plain"]["n_voxels"], rows["calibrated"]["n_voxels"])
        # A factor of 1 dB on every beam; backscatter is linear, so the background goes along.
        shift = float(rows["calibrated"]["sv_mean_db"]) - float(rows["plain"]["sv_mean_db"])
        self.assertAlmostEqual(abs(shift), 1.0, delta=0.02)

    def test_a_seed_in_the_sea_is_refused_in_one_line(self):
        out = self.fresh("propagate-sea")
        code, _, err = sonarx.run("propagate", SURVEY, "--observation", "obs-0001", "--seed", "0,10,12,3",
                                  "--tolerance-db", "10", "--out", out)
        self.assertEqual(code, 2)
        self.assertEqual(len(err.strip().splitlines()), 1)
        self.assertRegex(err, r"^sonarx: --seed 0,10,12,3: lies in ")

    def test_a_tolerance_in_the_other_unit_goes_by_the_growth_curve(self):
        place, _ = seed()
        flat = self.fresh("flat-curve") / "curve.json"
        flat.write_text(json.dumps({"tf_version": 1, "opacity_length_m": 10, "points": [
            {"sv_db": -70, "opacity": 0, "rgb": [0, 0, 1]}, {"sv_db": -45, "opacity": 0.9, "rgb": [0, 1, 0]},
            {"sv_db": -30, "opacity": 0, "rgb": [1, 0, 0]}]}))
        found = {}
        for name, tolerance in (("db", ("--tolerance-db", "12")), ("opacity", ("--tolerance-opacity", "0.3"))):
            out = self.fresh(f"propagate-{name}")  # the default curve rises by 1 over 40 dB
            self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, *tolerance, "--reach", "1",
                        "--out", out)
            found[name] = (out / "school_pings.csv").read_text()
        self.assertEqual(found["db"], found["opacity"])
        self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, "--tolerance-db", "60", "--reach",
                    "0", "--out", self.fresh("propagate-wide"))
        for more, what in ((("--tolerance-db", "60", "--mode", "paper"), "--tolerance-db 60: is 1.5 of opacity"),
                           (("--tolerance-opacity", "0.0001"), "--tolerance-opacity 0.0001: is 0.004 dB"),
                           (("--tolerance-opacity", "0.3", "--transfer-function", flat), "name --tolerance-db")):
            code, _, err = sonarx.run("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, *more, "--out",
                                      self.fresh("propagate-none"))
            self.assertEqual((code, len(err.strip().splitlines())), (2, 1), err)
            self.assertIn(what, err)

    def test_seeds_that_are_no_voxels(self):
        fans, beams = shape()
        for place in ("1,2,3", "a,b,c,d", f"0,{fans},0,100", f"0,0,{beams},100", "0,0,0,999999", "-1,0,0,100", "9999,0,0,100"):
            with self.subTest(place):
                code, _, err = sonarx.run("propagate", SURVEY, "--observation", "obs-0001", f"--seed={place}",
                                          "--tolerance-db", "10", "--out", self.fresh("propagate-none"))
                self.assertEqual(code, 2, err)
                self.assertEqual(len(err.strip().splitlines()), 1, err)


class SessionRecipe(Case):
    """A recipe that a window keeps beside a journal is that of the session's run, whatever is measured anew."""

    @unittest.skipIf(netCDF4 is None, "netCDF4-python is not installed")
    def test_a_session_keeps_its_recipe(self):
        folder = self.fresh("session-recipe")
        clicked = folder / "clicked"
        place, _ = seed()
        self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, "--tolerance-db", "10", "--reach", "1",
                    "--out", clicked)
        kept = clicked / "session-recipe.json"
        kept.write_text('{"recipe_version": 1, "detect": {"tolerance_db": 7}}', encoding="utf-8")
        for name, options, speed in (("plain", [], 0.0), ("measured", ["--sound-speed", "1480"], 1480.0)):
            self.sonarx("run", SURVEY, "--session", clicked, "--only", "obs-0001", "--out", folder / name, *options)
            with netCDF4.Dataset(folder / name / "products" / "obs-0001.nc") as product:
                used = json.loads(product.recipe)
            self.assertEqual(used["detect"]["tolerance_db"], 7.0, name)
            self.assertFalse(used["automatic"], "the session's lines say where schools are detected")
            self.assertEqual(used["survey"]["sound_speed_mps"], speed)
        for text in ("{", '{"recipe_version": 1, "median": {"kernel_fans": 4}}'):
            kept.write_text(text, encoding="utf-8")
            self.one_line_error("run", SURVEY, "--session", clicked, "--out", folder / "broken", code=1, names=kept.name)


if __name__ == "__main__":
    sonarx.main()
