# SPDX-License-Identifier: Apache-2.0
"""The desktop program where there is no display: one line, and no abort."""
import os
import subprocess
import sys
import unittest

PROGRAM = sys.argv.pop(1)


class NoDisplay(unittest.TestCase):
    def test_it_ends_with_one_line(self):
        bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
        for more in ({}, {"DISPLAY": ":987"}):
            done = subprocess.run([PROGRAM], env={**bare, **more}, capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn("no display", done.stderr)
            self.assertIn(f"'{more.get('DISPLAY', '')}'", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
