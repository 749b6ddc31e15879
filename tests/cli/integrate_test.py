# SPDX-License-Identifier: Apache-2.0
"""Echo integration against numpy: calibrated Sv, flags, background and masks as `export --to sv` writes them, cut into range bins
and depth channels by a program that shares nothing with ours. Formulas from docs/interfaces.md."""
import json
import math
import sys
from pathlib import Path

import sonarx
from sonarx import SURVEY, Case

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
try:
    import netCDF4
    import numpy as np
    from recount_earth import plane
    from recount_product import bounds
except ImportError:
    netCDF4 = None

EDSU_NMI, BIN_M, CHANNEL_M = 0.02, 60.0, 15.0
NASC = 4 * math.pi * 1852**2
NEVER = 1 | 2 | 64  # near field, surface, seabed
FAULT = 4 | 8 | 16 | 32


def close(test, told, expected, what, relative=1e-6):
    if not told:
        test.assertFalse(math.isfinite(expected), what)
        return
    test.assertLessEqual(abs(float(told) - expected), relative * max(abs(expected), 1e-30), what)


class Cells:
    """Sums of one observation by (EDSU, range bin, depth channel), in numpy."""

    def __init__(self, sv_file, product, edsu_of_ping):
        with netCDF4.Dataset(sv_file) as data, netCDF4.Dataset(product) as whole:
            data.set_auto_mask(False)
            whole.set_auto_mask(False)
            beams, platform = data["Sonar/Beam_group1"], data["Platform"]
            elevation, azimuth = np.radians(beams["elevation"][:]), np.radians(beams["azimuth"][:])
            r, volume = beams["range"][:], beams["volume"][:]
            counts, table = beams["Sv"], beams["sv_minus_power"]
            counts.set_auto_scale(False)
            table.set_auto_scale(False)
            grid = whole["grid"]
            width = np.radians(grid["vertical_width"][:])
            e, a = bounds(elevation, 0), bounds(azimuth, 0)
            step = r[1] - r[0]
            used = r >= step
            at_bin = np.where(used, (r / BIN_M).astype(int), -1)
            self.cells, self.area = {}, {}
            for ping, edsu in enumerate(edsu_of_ping):
                depth = float(platform["transducer_depth"][ping])
                n, flags = counts[ping].astype(float), beams["flags"][ping]
                linear = np.where(n == -32768, 0, 2.0**(n / 256))
                noise = 10**(beams["background_power"][ping] / 10)[:, :, None] * 2.0**(
                    table[int(beams["setting_of_ping"][ping])].astype(float) / 256)
                noise = np.where(np.isfinite(noise), noise, 0)
                member = beams["school_id"][ping] > 0
                water = (flags & NEVER) == 0
                heard = water & ((flags & FAULT) == 0) & (n != -32768)
                first = min(int(np.argmin(f)) for f in ((flags & 1) != 0).reshape(-1, len(r)))
                for b in range(at_bin.max() + 1):
                    ring = (at_bin == b) & (np.arange(len(r)) >= first)
                    area = (a[-1] - a[0]) * (r[ring] * step).sum()
                    self.area[edsu, b] = self.area.get((edsu, b), 0) + area
                top, bottom = (depth - r * np.sin(x)[:, None] for x in (e[1:], e[:-1]))
                axis = -elevation[:, None, None]
                scale = np.sqrt(8 * math.log(2)) / width[:, :, None]

                def heard_above(z):
                    """Share of each beam's echo that comes from above a depth, but for a constant."""
                    with np.errstate(divide="ignore", invalid="ignore"):
                        dip = np.arcsin(np.clip((z - depth) / r, -1, 1))[None, None, :] - axis
                    return 0.5 * erf(dip * scale)

                below = heard_above(0.0)
                for c in range(int(bottom[:, used].max() / CHANNEL_M) + 1):
                    z0, z1 = c * CHANNEL_M, (c + 1) * CHANNEL_M
                    with np.errstate(divide="ignore", invalid="ignore"):
                        share = np.clip(np.minimum(bottom, z1) - np.maximum(top, z0), 0, None) / (bottom - top)
                    share[:, ~used] = 0
                    v = volume * share[:, None, :]
                    above, below = below, heard_above(z1)
                    beam = below - above
                    for b in range(at_bin.max() + 1):
                        of = at_bin == b
                        part = v[:, :, of]
                        if not (part * water[:, :, of]).sum() > 0:
                            continue
                        h, m = heard[:, :, of], member[:, :, of]
                        echo = (linear - noise)[:, :, of] * part * h
                        sums = np.array([(part * water[:, :, of]).sum(), (part * h).sum(), (part * (h & m)).sum(), echo.sum(),
                                         (echo * m).sum(), (noise[:, :, of] * part * h).sum(),
                                         (part * h * beam[:, :, of]).sum()])
                        self.cells[edsu, b, c] = self.cells.get((edsu, b, c), 0) + sums


def erf(x):
    """Abramowitz & Stegun 7.1.26, 1.5e-7."""
    t = 1 / (1 + 0.3275911 * np.abs(x))
    poly = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))))
    return np.sign(x) * (1 - poly * np.exp(-x * x))


def edsus(product):
    """Number of the unit of each ping, from 1, by distance sailed."""
    with netCDF4.Dataset(product) as data:
        lat, lon = data["pings"]["latitude"][:], data["pings"]["longitude"][:]
    sailed, of_ping = 0.0, [1]
    for i in range(1, len(lat)):
        sailed += math.hypot(*plane(lat[i - 1], lon[i - 1], lat[i], lon[i]))
        of_ping.append(int(sailed / (EDSU_NMI * 1852)) + 1)
    return of_ping, sailed / 1852


class Integrate(Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.fresh("integrate")
        cls.out, cls.sv = cls.folder / "out", cls.folder / "sv"

    def setUp(self):
        if netCDF4 is None:
            self.skipTest("python3-netcdf4 is not installed")
        if self.out.exists():
            return
        # What beams hear of the seabed by their edges stands in no file: without a seabed nothing is left out for it.
        recipe = json.loads(self.sonarx("recipe"))
        recipe["seabed"]["enabled"] = False
        (self.folder / "recipe.json").write_text(json.dumps(recipe))
        self.sonarx("run", SURVEY, "--out", self.out, "--recipe", self.folder / "recipe.json")
        self.sonarx("export", self.out, "--to", "sv", "--survey", SURVEY, "--out", self.sv)

    def integrate(self, *options, out=None):
        return self.sonarx("integrate", SURVEY, "--out", out or self.out, "--edsu-nmi", EDSU_NMI, "--range-bin-m", BIN_M,
                           "--depth-channel-m", CHANNEL_M, *options)

    def test_sums_are_those_of_numpy(self):
        self.integrate()
        rows = sonarx.read_csv(self.out / "nasc.csv")
        effort = sonarx.read_csv(self.out / "effort.csv")
        for name in ("obs-0001", "obs-0002"):
            product = self.out / "products" / f"{name}.nc"
            of_ping, sailed = edsus(product)
            cells = Cells(self.sv / f"{name}-sv.nc", product, of_ping)
            own = [r for r in rows if r["transect"] == name]
            told = {(int(r["edsu"]), round(float(r["range_from_m"]) / BIN_M), round(float(r["depth_from_m"]) / CHANNEL_M)): r
                    for r in own}
            self.assertEqual(len(told), len(own))
            self.assertEqual(set(told), {k for k in cells.cells if cells.area[k[:2]] > 0})
            for key, row in told.items():
                water, heard, school, echo, school_echo, noise, beam = cells.cells[key]
                height = water / cells.area[key[:2]]
                where = f"{name} {key}"
                close(self, row["volume_m3"], heard, where)
                close(self, row["height_m"], height, where)
                close(self, row["valid_fraction"], heard / water, where)
                if not heard > 0:
                    continue
                sv = echo / heard
                close(self, row["filled_fraction"], school / heard, where)
                close(self, row["beam_filling"], beam / heard, where, 1e-4)
                close(self, row["sa_m2_m2"], sv * height, where, 1e-5)
                close(self, row["nasc_m2_nmi2"], NASC * sv * height, where, 1e-5)
                close(self, row["nasc_school_m2_nmi2"], NASC * school_echo / heard * height, where, 1e-5)
                if sv > 0:
                    self.assertAlmostEqual(float(row["sv_mean_db"]), 10 * math.log10(sv), delta=1e-4)
                    self.assertAlmostEqual(float(row["noise_sv_db"]), 10 * math.log10(noise / heard), delta=1e-4)
            # The unit's column: each channel's mean over all ranges, as high as it is where it is highest.
            units = [r for r in effort if r["transect"] == name]
            self.assertAlmostEqual(sum(float(r["distance_nmi"]) for r in units), sailed, delta=1e-6 * sailed)
            self.assertEqual(sum(int(r["n_pings"]) for r in units), len(of_ping))
            for unit in units:
                column = 0.0
                channels = {k[2] for k in told if k[0] == int(unit["edsu"])}
                for channel in channels:
                    own = {k: v for k, v in cells.cells.items() if k[0] == int(unit["edsu"]) and k[2] == channel and v[1] > 0}
                    if own:
                        height = max(v[0] / cells.area[k[:2]] for k, v in own.items())
                        column += NASC * height * sum(v[3] for v in own.values()) / sum(v[1] for v in own.values())
                close(self, unit["nasc_m2_nmi2"], column, f"{name} EDSU {unit['edsu']}", 1e-5)
        self.assertTrue(any(float(r["filled_fraction"]) > 0 for r in rows if r["filled_fraction"]))
        self.assertTrue(any(r["filled_fraction"] == "0" for r in rows), "water without fish has its rows")

    def test_strata_are_weighted_by_the_length_of_transects(self):
        self.integrate()
        times = sonarx.read_csv(self.out / "effort.csv")
        first = {n: [r for r in times if r["transect"] == n] for n in ("obs-0001", "obs-0002")}
        lines = ["name,stratum,type,start_utc,stop_utc"]
        for name, units in first.items():
            lines.append(f"{name}-t,north,transect,{units[0]['first_time_utc'][:-1]}9Z,{units[-1]['last_time_utc'][:-1]}9Z")
        off = first["obs-0001"][1]
        lines.append(f"trawl,,off,{off['first_time_utc'][:19]}Z,{off['last_time_utc'][:-1]}9Z")
        transects = self.folder / "transects.csv"
        transects.write_text("\n".join(lines) + "\n")
        self.integrate("--transects", transects)
        effort = sonarx.read_csv(self.out / "effort.csv")
        stretches = [r for r in effort if r["type"] == "off"]
        self.assertIn("trawl", [r["transect"] for r in stretches])
        trawl = next(r for r in stretches if r["transect"] == "trawl")
        self.assertEqual(trawl["n_pings"], off["n_pings"])
        self.assertEqual((trawl["n_pings_used"], trawl["nasc_m2_nmi2"], trawl["edsu"]), ("0", "", "0"))
        strata = sonarx.read_csv(self.out / "strata.csv")
        self.assertEqual([r["level"] for r in strata], ["transect", "transect", "stratum", "survey"])
        for column in ("nasc_m2_nmi2", "nasc_school_m2_nmi2"):
            lengths, means = [], []
            for row in strata[:2]:
                units = [r for r in effort if r["transect"] == row["transect"] and r["type"] == "transect"]
                length = sum(float(r["distance_nmi"]) for r in units)
                lengths.append(length)
                means.append(sum(float(r["distance_nmi"]) * float(r[column]) for r in units) / length)
                close(self, row[column], means[-1], row["transect"], 1e-9)
            weights = [x / sum(lengths) for x in lengths]
            mean = sum(w * x for w, x in zip(weights, means))
            error = math.sqrt(2 * sum((w * (x - mean))**2 for w, x in zip(weights, means)))
            for row in strata[2:]:
                close(self, row[column], mean, row["level"], 1e-9)
                close(self, row[column.replace("_m2_nmi2", "_se_m2_nmi2")], error, row["level"], 1e-9)

    def test_threads_change_no_byte(self):
        other = self.fresh("integrate-one")
        (other / "products").symlink_to(self.out / "products")
        self.integrate("--jobs", 1, out=other)
        self.integrate("--jobs", 4)
        for table in ("effort.csv", "nasc.csv", "strata.csv"):
            self.assertEqual((other / table).read_bytes(), (self.out / table).read_bytes(), table)

    def test_without_products_schools_are_unknown_and_said_to_be(self):
        empty = self.fresh("integrate-empty")
        code, _, notes = sonarx.run("integrate", SURVEY, "--out", empty)
        self.assertEqual(code, 0, notes)
        self.assertIn("no-product: obs-0001", notes)
        for row in sonarx.read_csv(empty / "nasc.csv"):
            self.assertEqual(row["filled_fraction"] + row["nasc_school_m2_nmi2"] + row["sv_rest_db"], "")
        self.assertTrue(all(r["n_schools"] == "" for r in sonarx.read_csv(empty / "effort.csv")))

    def test_refuses_in_one_line(self):
        bad = self.folder / "bad.csv"
        bad.write_text("name,stratum,type,start_utc,stop_utc\nA,,line,2020-01-01T00:00:00Z,2020-01-01T01:00:00Z\n")
        self.one_line_error("integrate", SURVEY, "--out", self.out, "--transects", bad, code=1, names=bad)
        self.one_line_error("integrate", SURVEY, "--out", SURVEY / "out", code=2, names=SURVEY)
        self.one_line_error("integrate", SURVEY, "--out", self.out, "--layer-top-m", 50, "--layer-bottom-m", 40, code=2,
                            names="--layer-bottom-m")
        self.one_line_error("integrate", SURVEY, "--out", self.out, "--depth-min-m", 50, "--depth-max-m", 51, code=2,
                            names="--depth-max-m")
        self.one_line_error("integrate", SURVEY, "--out", self.out, "--recipe", self.folder / "recipe.json", code=2,
                            names=self.out)

    def test_what_is_given_back_for_extinction_is_all_that_changes(self):
        """A ratio at which the survey's small schools are dense; schools are found as before, only measured otherwise."""
        self.integrate()
        recipe = json.loads((self.folder / "recipe.json").read_text())
        recipe["measure"]["extinction"].update(correct=True, ratio=30, ratio_low=20, ratio_high=40)
        (self.folder / "corrected.json").write_text(json.dumps(recipe))
        out = self.fresh("integrate-corrected")
        self.sonarx("run", SURVEY, "--out", out, "--recipe", self.folder / "corrected.json")
        code, _, notes = sonarx.run("integrate", SURVEY, "--out", out, "--edsu-nmi", EDSU_NMI, "--range-bin-m", BIN_M,
                                    "--depth-channel-m", CHANNEL_M)
        self.assertEqual(code, 0, notes)
        self.assertIn("extinction-corrected", notes)
        given_back = 0
        for table in ("effort.csv", "nasc.csv", "strata.csv"):
            before, after = (sonarx.read_csv(folder / table) for folder in (self.out, out))
            self.assertEqual(len(before), len(after))
            for row, (was, now) in enumerate(zip(before, after, strict=True)):
                self.assertEqual(was["nasc_extinction_m2_nmi2"], "")
                if not was["nasc_m2_nmi2"]:
                    continue
                back, low, high = (float(now[f"nasc_extinction{end}_m2_nmi2"]) for end in ("", "_low", "_high"))
                close(self, now["nasc_m2_nmi2"], float(was["nasc_m2_nmi2"]) + back, f"{table} {row}", 1e-9)
                given_back += back > 0
                if table == "strata.csv":  # in a cell behind a school what is heard may be below the background
                    self.assertTrue(0 < low < back < high, f"{row}: {low} {back} {high}")
        self.assertGreater(given_back, 10)

    def test_transects_without_pings_are_named(self):
        self.integrate()
        units = sonarx.read_csv(self.out / "effort.csv")
        empty = "lost,north,transect,1999-01-01T00:00:00Z,1999-01-01T01:00:00Z\n"
        table = self.folder / "lost.csv"
        table.write_text("name,stratum,type,start_utc,stop_utc\n" + empty +
                         f"kept,north,transect,{units[0]['first_time_utc']},{units[0]['last_time_utc'][:-1]}9Z\n")
        out = self.fresh("integrate-lost")
        code, _, notes = sonarx.run("integrate", SURVEY, "--out", out, "--transects", table)
        self.assertEqual(code, 0, notes)
        self.assertIn("transect-without-pings: lost", notes)
        self.assertNotIn("transect-without-pings: kept", notes)
        table.write_text("name,stratum,type,start_utc,stop_utc\n" + empty)
        self.one_line_error("integrate", SURVEY, "--out", out, "--transects", table, code=1, names="no transect")

    def test_reduced_raw_files_are_refused(self):
        """What they leave out would count as water without echo."""
        reduced = self.fresh("integrate-reduced")
        self.sonarx("export", self.out, "--to", "raw-reduced", "--survey", SURVEY, "--dest", reduced)
        self.one_line_error("integrate", reduced, "--out", self.fresh("integrate-reduced-out"), code=1, names="raw-reduced")


if __name__ == "__main__":
    sonarx.main()
