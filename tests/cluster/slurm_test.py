# SPDX-License-Identifier: Apache-2.0
"""A survey on a real Slurm of two nodes on this machine (tools/setup.sh cluster): submitted, killed in mid-run, submitted again.
What comes out is that of one run, byte for byte."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cli"))
import local_slurm  # noqa: E402
import sonarx  # noqa: E402

WORK = pathlib.Path(os.environ["SONAR_CLUSTER_WORK"])
PINGS = 120  # of an observation: some seconds of a task, in which its node can be killed
MISSING = local_slurm.missing_programs()


@unittest.skipIf(MISSING, f"not installed (tools/setup.sh cluster): {', '.join(MISSING)}")
class Cluster(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        cls.survey = WORK / "it's a survey"
        code, out, error = sonarx.run("simulate", cls.survey, "--preset", "easy", "--seed", "4", "--observations", "4",
                                      "--pings", PINGS, "--schools", "2")
        assert code == 0, out + error
        cls.laptop = WORK / "laptop"
        code, out, error = sonarx.run("run", cls.survey, "--out", cls.laptop, "--jobs", "1")
        assert code == 0, out + error
        cls.slurm = local_slurm.LocalSlurm(WORK / "slurm", nodes=2, cpus=1)
        cls.slurm.__enter__()
        cls.addClassCleanup(cls.slurm.__exit__, None, None, None)

    def sonarx(self, *words):
        """(exit code, output) of a verb that sees this Slurm."""
        done = subprocess.run([sonarx.PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=300, check=False,
                              env={**os.environ, **self.slurm.environment()})
        return done.returncode, done.stdout + done.stderr

    def submit(self, out, *options):
        """The jobs (array, merge) of a survey that is handed in."""
        code, told = self.sonarx("submit", self.survey, "-o", out, "--cpus", "1", *options)
        self.assertEqual(code, 0, told)
        jobs = re.findall(r"(?:array|merge) job (\d+)", told)
        self.assertEqual(len(jobs), 2, told)
        return jobs

    def assert_as_the_laptops(self, out):
        for path in ("schools.csv", "school_pings.csv", "survey.gpkg", "survey.json",
                     *(f"products/obs-000{i}.nc" for i in range(1, 5))):
            self.assertTrue((out / path).read_bytes() == (self.laptop / path).read_bytes(), path)

    def log(self, out, name):
        return (out / "slurm" / "logs" / name).read_text()

    def test_a_survey_of_two_nodes_is_that_of_one_laptop(self):
        out = WORK / "all is well"
        array, merge = self.submit(out, "--partition", "all", "--time", "10")
        self.slurm.wait(merge, timeout=240)
        self.assertEqual({j.state for j in self.slurm.jobs(array)}, {"COMPLETED"})
        self.assert_as_the_laptops(out)
        code, told = self.sonarx("status", out)
        self.assertEqual((code, told), (0, "4 tasks: 4 done\n"))
        self.assertEqual(list((out / "tasks").glob("*")), [], "a task that is done has no record")
        code, told = self.sonarx("submit", self.survey, "-o", out, "--cpus", "1")
        self.assertIn("4 tasks, all done", told)

    def test_a_node_that_dies_loses_nothing(self):
        out = WORK / "killed"
        array, merge = self.submit(out)
        node = self.running_node(array)
        self.slurm.kill_node(node)
        self.slurm.wait_nodes("down.*", [node], timeout=120)
        code, told = self.sonarx("submit", self.survey, "-o", out)
        self.assertEqual(code, 2, told)
        self.assertIn("is still in Slurm's queue", told)
        try:
            self.slurm.wait(merge, timeout=240)
        finally:
            self.slurm.start_node(node)
        self.assertGreater(sum(int(j.restarts) for j in self.slurm.jobs(array)), 0, "a task was begun again")
        self.assert_as_the_laptops(out)

    def running_node(self, array):
        until = time.monotonic() + 60
        while time.monotonic() < until:
            for job in self.slurm.jobs(array):
                if job.state == "RUNNING" and job.node:
                    time.sleep(0.5)  # it is at work
                    return job.node
            time.sleep(0.05)
        self.fail("no task began")

    def test_what_failed_is_named_and_done_by_the_next_submission_alone(self):
        out = WORK / "again"
        last = sorted(self.survey.glob("*.raw"))[-1]
        code, told = self.sonarx("submit", self.survey, "-o", out, "--cpus", "1", "--dry-run")
        self.assertEqual(code, 0, told)
        self.assertIn("#SBATCH --array=0-3\n", told)
        self.assertFalse((out / "slurm").exists(), "nothing is handed in")
        away = WORK / last.name
        array, merge = self.submit(out, "--time", "10")
        last.rename(away)  # before the last task begins, as far as two nodes are quick
        self.slurm.wait(merge, timeout=240)
        away.rename(last)
        missing = [i for i in range(4) if not (out / "products" / f"obs-000{i + 1}.nc").exists()]
        self.assertIn(3, missing)
        # The task finds the file gone, or its observation not as it was planned.
        self.assertRegex(self.log(out, "merge.log"), r"(?m)^sonarx: obs-0004: .*: plan again$")
        merged = self.slurm.jobs(merge)[0]
        self.assertEqual((merged.state, merged.exit_code), ("FAILED", 3))
        code, told = self.sonarx("status", out)
        self.assertEqual(code, 3, told)
        self.assertRegex(told, rf"^4 tasks: {4 - len(missing)} done, {len(missing)} failed\n")
        self.assertIn("obs-0004 failed (task 3): ", told)
        array, merge = self.submit(out)
        script = (out / "slurm" / "sonarx-survey.sbatch").read_text()
        tasks = re.search(r"--array=(\S+)", script).group(1)
        self.assertEqual(tasks, "3" if missing == [3] else f"{missing[0]}-3")
        self.slurm.wait(merge, timeout=240)
        self.assert_as_the_laptops(out)


if __name__ == "__main__":
    sonarx.main()
