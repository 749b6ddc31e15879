# SPDX-License-Identifier: Apache-2.0
"""The same work cut into tasks, by any number of jobs, without the raw data, gives the same survey."""
import json
import shutil

import sonarx
from sonarx import OUT, SURVEY, Case

# What a survey is: the rest of the folder says how it was made.
RESULTS = ("schools.csv", "school_pings.csv", "products/obs-0001.nc", "products/obs-0002.nc")


class Merge(Case):
    def same_results(self, other):
        for name in RESULTS:
            self.assertEqual((other / name).read_bytes(), (OUT / name).read_bytes(), name)
        self.sonarx("compare", OUT, other)

    def test_plan_tasks_merge_equals_run(self):
        out = self.fresh("tasks")
        self.sonarx("plan", SURVEY, "--out", out)
        plan = json.loads((out / "plan.json").read_text())
        self.assertEqual(len(plan["tasks"]), 2)
        for task in (1, 0):  # in any order
            self.sonarx("run", "--plan", out / "plan.json", "--task", task)
        self.sonarx("merge", out)
        self.same_results(out)
        self.one_line_error("run", "--plan", out / "plan.json", "--task", 99, code=2)

    def test_any_number_of_jobs(self):
        for jobs in (1, 3):
            out = self.fresh(f"jobs-{jobs}")
            self.sonarx("run", SURVEY, "--out", out, "--jobs", jobs)
            self.same_results(out)
            shutil.rmtree(out)

    def test_raw_moved_away(self):
        away = self.fresh("away")
        shutil.copytree(SURVEY, away / "survey", ignore=shutil.ignore_patterns("truth"))
        self.sonarx("run", away / "survey", "--out", away / "out")
        (away / "survey").rename(away / "gone")
        for name in ("schools.csv", "school_pings.csv", "survey.gpkg"):
            (away / "out" / name).unlink()
        self.sonarx("merge", away / "out")
        self.same_results(away / "out")
        self.assertGreater((away / "out" / "survey.gpkg").stat().st_size, 10000)
        self.sonarx("export", away / "out", "--to", "geojson", "--dest", away / "geojson")

    def test_a_refused_run_leaves_nothing(self):
        for wrong in (("--pings", "900:901"), ("--only", "obs-0009")):
            out = self.fresh("merge-refused") / "out"
            self.one_line_error("run", SURVEY, "--out", out, *wrong, code=2)
            self.assertFalse(out.exists(), wrong)

    def test_only_one_observation_then_the_rest(self):
        out = self.fresh("only")
        said = self.sonarx("run", SURVEY, "--out", out, "--only", "obs-0002")
        self.assertNotIn("missing", said)
        survey = json.loads((out / "survey.json").read_text())
        self.assertEqual((survey["missing"], survey["not_run"], survey["failures"]), ([], ["obs-0001"], []))
        self.assertEqual([p.name for p in (out / "products").glob("*.nc")], ["obs-0002.nc"])
        self.assertEqual({r["survey_school"] for r in sonarx.read_csv(out / "schools.csv")}, {"0"}, "not all are there yet")
        self.sonarx("run", SURVEY, "--out", out)
        self.same_results(out)

    def test_some_pings_only_are_told_of(self):
        out = self.fresh("some-pings")
        said = self.sonarx("run", SURVEY, "--out", out, "--pings", "0:5")
        self.assertIn("asked for some pings only: obs-0001, obs-0002\n", said)
        survey = json.loads((out / "survey.json").read_text())
        self.assertEqual(survey["partly_run"], ["obs-0001", "obs-0002"])
        self.assertIs(survey["summary"]["complete"], False)
        self.assertEqual([o["notes"].get("pings-left-out") for o in survey["observations"]], [1, 1])
        self.assertEqual({r["survey_school"] for r in sonarx.read_csv(out / "schools.csv")}, {"0"}, "schools, and no numbers yet")
        self.sonarx("run", SURVEY, "--out", out)
        whole = json.loads((out / "survey.json").read_text())
        self.assertEqual((whole["partly_run"], whole["summary"]["complete"]), ([], True))
        self.same_results(out)

    def test_a_newer_programs_plan_is_not_replaced(self):
        out = self.fresh("newer-plan")
        self.sonarx("plan", SURVEY, "--out", out)
        plan = json.loads((out / "plan.json").read_text())
        plan["plan_version"] += 1
        (out / "plan.json").write_text(json.dumps(plan))
        for verb in ("run", "plan"):
            self.one_line_error(verb, SURVEY, "--out", out, code=1, names="plan_version")
        self.assertEqual(json.loads((out / "plan.json").read_text()), plan)

    def test_compare_names_a_difference(self):
        self.sonarx("compare", OUT / "products/obs-0001.nc", OUT / "products/obs-0001.nc")
        code, out, err = sonarx.run("compare", OUT / "products/obs-0001.nc", OUT / "products/obs-0002.nc")
        self.assertEqual(code, 1)
        self.assertTrue((out + err).strip())

    def test_recipe(self):
        folder = self.fresh("recipe")
        for preset in ("default", "paper"):
            text = self.sonarx("recipe", "--preset", preset)
            self.assertIn("recipe_version", json.loads(text))
            (folder / f"{preset}.json").write_text(text)
            self.sonarx("recipe", "--validate", folder / f"{preset}.json")
        recipe = json.loads((folder / "default.json").read_text())
        recipe["recipe_version"] += 1
        (folder / "newer.json").write_text(json.dumps(recipe))
        self.one_line_error("recipe", "--validate", folder / "newer.json", code=1, names="version")
        (folder / "broken.json").write_text("{")
        self.one_line_error("recipe", "--validate", folder / "broken.json", code=1, names="broken.json")
        (folder / "odd.json").write_text('{"recipe_version": 1, "detect": {"tolerance_db": 1000}}')
        self.one_line_error("recipe", "--validate", folder / "odd.json", code=1, names="detect.tolerance_db")

    def test_mixed_recipes_are_refused(self):
        out = self.fresh("mixed")
        self.sonarx("run", SURVEY, "--out", out, "--only", "obs-0001")
        recipe = json.loads(self.sonarx("recipe", "--preset", "paper"))
        (out / "paper.json").write_text(json.dumps(recipe))
        other = self.fresh("mixed-other")
        self.sonarx("run", SURVEY, "--out", other, "--only", "obs-0002", "--recipe", out / "paper.json")
        shutil.copy(other / "products/obs-0002.nc", out / "products/obs-0002.nc")
        self.one_line_error("merge", out, code=1, names="recipe")


if __name__ == "__main__":
    sonarx.main()
