# SPDX-License-Identifier: Apache-2.0
"""Every sonarx command of README, manual and --help, executed in the order of the page, on the survey that the page tells to
make. A folder, a recipe or a picture that a page names is that of the page; those of --help have the tests' survey."""
import datetime
import os
import re
import shutil
import shlex
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
import movement_test
import sonarx
from sonarx import SURVEY, VERBS, WORK, Case

PROJECT = Path(__file__).resolve().parent.parent.parent
# Left out: what takes another program or another machine, or more schools than the tests' survey has (tests/cli/check_test.py).
# tests/cluster hands surveys in to a real Slurm.
ELSEWHERE = re.compile(r"^sonarx submit (?!.*--dry-run)|^sonarx check " + ("" if shutil.which("ffmpeg") else r"|^sonarx render movie .*\.mp4")
                       + ("" if movement_test.netCDF4 else r"|^sonarx run .*--currents"))
# What the reader brings.
BROUGHT = {"cast.csv": "depth_m,sound_speed_mps\n0,1485\n100,1478\n",
           "transects.csv": "name,stratum,type,start_utc,stop_utc\nT1,north,transect,2000-01-01T00:00:00Z,2100-01-01T00:00:00Z\n",
           "lengths.csv": "length_cm,count\n25,20\n27,50\n29,30\n"}


def commands(page):
    """(number of the line, command) of the shell blocks, comments taken off."""
    shell = False
    for number, line in enumerate((PROJECT / page).read_text().splitlines(), 1):
        if line.startswith("```"):
            shell = line == "```sh"
        elif shell and line.startswith("sonarx "):
            yield number, re.sub(r"\s+#.*$", "", line)


class Commands(Case):
    simulated = {}  # by command: the folder that it filled

    def execute(self, command, folder, place):
        """A survey that a page simulates as another did is copied: the same command gives the same bytes
        (tests/cli/small_survey_test.py)."""
        words = shlex.split(command)
        if words[1] == "simulate" and command in self.simulated:
            shutil.copytree(self.simulated[command], folder / words[2])
            return
        self.run_in(folder, command, place)
        if words[1] == "simulate":
            self.simulated[command] = folder / words[2]

    def run_in(self, folder, command, place):
        environment = {**os.environ, "XDG_CACHE_HOME": str(WORK / "cache"),
                       "PATH": f"{Path(sonarx.PROGRAM).parent}:{os.environ['PATH']}"}
        environment.pop("DISPLAY", None)
        ran = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True,
                             timeout=600, check=False)
        self.assertEqual(ran.returncode, 0, f"{place}: {command}\n{ran.stdout[-1000:]}\n{ran.stderr[-2000:]}")
        for option, made in zip(shlex.split(command), shlex.split(command)[1:]):
            if option in ("--out", "-o", "--dest"):
                self.assertTrue((folder / made).exists() or "--dry-run" in command, f"{place}: no {made}")

    def executed(self, page):
        folder = self.fresh(f"commands-{Path(page).stem}")
        for name, text in BROUGHT.items():
            (folder / name).write_text(text)
        if movement_test.netCDF4:
            noon = datetime.datetime(2020, 1, 1, 12, tzinfo=datetime.timezone.utc)
            movement_test.write_adcp(folder / "adcp.nc", noon, noon + datetime.timedelta(hours=1))
        done = 0
        for number, command in commands(page):
            if not ELSEWHERE.match(command):
                self.execute(command, folder, f"{page}:{number}")
                done += 1
        return done

    def test_readme(self):
        self.assertGreater(self.executed("README.md"), 10)

    def test_user_guide(self):
        self.assertGreater(self.executed("docs/user-guide.md"), 20)

    def test_cluster(self):
        self.assertGreater(self.executed("docs/cluster.md"), 3)

    def test_help(self):
        folder = self.fresh("commands-help")
        (folder / "SURVEY").symlink_to(SURVEY)
        shutil.copy(SURVEY / "truth" / "depth.tif", folder)
        (folder / "lengths.csv").write_text(BROUGHT["lengths.csv"])
        shutil.copytree(WORK / "out", folder / "OTHER")
        # Whatever the survey, the example is the same with fewer pings; one that follows ends when all is over.
        shorter = {"simulate": " --pings 2", "follow": " --idle-exit 1"}
        simulated = 0
        for verb in sorted(VERBS, key=lambda verb: verb != "recipe"):  # the first makes R.json
            examples = re.findall(r"^  (sonarx .*?)(?:   .*)?$", self.sonarx("help", verb), re.MULTILINE)
            self.assertTrue(examples, f"{verb} --help has no example")
            for command in examples:
                if ELSEWHERE.match(command):
                    continue
                if verb == "simulate":
                    simulated += 1
                    command = command.replace("SYNTHETIC", f"SYNTHETIC-{simulated}")
                # The truth of the survey that was run.
                command = command.replace("SYNTHETIC/truth", "SURVEY/truth")
                self.execute(command if "--pings" in command else command + shorter.get(verb, ""), folder, f"{verb} --help")


if __name__ == "__main__":
    sonarx.main()
