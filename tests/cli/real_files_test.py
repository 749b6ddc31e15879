# SPDX-License-Identifier: Apache-2.0
"""`sonarx info` on real files against what was counted by walking each to its last byte. SONAR_DATA, or ../shared/data
beside the project; skipped where there are none."""
import json
import os
import sys
from pathlib import Path

import sonarx
from sonarx import PROJECT, Case

DATA = Path(os.environ.get("SONAR_DATA", PROJECT.parent / "shared" / "data")).resolve()
# name: channels, pings, samples, NME0 (None = not counted), sum of all power counts
FACTS = {
    "Summer2017-D20170615-T214712.raw": (3, 10, 259, 130, -48757955),
    "Summer2017-D20170615-T214606.raw": (3, 43, 259, None, -208610252),
    "Summer2017-D20170615-T212933.raw": (3, 52, 259, 745, -252834558),
    "Summer2017-D20170615-T190214.raw": (3, 19, 3888, 688, -2561562094),
    "RedSlip-D20160915-T120914.raw": (1, 1205, 837, 1, -6950622914),
    "D20070724-T042400.raw": (4, 36, 2604, 125, -4405006622),
}


class RealFiles(Case):
    def info(self, name):
        out = self.sonarx("info", DATA / "raw" / name, "--json", "--checksum")
        return json.loads(out)["files"][0]

    def test_counted_facts(self):
        for name, (channels, pings, samples, nmea, power) in FACTS.items():
            with self.subTest(name):
                file = self.info(name)
                self.assertEqual(file["size"], (DATA / "raw" / name).stat().st_size)
                self.assertEqual(file["channels"], channels)
                self.assertEqual(file["pings"], pings)
                self.assertEqual(file["samples"], {"min": samples, "max": samples})
                self.assertEqual(file["datagrams"]["RAW0"], channels * pings)
                self.assertEqual(file["datagrams"]["CON0"], 1)
                self.assertEqual(file["power_count_sum"], power)
                if nmea is not None:
                    self.assertEqual(file["datagrams"]["NME0"], nmea)

    def test_positions_and_times(self):
        position = self.info("Summer2017-D20170615-T190214.raw")["first_position"]
        self.assertAlmostEqual(position["latitude"], 44.6264, 3)
        self.assertAlmostEqual(position["longitude"], -124.0481, 3)
        file = self.info("D20070724-T042400.raw")
        self.assertAlmostEqual(file["first_position"]["latitude"], 40.263, 3)
        self.assertAlmostEqual(file["first_position"]["longitude"], -71.222, 3)
        # The recording computer's clock was 35 s ahead of GPS.
        self.assertAlmostEqual(file["gps_minus_clock_s"], -35, delta=1.5)
        file = self.info("RedSlip-D20160915-T120914.raw")
        self.assertIsNone(file["first_position"])
        self.assertEqual(file["first_time_utc"], "2016-09-15T12:09:14.888Z")
        self.assertEqual(file["last_time_utc"], "2016-09-15T12:10:06.644Z")

    def test_ek80_is_recognised_and_named(self):
        for name in ("EK80-power-angle.raw", "EK80-complex.raw"):
            code, out, err = sonarx.run("info", DATA / "raw" / name, "--json")
            self.assertEqual(code, 0, err)
            file = json.loads(out)["files"][0]
            self.assertEqual((file["format"], file["sounder"], file["channels"]), ("simrad-ek80", "EK80", 2))
            self.assertEqual(file["datagrams"]["RAW3"], 12)
            self.assertIn("format-not-read", [note["code"] for note in file["notes"]])

    def test_whole_folder(self):
        before = sonarx.snapshot(DATA / "raw")
        code, out, err = sonarx.run("info", DATA / "raw", "--json")
        self.assertEqual(code, 0, err)
        names = {Path(f["path"]).name for f in json.loads(out)["files"]}
        self.assertLessEqual(set(FACTS), names)
        self.assertEqual(sonarx.snapshot(DATA / "raw"), before)


if __name__ == "__main__":
    if not (DATA / "raw").is_dir():
        print(f"skipped: no real files at {DATA}")
        sys.exit(77)
    sonarx.main()
