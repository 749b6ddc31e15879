# SPDX-License-Identifier: Apache-2.0
"""Where OpenGL without a window is looked for: graphics cards first, each by itself, then Mesa's platform."""
import os
import unittest

import sonarx
from rendering import BOTH, SIZE, render

SHIM = os.environ.get("SONAR_EGL_SHIM")


@unittest.skipUnless(SHIM, "no stand-in for EGL beside a sanitizer")
class Displays(sonarx.Case):
    def asked_for(self, **environment):
        """The displays that were asked for, one after the other, and how the program ended."""
        log = self.fresh("displays") / "log"
        log.touch()
        ended = render("volume", *BOTH, *SIZE, "--frames", "0", "--renderer", "gl", "--out", log.with_name("x.png"),
                       environment={"LD_LIBRARY_PATH": os.pathsep.join(filter(None, [SHIM, os.environ.get("LD_LIBRARY_PATH")])),
                                    "SONAR_EGL_LOG": str(log), **environment})
        if "OpenGL is not installed" in ended[2]:
            self.skipTest(ended[2].strip())
        return log.read_text().splitlines(), ended

    def test_cards_come_before_mesa_and_none_draws_by_software(self):
        displays, (code, _, error) = self.asked_for()
        self.assertEqual(displays, ["device 0", "device 2", "surfaceless"])
        self.assertNotEqual(code, 0)
        self.assertIn("is a driver installed?", error)

    def test_an_older_egl_has_mesas_alone(self):
        self.assertEqual(self.asked_for(SONAR_EGL_OLD="1")[0], ["surfaceless"])


if __name__ == "__main__":
    sonarx.main()
