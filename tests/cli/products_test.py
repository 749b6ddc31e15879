# SPDX-License-Identifier: Apache-2.0
"""What `run` writes, held against docs/interfaces.md with readers of other people: netCDF4-python, sqlite3, csv."""
import json
import re
import sqlite3
import unittest

import sonarx
from sonarx import OUT, SCHOOL_PINGS, SCHOOLS, Case

try:
    import netCDF4
    import numpy
except ImportError:
    netCDF4 = None

TIME = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z")
LAYERS = {"vessel_track": "LINESTRING", "observations": "POLYGON", "swept": None, "observation_starts": "POINT",
          "schools": "MULTIPOLYGON", "school_outlines": None, "school_centres": "POINT"}


class Tables(Case):
    def test_columns(self):
        self.assertEqual(sonarx.header(OUT / "schools.csv"), SCHOOLS)
        self.assertEqual(sonarx.header(OUT / "school_pings.csv"), SCHOOL_PINGS)

    def test_values_are_written_as_promised(self):
        rows = sonarx.read_csv(OUT / "school_pings.csv")
        self.assertGreater(len(rows), 0)
        for row in rows:
            self.assertRegex(row["time_utc"], TIME)
            for name in ("latitude", "longitude"):
                self.assertRegex(row[name], r"^-?\d+\.\d{8}$")
            for name, text in row.items():
                if name not in ("observation", "time_utc", "latitude", "longitude") and text:
                    # The shortest form that reads back equal.
                    self.assertLessEqual(len(text.lstrip("-")), 24, name)
                    self.assertEqual(float(text), float(repr(float(text))), name)
                    self.assertNotIn("nan", text.lower())
            self.assertGreaterEqual(float(row["length_m"]), float(row["width_m"]))
            self.assertAlmostEqual(float(row["height_m"]), float(row["depth_max_m"]) - float(row["depth_min_m"]), 6)
            self.assertEqual(int(row["touches_edge"]), int((int(row["edge_flags"]) & 255) != 0))
            self.assertEqual(row["provisional"], "0")
            self.assertTrue(0 <= float(row["axis_deg"]) <= 180)
            for share in ("valid_fraction", "edge_fraction"):
                self.assertTrue(0 <= float(row[share]) <= 1, f"{share} = {row[share]}")

    def test_tracks_and_their_pings_agree(self):
        pings = sonarx.read_csv(OUT / "school_pings.csv")
        for school in sonarx.read_csv(OUT / "schools.csv"):
            own = [p for p in pings if (p["observation"], p["school_id"]) == (school["observation"], school["school_id"])]
            self.assertEqual(len(own), int(school["n_pings"]))
            self.assertEqual(school["first_time_utc"], min(p["time_utc"] for p in own))
            self.assertEqual(school["last_time_utc"], max(p["time_utc"] for p in own))
            self.assertIn(school["origin"], ("manual", "automatic"))
            self.assertIn(school["status"], ("unreviewed", "accepted", "corrected", "rejected"))
            whole = sum(p["touches_edge"] == "0" for p in own)
            self.assertEqual(whole, int(school["n_pings_whole"]))
            self.assertAlmostEqual(float(school["touches_edge_fraction"]), 1 - whole / len(own), 9)

    def test_summary_and_plan_are_json(self):
        self.assertIsInstance(json.loads((OUT / "survey.json").read_text()), dict)
        self.assertIn("plan_version", json.loads((OUT / "plan.json").read_text()))

    def test_nothing_temporary_is_left(self):
        names = {p.relative_to(OUT).as_posix() for p in OUT.rglob("*") if p.is_file()}
        self.assertLessEqual({"plan.json", "schools.csv", "school_pings.csv", "survey.gpkg", "survey.json",
                              "products/obs-0001.nc", "products/obs-0002.nc"}, names)
        self.assertEqual([n for n in names if n.endswith(("~", ".tmp", ".part", "-wal", "-shm", "-journal"))], [])


class Map(Case):
    def setUp(self):
        self.map = sqlite3.connect(f"file:{OUT / 'survey.gpkg'}?mode=ro", uri=True)
        self.addCleanup(self.map.close)

    def rows(self, query):
        return self.map.execute(query).fetchall()

    def test_layers(self):
        types = dict(self.rows("SELECT table_name, geometry_type_name FROM gpkg_geometry_columns"))
        for layer, kind in LAYERS.items():
            self.assertIn(layer, types)
            if kind:
                self.assertEqual(types[layer].upper(), kind)
        self.assertEqual({r[0] for r in self.rows("SELECT srs_id FROM gpkg_geometry_columns")}, {4326})

    def test_schools_have_the_columns_of_the_table(self):
        for layer, columns in (("schools", SCHOOLS), ("school_centres", SCHOOL_PINGS)):
            names = [r[1] for r in self.rows(f"PRAGMA table_info({layer})")]
            self.assertLessEqual(set(columns), set(names))

    def test_as_many_rows_as_the_tables(self):
        self.assertEqual(self.rows("SELECT COUNT(*) FROM schools")[0][0], len(sonarx.read_csv(OUT / "schools.csv")))
        for layer in ("school_centres", "school_outlines"):
            self.assertEqual(self.rows(f"SELECT COUNT(*) FROM {layer}")[0][0],
                             len(sonarx.read_csv(OUT / "school_pings.csv")))
        for layer in ("vessel_track", "observations", "observation_starts"):
            self.assertEqual(self.rows(f"SELECT COUNT(*) FROM {layer}")[0][0], 2)


@unittest.skipIf(netCDF4 is None, "python3-netcdf4 is not installed")
class Product(Case):
    def setUp(self):
        self.product = netCDF4.Dataset(OUT / "products" / "obs-0001.nc")
        self.addCleanup(self.product.close)

    def test_attributes(self):
        for name in ("Conventions", "title", "source", "history", "product_version", "sonar_explorer_version", "recipe",
                     "recipe_hash", "input_files", "observation"):
            self.assertIn(name, self.product.ncattrs())
        json.loads(self.product.recipe)
        self.assertEqual(self.product.observation, "obs-0001")
        self.assertIn("SYNTHETIC", self.product.title)

    def test_every_refused_echo_is_told(self):
        """`run --why` tells a line for each echo of /rejected; each row missed its limit by the figure that it tells.

        No school is 15 fans high: what are schools else is refused."""
        folder = self.fresh("why")
        recipe = folder / "tall.json"
        recipe.write_text('{"recipe_version": 1, "detect": {"min_fans": 15}}', encoding="utf-8")
        out = folder / "out"
        code, told, error = sonarx.run("run", sonarx.SURVEY, "--out", out, "--recipe", recipe, "--why")
        self.assertEqual(code, 0, error)
        self.assertEqual(sonarx.read_csv(out / "schools.csv"), [])
        lines = [line for line in told.splitlines() if ": no school: " in line]
        for name in ("obs-0001", "obs-0002"):
            with netCDF4.Dataset(out / "products" / f"{name}.nc") as product:
                rejected = product["rejected"]
                ids = set(rejected["echo_id"][:].tolist())
                self.assertGreater(len(ids), 0)
                self.assertEqual(ids, set(range(1, len(ids) + 1)))
                self.assertEqual(sum(line.startswith(name) for line in lines), len(ids))
                self.assertTrue(all(re.search(r" dB: no school: .* at least \(judge \w+\)$", line) for line in lines))
                for judge, figure, limit in zip(rejected["judge"][:], rejected["figure"][:], rejected["limit"][:]):
                    self.assertIn(judge, ("size", "prominence"))
                    self.assertLess(figure, limit, judge)

    def test_variables(self):
        wanted = {
            "pings": ["time", "time_ns", "latitude", "longitude", "heading", "speed", "course", "distance", "pitch", "roll", "heave",
                      "transducer_depth", "gps_minus_clock", "bad"],
            "grid": ["elevation", "azimuth", "mounting_azimuth", "frequency", "channel", "sample_count",
                     "sample_spacing", "range_of_first_sample", "sound_speed"],
            "schools": SCHOOLS, "school_pings": SCHOOL_PINGS,
            "mask": ["school_id", "ping_index", "channel", "first_sample", "sample_count", "confidence"],
            "diagnostics": ["code", "file", "offset", "ping_index", "text"]}
        for group, names in wanted.items():
            self.assertLessEqual(set(names), set(self.product[group].variables), group)
        grid = self.product["grid"]
        self.assertEqual(grid["channel"].dimensions, ("fan", "beam"))
        self.assertEqual(grid["channel"].shape, (20, 25))
        self.assertTrue(numpy.allclose(grid["azimuth"][:], 240 + 2.5 * numpy.arange(25), atol=0.01))
        self.assertTrue(numpy.allclose(grid["elevation"][:], -45 + 45 / 19 * numpy.arange(20), atol=0.01))
        self.assertAlmostEqual(float(grid["sample_spacing"][...]), 1474.99 * 0.000512 / 2, 3)

    def test_runs_are_sorted_and_do_not_overlap(self):
        mask = self.product["mask"]
        keys = list(zip(*(mask[n][:].tolist() for n in ("school_id", "ping_index", "channel", "first_sample"))))
        counts = mask["sample_count"][:].tolist()
        self.assertEqual(keys, sorted(keys))
        self.assertTrue(all(c > 0 for c in counts))
        for (a, n), b in zip(zip(keys, counts), keys[1:]):
            if a[:3] == b[:3]:
                self.assertLessEqual(a[3] + n, b[3])
        self.assertEqual(sum(counts), len(mask["confidence"]))
        mask["confidence"].set_auto_scale(False)
        self.assertEqual(mask["confidence"].dtype, numpy.uint8)
        self.assertAlmostEqual(float(mask["confidence"].scale_factor), 1 / 255, 9)
        self.assertGreaterEqual(int(mask["confidence"][:].min()), 1)

    def test_rows_agree_with_the_csv(self):
        rows = [r for r in sonarx.read_csv(OUT / "school_pings.csv") if r["observation"] == "obs-0001"]
        group = self.product["school_pings"]
        for name in ("volume_m3", "depth_m", "sv_mean_db", "edge_flags", "n_voxels"):
            self.assertEqual([float(r[name]) if r[name] else None for r in rows],
                             [None if v is None or v != v else float(v) for v in group[name][:].tolist()], name)


if __name__ == "__main__":
    sonarx.main()
