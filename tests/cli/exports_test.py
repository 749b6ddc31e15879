# SPDX-License-Identifier: Apache-2.0
"""Exports are readable by others, and reduced raw files give the same schools."""
import json
import sqlite3

import sonarx
from sonarx import OUT, SURVEY, Case

try:
    import netCDF4
except ImportError:
    netCDF4 = None

KEYS = ("observation", "school_id", "time_utc", "n_voxels", "volume_m3")


def total(folder, pattern):
    return sum(p.stat().st_size for p in folder.rglob(pattern))


class Exports(Case):
    def export(self, kind, *more):
        dest = self.fresh(f"export-{kind}")
        self.sonarx("export", OUT, "--to", kind, "--dest", dest, *more)
        self.assertTrue([p for p in dest.rglob("*") if p.is_file()])
        return dest

    def test_csv(self):
        dest = self.export("csv")
        for name in ("schools.csv", "school_pings.csv"):
            self.assertEqual((dest / name).read_bytes(), (OUT / name).read_bytes())

    def test_geojson(self):
        dest = self.export("geojson")
        features = 0
        for file in sorted(dest.rglob("*.geojson")):
            collection = json.loads(file.read_text())
            self.assertEqual(collection["type"], "FeatureCollection")
            features += len(collection["features"])
        self.assertGreater(features, len(sonarx.read_csv(OUT / "school_pings.csv")))

    def test_gpkg(self):
        for file in self.export("gpkg").rglob("*.gpkg"):
            with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as table:
                count = table.execute("SELECT COUNT(*) FROM schools").fetchone()[0]
                self.assertEqual(count, len(sonarx.read_csv(OUT / "schools.csv")))

    def test_netcdf_mask(self):
        dest = self.export("netcdf-mask")
        if netCDF4 is None:
            self.skipTest("python3-netcdf4 is not installed")
        voxels = 0
        for file in dest.rglob("*.nc"):
            with netCDF4.Dataset(file) as mask:
                voxels += sum(int((v[:] > 0).sum()) for k, v in mask.variables.items() if "confidence" in k)
        self.assertEqual(voxels, sum(int(row["n_voxels"]) for row in sonarx.read_csv(OUT / "school_pings.csv")))

    def test_reduced_raw_gives_the_same_masks(self):
        dest = self.export("raw-reduced", "--survey", SURVEY)
        # The schools fill about a hundredth of the sector.
        self.assertLess(total(dest, "*.raw"), total(SURVEY, "*.raw") / 4)
        info = json.loads(self.sonarx("info", dest, "--json"))
        self.assertTrue(info["observations"])
        again = self.fresh("export-raw-reduced-out")
        self.sonarx("run", dest, "--out", again)
        # Observations without schools may be gone, so that display names may shift; nothing else may.
        names = {"observation", "school_id", "ping_index"}
        self.assertTrue(any(r["bottom_depth_m"] for r in sonarx.read_csv(OUT / "school_pings.csv")))
        rows = lambda folder: sorted([[r[k] for k in r if k not in names]
                                      for r in sonarx.read_csv(folder / "school_pings.csv")])
        self.assertEqual(rows(again), rows(OUT))

    def test_reduced_raw_with_the_rest_coarsened(self):
        """One beam in five stays of the rest, and the schools' own samples: far less than all of it, and the same masks."""
        dest = self.export("raw-reduced", "--survey", SURVEY, "--coarsen", "5")
        self.assertLess(total(dest, "*.raw"), total(SURVEY, "*.raw") / 2)
        again = self.fresh("export-raw-coarse-out")
        self.sonarx("run", dest, "--out", again)
        masks = lambda folder: sorted([[r[k] for k in KEYS[2:]] for r in sonarx.read_csv(folder / "school_pings.csv")])
        self.assertEqual(masks(again), masks(OUT))

    def test_reduced_raw_of_loud_water_and_reduced_once_more(self):
        """In water louder than -68 dB its level is background, which only the whole ping tells."""
        params = self.fresh("loud-params") / "params.json"
        params.write_text(json.dumps({"water": {"reverberation_sv_db": -62.0}, "schools": 2, "pings": 24,
                                      "observations": 1, "sv_min_db": -45.0}))
        survey, out = self.fresh("loud-survey"), self.fresh("loud-out")
        self.sonarx("simulate", survey, "--params", params, "--seed", "5")
        self.sonarx("run", survey, "--out", out)
        masks = lambda folder: [[r[k] for k in r if k != "ping_index"] for r in sonarx.read_csv(folder / "school_pings.csv")]
        self.assertGreater(len(masks(out)), 10)
        for step in ("once", "twice"):
            dest, again = self.fresh(f"loud-{step}"), self.fresh(f"loud-{step}-out")
            self.sonarx("export", out, "--to", "raw-reduced", "--survey", survey, "--dest", dest)
            self.sonarx("run", dest, "--out", again)
            self.assertEqual(masks(again), masks(out), step)
            survey, out = dest, again

    def test_reduced_raw_needs_the_survey(self):
        code, _, err = sonarx.run("export", OUT, "--to", "raw-reduced", "--dest", self.fresh("export-none"))
        self.assertEqual(code, 2, err)


if __name__ == "__main__":
    sonarx.main()
