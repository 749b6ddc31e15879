# SPDX-License-Identifier: Apache-2.0
"""Independent recount: numpy, netCDF4 and a reader of its own take masks and raw samples and work out every column that
needs no background again. Formulas from docs/interfaces.md, not from the program."""
import math
import sys

import sonarx
from sonarx import OUT, SURVEY, Case

try:
    import netCDF4
    import numpy as np
    import raw_reader
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
        wanted = {int(self.observations[r["observation"]].pings["time"][int(r["ping_index"])]) for r in chosen}
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
            raw = found[int(observation.pings["time"][ping])]
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


if __name__ == "__main__":
    sonarx.main()
