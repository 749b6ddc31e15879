# SPDX-License-Identifier: Apache-2.0
"""Products and maps as other people's programs read them: netCDF4, ncdump, UDUNITS, xarray, OGR, and R and QGIS where they are
installed (tools/setup.sh readers)."""
import json
import re
import shutil
import sqlite3
import subprocess
import unittest
import xml.etree.ElementTree

import sonarx
from sonarx import OUT, SURVEY, WORK, Case

try:
    import netCDF4
except ImportError:
    netCDF4 = None
try:
    import xarray
except ImportError:
    xarray = None

PRODUCT = OUT / "products" / "obs-0001.nc"
TIMES = {"pings": ["time"], "schools": ["first_time", "last_time", "decided_time"], "school_pings": ["time"]}


def said(*words, **more):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=300, check=False, **more)
    return done.returncode, done.stdout, done.stderr


def variables(group):
    """(group, name, variable) of a group and those in it."""
    yield from ((group, name, variable) for name, variable in group.variables.items())
    for inner in group.groups.values():
        yield from variables(inner)


class KeepsToCf:
    """What CF asks of every file that is written: `self.file` is open."""

    def test_says_that_it_keeps_to_cf_and_whence_it_comes(self):
        self.assertEqual(self.file.Conventions, "CF-1.11")
        for name in ("title", "source", "history", "sonar_explorer_version", "recipe_hash", "observation"):
            self.assertTrue(self.file.getncattr(name), name)

    def test_every_variable_has_a_name_for_people(self):
        for group, name, variable in variables(self.file):
            self.assertIn("long_name", variable.ncattrs(), f"{group.path}/{name}")

    def test_what_is_unknown_says_so(self):
        for group, name, variable in variables(self.file):
            variable.set_auto_mask(False)
            if variable.dtype in ("float32", "float64") and (variable[...] != variable[...]).any():
                self.assertIn("_FillValue", variable.ncattrs(), f"{group.path}/{name}")

    def test_coordinates_name_variables_of_the_group(self):
        for group, name, variable in variables(self.file):
            if "coordinates" in variable.ncattrs():
                for where in variable.coordinates.split():
                    self.assertIn(where, group.variables, f"{group.path}/{name}")
                    self.assertNotEqual(where, name)

    def test_what_lies_along_pings_and_beams_says_where(self):
        """Coordinates themselves lie along one dimension and have a standard name, or lend the dimension theirs."""
        places = {where for _, _, v in variables(self.file) for where in getattr(v, "coordinates", "").split()}
        for group, name, variable in variables(self.file):
            if len(variable.dimensions) > 1 and group.name != "grid":
                self.assertIn("coordinates", variable.ncattrs(), f"{group.path}/{name}")
            elif getattr(variable, "standard_name", "").startswith("platform_"):
                self.assertTrue("coordinates" in variable.ncattrs() or name in places, f"{group.path}/{name}")

    def test_flags_have_as_many_meanings_as_values(self):
        for group, name, variable in variables(self.file):
            if "flag_meanings" in variable.ncattrs():
                values = variable.flag_masks if "flag_masks" in variable.ncattrs() else variable.flag_values
                self.assertEqual(len(values), len(variable.flag_meanings.split()), f"{group.path}/{name}")
                self.assertEqual(values.dtype, variable.dtype)

    def test_volume_backscattering_strength_has_its_standard_name(self):
        for group, name, variable in variables(self.file):
            if name in ("Sv", "Sv_filtered", "sv_mean_db", "sv_max_db"):
                self.assertEqual(variable.standard_name, "acoustic_volume_backscattering_strength_in_sea_water",
                                 f"{group.path}/{name}")

    @unittest.skipUnless(shutil.which("udunits2"), "udunits-bin is not installed")
    def test_units_are_those_of_udunits(self):
        for unit in sorted({v.units for _, _, v in variables(self.file) if "units" in v.ncattrs()}):
            if unit.startswith("dB"):  # a ratio, which UDUNITS does not write so: the exception that the docs list
                continue
            code, told, error = said("udunits2", "-H", unit, "-W", "")
            self.assertEqual(code, 0, f"{unit}: {told}{error}")


@unittest.skipIf(netCDF4 is None, "python3-netcdf4 is not installed")
class Exported(KeepsToCf, Case):
    FORMAT, ALSO = "sv", ("--survey", SURVEY)

    @classmethod
    def setUpClass(cls):
        cls.folder = WORK / f"cf-{cls.FORMAT}"
        code, out, err = sonarx.run("export", OUT, "--to", cls.FORMAT, "-o", cls.folder, *cls.ALSO)
        assert code == 0, out + err

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.file = netCDF4.Dataset(min(self.folder.glob("*.nc")))
        self.addCleanup(self.file.close)


class ExportedMasks(Exported):
    FORMAT, ALSO = "netcdf-mask", ()


@unittest.skipIf(netCDF4 is None, "python3-netcdf4 is not installed")
class Netcdf(KeepsToCf, Case):
    def setUp(self):
        self.product = self.file = netCDF4.Dataset(PRODUCT)
        self.addCleanup(self.product.close)

    def test_its_version(self):
        self.assertEqual(int(self.product.product_version), 2)

    def test_what_may_be_unknown_says_so_and_keys_never_are(self):
        for group, name, variable in variables(self.file):
            if name in ("school_id", "ping_index", "time_ns") and group.name != "diagnostics":
                self.assertNotIn("_FillValue", variable.ncattrs(), f"{group.path}/{name}")
            if group.name in ("pings", "schools", "school_pings", "rejected") and variable.dtype == "float64":
                self.assertIn("_FillValue", variable.ncattrs(), f"{group.path}/{name}")
        for name in ("vertical_width", "horizontal_width", "psi_used", "psi_stated", "psi_from_widths", "psi_excess"):
            self.assertIn("_FillValue", self.product["grid"][name].ncattrs(), name)

    def test_edges_are_bits(self):
        edges = self.product["school_pings"]["edge_flags"]
        self.assertEqual(edges.flag_masks.tolist(), [2 ** i for i in range(9)])

    def test_times_are_dates_to_every_reader(self):
        rows = sonarx.read_csv(OUT / "school_pings.csv")
        of_pings = [r["time_utc"] for r in rows if r["observation"] == "obs-0001"]
        times = self.product["school_pings"]["time"]
        dates = netCDF4.num2date(times[:], times.units, times.calendar, only_use_cftime_datetimes=False)
        self.assertEqual([d.isoformat(timespec="milliseconds") + "Z" for d in dates], of_pings)
        # numpy's rounding of the milliseconds is to the even; the key is exact
        exact = self.product["pings"]["time_ns"][:]
        self.assertTrue((exact // 1000 == self.product["pings"]["time"][:]).all())

    def test_no_time_is_no_date(self):
        decided = self.product["schools"]["decided_time"][:]
        self.assertTrue(decided.mask.all(), "nobody has decided anything")

    def test_masks_are_a_ragged_array(self):
        count = self.product["mask"]["sample_count"]
        self.assertEqual(count.sample_dimension, "voxel")
        self.assertEqual(int(count[:].sum()), len(self.product["mask"].dimensions["voxel"]))

    @unittest.skipUnless(shutil.which("udunits2"), "udunits-bin is not installed")
    def test_the_log_counts_nautical_miles(self):
        self.assertEqual(self.product["pings"]["distance"].units, "nautical_mile")
        self.assertIn("1852 m", said("udunits2", "-H", "nautical_mile", "-W", "m")[1])

    @unittest.skipUnless(shutil.which("ncdump"), "netcdf-bin is not installed")
    def test_ncdump_reads_it_without_a_word(self):
        """Its -t knows no unit shorter than a second: it shows the numbers."""
        code, told, error = said("ncdump", "-t", "-v", "/pings/time", PRODUCT)
        self.assertEqual((code, error), (0, ""))
        first = int(self.product["pings"]["time"][0])
        self.assertTrue(f" time = {first}," in told, "the first ping's time")


@unittest.skipIf(xarray is None, "python3-xarray is not installed")
class Xarray(Case):
    def test_groups_open_with_dates_and_missing_values(self):
        for group, names in TIMES.items():
            with xarray.open_dataset(PRODUCT, group=group) as opened:
                for name in names:
                    self.assertEqual(opened[name].dtype.kind, "M", f"{group}/{name}")
        with xarray.open_dataset(PRODUCT, group="school_pings") as opened, \
                xarray.open_dataset(PRODUCT, group="pings") as pings:
            self.assertIn("latitude", opened.coords)
            # To the last bit: schools are joined with pings by time.
            self.assertTrue(opened["time"].isin(pings["time"]).all())
            rows = [r for r in sonarx.read_csv(OUT / "school_pings.csv") if r["observation"] == "obs-0001"]
            for row, sv in zip(rows, opened["sv_mean_db"].values):
                self.assertEqual(float(row["sv_mean_db"] or "nan") == sv or sv != sv, True)


class Map(Case):
    def setUp(self):
        self.map = sqlite3.connect(f"file:{OUT / 'survey.gpkg'}?mode=ro", uri=True)
        self.addCleanup(self.map.close)
        self.layers = [r[0] for r in self.map.execute("SELECT table_name FROM gpkg_geometry_columns")]

    def test_every_layer_has_a_style_that_is_its_default(self):
        styles = dict(self.map.execute("SELECT f_table_name, styleQML FROM layer_styles WHERE useAsDefault = 1"))
        self.assertEqual(sorted(styles), sorted(self.layers))
        for layer, qml in styles.items():
            root = xml.etree.ElementTree.fromstring(re.sub(r"<!DOCTYPE[^>]*>", "", qml))
            self.assertEqual(root.tag, "qgis", layer)
            self.assertIsNotNone(root.find("renderer-v2/symbols/symbol/layer"), layer)
        self.assertIn('attr="coalesce(sv_mean_db, -150)"', styles["schools"])
        for symbol, range_ in zip(*(xml.etree.ElementTree.fromstring(re.sub(r"<!DOCTYPE[^>]*>", "", styles["schools"]))
                                    .findall(p) for p in ("renderer-v2/symbols/symbol", "renderer-v2/ranges/range"))):
            self.assertEqual(symbol.get("name"), range_.get("symbol"))

    def test_columns_are_described_with_their_units(self):
        described = dict(self.map.execute(
            "SELECT column_name, description FROM gpkg_data_columns WHERE table_name = 'schools'"))
        names = [r[1] for r in self.map.execute("PRAGMA table_info(schools)") if r[1] not in ("fid", "geom")]
        self.assertEqual(sorted(described), sorted(names))
        self.assertTrue(described["backscatter_m2"].endswith("[m2]"))
        self.assertIn("sigma_bs", described["backscatter_m2"])
        extensions = {r[0] for r in self.map.execute("SELECT extension_name FROM gpkg_extensions")}
        self.assertIn("gpkg_schema", extensions)

    @unittest.skipUnless(shutil.which("ogrinfo"), "gdal-bin is not installed")
    def test_ogr_reads_it_without_a_word(self):
        code, told, error = said("ogrinfo", "-ro", "-al", "-so", OUT / "survey.gpkg")
        self.assertEqual((code, error), (0, ""))
        for layer in self.layers:
            self.assertIn(f"Layer name: {layer}", told)

    @unittest.skipUnless(shutil.which("ogrinfo"), "gdal-bin is not installed")
    def test_ogr_reads_the_layers_as_geojson_too(self):
        folder = self.fresh("ogr-geojson")
        self.sonarx("export", OUT, "--to", "geojson", "-o", folder)
        files = sorted(folder.rglob("*.geojson"))
        self.assertTrue(files)
        for file in files:
            code, told, error = said("ogrinfo", "-ro", "-al", "-so", file)
            self.assertEqual((code, error), (0, ""))
            self.assertIn(f"Feature Count: {len(json.loads(file.read_text())['features'])}\n", told)

    def test_schools_have_numbers_that_are_unique_in_the_survey(self):
        schools = sonarx.read_csv(OUT / "schools.csv")
        numbers = [int(s["survey_school"]) for s in schools]
        self.assertEqual(numbers, list(range(1, len(schools) + 1)))
        known = {(s["observation"], s["school_id"]): s["survey_school"] for s in schools}
        for row in sonarx.read_csv(OUT / "school_pings.csv"):
            self.assertEqual(row["survey_school"], known[row["observation"], row["school_id"]])
        self.assertEqual(sorted(r[0] for r in self.map.execute("SELECT survey_school FROM schools")), numbers)

    def test_numbers_stay_when_a_file_is_added(self):
        """The second observation's file first, then both: the first one's schools get the numbers behind."""
        folder = self.fresh("numbers")
        files = sorted(sonarx.SURVEY.glob("*.raw"))
        (folder / "survey").mkdir()
        (folder / "survey" / files[1].name).symlink_to(files[1])
        self.sonarx("run", folder / "survey", "--out", folder / "out")
        before = [r["survey_school"] for r in sonarx.read_csv(folder / "out" / "schools.csv")]
        (folder / "survey" / files[0].name).symlink_to(files[0])
        self.sonarx("run", folder / "survey", "--out", folder / "out")
        after = sonarx.read_csv(folder / "out" / "schools.csv")
        self.assertEqual([r["survey_school"] for r in after if r["observation"] == "obs-0002"], before)
        self.assertEqual(sorted(int(r["survey_school"]) for r in after), list(range(1, len(after) + 1)))


if __name__ == "__main__":
    sonarx.main()
