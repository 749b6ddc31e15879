# SPDX-License-Identifier: Apache-2.0
"""Makes the survey that the other tests read, and runs it: simulate -> info -> run -> score -> compare."""
import json
import resource
import shutil
import subprocess

import sonarx
from sonarx import OUT, SCHOOL_PINGS, SCHOOLS, SURVEY, TRUTH, WORK, Case

FLAGS = ["--preset", "easy", "--seed", "3", "--observations", "2", "--pings", "14", "--schools", "2"]


class SmallSurvey(Case):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        code, out, err = sonarx.run("simulate", SURVEY, *FLAGS)
        assert code == 0, out + err
        cls.raw = sonarx.snapshot(SURVEY)
        code, out, err = sonarx.run("run", SURVEY, "--out", OUT)
        assert code == 0, out + err

    def test_simulated_survey(self):
        self.assertTrue(sorted(SURVEY.glob("*.raw")))
        self.assertEqual(sonarx.header(TRUTH / "schools.csv"), SCHOOLS + ["SYNTHETIC"])
        self.assertEqual(sonarx.header(TRUTH / "school_pings.csv"), SCHOOL_PINGS + ["SYNTHETIC"])
        self.assertGreater(len(sonarx.read_csv(TRUTH / "bodies.csv")), 0)
        self.assertEqual(sorted(p.name for p in TRUTH.glob("*.nc")), ["obs-0001.nc", "obs-0002.nc"])
        for raw in SURVEY.glob("*.raw"):
            self.assertIn(b"SYNTHETIC", raw.read_bytes()[:2000])

    def test_the_same_seed_gives_the_same_bytes(self):
        again = self.fresh("again")
        self.sonarx("simulate", again / "survey", *FLAGS)
        self.assertEqual(sonarx.contents(again / "survey"), sonarx.contents(SURVEY))
        shutil.rmtree(again)

    def test_info(self):
        info = json.loads(self.sonarx("info", SURVEY, "--json", "--checksum"))
        self.assertEqual([o["name"] for o in info["observations"]], ["obs-0001", "obs-0002"])
        for observation in info["observations"]:
            self.assertEqual(observation["grid"], {"fans": 20, "beams": 25})
            self.assertEqual(observation["pings"], 14)
            self.assertLess(observation["first_time_utc"], observation["last_time_utc"])
        for file in info["files"]:
            self.assertEqual(file["channels"], 500)
            self.assertEqual(file["datagrams"]["RAW0"], 500 * file["pings"])
            self.assertEqual(file["datagrams"]["CON0"], 1)
            self.assertEqual(file["notes"], [])
            self.assertIn("power_count_sum", file)
            self.assertLessEqual(file["samples"]["min"], file["samples"]["max"])
            for key in ("path", "format", "sounder", "size", "first_time_utc", "last_time_utc", "first_position",
                        "talkers", "gps_minus_clock_s"):
                self.assertIn(key, file)
        self.assertGreater(len(self.sonarx("info", SURVEY)), 100)

    def test_the_raw_folder_is_never_written_to(self):
        self.assertEqual(sonarx.snapshot(SURVEY), self.raw)

    def test_memory_stays_bounded(self):
        """Every program that this test started, the run among them."""
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, 600 * 1024)

    def test_score(self):
        score = json.loads(self.sonarx("score", OUT, "--truth", TRUTH, "--json"))
        self.assertEqual(len(score["schools"]), len(sonarx.read_csv(TRUTH / "schools.csv")))
        for school in score["schools"]:
            for key in ("truth_id", "found_id", "inside", "n_pings", "n_unclipped", "dice", "cog_error_m",
                        "volume_ratio", "volume_corrected_ratio", "backscatter_error_db", "sv_error_db",
                        "speed_error_mps", "purity", "range_m", "elevation_deg", "length_corrected_ratio",
                        "width_corrected_ratio", "height_corrected_ratio"):
                self.assertIn(key, school)
        self.assertEqual(score["false_schools"], [])
        self.assertEqual(score["summary"]["found_fraction"], 1.0)
        self.assertGreater(score["summary"]["mean_dice"], 0.8)
        self.assertIn("found_fraction", score["summary"])
        self.assertIn("mean_dice", score["summary"])
        self.assertEqual(score["summary"]["pings"], 28)
        for thirds in ("by_range_third", "by_elevation_third"):
            self.assertEqual(sum(third["counted"] for third in score["summary"][thirds]), score["summary"]["counted"])
        self.assertTrue(self.sonarx("score", OUT, "--truth", TRUTH).strip())

    def test_score_names_what_of_the_truth_is_missing(self):
        folder = self.fresh("torn-truth")
        shutil.copytree(TRUTH, folder / "truth")
        (folder / "truth" / "obs-0002.nc").unlink()
        code, out, err = sonarx.run("score", OUT, "--truth", folder / "truth", "--json")
        self.assertEqual(code, 3)
        self.assertEqual(len(err.splitlines()), 1)
        self.assertIn("obs-0002.nc is missing", err)
        self.assertEqual({s["truth_id"].split("/")[0] for s in json.loads(out)["schools"]}, {"obs-0001"})

    def test_score_refuses_a_truth_of_other_pings(self):
        folder = self.fresh("other-truth")
        self.sonarx("simulate", folder / "survey", "--preset", "easy", "--seed", "9", "--observations", "1", "--pings", "3",
                    "--schools", "1")
        self.sonarx("run", folder / "survey", "--out", folder / "out")
        truth = folder / "first" / "truth"
        shutil.copytree(TRUTH, truth)
        (truth / "obs-0001.nc").unlink()  # begins when the other survey does; the second observation is another day's
        (truth / "obs-0002.nc").rename(truth / "obs-0001.nc")
        self.one_line_error("score", folder / "out", "--truth", truth, code=1, names=folder / "out")

    def test_schools_that_found_no_room_are_told(self):
        folder = self.fresh("full")
        code, out, error = sonarx.run("simulate", folder / "survey", "--preset", "easy", "--observations", "1", "--pings", "2",
                                      "--schools", "60")
        self.assertEqual(code, 0, error)
        schools = len(sonarx.read_csv(folder / "survey" / "truth" / "schools.csv"))
        self.assertLess(schools, 60)
        self.assertIn(f"{schools} of 60 schools had room", error)

    def test_nothing_is_simulated_beneath_raw_files(self):
        before = sonarx.snapshot(SURVEY)
        for inner in (SURVEY / "inner", SURVEY / "a" / "b"):
            self.one_line_error("simulate", inner, "--preset", "easy", code=2, names=inner)
        self.assertEqual(sonarx.snapshot(SURVEY), before)

    def test_nothing_is_simulated_among_results(self):
        before = sonarx.snapshot(OUT)
        for force in ((), ("--force",)):
            self.one_line_error("simulate", OUT, "--preset", "easy", *force, code=2, names="holds a survey's results")
        self.assertEqual(sonarx.snapshot(OUT), before)

    def test_a_run_that_looks_for_nothing_says_so(self):
        folder = self.fresh("nothing")
        recipe = json.loads(self.sonarx("recipe"))
        recipe["automatic"] = False
        (folder / "r.json").write_text(json.dumps(recipe))
        code, _, err = sonarx.run("run", SURVEY, "--out", folder / "out", "--recipe", folder / "r.json", "--only", "obs-0001")
        self.assertEqual(code, 0, err)
        self.assertIn("schools were not detected", err)

    def test_geojson_holds_the_tables_values(self):
        folder = self.fresh("geojson")
        self.sonarx("export", OUT, "--to", "geojson", "--dest", folder / "map")
        features = json.loads((folder / "map" / "school_centres.geojson").read_text())["features"]
        rows = sonarx.read_csv(OUT / "school_pings.csv")
        self.assertEqual(len(features), len(rows))
        for feature, row in zip(features, rows):
            self.assertEqual(list(feature["properties"]), SCHOOL_PINGS)
            for name, value in feature["properties"].items():
                if value is None or isinstance(value, str):
                    self.assertEqual(value or "", row[name])
                else:
                    self.assertEqual(value, float(row[name]))

    def test_an_export_that_finds_the_disk_full_leaves_nothing(self):
        folder = self.fresh("full")
        # No file may grow beyond 2 kB: what a full disk does, half way.
        limited = f"trap '' XFSZ; ulimit -f 4; exec {sonarx.PROGRAM} export {OUT} --to geojson --dest {folder / 'map'}"
        done = subprocess.run(["sh", "-c", limited], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        self.assertIn("File too large", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertEqual([p for p in folder.rglob("*") if p.is_file()], [])

    def test_a_second_run_does_nothing_again(self):
        before = sonarx.snapshot(OUT / "products")
        self.sonarx("run", SURVEY, "--out", OUT)
        self.assertEqual(sonarx.snapshot(OUT / "products"), before)

    def test_remeasuring_unchanged_calibration_changes_no_table(self):
        again = self.fresh("remeasured")
        shutil.copytree(OUT, again / "out")
        self.sonarx("run", SURVEY, "--out", again / "out", "--remeasure")
        for table in ("schools.csv", "school_pings.csv"):
            self.assertEqual((again / "out" / table).read_bytes(), (OUT / table).read_bytes())
        shutil.rmtree(again)

    def test_extinction_and_errors_change_nothing_but_what_they_are_about(self):
        folder = self.fresh("corrected")
        recipe = json.loads(self.sonarx("recipe"))
        recipe["measure"]["extinction"]["correct"] = True
        recipe["errors"]["enabled"] = True
        (folder / "recipe.json").write_text(json.dumps(recipe), encoding="utf-8")
        self.sonarx("run", SURVEY, "--recipe", folder / "recipe.json", "--out", folder / "out")
        self.assertIn("extinction-corrected", (folder / "out" / "survey.json").read_text(encoding="utf-8"))
        before, after = (sonarx.read_csv(out / "schools.csv") for out in (OUT, folder / "out"))
        self.assertEqual(len(before), len(after))
        for was, now in zip(before, after, strict=True):
            self.assertEqual((was["volume_m3"], was["extinction_corrected"]), (now["volume_m3"], "0"))
            self.assertEqual(now["extinction_corrected"], "1")
            # The echo is what the table said that it lacked.
            lost = float(was["extinction_share"])
            self.assertGreater(lost, 0)
            heard = float(was["backscatter_m2"]) / float(now["backscatter_m2"])
            self.assertAlmostEqual(1 - heard, lost, delta=0.3 * lost)
            self.assertEqual(was["volume_se_m3"], "")
            self.assertLess(0, float(now["volume_se_m3"]))
            self.assertLess(float(now["volume_se_m3"]), 0.5 * float(now["volume_m3"]))
            self.assertLess(0.5, float(now["sv_mean_se_db"]), "the calibration's error")
        shutil.rmtree(folder)


if __name__ == "__main__":
    sonarx.main()
