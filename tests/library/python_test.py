# SPDX-License-Identifier: Apache-2.0
"""The Python module on the small survey: arrays against a second reader of the raw files, schools against the tables."""
import gc
import os
import signal
import sys
import threading
import time
import unittest
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

    @unittest.skipIf(xarray is None, "python3-xarray is not installed")
    def test_datasets_have_units(self):
        schools = self.product.schools_dataset()
        self.assertEqual(schools["volume_m3"].attrs["units"], "m3")
        self.assertEqual(schools.sizes["school"], len(self.product.schools["school_id"]))
        self.assertIn("sv_mean_db", self.product.school_pings_dataset())


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
        self.refused("usage", "99", self.observation.ping, 99)
        self.refused("bad_parameter", "25", se.grow, self.observation, 0, (0, 25, 10))
        self.refused("bad_parameter", "mode paper", se.grow, self.observation, 0, (9, 9, 400), tolerance_opacity=0.2)
        self.refused("mismatch", "obs-000", se.measure, self.survey.observation("obs-0002"), self.product)

    def test_a_seed_of_two_numbers(self):
        with self.assertRaises(ValueError):
            se.grow(self.observation, 0, (1, 2))


class Interrupted(Opened):
    def test_ctrl_c_ends_what_runs_and_leaves_the_survey_whole(self):
        big = WORK / "interrupted"
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


class Documented(unittest.TestCase):
    def test_everything_says_what_it_is(self):
        bare = []
        for name, thing in vars(se).items():
            if name.startswith("_") or not callable(thing):
                continue
            parts = [(name, thing)]
            if isinstance(thing, type) and not issubclass(thing, Exception):
                parts += [(f"{name}.{k}", v) for k, v in vars(thing).items() if not k.startswith("_")]
            # pybind11 writes the signature itself: a sentence must follow it
            bare += [n for n, part in parts if len((part.__doc__ or "").split("\n\n")[-1].split()) < 2]
        self.assertEqual(bare, [])

    def test_recipe(self):
        recipe = se.Recipe().with_value("detect.tolerance_db", 8.5).with_value("automatic", False)
        self.assertNotEqual(recipe.hash, se.Recipe().hash)
        self.assertEqual(se.Recipe.from_json(recipe.to_json()).hash, recipe.hash)


if __name__ == "__main__":
    sonarx.main()
