# SPDX-License-Identifier: Apache-2.0
"""Totals, counted again from the tables by a program that shares nothing with ours: of a survey in which a school was
selected by hand for a few pings, detection found the rest of it, and the clock cut the observations."""
import json
import math
import sqlite3

import propagate_test
import sonarx
from sonarx import SURVEY, Case


def schools_of(rows):
    """[[rows]]: those that count, together where `continues` joins them, whichever way round."""
    parent = {(r["observation"], r["school_id"]): (r["observation"], r["school_id"]) for r in rows}

    def root(key):
        while parent[key] != key:
            key = parent[key]
        return key
    for r in rows:
        whole = tuple(r["continues"].rsplit("/", 1)) if r["continues"] else None
        if whole in parent:
            parent[root((r["observation"], r["school_id"]))] = root(whole)
    together = {}
    for r in rows:
        if r["status"] != "rejected":
            together.setdefault(root((r["observation"], r["school_id"])), []).append(r)
    return list(together.values())


def backscatter(school, pings):
    """Mean over a school's pings of what its rows have in each: over those that touch no edge where there are any."""
    parts = {(r["observation"], r["school_id"]) for r in school}
    sums, edges = {}, {}
    for p in pings:
        if (p["observation"], p["school_id"]) in parts:
            at = p["observation"], p["ping_index"]
            sums[at] = sums.get(at, 0.0) + float(p["backscatter_total_m2"])
            edges[at] = edges.get(at, False) or p["touches_edge"] == "1"
    used = [at for at in sums if not edges[at]] or list(sums)
    return sum(sums[at] for at in used) / len(used)


class Totals(Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.fresh("totals")

    def setUp(self):
        if propagate_test.netCDF4 is None:
            self.skipTest("python3-netcdf4 is not installed")

    def held_to(self, out):
        """(schools, backscatter) as survey.json says, held against the tables and the map."""
        rows, pings = sonarx.read_csv(out / "schools.csv"), sonarx.read_csv(out / "school_pings.csv")
        schools = schools_of(rows)
        survey = json.loads((out / "survey.json").read_text())
        summary = survey["summary"]
        self.assertEqual(summary["schools"], len(schools))
        self.assertEqual(summary["school_rows"], len(rows))
        self.assertEqual(summary["school_rows_continued"], len(rows) - len(schools))
        total = sum(backscatter(school, pings) for school in schools)
        self.assertAlmostEqual(summary["backscatter_total_m2"], total, delta=1e-9 * total)
        told = {o["name"]: o["schools"] for o in survey["observations"]}
        here = {name: len(schools_of([r for r in rows if r["observation"] == name])) for name in told}
        self.assertEqual(told, here)
        with sqlite3.connect(out / "survey.gpkg") as gpkg:
            self.assertEqual(dict(gpkg.execute("select observation, n_schools from observations")), here)
        self.sonarx("render", "survey-map", out, "--out", out / "map.svg")
        self.assertIn(f"{len(here)} observations, {len(schools)} schools", (out / "map.svg").read_text())
        return len(schools), total

    def test_a_school_in_parts_counts_once(self):
        recipe = json.loads(self.sonarx("recipe"))
        (self.folder / "default.json").write_text(json.dumps(recipe))
        default = ["--recipe", self.folder / "default.json"]  # the click's own looks for nothing
        whole, clicked = self.folder / "whole", self.folder / "clicked"
        self.sonarx("run", SURVEY, "--out", whole)
        found = self.held_to(whole)
        seed, _ = propagate_test.seed()
        self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", seed, "--reach", 1, "--out", clicked)
        times = [r["time_utc"] for r in sonarx.read_csv(whole / "school_pings.csv") if r["observation"] == "obs-0001"]
        seconds = [float(t[17:-1]) + 60 * int(t[14:16]) for t in times]
        recipe["survey"]["observation_max_s"] = 0.55 * (max(seconds) - min(seconds))
        (self.folder / "cut.json").write_text(json.dumps(recipe))
        session, cut = ["--session", clicked / "session.jsonl"], ["--recipe", self.folder / "cut.json"]
        # Two standard errors by fading: what a school's mean hangs on its masks is less.
        error = math.sqrt(sum(float(r["backscatter_total_se_m2"])**2 for r in sonarx.read_csv(whole / "schools.csv")))
        for name, options in (("by-hand", session + default), ("cut", cut), ("both", session + cut)):
            with self.subTest(name):
                out = self.folder / name
                self.sonarx("run", SURVEY, "--out", out, *options)
                schools, total = self.held_to(out)
                rows = sonarx.read_csv(out / "schools.csv")
                self.assertGreater(len(rows), found[0])
                self.assertEqual(schools, found[0])
                self.assertLessEqual(total, found[1] + 2 * error)
        # Over the results of one another, in whatever order: the same.
        order = self.folder / "order"
        for options in (session, default, session + default):
            self.sonarx("run", SURVEY, "--out", order, *options)
        schools, total = self.held_to(order)
        expected = json.loads((self.folder / "by-hand" / "survey.json").read_text())["summary"]
        self.assertEqual(schools, expected["schools"])
        self.assertAlmostEqual(total, expected["backscatter_total_m2"], delta=1e-9 * total)


if __name__ == "__main__":
    sonarx.main()
