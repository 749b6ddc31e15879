# SPDX-License-Identifier: Apache-2.0
"""docs/python.md and docs/r.md, executed block by block as a reader would: on the survey that the page has made."""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
import sonarx
from sonarx import WORK, Case

MODULE = Path(sys.argv.pop(1))
DOCS = Path(__file__).resolve().parent.parent.parent / "docs"
ENVIRONMENT = {**os.environ, "PATH": f"{Path(sonarx.PROGRAM).parent}:{os.environ['PATH']}", "PYTHONPATH": str(MODULE),
               "XDG_CACHE_HOME": str(WORK / "cache"), "MPLBACKEND": "Agg"}


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```", (DOCS / page).read_text(), re.DOTALL | re.MULTILINE)


def has_r():
    if not shutil.which("Rscript"):
        return False
    wanted = "q(status = !all(c('ncdf4', 'sf', 'ggplot2') %in% rownames(installed.packages())))"
    return subprocess.run(["Rscript", "-e", wanted], check=False, capture_output=True).returncode == 0


class Pages(Case):
    def run_page(self, page, language, program, script):
        folder = self.fresh(f"page-{language}")
        shell = blocks(page, "sh")
        self.assertTrue(shell)
        for text in shell:
            self.done(folder, "bash", "-euc", text)
        code = blocks(page, language)
        self.assertGreater(len(code), 4)
        (folder / script).write_text("\n".join(code))
        return folder, self.done(folder, program, script)

    def done(self, folder, *words):
        ran = subprocess.run(words, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=600, check=False)
        self.assertEqual(ran.returncode, 0, f"{words}\n{ran.stdout[-2000:]}\n{ran.stderr[-2000:]}")
        return ran.stdout

    def figure(self, file):
        """Made, of the size asked for, and not blank."""
        data = file.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertGreater(len(data), 10000)

    @unittest.skipUnless(importlib.util.find_spec("xarray") and importlib.util.find_spec("matplotlib"),
                         "python3-xarray and python3-matplotlib are not installed")
    def test_python(self):
        folder, told = self.run_page("python.md", "python", sys.executable, "page.py")
        rows = sonarx.read_csv(folder / "out" / "schools.csv")
        for row in rows:
            self.assertIn(f"school {row['school_id']}: {row['n_pings']} pings, mean Sv {float(row['sv_mean_db']):.1f} dB", told)
        self.assertIn("not_found - not-there", told)
        self.assertLess(float(re.search(r"largest difference: (\S+) dB", told).group(1)), 1e-6)
        self.figure(folder / "schools.png")

    @unittest.skipUnless(has_r(), "R with ncdf4, sf and ggplot2 is not installed")
    def test_r(self):
        folder, told = self.run_page("r.md", "r", "Rscript", "page.R")
        self.assertIn("nautical_mile", told)
        first = min(r["first_time_utc"] for r in sonarx.read_csv(folder / "out" / "schools.csv"))
        self.assertIn(first[:10], told)
        self.figure(folder / "schools-map.png")


if __name__ == "__main__":
    sonarx.main()
