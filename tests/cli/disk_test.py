# SPDX-License-Identifier: Apache-2.0
"""A disk that is full, or breaks, at any call that would change it; and the order in which things reach it.

SONAR_SHIM = the library that makes calls fail, SONAR_FAULTS = how many of the calls (16; 0 = every one)."""
import errno
import json
import os
import random
import shutil
import subprocess
import unittest

import propagate_test
import sonarx
from sonarx import PROGRAM, SURVEY, WORK, Case

SHIM = os.environ.get("SONAR_SHIM", "")
# SQLite calls a flush that finds no room an I/O error.
SAYS = {errno.ENOSPC: "No space left on device|disk is full|disk I/O error", errno.EIO: "Input/output error|disk I/O error"}
FAULTS = int(os.environ.get("SONAR_FAULTS", "16"))


def shimmed(*arguments, below, fail=0, error=errno.ENOSPC, log=None):
    environment = {**os.environ, "XDG_CACHE_HOME": str(WORK / "cache"), "LD_PRELOAD": SHIM, "SONAR_SHIM_BELOW": str(below),
                   "SONAR_SHIM_ERROR": str(error)}
    if fail:
        environment["SONAR_SHIM_FAIL"] = str(fail)
    if log:
        environment["SONAR_SHIM_LOG"] = str(log)
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          timeout=300, env=environment, check=False)
    return done.returncode, done.stdout, done.stderr


@unittest.skipUnless(SHIM, "SONAR_SHIM, the library that makes calls fail, is not given: none is built with sanitizers")
class Disk(Case):
    @classmethod
    def setUpClass(cls):
        folder = cls.fresh("disk")
        cls.survey, cls.out = sonarx.simulate_tiny(folder, observations=2, pings=5), folder / "out"
        for file in cls.survey.glob("*.raw"):  # over for `follow` from the start, and not only once these tests have run for so long
            os.utime(file, (0, 0))
        code, _, err = sonarx.run("run", cls.survey, "--out", cls.out)
        assert code == 0, err

    def logged(self, name, *arguments, below):
        log = self.fresh(name) / "calls"
        code, _, err = shimmed(*arguments, below=below, log=log)
        self.assertEqual(code, 0, err)
        return [line.split(" ") for line in log.read_text().splitlines()]

    def check_order(self, calls):
        """What is renamed into place was flushed after its last write, and its folder is flushed after the rename."""
        renamed = 0
        for i, call in enumerate(calls):
            if call[0] != "rename":
                continue
            renamed += 1
            source, target = call[1:]
            before = [c[0] for c in calls[:i] if c[-1] == source]
            self.assertIn("write", before, target)
            self.assertEqual(before[-1], "fsync", f"{target}: renamed before it was flushed")
            folder = os.path.dirname(target)
            self.assertIn(["fsync", "-", folder], calls[i:], f"{target}: its folder is not flushed")
            later = [c for c in calls[i:] if c[0] == "write" and c[-1] == target]
            self.assertEqual(later, [], f"{target}: written to under its own name")
        return renamed

    def test_what_a_power_cut_leaves_is_whole(self):
        folder = self.fresh("power")
        out = folder / "out"
        # two products, plan, two tables, map, survey.json
        self.assertEqual(self.check_order(self.logged("power-run", "run", self.survey, "--out", out, below=out)), 7)
        self.assertGreater(self.check_order(self.logged("power-export", "export", out, "--to", "csv", "--dest",
                                                        folder / "csv", below=folder / "csv")), 1)
        self.assertEqual(self.check_order(self.logged("power-render", "render", "observation-map", out, "--out",
                                                      folder / "map.png", below=folder)), 1)

    def faulty_runs(self, calls, error):
        """Some of the calls fail, and all behind them: nothing half is left, and the next run ends as an undisturbed one."""
        folder = self.fresh(f"faults-{error}")
        out = folder / "out"
        places = range(1, calls + 1)
        if FAULTS and calls > FAULTS:
            places = sorted({1, calls, *random.Random(error).sample(places, FAULTS - 2)})
        for at in places:
            with self.subTest(call=at):
                shutil.rmtree(out, ignore_errors=True)
                code, _, err = shimmed("run", self.survey, "--out", out, below=out, fail=at, error=error)
                self.assertIn(code, (1, 3), err)
                self.assertTrue(err.strip().splitlines()[-1].startswith("sonarx: "), err)
                self.assertRegex(err, SAYS[error])
                self.assertNotIn("sqlite3_exec", err)
                left = [p for p in out.rglob("*") if p.is_file() and not p.name.startswith(".")]
                for product in (p for p in left if p.suffix == ".nc"):
                    self.sonarx("compare", product, product)
                for file in left:
                    theirs = self.out / file.relative_to(out)
                    if file.suffix in (".csv", ".nc") and code == 1:
                        self.assertEqual(file.read_bytes(), theirs.read_bytes(), file)
        self.sonarx("run", self.survey, "--out", out)
        self.sonarx("compare", self.out, out)
        hidden = [p.name for p in out.rglob(".*") if p.is_file()]
        self.assertEqual(hidden, [])

    def test_a_disk_that_is_full_or_breaks_at_any_call(self):
        calls = len(self.logged("count", "run", self.survey, "--out", self.fresh("count-out") / "out",
                                below=WORK / "count-out" / "out"))
        self.assertGreater(calls, 30)
        for error in (errno.ENOSPC, errno.EIO):
            self.faulty_runs(calls, error)

    def whole_or_absent(self, name, into, *arguments, begin=None):
        """Some of the calls under the folder `into` fail, and all behind them: what is there then is what an undisturbed one
        writes, byte for byte; of a journal, whole lines of it. begin(into) = what stands there before."""
        folder = self.fresh(f"faulty-{name}")
        wanted, faulty = folder / "wanted", folder / "faulty"

        def fresh(out):
            shutil.rmtree(out, ignore_errors=True)
            if begin:
                begin(out)

        fresh(wanted)
        calls = len(self.logged(f"faulty-{name}-count", *arguments, into, wanted, below=wanted))
        self.assertGreater(calls, 5)
        for error in (errno.ENOSPC, errno.EIO):
            places = range(1, calls + 1)
            if FAULTS and calls > FAULTS // 2:
                places = sorted({1, calls, *random.Random(error).sample(places, FAULTS // 2 - 2)})
            for at in places:
                with self.subTest(verb=name, call=at, error=errno.errorcode[error]):
                    fresh(faulty)
                    code, _, err = shimmed(*arguments, into, faulty, below=faulty, fail=at, error=error)
                    self.assertIn(code, (1, 3), err)
                    self.assertRegex(err, SAYS[error])
                    for file in (p for p in faulty.rglob("*") if p.is_file() and not p.name.startswith(".")):
                        theirs = wanted / file.relative_to(faulty)
                        if file.suffix == ".jsonl":
                            self.assertTrue(all(json.loads(line) for line in file.read_text().splitlines()))
                        elif name == "propagate":  # it tells when it was decided
                            self.assertEqual(len(file.read_bytes()), len(theirs.read_bytes()), file)
                        elif file.name != "survey.json" and file.parent.name != "earlier":  # what failed; what was held on to
                            self.assertEqual(file.read_bytes(), theirs.read_bytes(), file)

    def test_exports_merges_clicks_and_follow_leave_nothing_half(self):
        for kind in ("csv", "gpkg", "geojson", "netcdf-mask"):
            self.whole_or_absent(f"export-{kind}", "--dest", "export", self.out, "--to", kind)
        self.whole_or_absent("raw-reduced", "--dest", "export", self.out, "--to", "raw-reduced", "--survey", self.survey)
        if propagate_test.netCDF4 is not None:
            seed, _ = propagate_test.seed()
            self.whole_or_absent("propagate", "--out", "propagate", SURVEY, "--observation", "obs-0001", "--seed", seed,
                                 "--tolerance-db", "10", "--reach", "2")
        self.whole_or_absent("follow", "--out", "follow", self.survey, "--idle-exit", "1")
        self.whole_or_absent("merge", "merge", begin=lambda to: shutil.copytree(self.out, to))


if __name__ == "__main__":
    sonarx.main()
