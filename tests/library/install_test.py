# SPDX-License-Identifier: Apache-2.0
"""The library as somebody else uses it: installed, found by CMake, its example built outside the tree and run; and the pages
that are installed with the command line."""
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

for folder in ("cli", "docs"):
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent / folder))
import sonarx
from links import broken
from sonarx import OUT, SURVEY, WORK, Case

BUILD = Path(sys.argv.pop(1))
PROJECT = Path(__file__).resolve().parent.parent.parent
PREFIX = WORK / "installed"
EXAMPLE = WORK / "example"


def done(*words):
    environment = {**os.environ, "XDG_CACHE_HOME": str(WORK / "cache")}
    ran = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=600, check=False, env=environment)
    return ran.returncode, ran.stdout, ran.stderr


class Installed(Case):
    @classmethod
    def setUpClass(cls):
        for folder in (PREFIX, EXAMPLE):
            shutil.rmtree(folder, ignore_errors=True)
        # What lies in the project must not help: the example is copied away from it.
        shutil.copytree(PROJECT / "examples" / "cpp", EXAMPLE / "source")
        for words in (*(("cmake", "--install", BUILD, "--prefix", PREFIX, "--component", component)
                        for component in ("runtime", "library", "cli")),
                      ("cmake", "-S", EXAMPLE / "source", "-B", EXAMPLE / "build", f"-DCMAKE_PREFIX_PATH={PREFIX}",
                       "-DCMAKE_CXX_FLAGS=-std=c++20 -Wall -Wextra -Wpedantic -Werror"),
                      ("cmake", "--build", EXAMPLE / "build")):
            code, out, err = done(*words)
            assert code == 0, out + err

    def example(self, *words):
        return done(EXAMPLE / "build" / "schools", *words)

    def test_the_example_finds_what_the_command_line_finds(self):
        products = self.fresh("example-products")
        code, out, err = self.example(SURVEY, products)
        self.assertEqual((code, err), (0, ""))
        found = [line.split(",") for line in out.splitlines() if "," in line and line.startswith("obs-") and ":" not in line]
        expected = [[row["observation"], row["school_id"], row["n_pings"], f"{float(row['sv_mean_db']):.2f}"]
                    for row in sonarx.read_csv(OUT / "schools.csv")]
        self.assertEqual([[o, f"{float(i):.0f}", f"{float(n):.0f}", sv] for o, i, n, sv in found], expected)
        self.assertEqual(sorted(p.name for p in products.iterdir()), ["obs-0001.nc", "obs-0002.nc"])

    def test_a_wrong_value_is_one_line(self):
        code, out, err = self.example(SURVEY, self.fresh("example-wrong"), "detect.tolerance_db=-3")
        self.assertEqual((code, out), (1, ""))
        self.assertEqual(len(err.splitlines()), 1, err)
        self.assertIn("detect.tolerance_db", err)

    def test_headers_include_nothing_of_others(self):
        headers = sorted((PREFIX / "include" / "sonar_explorer").glob("*.h"))
        self.assertGreaterEqual(len(headers), 6)
        for header in headers:
            for included in re.findall(r'#include ([<"][^>"]+)', header.read_text()):
                self.assertTrue(included.startswith('"sonar_explorer/') or re.fullmatch(r"<[a-z]+", included),
                                f"{header.name}: {included}")

    def test_only_the_facade_is_exported(self):
        library = next(PREFIX.rglob("libsonar_explorer.so"))
        code, out, err = done("nm", "-D", "-C", "--defined-only", library)
        self.assertEqual(code, 0, err)
        names = [line.split(" ", 2)[2] for line in out.splitlines()]
        self.assertGreater(len(names), 30)
        foreign = [n for n in names if not re.match(r"((typeinfo|vtable|typeinfo name) for )?sonar_explorer(::|_)", n)
                   and not n.startswith("SONAR_EXPLORER")]
        self.assertEqual(foreign, [])

    def test_links_of_the_pages_lead_to_what_is_installed(self):
        manual = next(PREFIX.rglob("user-guide.md"))
        self.assertTrue((manual.parent / "README.md").is_file())
        self.assertEqual(broken(sorted(manual.parent.glob("*.md"))), [])

    def test_versions_are_the_projects(self):
        version = re.search(r"VERSION (\d+)\.(\d+)\.(\d+)", (PROJECT / "CMakeLists.txt").read_text().split("project(")[1])
        header = (PREFIX / "include" / "sonar_explorer" / "version.h").read_text()
        told = [re.search(rf"VERSION_{part} (\d+)", header).group(1) for part in ("MAJOR", "MINOR", "PATCH")]
        self.assertEqual(told, list(version.groups()))
        code, out, err = done("cmake", "--find-package", "-DNAME=SonarExplorer", "-DCOMPILER_ID=GNU", "-DLANGUAGE=CXX",
                              "-DMODE=EXIST", f"-DCMAKE_PREFIX_PATH={PREFIX}")
        self.assertEqual(code, 0, out + err)


if __name__ == "__main__":
    sonarx.main()
