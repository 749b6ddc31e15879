# SPDX-License-Identifier: Apache-2.0
"""The same bytes whatever the user's language and clock: a decimal comma, a time zone at the edge of the day, threads, and what
the C library makes of the processor. Widths of vectors: `Observe.EveryVectorWidthGivesTheSameProduct`."""
import os
import shutil
import subprocess
from pathlib import Path

import sonarx
from sonarx import OUT, PROGRAM, SURVEY, WORK, Case

COMMA, ZONE = "de_DE.UTF-8", "Pacific/Kiritimati"
# The C library has variants of its functions for each kind of processor, and can be told not to use some.
PLAIN_PROCESSOR = "glibc.cpu.hwcaps=-AVX512F,-AVX2,-AVX,-FMA,-FMA4"


def call(*arguments, **environment):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, stdin=subprocess.DEVNULL, check=False,
                          env={**os.environ, "XDG_CACHE_HOME": str(WORK / "cache"), **environment})
    return done.returncode, done.stdout, done.stderr


class Equal(Case):
    def locale_with_commas(self):
        """A folder that holds it, made from the system's sources; empty where there are none."""
        if not Path("/usr/share/i18n/locales/de_DE").exists():
            return {}
        folder = self.fresh("locales")
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", str(folder / COMMA)], check=False, capture_output=True)
        told = subprocess.run(["locale", "decimal_point"], capture_output=True, text=True, check=True,
                              env={**os.environ, "LOCPATH": str(folder), "LC_ALL": COMMA})
        self.assertEqual(told.stdout.strip(), ",")
        return {"LOCPATH": str(folder), "LC_ALL": COMMA}

    def expect_same_run(self, name, *options, **environment):
        folder = self.fresh(name)
        out = folder / "out"
        code, _, err = call("run", SURVEY, "--out", out, *options, **environment)
        self.assertEqual(code, 0, err)
        for file in ("products/obs-0001.nc", "products/obs-0002.nc", "schools.csv", "school_pings.csv", "survey.gpkg"):
            self.assertEqual((out / file).read_bytes(), (OUT / file).read_bytes(), file)
        shutil.rmtree(folder)

    def test_products_do_not_depend_on_the_processor(self):
        self.expect_same_run("equal-bits", GLIBC_TUNABLES=PLAIN_PROCESSOR)

    def test_products_do_not_depend_on_language_zone_and_threads(self):
        comma = self.locale_with_commas()
        if not comma:
            self.skipTest("the system has no sources of languages")
        self.expect_same_run("equal-language", "--jobs", 3, TZ=ZONE, **comma)

    def test_neither_does_what_is_told_exported_and_read(self):
        comma = self.locale_with_commas()
        if not comma:
            self.skipTest("the system has no sources of languages")
        folder = self.fresh("equal-told")
        (folder / "speed.csv").write_text("depth_m,sound_speed_mps\n0,1490.5\n300,1481.25\n")
        for i, environment in enumerate(({}, {"TZ": ZONE, **comma})):
            to = folder / str(i)
            to.mkdir()
            for name, arguments in {
                    "info": ("info", SURVEY, "--json"), "recipe": ("recipe", "--describe"),
                    "taken": ("recipe", "--sound-speed", folder / "speed.csv"),
                    "score": ("score", OUT, "--truth", sonarx.TRUTH, "--json"),
                    "geojson": ("export", OUT, "--to", "geojson", "--dest", to / "geojson"),
                    "csv": ("export", OUT, "--to", "csv", "--dest", to / "csv"),
                    "map": ("render", "observation-map", OUT, "--out", to / "map.svg"),
                    "slice": ("render", "slice-top", SURVEY, "--out", to / "slice.png"),
                    "simulate": ("simulate", to / "survey", "--pings", "2", "--observations", "1", "--speed-knots", "8.5")}.items():
                code, text, err = call(*arguments, **environment)
                self.assertEqual(code, 0, (name, err))
                (to / f"{name}.txt").write_bytes(text.replace(str(to).encode(), b"TO"))
        self.assertEqual(sonarx.contents(folder / "1"), sonarx.contents(folder / "0"))


if __name__ == "__main__":
    sonarx.main()
