# SPDX-License-Identifier: Apache-2.0
"""Exports are readable by others, and reduced raw files give the same schools."""
import json
import random
import sqlite3
import struct

import sonarx
from sonarx import OUT, SURVEY, Case

try:
    import netCDF4
    import raw_reader
except ImportError:
    netCDF4 = None

KEYS = ("observation", "school_id", "time_utc", "n_voxels", "volume_m3")


def total(folder, pattern):
    return sum(p.stat().st_size for p in folder.rglob(pattern))


def datagrams(raw):
    """(type, type and time, body) of each"""
    at = 0
    while at < len(raw):
        size = struct.unpack_from("<i", raw, at)[0]
        yield raw[at + 4:at + 8], raw[at + 4:at + 16], raw[at + 16:at + 4 + size]
        at += size + 8


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
        first = {(row["observation"], row["school_id"]): row["first_time_utc"] for row in sonarx.read_csv(OUT / "schools.csv")}
        edges = sonarx.read_csv(dest / "tracks_edges.csv")
        self.assertEqual({(e["observation"], e["school_id"]): e["time_utc"] for e in edges if e["event"] in ("born", "split")},
                         first)

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

    def single_beam(self, raw, to):
        """A copy of a recording that names an EK60 as its sounder."""
        data = bytearray(raw.read_bytes())
        name = 16 + 256  # of the first datagram, which is CON0: length, type and time, then the names of survey and transect
        self.assertEqual((data[4:8], data[name:name + 4]), (b"CON0", b"MBS\0"))
        data[name:name + 5] = b"ER60\0"
        to.write_bytes(data)

    def test_sv_of_single_beams_is_no_silent_nothing(self):
        folder = self.fresh("single-beams")
        survey, out = folder / "survey", folder / "out"
        survey.mkdir()
        first, second = sorted(SURVEY.glob("*.raw"))
        self.single_beam(first, survey / first.name)
        self.sonarx("run", survey, "--out", out)
        self.one_line_error("export", out, "--to", "sv", "--survey", survey, "--dest", folder / "none", code=1,
                            names="no observation has a grid of fans and beams")
        self.assertFalse((folder / "none").exists())
        (survey / second.name).write_bytes(second.read_bytes())
        self.sonarx("run", survey, "--out", out)
        observations = json.loads((out / "survey.json").read_text())["observations"]
        self.assertEqual(len(observations), 2)
        single, = [o["name"] for o in observations if o["grid"] is None]
        code, said, told = sonarx.run("export", out, "--to", "sv", "--survey", survey, "--dest", folder / "some")
        self.assertEqual((code, told), (0, f"note no-grid: {single}: left out, for it has no grid of fans and beams\n"))
        self.assertEqual(len(said.splitlines()), 1)
        self.assertNotIn(single, said)

    def test_reduced_raw_gives_the_same_masks(self):
        dest = self.export("raw-reduced", "--survey", SURVEY)
        # The schools fill about a hundredth of the sector.
        self.assertLess(total(dest, "*.raw"), total(SURVEY, "*.raw") / 3)
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
        self.assert_same_samples_of_schools(dest)

    def assert_same_samples_of_schools(self, reduced):
        """As a reader of raw files tells them that shares nothing with ours; last, for the test is skipped without netCDF4."""
        if netCDF4 is None:
            self.skipTest("python3-numpy or python3-netcdf4 is not installed")
        runs = []
        for file in (OUT / "products").glob("*.nc"):
            with netCDF4.Dataset(file) as product:
                times = [int(t) for t in product["pings/time_ns"][:]]
                columns = (product["mask"][name][:].tolist() for name in ("ping_index", "channel", "first_sample", "sample_count"))
                runs += [(times[ping], *run) for ping, *run in zip(*columns)]
        wanted = {time for time, *_ in runs}
        read = lambda folder: {time: channels for raw in folder.rglob("*.raw")
                               for time, channels in raw_reader.pings(raw.read_bytes(), wanted)[1].items()}
        whole, less = read(SURVEY), read(reduced)
        self.assertEqual(set(less), wanted)
        for time, channel, first, count in runs:
            kept, told = (of[time][channel]["counts"][first - of[time][channel]["offset"]:][:count] for of in (less, whole))
            self.assertGreaterEqual(first, less[time][channel]["offset"])
            self.assertEqual(len(kept), count)
            self.assertEqual(kept.tolist(), told.tolist())

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
        self.assert_reduced_twice_is_the_same("loud", survey, out)

    def assert_reduced_twice_is_the_same(self, name, survey, out):
        rows = lambda folder: [[r[k] for k in r if k != "ping_index"] for r in sonarx.read_csv(folder / "school_pings.csv")]
        wanted = rows(out)
        self.assertGreater(len(wanted), 10)
        for step in ("once", "twice"):
            dest, again = self.fresh(f"{name}-{step}"), self.fresh(f"{name}-{step}-out")
            self.sonarx("export", out, "--to", "raw-reduced", "--survey", survey, "--dest", dest)
            self.sonarx("run", dest, "--out", again)
            self.assertEqual(rows(again), wanted, step)
            survey, out = dest, again

    def test_reduced_raw_of_a_survey_that_lost_channels(self):
        """A channel that is missing, or that ends early, is no water in the reduced file either: it was lost."""
        survey, out = self.fresh("lost-survey"), self.fresh("lost-out")
        rng = random.Random(7)
        lost = shorter = 0
        for raw in SURVEY.glob("*.raw"):
            parts = []
            for kind, head, body in datagrams(raw.read_bytes()):
                count = struct.unpack_from("<i", body, 68)[0] if kind == b"RAW0" else 0
                chance = rng.random() if kind == b"RAW0" else 1.0
                first = kind == b"RAW0" and struct.unpack_from("<h", body)[0] == 1
                if chance < 0.04 or (first and chance < 0.3):
                    lost += 1
                    continue
                if chance < 0.08:
                    shorter += 1
                    left = rng.randrange(count // 10, count) // 2 * 2
                    body = body[:68] + struct.pack("<i", left) + body[72:72 + 2 * left]
                size = struct.pack("<i", len(head) + len(body))
                parts.append(size + head + body + size)
            (survey / raw.name).write_bytes(b"".join(parts))
        self.assertGreater(min(lost, shorter), 100)
        self.sonarx("run", survey, "--out", out)
        self.assert_reduced_twice_is_the_same("lost", survey, out)

    def test_reduced_raw_of_a_crowd(self):
        """Among many schools, what was detected but became no school decides with which detection a track goes on."""
        params = self.fresh("crowd-params") / "params.json"
        params.write_text(json.dumps({"schools": 14, "pings": 20, "observations": 1}))
        survey, out = self.fresh("crowd-survey"), self.fresh("crowd-out")
        self.sonarx("simulate", survey, "--params", params, "--seed", "3")
        self.sonarx("run", survey, "--out", out)
        self.assert_reduced_twice_is_the_same("crowd", survey, out)

    def test_reduced_raw_names_the_option_that_is_wrong(self):
        code, _, err = sonarx.run("export", OUT, "--to", "raw-reduced", "--survey", SURVEY, "--dest",
                                  self.fresh("export-wrong"), "--coarsen", "-1")
        self.assertEqual(code, 2, err)
        self.assertEqual(err, "sonarx: --coarsen: -1 is outside 0 .. 10000 beams\n")

    def test_reduced_raw_needs_the_survey(self):
        code, _, err = sonarx.run("export", OUT, "--to", "raw-reduced", "--dest", self.fresh("export-none"))
        self.assertEqual(code, 2, err)


if __name__ == "__main__":
    sonarx.main()
