#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each folder of fixtures/ breaks the one rule that it is named after, in every file but its innocent ones; `sound`
breaks none."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
CHECK = HERE.parent.parent / "tools" / "check_layers"
FIXTURES = HERE / "fixtures"
# Files that must be there for the guilty ones to be judged.
INNOCENT = {"room-table/src/geo/sector.h", "include-path/src/base/hash.h", "own-header-first/src/base/hash.h",
            "indirect/src/school/grow.h", "indirect/src/pipeline/recipe.h", "indirect/src/session/open_survey.h",
            "format/src/io/simrad/indexer.h", "independent/src/synth/field.h", "independent/src/signal/median.h"}


def check(root):
    run = subprocess.run([sys.executable, CHECK, root], capture_output=True, text=True, check=False)
    findings = [line.split(": ", 2) for line in run.stdout.splitlines()]
    return run, {(place.split(":")[0], rule) for place, rule, _ in findings}


class CheckLayers(unittest.TestCase):
    def test_every_fixture_breaks_its_rule_and_no_other(self):
        folders = sorted(f for f in FIXTURES.iterdir() if f.name != "sound")
        self.assertGreater(len(folders), 9)
        for folder in folders:
            with self.subTest(folder.name):
                guilty = {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}
                guilty -= {p.removeprefix(folder.name + "/") for p in INNOCENT}
                run, findings = check(folder)
                self.assertEqual(findings, {(path, folder.name) for path in guilty})
                self.assertEqual(run.returncode, 1)

    def test_sound_tree_passes(self):
        run, findings = check(FIXTURES / "sound")
        self.assertEqual((run.returncode, findings, run.stderr), (0, set(), ""))

    def test_long_files_are_noted_then_refused(self):
        head = "// SPDX-License-Identifier: Apache-2.0\n#pragma once\n"
        for lines, code, rules in [(400, 0, set()), (800, 0, set()), (801, 1, {("src/base/long.h", "length")})]:
            with self.subTest(lines=lines), tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "src" / "base" / "long.h"
                file.parent.mkdir(parents=True)
                file.write_text(head + "\n" * (lines - 2))
                run, findings = check(folder)
                self.assertEqual((run.returncode, findings), (code, rules))
                self.assertEqual("note: 800 lines" in run.stderr, lines == 800)

    def test_every_rule_of_the_program_has_a_fixture(self):
        import re
        rules = set(re.findall(r'report\.add\([^"]*?"([a-z-]+)"', CHECK.read_text()))
        self.assertEqual(rules - {"length"}, {f.name for f in FIXTURES.iterdir()} - {"sound"})

    def test_wrong_usage(self):
        with tempfile.TemporaryDirectory() as empty:
            self.assertEqual(check(empty)[0].returncode, 2)


if __name__ == "__main__":
    unittest.main()
