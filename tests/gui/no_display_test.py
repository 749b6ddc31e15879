# SPDX-License-Identifier: Apache-2.0
"""The desktop program where there is no display: one line and no abort; help, version and wrong usage need none."""
import json
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1)
PROJECT = Path(__file__).resolve().parent.parent.parent
BARE = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}


def run(*arguments, **more):
    """(exit code, standard output, standard error)"""
    done = subprocess.run([PROGRAM, *arguments], env={**BARE, **more}, capture_output=True, text=True, timeout=60, check=False)
    return done.returncode, done.stdout, done.stderr


class NoDisplay(unittest.TestCase):
    def test_it_ends_with_one_line(self):
        for more in ({}, {"DISPLAY": ":987"}):
            code, out, err = run(**more)
            self.assertEqual((code, out), (1, ""), err)
            self.assertEqual(len(err.splitlines()), 1, err)
            self.assertIn("no display", err)
            self.assertIn(f"'{more.get('DISPLAY', '')}'", err)

    def test_options_are_read_before_a_display_is_asked_for(self):
        see = "; see sonar-explorer --help\n"
        for word, said in (("--colour", "there is no option --colour"), ("-x", "there is no option -x"),
                           ("-v", "there is no option -v"), ("--recipe", "Missing value after '--recipe'")):
            self.assertEqual(run(word), (2, "", f"sonar-explorer: {said}{see}"))
        for words in (("-style", "fusion"), ("-platform=xcb",), ("--dark", "a survey")):
            self.assertIn("no display", run(*words)[2], "Qt's own, or ours")

    def test_words_for_translators_need_no_display(self):
        code, out, err = run("--words")
        self.assertEqual((code, err), (0, ""))
        words = json.loads(out)
        self.assertEqual(len(words), len(set(words)))
        self.assertIn("&File", words)

    def test_help_and_version(self):
        code, out, err = run("--help")
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(run("-h")[1], out)
        self.assertIn("\nExamples:\n  sonar-explorer --demo ", out)
        manual = re.search(r"(?m)^Manual: (.*)$", out).group(1)
        self.assertTrue((PROJECT / manual).is_file(), manual)
        self.assertRegex(out, r"-V, --version ")
        self.assertNotIn("platform", out, "what Qt takes is told by Qt")
        self.assertEqual(run("-V"), run("--version"))
        self.assertRegex(run("-V")[1], r"^sonar-explorer \d+\.\d+\.\d+\n$")


if __name__ == "__main__":
    unittest.main(verbosity=2)
