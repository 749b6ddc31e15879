# SPDX-License-Identifier: Apache-2.0
"""Schools carried by a known current, and a file of that current: their speed through the water is what was put in."""
import datetime
import json
import math
import unittest

import sonarx
from sonarx import Case

try:
    import netCDF4
except ImportError:
    netCDF4 = None

OWN_MPS, EAST_MPS, NORTH_MPS = 0.5, 0.4, -0.3
FLAGS = ["--preset", "easy", "--seed", "5", "--observations", "1", "--pings", "30", "--schools", "2", "--speed-knots", "3"]


def write_adcp(path, first, last):
    """As UHDAS writes: a profile every 60 s of bins of 8 m from 12 m, the last of them filled."""
    epoch = datetime.datetime(first.year, 1, 1, tzinfo=datetime.timezone.utc)
    minutes = int((last - first).total_seconds() / 60) + 3
    with netCDF4.Dataset(path, "w", format="NETCDF3_CLASSIC") as data:
        data.createDimension("time", None)
        data.createDimension("depth_cell", 20)
        time = data.createVariable("time", "f8", ("time",))
        time.units = f"days since {first.year}-01-01 00:00:00"
        depth = data.createVariable("depth", "f4", ("time", "depth_cell"))
        depth.units = "meter"
        start = (first - epoch).total_seconds() / 86400
        time[:] = [start + (k - 1) / 1440 for k in range(minutes)]
        depth[:] = [[12 + 8 * bin for bin in range(20)]] * minutes
        for name, value in (("u", EAST_MPS), ("v", NORTH_MPS)):
            velocity = data.createVariable(name, "f4", ("time", "depth_cell"), fill_value=1e38)
            velocity.units = "meter second-1"
            velocity[:] = [[value] * 19 + [1e38]] * minutes


@unittest.skipIf(netCDF4 is None, "netCDF4-python writes the currents")
class Movement(Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.fresh("movement")
        cls.survey, cls.out = cls.folder / "survey", cls.folder / "out"
        cls.adcp = cls.folder / "adcp.nc"
        params = cls.folder / "params.json"
        params.write_text(json.dumps({"own_speed_min_mps": OWN_MPS, "own_speed_max_mps": OWN_MPS,
                                      "current_east_mps": EAST_MPS, "current_north_mps": NORTH_MPS}))
        code, out, err = sonarx.run("simulate", cls.survey, *FLAGS, "--params", params)
        assert code == 0, out + err
        times = [datetime.datetime.fromisoformat(row["time_utc"].replace("Z", "+00:00"))
                 for row in sonarx.read_csv(cls.survey / "truth" / "school_pings.csv")]
        write_adcp(cls.adcp, min(times), max(times))
        code, out, err = sonarx.run("run", cls.survey, "--out", cls.out, "--currents", cls.adcp)
        assert code == 0, out + err

    def test_speed_through_the_water_is_what_was_put_in(self):
        known = [row for row in sonarx.read_csv(self.out / "schools.csv") if row["speed_water_mps"]]
        self.assertTrue(known)
        for row in known:
            self.assertLess(abs(float(row["speed_water_mps"]) - OWN_MPS), max(0.05, 3 * float(row["speed_water_se_mps"])))
            self.assertAlmostEqual(float(row["current_east_mps"]), EAST_MPS, places=3)
            self.assertAlmostEqual(float(row["current_north_mps"]), NORTH_MPS, places=3)
            course, water = (math.radians(float(row[name])) for name in ("course_deg", "course_water_deg"))
            east = float(row["speed_mps"]) * math.sin(course) - EAST_MPS
            north = float(row["speed_mps"]) * math.cos(course) - NORTH_MPS
            self.assertAlmostEqual(math.sin(water) * float(row["speed_water_mps"]), east, delta=0.02)
            self.assertAlmostEqual(math.cos(water) * float(row["speed_water_mps"]), north, delta=0.02)

    def test_movement_against_the_ship(self):
        rows = [row for row in sonarx.read_csv(self.out / "school_pings.csv") if row["time_to_cpa_s"]]
        self.assertTrue(rows)
        for row in rows:
            self.assertLessEqual(float(row["cpa_m"]), float(row["range_m"]) + 1)
            self.assertAlmostEqual(float(row["ship_speed_mps"]), 3 * 1852 / 3600, delta=0.3)
            if row["speed_away_mps"]:
                slack = 0.2 + 3 * float(row["speed_away_se_mps"])  # the speed is freed of noise, its part is not
                self.assertLessEqual(abs(float(row["speed_away_mps"])), float(row["speed_smoothed_mps"]) + slack)
            # What has a velocity has its errors, and what is taken for still has none.
            for name in ("time_to_cpa_se_s", "cpa_se_m", "vertical_speed_smoothed_se_mps"):
                self.assertEqual(bool(row[name]), bool(row["speed_smoothed_mps"]), name)

    def test_pooled_table(self):
        dest = self.fresh("movement-export")
        self.sonarx("export", self.out, "--to", "avoidance", "--dest", dest)
        rows = sonarx.read_csv(dest / "avoidance.csv")
        self.assertEqual({row["against"] for row in rows}, {"range_m", "relative_bearing_deg", "time_to_cpa_s"})
        for row in rows:
            self.assertGreaterEqual(int(row["n_pings"]), int(row["n_schools"]))

    def test_the_map_and_charts_are_drawn(self):
        self.sonarx("render", "survey-map", self.out, "--out", self.folder / "map.png", "--size", "800x600")
        self.sonarx("render", "chart", self.out, "--x", "time_to_cpa_s", "--y", "speed_away_mps", "--out",
                    self.folder / "chart.png", "--size", "800x600")

    def test_the_volume_has_arrows_unless_they_are_not_wanted(self):
        picture = self.folder / "volume.png"
        view = ("render", "volume", self.out, "--masks-alone", "--frames", "0", "--renderer", "cpu", "--size", "500x400")
        self.sonarx(*view, "--out", picture)
        same = ("--reference", picture, "--largest-difference", 0, "--mean-difference", 0)
        self.sonarx(*view, *same)
        self.assertEqual(sonarx.run(*view, "--no-current-arrows", *same)[0], 1)

    def test_a_file_that_is_none_is_refused_in_one_line(self):
        bad = self.folder / "bad.nc"
        bad.write_text("no netCDF")
        self.one_line_error("run", self.survey, "--out", self.folder / "none", "--currents", bad, code=1, names=bad)


if __name__ == "__main__":
    sonarx.main()
