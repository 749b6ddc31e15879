# SPDX-License-Identifier: Apache-2.0
"""Rendering for the tests: the small survey, and the verb with an environment of its own."""
import os

import sonarx

DEPTHS = sonarx.TRUTH / "depth.tif"
BOTH = [sonarx.SURVEY, sonarx.OUT]
SIZE = ["--size", "640x480"]


def render(*arguments, environment=None):
    before = dict(os.environ)
    os.environ.update(environment or {})
    try:
        return sonarx.run("render", *arguments)
    finally:
        os.environ.clear()
        os.environ.update(before)
