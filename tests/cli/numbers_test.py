# SPDX-License-Identifier: Apache-2.0
"""A school keeps its number: when a file comes in late, when the cutting into observations changes, when names shift."""
import json
import math
import shutil

import sonarx
from sonarx import SURVEY, Case


def centres(out):
    """{observation: {school: where it was first seen}}; what a school is, whatever it is called."""
    found = {}
    for row in sonarx.read_csv(out / "school_pings.csv"):  # sorted by school and ping
        place = float(row["latitude"]), float(row["longitude"])
        found.setdefault(row["observation"], {}).setdefault(int(row["school_id"]), place)
    return found


def near(a, b):
    """Within 40 m: where an observation begins decides a little about its first pings."""
    return math.hypot((a[0] - b[0]) * 111200, (a[1] - b[1]) * 111200 * math.cos(math.radians(a[0]))) < 40


class Numbers(Case):
    def same_schools(self, found, expected):
        self.assertEqual(sorted(found), sorted(expected))
        for number, place in expected.items():
            self.assertTrue(near(found[number], place), f"school {number}: {found[number]}, expected {place}")

    def same_surveys(self, out, expected):
        found = centres(out)
        self.assertEqual(sorted(found), sorted(expected))
        for observation, schools in expected.items():
            self.same_schools(found[observation], schools)

    def test_numbers_stay_with_their_schools(self):
        folder = self.fresh("numbers")
        raw = folder / "raw"
        raw.mkdir()
        first, second = sorted(SURVEY.glob("*.raw"))
        recipe = json.loads(self.sonarx("recipe"))
        recipe["survey"].update(observation_gap_s=1e6, observation_max_s=0)
        (folder / "one.json").write_text(json.dumps(recipe))
        one, out = ["--recipe", folder / "one.json"], folder / "out"

        shutil.copy(second, raw)
        self.sonarx("run", raw, "--out", out, *one)
        before = centres(out)["obs-0001"]
        self.assertGreaterEqual(len(before), 1)

        # A file that lies before in time joins the observation: its schools come first, but numbers are given already.
        shutil.copy(first, raw)
        self.sonarx("run", raw, "--out", out, *one)
        both = centres(out)["obs-0001"]
        self.same_schools({n: s for n, s in both.items() if n in before}, before)
        added = {n: s for n, s in both.items() if n not in before}
        self.assertGreaterEqual(len(added), 1)
        self.assertGreater(min(added), max(before))
        self.assertFalse((out / "earlier").exists())

        # Cut in two by the default recipe, names shifted: obs-0002 is what obs-0001 was at first.
        self.sonarx("run", raw, "--out", out)
        self.same_surveys(out, {"obs-0001": added, "obs-0002": before})
        self.assertFalse((out / "earlier").exists())

        # The same through a plan, tasks in any order; obs-0001 is overwritten before the task that needs its numbers.
        (raw / first.name).unlink()
        self.sonarx("run", raw, "--out", out)
        self.same_surveys(out, {"obs-0001": before})
        shutil.copy(first, raw)
        self.sonarx("plan", raw, "--out", out)
        for task in (0, 1):
            self.sonarx("run", "--plan", out / "plan.json", "--task", task)
        self.sonarx("merge", out)
        self.same_surveys(out, {"obs-0001": added, "obs-0002": before})

        # In a fresh folder numbers begin at 1.
        self.sonarx("run", raw, "--out", folder / "fresh")
        self.assertEqual(min(centres(folder / "fresh")["obs-0001"]), 1)
        shutil.rmtree(folder)


if __name__ == "__main__":
    sonarx.main()
