# SPDX-License-Identifier: Apache-2.0
"""Independent recount: numpy, netCDF4 and a reader of its own take masks and raw samples and work out every column that
needs no background again. Formulas from docs/interfaces.md, not from the program. Then the other recount, recount.py, is
itself tested: a survey with faults in its schools passes, and one changed value of any column is noticed."""
import contextlib
import csv
import io
import math
import re
import shutil
import sys

import sonarx
from sonarx import OUT, SURVEY, Case

try:
    import netCDF4
    import numpy as np
    import raw_reader
    sys.path.insert(0, str(sonarx.PROJECT / "tests"))
    import recount as whole_recount
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

AXIS_M, E2 = 6378137.0, 0.0066943799901413165


def cell_bounds(centres):
    middle = (centres[1:] + centres[:-1]) / 2
    first, last = centres[1] - centres[0], centres[-1] - centres[-2]
    return np.concatenate([[centres[0] - first / 2], middle, [centres[-1] + last / 2]])


def metres_per_radian(latitude_deg):
    s = math.sin(math.radians(latitude_deg))
    w = 1 - E2 * s * s
    return AXIS_M * (1 - E2) / w**1.5, AXIS_M / math.sqrt(w) * math.cos(math.radians(latitude_deg))


class Observation:
    """One product, with its masks as arrays of voxels."""

    def __init__(self, name):
        product = netCDF4.Dataset(OUT / "products" / f"{name}.nc")
        grid, self.pings = product["grid"], {k: v[:] for k, v in product["pings"].variables.items()}
        self.elevation, self.azimuth = (np.radians(np.asarray(grid[k][:], float)) for k in ("elevation", "azimuth"))
        self.spacing = float(grid["sample_spacing"][...])
        self.first = float(grid["range_of_first_sample"][...])
        self.place = {int(c): (f, b) for (f, b), c in np.ndenumerate(np.asarray(grid["channel"][:]))}
        mask = product["mask"]
        mask["confidence"].set_auto_scale(False)
        confidence, runs = np.asarray(mask["confidence"][:], float) / 255, {}
        at = 0
        for key in zip(*(np.asarray(mask[k][:]).tolist()
                         for k in ("school_id", "ping_index", "channel", "first_sample", "sample_count"))):
            school, ping, channel, first, count = key
            runs.setdefault((school, ping), []).append((channel, first, confidence[at:at + count]))
            at += count
        self.runs = runs
        product.close()

    def voxels(self, school, ping):
        fan, beam, channel, sample, confidence = [], [], [], [], []
        for c, first, weights in self.runs[(school, ping)]:
            f, b = self.place[c]
            n = len(weights)
            fan += [f] * n
            beam += [b] * n
            channel += [c] * n
            sample += range(first, first + n)
            confidence += weights.tolist()
        return tuple(map(np.array, (fan, beam, channel, sample, confidence)))

    def to_enu(self, elevation, azimuth, r, heading):
        bearing = azimuth + heading
        horizontal = r * np.cos(elevation)
        return horizontal * np.sin(bearing), horizontal * np.cos(bearing), -r * np.sin(elevation)


def recount(observation, school, ping):
    o = observation
    fan, beam, _, sample, confidence = o.voxels(school, ping)
    r = o.first + sample * o.spacing
    r1, r2 = r - o.spacing / 2, r + o.spacing / 2
    eb, ab = cell_bounds(o.elevation), cell_bounds(o.azimuth)
    volume = ((r2**3 - r1**3) / 3 * (ab[beam + 1] - ab[beam]) * np.abs(np.sin(eb[fan + 1]) - np.sin(eb[fan])))
    volume[r < o.spacing] = 0
    heading = math.radians(float(o.pings["heading"][ping]))
    depth0 = float(o.pings["transducer_depth"][ping])
    east, north, down = o.to_enu(o.elevation[fan], o.azimuth[beam], r, heading)
    w = confidence * volume
    w = w / w.sum()
    ce, cn, cd = (w * east).sum(), (w * north).sum(), (w * down).sum()
    m, p = metres_per_radian(float(o.pings["latitude"][ping]))
    t = math.tan(math.radians(float(o.pings["latitude"][ping])))
    cov = np.cov(np.stack([east, north]), aweights=w, ddof=0)
    values, vectors = np.linalg.eigh(cov)
    axis = vectors[:, 1]
    corners = [o.to_enu(eb[fan + i], ab[beam + j], rr, heading) for i in (0, 1) for j in (0, 1) for rr in (r1, r2)]
    ex, no, de = (np.concatenate([c[k] for c in corners]) for k in range(3))
    along, across = axis[0] * ex + axis[1] * no, -axis[1] * ex + axis[0] * no
    extents = sorted([np.ptp(along), np.ptp(across)])
    round_blob = values[1] - values[0] < 1e-3 * values[1]
    bearing = math.degrees(math.atan2(axis[0], axis[1])) % 180
    if np.ptp(along) < np.ptp(across):
        bearing = (bearing + 90) % 180
    return {
        "n_voxels": len(fan), "n_beams": len(set(beam.tolist())), "n_fans": len(set(fan.tolist())),
        "volume_m3": volume.sum(), "depth_m": depth0 + cd, "range_m": math.sqrt(ce**2 + cn**2 + cd**2),
        "bearing_deg": math.degrees(math.atan2(ce, cn)) % 360,
        "latitude": float(o.pings["latitude"][ping]) + math.degrees(cn / m - ce * ce * t / (2 * m * p) * math.cos(
            math.radians(float(o.pings["latitude"][ping])))),
        "longitude": float(o.pings["longitude"][ping]) + math.degrees(ce / p * (1 + cn * t * math.cos(
            math.radians(float(o.pings["latitude"][ping]))) / p)),
        "depth_min_m": depth0 + de.min(), "depth_max_m": depth0 + de.max(), "height_m": de.max() - de.min(),
        "length_m": None if round_blob else extents[1], "width_m": None if round_blob else extents[0],
        "axis_deg": None if round_blob else bearing,
    }, volume


class Recount(Case):
    @classmethod
    def setUpClass(cls):
        cls.rows = sonarx.read_csv(OUT / "school_pings.csv")
        cls.observations = {name: Observation(name) for name in {r["observation"] for r in cls.rows}}

    def test_geometry(self):
        self.assertTrue(self.rows)
        for row in self.rows:
            observation = self.observations[row["observation"]]
            school, ping = int(row["school_id"]), int(row["ping_index"])
            expected, _ = recount(observation, school, ping)
            with self.subTest(observation=row["observation"], school=school, ping=ping):
                for name, value in expected.items():
                    if value is None:
                        continue
                    got = float(row[name])
                    if name in ("bearing_deg", "axis_deg"):
                        turn = 180 if name == "axis_deg" else 360
                        self.assertLess(abs((got - value + turn / 2) % turn - turn / 2), 1e-4, name)
                    elif name in ("latitude", "longitude"):
                        self.assertAlmostEqual(got, value, delta=2e-8, msg=name)
                    else:
                        self.assertAlmostEqual(got, value, delta=1e-6 * max(1.0, abs(value)), msg=name)

    def test_backscatter(self):
        """Sv straight from the raw counts. The product takes a background away that is far below schools here, and
        stores Sv in steps of 0.012 dB: hence 0.1 dB for means."""
        files = [p.read_bytes() for p in sorted(SURVEY.glob("*.raw"))]
        chosen = self.rows[::3]
        wanted = {int(self.observations[r["observation"]].pings["time_ns"][int(r["ping_index"])]) for r in chosen}
        found, config = {}, []
        for data in files:
            config, pings = raw_reader.pings(data, wanted)
            found.update(pings)
        self.assertEqual(set(found), wanted)
        judged = 0
        for row in chosen:
            observation = self.observations[row["observation"]]
            school, ping = int(row["school_id"]), int(row["ping_index"])
            self.assertNotEqual(row["snr_db"], "", "the survey has noise in every beam, so its level is known")
            if float(row["valid_fraction"]) < 1 - 1e-9 or float(row["snr_db"]) < 20:
                continue
            judged += 1
            _, _, channel, sample, _ = observation.voxels(school, ping)
            _, volume = recount(observation, school, ping)
            raw = found[int(observation.pings["time_ns"][ping])]
            tables = {c: raw_reader.sv_db(raw[c], config[c]) for c in set(channel.tolist())}
            sv_db = np.array([tables[c][s - raw[c]["offset"]] for c, s in zip(channel.tolist(), sample.tolist())])
            mean = (10 ** (sv_db / 10) * volume).sum() / volume.sum()
            with self.subTest(observation=row["observation"], school=school, ping=ping):
                self.assertAlmostEqual(float(row["sv_mean_db"]), 10 * math.log10(mean), delta=0.1)
                self.assertAlmostEqual(float(row["sv_max_db"]), sv_db.max(), delta=0.1)
                self.assertAlmostEqual(float(row["backscatter_m2"]),
                                       10 ** (float(row["sv_mean_db"]) / 10) * volume.sum(),
                                       delta=1e-6 * float(row["backscatter_m2"]))
        self.assertGreater(judged, len(chosen) // 2)


# What a recount holds the columns to, by family. Not here: threshold_db and bottom_depth_m, see recount.py, and a
# ping's backscatter_total, which hangs on flags outside the masks.
PING_FAMILIES = {
    "counts": ("n_voxels", "n_beams", "n_fans"),
    "place": ("latitude", "longitude", "depth_m", "range_m", "bearing_deg"),
    "sizes": ("volume_m3", "length_m", "width_m", "height_m", "axis_deg", "depth_min_m", "depth_max_m"),
    "echo": ("sv_mean_db", "sv_p95_db", "sv_max_db", "backscatter_m2", "snr_db", "valid_fraction",
             "backscatter_psi_error_db"),
    "form": ("equivalent_radius_m", "box_length_m", "box_width_m", "box_thickness_m", "box_bearing_deg", "box_tilt_deg",
             "surface_distance_m", "horizontal_range_m"),
    "spread": ("sv_p5_db", "sv_p50_db", "sv_robust_mean_db", "sv_variation", "sv_skewness", "sv_kurtosis", "nasc_m2_nmi2",
               "mass_depth_m"),
    "corrected": ("volume_corrected_m3", "sv_corrected_db"),
    "edges": ("edge_flags", "edge_fraction", "touches_edge"),
    "others": ("provisional",),
}
SCHOOL_FAMILIES = {
    "counts": ("n_pings", "n_pings_whole", "touches_edge_fraction"),
    "place": ("latitude", "longitude", "depth_m"),
    "sizes": ("volume_m3", "volume_corrected_m3", "length_m", "width_m", "height_m"),
    "echo": ("sv_mean_db", "sv_corrected_db", "backscatter_m2", "backscatter_psi_error_db",
             "backscatter_total_m2", "backscatter_total_se_m2"),
    "form": ("surface_m2", "area_m2", "box_length_m", "sphericity", "n_nuclei", "sv_robust_mean_db", "nasc_m2_nmi2"),
    "motion": ("speed_mps", "speed_se_mps", "course_deg", "vertical_speed_mps"),
}
# Changes that matter to somebody: 1 cm on the map, a tenth of a degree, 1 mm/s; all others a ten-thousandth.
CHANGE = {"latitude": 1e-7, "longitude": 2e-7, "course_deg": 0.1, "axis_deg": 0.1, "box_bearing_deg": 0.1, "box_tilt_deg": 0.1, "speed_mps": 1e-3, "speed_se_mps": 1e-3,
          "vertical_speed_mps": 1e-3, "edge_flags": 128}


class Read:
    """The pings of a survey, read once."""

    def __init__(self, survey, times):
        self.pings = list(whole_recount.Survey(survey).load(times))

    def load(self, wanted):
        return (ping for ping in self.pings if ping[0] in wanted)


def times_of(o):
    return {int(o.pings["time_ns"][int(r["ping_index"])]) for r in o.rows}


def deviations_of(o, pings):
    deviations = whole_recount.Deviations()
    with contextlib.redirect_stdout(io.StringIO()):
        whole_recount.recount_observation(o, pings, 1, deviations)
    return deviations


class RecountNotices(Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.fresh("recount")
        cls.product = OUT / "products" / "obs-0001.nc"
        cls.sound = whole_recount.Observation(cls.product)
        cls.pings = Read(SURVEY, times_of(cls.sound))

    def changed(self, change):
        """What is beyond tolerance in a copy of the product that `change` has had its way with; None = something."""
        copy = self.folder / self.product.name
        shutil.copy(self.product, copy)
        with netCDF4.Dataset(copy, "r+") as data:
            data.set_auto_mask(False)
            change(data)
        deviations = deviations_of(whole_recount.Observation(copy), self.pings)
        return deviations.beyond() or ({None} if deviations.failed else set())

    def test_a_sound_product_passes(self):
        self.assertEqual(self.changed(lambda data: None), set())

    def each(self, table, families):
        """One value of each column of a family is changed, each in a row of its own: these columns and no others."""
        for family, columns in families.items():
            def change(data, columns=columns):
                for k, name in enumerate(columns):
                    variable = data[table][name]
                    known = [i for i in range(len(variable)) if math.isfinite(variable[i])]
                    at = known[k % len(known)]
                    old = variable[at]
                    step = CHANGE.get(name, 1 if variable.dtype.kind == "i" else 1e-4 * max(abs(old), 1e-2))
                    variable[at] = old ^ step if name == "edge_flags" else old + step
            with self.subTest(table=table, family=family):
                self.assertEqual({name for at, name in self.changed(change) if at == table}, set(columns))

    def test_any_column_of_school_pings(self):
        self.each("school_pings", PING_FAMILIES)

    def test_any_column_of_schools(self):
        self.each("schools", SCHOOL_FAMILIES)

    def test_known_and_unknown(self):
        """A number where there should be none, and none where there should be one."""
        def forget(data):
            data["schools"]["speed_mps"][0] = math.nan
            data["school_pings"]["sv_mean_db"][0] = math.nan
        self.assertLessEqual({("schools", "speed_mps"), ("school_pings", "sv_mean_db")}, self.changed(forget))

    def test_extents_do_not_change_alone(self):
        for row, name in enumerate(("length_corrected_m", "width_corrected_m", "height_corrected_m")):
            def change(data, row=row, name=name):
                # Where a body cannot be told there is nothing to change.
                volumes = data["school_pings"]["volume_corrected_m3"]
                known = [i for i, volume in enumerate(volumes) if math.isfinite(volume)]
                data["school_pings"][name][known[row]] *= 1.0001
            with self.subTest(column=name):
                self.assertIn(("school_pings", "volume_corrected_m3"), self.changed(change))

    def test_times(self):
        for table, name in (("school_pings", "time_utc"), ("schools", "first_time_utc"), ("schools", "last_time_utc")):
            def change(data, table=table, name=name):
                data[table][name][0] = data[table][name][0].replace("Z", "1Z")
            with self.subTest(table=table, column=name):
                self.assertEqual(self.changed(change), {None})

    def test_masks(self):
        def other(data, name, change):
            data["mask"][name].set_auto_scale(False)
            data["mask"][name][0] = change(data["mask"][name][0])
        cases = {"confidence": (lambda q: 255 if q < 128 else 1, "depth_m"), "first_sample": (lambda s: s - 1, "volume_m3"),
                 "fault": (lambda f: 1 - f, "valid_fraction")}
        for name, (change, column) in cases.items():
            with self.subTest(variable=name):
                self.assertIn(("school_pings", column), self.changed(lambda data: other(data, name, change)))

    def test_any_column_of_the_tables(self):
        for table, rows, ignored in (("schools.csv", "schools", {"continues"}), ("school_pings.csv", "rows", set())):
            products = sorted((OUT / "products").glob("obs-*.nc"))
            told = [r for p in products for r in getattr(whole_recount.Observation(p), rows)]
            with open(OUT / table, newline="", encoding="utf-8") as stream:
                lines = list(csv.reader(stream))
            for i, name in [(i, n) for i, n in enumerate(lines[0]) if n not in ignored] + [(None, "nothing")]:
                changed = [list(line) for line in lines]
                if i is not None:
                    digit = re.search("[0-9]", text := changed[1][i])
                    other = digit and str((int(digit[0]) + 1) % 10)
                    changed[1][i] = text[:digit.start()] + other + text[digit.end():] if digit else text + "1"
                with open(self.folder / table, "w", newline="", encoding="utf-8") as stream:
                    csv.writer(stream).writerows(changed)
                deviations = whole_recount.Deviations()
                with contextlib.redirect_stdout(io.StringIO()), self.subTest(table=table, column=name):
                    try:
                        whole_recount.compare_table(self.folder / table, told, deviations)
                    except ValueError:
                        deviations.failed = True  # no number any more
                    self.assertEqual(deviations.failed, i is not None)


class Faults(Case):
    """A noisy survey: interference, corrupted packets and impulse noise lie in the schools, so that members are no valid ones."""

    @classmethod
    def setUpClass(cls):
        cls.folder = cls.fresh("faults")
        flags = ["--preset", "hard", "--seed", "2", "--observations", "1", "--pings", "12", "--schools", "3", "--noise",
                 "2"]
        for arguments in (["simulate", cls.folder / "survey", *flags],
                          ["run", cls.folder / "survey", "--out", cls.folder / "out"]):
            code, out, err = sonarx.run(*arguments)
            assert code == 0, out + err
        cls.product = cls.folder / "out" / "products" / "obs-0001.nc"
        cls.observation = whole_recount.Observation(cls.product)
        cls.pings = Read(cls.folder / "survey", times_of(cls.observation))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_rows_with_faults_are_recounted(self):
        partly = [r for r in self.observation.rows if 0 < r["valid_fraction"] < 1 - 1e-9]
        self.assertGreater(len(partly), 2)
        self.assertEqual(deviations_of(self.observation, self.pings).beyond(), set())
        count = deviations_of(self.observation, self.pings).worst[("school_pings", "valid_fraction")][0]
        self.assertEqual(count, len(self.observation.rows))

    def test_a_fault_that_is_none_is_noticed(self):
        """Both ways: the first fault taken for a sound sample, the first sound sample for a fault."""
        for value in (1, 0):
            copy = self.folder / "changed.nc"
            shutil.copy(self.product, copy)
            with netCDF4.Dataset(copy, "r+") as data:
                fault = data["mask"]["fault"]
                at = int(np.flatnonzero(np.asarray(fault[:]) == value)[0])
                fault[at] = 1 - value
            beyond = deviations_of(whole_recount.Observation(copy), self.pings).beyond()
            with self.subTest(value=value):
                self.assertIn(("school_pings", "valid_fraction"), beyond)
                self.assertIn(("school_pings", "sv_mean_db"), beyond)

    def test_remeasured_products_know_their_faults(self):
        again = self.folder / "again"
        shutil.copytree(self.folder / "out", again)
        self.sonarx("run", self.folder / "survey", "--out", again, "--remeasure")
        with netCDF4.Dataset(self.product) as a, netCDF4.Dataset(again / "products" / "obs-0001.nc") as b:
            np.testing.assert_array_equal(a["mask"]["fault"][:], b["mask"]["fault"][:])


if __name__ == "__main__":
    sonarx.main()
