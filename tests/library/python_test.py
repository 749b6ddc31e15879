# SPDX-License-Identifier: Apache-2.0
"""The Python module on the small survey: arrays against a second reader of the raw files, schools against the tables."""
import gc
import inspect
import os
import signal
import sys
import threading
import time
import unittest
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
sys.path.insert(0, sys.argv.pop(1))  # where the built module lies
import numpy
import raw_reader
import sonarx
from sonarx import OUT, SURVEY, WORK, Case

os.environ["XDG_CACHE_HOME"] = str(WORK / "cache")
import sonar_explorer as se

try:
    import xarray
except ImportError:
    xarray = None


class Opened(Case):
    @classmethod
    def setUpClass(cls):
        cls.survey = se.open_survey(SURVEY)
        cls.observation = cls.survey.observation("obs-0001")
        cls.rows = [r for r in sonarx.read_csv(OUT / "school_pings.csv") if r["observation"] == "obs-0001"]
        cls.product = se.read_product(OUT / "products" / "obs-0001.nc")

    def seed(self):
        """A ping with a school and the middle voxel of that school's longest run."""
        mask = max(self.product.masks, key=lambda m: len(m.confidence))
        run = max(mask.runs, key=lambda r: r.count)
        return mask, (run.fan, run.beam, run.first_sample + run.count // 2)


class Survey(Opened):
    def test_observations_with_their_names_and_lengths(self):
        self.assertEqual([o.name for o in self.survey.observations], ["obs-0001", "obs-0002"])
        self.assertEqual([len(o) for o in self.survey.observations], [14, 14])
        self.assertIn("synthetic", self.observation.sounder)
        self.assertEqual(self.survey.notes, [])

    def test_a_path_may_be_text_path_or_list(self):
        files = sorted(SURVEY.glob("*.raw"))
        self.assertEqual(len(se.open_survey(str(SURVEY)).observations), 2)
        self.assertEqual(len(se.open_survey(files).observations), 2)
        self.assertEqual(len(se.open_survey(tuple(map(str, files))).observations), 2)

    def test_places_are_those_of_the_tables(self):
        places = self.observation.places
        times = numpy.array([p.time_ns for p in places], "datetime64[ns]")
        for row in self.rows:
            ms = numpy.datetime64(row["time_utc"].rstrip("Z"), "ms")
            self.assertLessEqual(abs(times[int(row["ping_index"])] - ms), numpy.timedelta64(1, "ms"))
        self.assertTrue(all(58 < p.latitude_deg < 63 for p in places))

    def test_coordinates(self):
        grid = self.observation.grid
        self.assertEqual(grid.shape, (20, 25, len(grid.range_m)))
        self.assertTrue((numpy.diff(grid.range_m) > 0).all())
        self.assertEqual(self.observation.cell_volumes_m3.shape, grid.shape)
        self.assertEqual(len(grid.frequency_hz), 20)


class Arrays(Opened):
    def test_power_and_sv_are_those_of_a_second_reader(self):
        place = self.observation.places[3]
        ping = self.observation.ping(3)
        beams, found = [], {}
        for file in sorted(SURVEY.glob("*.raw")):
            config, pings = raw_reader.pings(file.read_bytes(), {place.time_ns})
            if pings:
                beams, found = config, pings[place.time_ns]
        self.assertEqual(len(found), 500)
        channels = self.observation.grid.channel
        worst = 0.0
        for fan, beam in ((0, 0), (7, 12), (19, 24)):
            raw = found[channels[fan, beam]]
            stored = slice(raw["offset"], raw["offset"] + len(raw["counts"]))
            self.assertTrue((ping.power[fan, beam, stored] == raw["counts"]).all())
            sv = ping.sv[fan, beam, stored] * se.DB_PER_COUNT
            worst = max(worst, numpy.abs(sv - raw_reader.sv_db(raw, beams[channels[fan, beam]]))[1:].max())
        self.assertLess(worst, 0.01)  # half a count, and tables of the gain in single precision

    def test_arrays_are_views_that_nobody_writes_to(self):
        ping = self.observation.ping(0)
        for name, dtype in (("power", "int16"), ("sv", "int16"), ("sv_filtered", "int16"), ("flags", "uint8")):
            array = getattr(ping, name)
            self.assertEqual((array.shape, array.dtype), (ping.shape, numpy.dtype(dtype)), name)
            self.assertTrue(numpy.shares_memory(array, getattr(ping, name)), f"{name} is copied")
            with self.assertRaises(ValueError):
                array[0, 0, 0] = 0
        self.assertEqual(ping.background_power_db.shape, ping.shape[:2])

    def test_arrays_outlive_their_ping(self):
        sv = self.observation.ping(0).sv
        sum_before = int(sv.astype("int64").sum())
        gc.collect()
        for index in range(1, 6):
            self.observation.ping(index)
        self.assertEqual(int(sv.astype("int64").sum()), sum_before)


class Schools(Opened):
    def test_detect_is_what_run_finds(self):
        found = se.detect(self.observation)
        for mine, theirs in ((found.schools, self.product.schools), (found.school_pings, self.product.school_pings)):
            self.assertEqual(list(mine), list(theirs))
            for name in ("school_id", "sv_mean_db", "volume_m3"):
                numpy.testing.assert_array_equal(mine[name], theirs[name], name)
        self.assertEqual([m.confidence for m in found.masks], [m.confidence for m in self.product.masks])

    def test_products_read_as_the_tables_say(self):
        self.assertEqual(self.product.observation, "obs-0001")
        table = self.product.school_pings
        numpy.testing.assert_allclose(table["sv_mean_db"], [float(r["sv_mean_db"]) for r in self.rows], rtol=1e-12)
        self.assertEqual(list(table["school_id"]), [int(r["school_id"]) for r in self.rows])

    def test_school_ids_are_the_masks(self):
        mask, (fan, beam, sample) = self.seed()
        ids = self.product.school_ids(mask.ping_index)
        self.assertEqual(ids[fan, beam, sample], mask.school_id)
        of_ping = sum(len(m.confidence) for m in self.product.masks if m.ping_index == mask.ping_index)
        self.assertEqual(int((ids > 0).sum()), of_ping)

    def test_grow_takes_the_seed_and_propagate_reaches_further(self):
        mask, seed = self.seed()
        grown = se.grow(self.observation, mask.ping_index, seed)
        ids = grown.school_ids(mask.ping_index)
        self.assertGreater(ids[seed], 0)
        self.assertEqual({m.ping_index for m in grown.masks}, {mask.ping_index})
        wider = se.grow(self.observation, mask.ping_index, [seed], tolerance_db=30.0)
        self.assertGreater(len(wider.masks[0].confidence), len(grown.masks[0].confidence))
        followed = se.propagate(self.observation, mask.ping_index, seed, reach=1)
        pings = {m.ping_index for m in followed.masks}
        self.assertLessEqual(pings, {mask.ping_index + d for d in (-1, 0, 1)})
        self.assertGreater(len(pings), 1)

    def test_measure_works_out_other_masks_anew(self):
        again = se.measure(self.observation, self.product)
        numpy.testing.assert_array_equal(again.school_pings["sv_mean_db"], self.product.school_pings["sv_mean_db"])
        masks = self.product.masks
        halved = self.product.with_masks([m for m in masks if m.ping_index % 2 == 0])
        fewer = se.measure(self.observation, halved).school_pings
        kept = [i for i, p in enumerate(self.product.school_pings["ping_index"]) if p % 2 == 0]
        numpy.testing.assert_array_equal(fewer["volume_m3"], self.product.school_pings["volume_m3"][kept])

    def test_a_product_written_is_the_product_read(self):
        file = self.fresh("python-product") / "obs-0001.nc"
        self.product.write(file)
        again = se.read_product(file)
        self.assertEqual([m.confidence for m in again.masks], [m.confidence for m in self.product.masks])

    def test_a_product_is_written_only_where_a_folder_is(self):
        missing = self.fresh("python-missing") / "folder"
        with self.assertRaises(se.Error) as caught:
            self.product.write(missing / "obs-0001.nc")
        self.assertEqual((caught.exception.kind, str(caught.exception)),
                         ("not_found", f"{missing}: no such folder to write to"))
        self.assertFalse(missing.exists())


@unittest.skipIf(xarray is None, "python3-xarray is not installed")
class Datasets(Opened):
    FILE = OUT / "products" / "obs-0001.nc"

    def test_are_named_and_described_as_in_the_file(self):
        def told(attributes):
            return {k: v.tolist() if isinstance(v, numpy.ndarray) else v for k, v in attributes.items()}

        for group, mine in (("schools", self.product.schools_dataset()),
                            ("school_pings", self.product.school_pings_dataset())):
            with xarray.open_dataset(self.FILE, group=group) as file:
                self.assertEqual(set(mine.coords), set(file.coords))
                self.assertEqual(set(mine.variables), set(file.variables))
                self.assertEqual(mine.sizes, file.sizes)
                for name, variable in file.variables.items():
                    self.assertEqual(told(mine[name].attrs), told(variable.attrs), f"{group}/{name}")
        self.assertEqual(mine["volume_m3"].attrs["units"], "m3")
        self.assertEqual(mine["edge_flags"].attrs["flag_masks"].tolist(), [2 ** i for i in range(9)])
        self.assertIn("seabed", mine["edge_flags"].attrs["flag_meanings"].split())

    def test_times_are_those_of_the_pings_to_the_last_bit(self):
        with xarray.open_dataset(self.FILE, group="pings") as file:
            times = file["time"].values
        rows, schools = self.product.school_pings_dataset(), self.product.schools_dataset()
        for dataset in (rows, schools):
            for name in (n for n in dataset.variables if n.endswith("time")):
                self.assertEqual(dataset[name].dtype, numpy.dtype("datetime64[ns]"), name)
        self.assertTrue((rows["time"].values == times[self.product.school_pings["ping_index"]]).all())
        for school in schools["school_id"].values:
            seen = rows["ping_index"].values[rows["school_id"].values == school]
            of = schools.isel(school=schools["school_id"].values == school)
            self.assertEqual((of["first_time"].item(), of["last_time"].item()),
                             (times[seen.min()].item(), times[seen.max()].item()))
        self.assertTrue(numpy.isnat(schools["decided_time"].values).all())

    def test_can_be_written_and_read(self):
        file = self.fresh("python-dataset") / "rows.nc"
        rows = self.product.school_pings_dataset()
        rows.to_netcdf(file)
        with xarray.open_dataset(file) as again:
            self.assertEqual(list(again["sv_mean_db"].values), list(rows["sv_mean_db"].values))


class Errors(Opened):
    def refused(self, kind, part, call, *arguments, **more):
        with self.assertRaises(se.Error) as caught:
            call(*arguments, **more)
        self.assertEqual(caught.exception.kind, kind, caught.exception)
        self.assertIn(part, str(caught.exception))
        self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_each_is_the_command_lines_one_line(self):
        self.refused("not_found", "/not/there", se.open_survey, "/not/there")
        self.refused("not_found", "/not/there.nc", se.read_product, "/not/there.nc")
        self.refused("usage", "obs-0009", self.survey.observation, "obs-0009")
        self.refused("bad_parameter", "detect.none", se.Recipe().with_value, "detect.none", 1)
        self.refused("bad_parameter", "0.1 .. 60", se.Recipe().with_value, "detect.tolerance_db", -3)
        self.refused("usage", "no ping 99: obs-0001 has pings 0 to 13", self.observation.ping, 99)
        self.refused("usage", "no ping -1: obs-0001 has pings 0 to 13", self.observation.ping, -1)
        self.refused("usage", "no ping 99: obs-0001 has pings 0 to 13", self.product.school_ids, 99)
        self.refused("usage", "no ping -1: obs-0001 has pings 0 to 13", self.product.school_ids, -1)
        self.refused("usage", "no ping -1: obs-0001 has pings 0 to 13", se.grow, self.observation, -1, (9, 9, 400))
        self.refused("bad_parameter", "25", se.grow, self.observation, 0, (0, 25, 10))
        self.refused("bad_parameter", "mode paper", se.grow, self.observation, 0, (9, 9, 400), tolerance_opacity=0.2)
        self.refused("mismatch", "obs-000", se.measure, self.survey.observation("obs-0002"), self.product)

    def test_a_seed_where_nothing_grows_is_told_without_the_journal(self):
        with self.assertRaises(se.Error) as caught:
            se.grow(self.observation, 6, (9, 9, 400))
        self.assertEqual(caught.exception.kind, "bad_parameter")
        self.assertRegex(str(caught.exception), r"^ping 6: the seed at fan 9, beam 9, sample 400 ")

    def test_arguments_that_do_not_fit_are_one_plain_line(self):
        mask = self.product.masks[0]
        wrong = numpy.zeros((30, 30))
        for call, name, got in (
                (lambda: se.open_survey(3), "open_survey: expected (paths: ", "got (3)"),
                (lambda: se.open_survey([3]), "open_survey: expected (paths: ", "got ([3])"),
                (lambda: se.open_survey(SURVEY, threads="two"), "open_survey: expected (paths: ", "threads='two')"),
                (lambda: se.read_product(3), "read_product: expected (path: ", "got (3)"),
                (lambda: se.detect(3), "detect: expected (observation: Observation)", "got (3)"),
                (lambda: se.detect(wrong), "detect: expected (observation: Observation)", "got (array([[0., 0., "),
                (se.detect, "detect: expected (observation: Observation)", "got ()"),
                (lambda: se.grow(self.observation, 6, "abc"), "grow: expected (observation: ", ", 6, 'abc')"),
                (lambda: se.grow(self.observation, 6, (1, 2)), "grow: expected (observation: ", ", 6, (1, 2))"),
                (lambda: se.grow(self.observation, 6, (1, 2, 3), db=1), "grow: expected (observation: ", "db=1)"),
                (lambda: self.observation.ping(1.5), "ping: expected (self: Observation, index: int)", ", 1.5)"),
                (lambda: self.observation.ping(2 ** 70), "ping: expected (self: Observation, index: int)",
                 f", {2 ** 70})"),
                (lambda: self.survey.observation(1), "observation: expected (self: Survey, name: str)", ", 1)"),
                (lambda: self.product.with_masks([1]), "with_masks: expected (self: Product, masks: ", ", [1])"),
                (lambda: self.product.school_ids("a"), "school_ids: expected (self: Product, ping: int)", ", 'a')"),
                (lambda: se.Recipe.from_json(3), "from_json: expected (text: str)", "got (3)"),
                (lambda: se.MaskRun(1, 2), "expected MaskRun(fan: int, beam: int, first_sample: int, count: int)",
                 "got (1, 2)"),
                (lambda: setattr(mask, "runs", 3), "expected (self: Mask, ", ", 3)"),
        ):
            with self.assertRaises(TypeError, msg=name) as caught:
                call()
            line = str(caught.exception)
            self.assertTrue(line.startswith(name), line)
            self.assertIn(got, line)
            self.assertNotRegex(line, r"\n|C\+\+|std::|incompatible|object at 0x|sonar_explorer\.")
            self.assertLess(len(line), 600)

    def test_what_python_refuses_stays_as_it_was(self):
        with self.assertRaisesRegex(TypeError, "JSON serializable"):
            se.Recipe().with_value("automatic", {1})

    def test_no_seed(self):
        self.refused("bad_parameter", "no seed is given", se.grow, self.observation, 6, [])


class Interrupted(Opened):
    def test_ctrl_c_ends_what_runs_and_leaves_the_survey_whole(self):
        big = self.fresh("interrupted")
        code, out, error = sonarx.run("simulate", big, "--preset", "demo", "--seed", "3")
        self.assertEqual(code, 0, out + error)
        observation = se.open_survey(big).observations[0]
        ended = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
        ended.start()
        begun = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(100):
                se.detect(observation)
        self.assertLess(time.monotonic() - begun, 30)
        self.assertEqual(observation.ping(0).sv.shape, observation.ping(1).sv.shape)


class Recipes(Case):
    OLD = '{"recipe_version": 1, "flags": {"wall": {"enabled": false}}}'

    def test_with_another_value(self):
        recipe = se.Recipe().with_value("detect.tolerance_db", 8.5).with_value("automatic", False)
        self.assertNotEqual(recipe.hash, se.Recipe().hash)
        self.assertEqual(se.Recipe.from_json(recipe.to_json()).hash, recipe.hash)

    def test_names_of_earlier_versions_are_warned_of_at_the_line_that_reads_them(self):
        file = self.fresh("python-recipe") / "old.json"
        file.write_text(self.OLD)
        for read, what in ((se.Recipe.from_json, self.OLD), (se.Recipe.from_file, file)):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                recipe = read(what)
            self.assertEqual([(str(w.message), w.filename) for w in caught],
                             [("flags.wall is called flags.interference now", __file__)])
            self.assertEqual(recipe.notes, ["flags.wall is called flags.interference now"])

    def test_a_warning_may_be_an_error(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaisesRegex(UserWarning, "flags.interference"):
                se.Recipe.from_json(self.OLD)
            self.assertEqual(se.Recipe.from_json(se.Recipe().to_json()).notes, [])


class Documented(Opened):
    CLASSES = [c for c in vars(se).values() if isinstance(c, type) and not issubclass(c, Exception)]

    @staticmethod
    def parts():
        """(name, thing, its docstring without the signature that pybind11 writes before it)"""
        for name, thing in vars(se).items():
            if name.startswith("_") or not callable(thing):
                continue
            found = [(name, thing)]
            if isinstance(thing, type) and not issubclass(thing, Exception):
                # An __init__ that is no instancemethod refuses: there is no such constructor.
                members = [(k, getattr(v, "__func__", v)) for k, v in vars(thing).items()
                           if not k.startswith("_") or (k == "__init__" and hasattr(v, "__func__"))]
                found += [(f"{name}.{k}", v) for k, v in members]
            for full, part in found:
                text = part.__doc__ or ""
                signed = not isinstance(part, (type, property))
                yield full, part, text.partition("\n\n")[2].strip() if signed else text

    def test_everything_says_what_it_is(self):
        """Each in words that stand alone, and no signature shows where an object lies."""
        for name, part, words in self.parts():
            if not name.endswith(".shape"):
                self.assertGreaterEqual(len(words.split()), 2, name)
            self.assertNotRegex(words, r"^(The same|Also|It |As )", name)
            self.assertNotIn("object at 0x", part.__doc__, name)

    def test_arrays_say_their_type_and_axes(self):
        for name, part, words in self.parts():
            returns = (part.fget if isinstance(part, property) else part).__doc__ or ""
            array = inspect.cleandoc(returns).splitlines()[0].partition("-> numpy.ndarray[")[2]
            if array:
                self.assertRegex(words, rf"^{array.rstrip(']').removeprefix('numpy.')} \[", name)

    def test_what_may_be_refused_is_told(self):
        for name, part, words in self.parts():
            if not isinstance(part, (type, property)) and not name.endswith(("__init__", "to_json")):
                self.assertIn("Raises ", words, name)

    def test_decibels_and_metres_have_units(self):
        for name, part, words in self.parts():
            for ending, unit in (("_db", "dB"), ("_hz", "Hz"), ("_m", " m"), ("_m3", "m3"), ("_deg", "degrees"),
                                 ("_mps", "m/s"), ("_ns", "nanoseconds"), (".sv", "dB re 1 m-1"),
                                 ("_filtered", "dB re 1 m-1")):
                if isinstance(part, property) and name.endswith(ending):
                    self.assertIn(unit, words, name)
        for function in (se.grow, se.propagate):
            for told in ("'tracked'", "'paper'", "dB, 0.1 to 60", "0 to 1", "grow.tolerance_db", "(fan, beam, sample)"):
                self.assertIn(told, function.__doc__)
        self.assertIn("recipe: sonar_explorer.Recipe = Recipe()", se.open_survey.__doc__)

    def test_what_is_printed_says_what_it_is(self):
        mask = self.product.masks[0]
        shown = [se.Recipe(), self.survey, self.observation, self.observation.grid, self.observation.places[0],
                 self.observation.ping(0), self.product, mask, mask.runs[0]]
        self.assertEqual({type(one) for one in shown}, set(self.CLASSES))
        for one in shown:
            self.assertIn(type(one).__name__, repr(one))
            self.assertNotIn("object at 0x", repr(one))
        self.assertEqual(repr(self.observation), "<Observation obs-0001, 14 pings>")
        self.assertEqual(repr(self.survey), "<Survey, 2 observations, 28 pings>")
        self.assertEqual(repr(se.MaskRun(1, 2, 3, 4)), "MaskRun(fan=1, beam=2, first_sample=3, count=4)")
        place = self.observation.places[0]
        self.assertIn(str(numpy.datetime64(place.time_ns, "ns")), repr(place))
        self.assertIn(f"{len(self.product.schools['school_id'])} schools", repr(self.product))


if __name__ == "__main__":
    sonarx.main()
