# SPDX-License-Identifier: Apache-2.0
"""Killed at any point, a run leaves whole files only, and the next run ends where an undisturbed one does.

SONAR_KILLS = how often (20)."""
import json
import os
import random
import shutil
import subprocess
import time

import sonarx
from sonarx import OUT, PROGRAM, SURVEY, WORK, Case

KILLS = int(os.environ.get("SONAR_KILLS", "20"))
RESULTS = ("schools.csv", "school_pings.csv", "products/obs-0001.nc", "products/obs-0002.nc")


def start(*arguments):
    return subprocess.Popen([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL, env={**os.environ, "XDG_CACHE_HOME": str(WORK / "cache")})


class Kill(Case):
    def disturbed(self, arguments, prepare, out, kills, seed):
        """Kills the run again and again, each time at another point of what an undisturbed one takes."""
        prepare()
        begin = time.monotonic()
        self.assertEqual(start(*arguments).wait(), 0)
        whole_s = time.monotonic() - begin
        prepare()
        points = random.Random(seed)
        done = 0
        for _ in range(kills):
            process = start(*arguments)
            try:
                process.wait(points.uniform(0, whole_s))
                done += 1
                prepare()  # it came to its end: begin anew
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            for product in out.glob("products/obs-*.nc"):
                self.sonarx("compare", product, product)  # whole, or not there
            for table in ("plan.json", "survey.json"):
                if (out / table).exists():
                    json.loads((out / table).read_text())
        self.assertLess(done, kills)
        self.assertEqual(start(*arguments).wait(), 0)

    def test_first_run(self):
        folder = self.fresh(f"kill-{KILLS}")
        out = folder / "out"
        arguments = ("run", SURVEY, "--out", out)
        self.disturbed(arguments, lambda: shutil.rmtree(out, ignore_errors=True), out, KILLS // 2, 1)
        for name in RESULTS:
            self.assertEqual((out / name).read_bytes(), (OUT / name).read_bytes(), name)
        self.sonarx("compare", OUT, out)
        left = [p.relative_to(out).as_posix() for p in out.rglob("*") if p.is_file()]
        self.assertEqual(sorted(left), sorted((*RESULTS, "plan.json", "survey.gpkg", "survey.json")))
        shutil.rmtree(folder)

    def test_a_run_over_older_products_whose_names_shift(self):
        folder = self.fresh(f"kill-again-{KILLS}")
        raw, older, calm, out = (folder / n for n in ("raw", "older", "calm", "out"))
        raw.mkdir()
        first, second = sorted(SURVEY.glob("*.raw"))
        shutil.copy(second, raw)
        recipe = json.loads(self.sonarx("recipe"))
        recipe["survey"].update(observation_gap_s=1e6, observation_max_s=0)
        (folder / "one.json").write_text(json.dumps(recipe))
        self.sonarx("run", raw, "--out", older, "--recipe", folder / "one.json")
        shutil.copy(first, raw)
        self.sonarx("run", raw, "--out", older, "--recipe", folder / "one.json")  # numbers of the first file are high

        shutil.copytree(older, calm)
        self.sonarx("run", raw, "--out", calm)
        self.assertNotEqual(sonarx.read_csv(calm / "schools.csv"), sonarx.read_csv(OUT / "schools.csv"))

        def prepare():
            shutil.rmtree(out, ignore_errors=True)
            shutil.copytree(older, out)

        self.disturbed(("run", raw, "--out", out), prepare, out, KILLS - KILLS // 2, 2)
        for name in RESULTS:
            self.assertEqual((out / name).read_bytes(), (calm / name).read_bytes(), name)
        self.assertFalse((out / "earlier").exists())
        shutil.rmtree(folder)


if __name__ == "__main__":
    sonarx.main()
