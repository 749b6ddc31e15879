# SPDX-License-Identifier: Apache-2.0
"""Handing in to Slurm, as far as no Slurm is needed: a script in sbatch's place answers (tests/cluster has a real one)."""
import os
import subprocess

import sonarx
from sonarx import SURVEY, WORK, Case

# sbatch(1), --time: "Acceptable time formats include ..."; slurm.conf(5): INFINITE and UNLIMITED.
TIMES = ["10", "10:30", "1:10:30", "2-3", "2-3:10", "2-3:10:30", "UNLIMITED", "INFINITE", "unlimited"]
NO_TIMES = ["foo", "1h", "10:", ":10", "1:2:3:4", "2-", "-3", "2-3:4:5:6", "1-2-3", "1.5", "10 ", "1,2", "", "UNLIMITED1"]


class Submit(Case):
    def test_times_are_slurms(self):
        out = self.fresh("submit-times")
        for time in TIMES:
            with self.subTest(time):
                told = self.sonarx("submit", SURVEY, "-o", out, "--time", time, "--dry-run")
                self.assertIn(f"#SBATCH --time={time}\n", told)

    def test_other_times_are_refused_before_anything_is_written(self):
        out = self.fresh("submit-no-times") / "out"
        for time in NO_TIMES:
            with self.subTest(time):
                self.one_line_error("submit", SURVEY, "-o", out, f"--time={time}", "--dry-run", code=2, names="--time: expected M, M:S")
        self.assertFalse(out.exists())

    def test_what_sbatch_says_is_one_line(self):
        folder = self.fresh("submit-sbatch")
        for program, script in (("sbatch", "echo 'sbatch: error: Unknown host' >&2; echo 'sbatch: error: No partition' >&2; exit 1"),
                                ("scontrol", "exit 1"), ("squeue", "exit 1")):
            file = folder / "bin" / program
            file.parent.mkdir(exist_ok=True)
            file.write_text(f"#!/bin/sh\n{script}\n")
            file.chmod(0o755)
        done = subprocess.run([sonarx.PROGRAM, "submit", SURVEY, "-o", folder / "out"], capture_output=True, text=True, timeout=60,
                              check=False, env={**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}",
                                                "XDG_CACHE_HOME": str(WORK / "cache")})
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertTrue(done.stderr.endswith("sbatch refused: sbatch: error: Unknown host; sbatch: error: No partition\n"), done.stderr)


if __name__ == "__main__":
    sonarx.main()
