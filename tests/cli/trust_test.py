# SPDX-License-Identifier: Apache-2.0
"""What others may have laid in the folders that the program works in: nothing of theirs is changed, nothing recorded is
written over."""
import shutil

import sonarx
from sonarx import OUT, SURVEY, TRUTH, Case, contents, snapshot


class Journals(Case):
    def test_a_recipe_in_a_journal_that_is_wrong_names_the_journal(self):
        folder = self.fresh("trust-journal")
        journal = folder / "choices.jsonl"
        journal.write_text('{"journal_version":1,"recipe":{"recipe_version":1,"detect":{"false_alarm":-5}},"files":[]}\n')
        # As a recipe named with --recipe: what a file says is no wrong usage.
        self.one_line_error("run", SURVEY, "--out", folder / "out", "--session", journal, code=1, names=f"{journal}: ")
        self.assertFalse((folder / "out").exists())
        shutil.rmtree(folder)


class Links(Case):
    """A folder of ours that is a link to somebody else's."""

    def setUp(self):
        self.folder = self.fresh("trust-links")
        self.theirs = self.folder / "theirs"
        self.out = self.folder / "out"

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_earlier_products_behind_a_link_are_let_be(self):
        shutil.copytree(OUT / "products", self.theirs)
        shutil.copytree(OUT, self.out)
        (self.out / "earlier").symlink_to(self.theirs)
        before = snapshot(self.theirs)
        self.sonarx("merge", self.out)
        self.assertEqual(snapshot(self.theirs), before)
        self.one_line_error("run", SURVEY, "--out", self.out, "--recipe", self.other_recipe(), code=1,
                            names=self.out / "earlier")
        self.assertEqual(snapshot(self.theirs), before)

    def other_recipe(self):
        file = self.folder / "recipe.json"
        file.write_text(self.sonarx("recipe").replace('"false_alarm": 2.0', '"false_alarm": 1.9'))
        return file

    def test_products_are_not_written_through_a_link(self):
        self.theirs.mkdir()
        self.out.mkdir()
        (self.out / "products").symlink_to(self.theirs)
        code, _, error = sonarx.run("run", SURVEY, "--out", self.out)
        self.assertNotEqual(code, 0)
        self.assertIn(f"{self.out}/products: is a link", error)
        self.assertEqual(list(self.theirs.iterdir()), [])

    def test_a_simulation_does_not_empty_what_a_link_names(self):
        shutil.copytree(TRUTH, self.theirs)
        before = snapshot(self.theirs)
        self.out.mkdir()
        (self.out / "truth").symlink_to(self.theirs)
        self.one_line_error("simulate", self.out, "--preset", "standard", "--force", code=1, names=self.out / "truth")
        self.assertEqual(snapshot(self.theirs), before)


class Recordings(Case):
    """No verb writes over a recording or beside recordings, whatever it was told of them."""

    def setUp(self):
        self.folder = self.fresh("trust-recordings")
        self.survey = self.folder / "survey"
        self.survey.mkdir()
        self.raw = self.survey / "a.raw"
        with open(next(SURVEY.glob("*.raw")), "rb") as source:
            self.raw.write_bytes(source.read(1_000_000))
        # The same under another name, in a folder of its own.
        self.renamed = self.folder / "elsewhere" / "recorded.png"
        self.renamed.parent.mkdir()
        shutil.copy(self.raw, self.renamed)
        self.before = contents(self.folder)

    def tearDown(self):
        self.assertEqual(contents(self.folder), self.before)
        shutil.rmtree(self.folder)

    def refused(self, *arguments, names):
        code, out, error = sonarx.run(*arguments)
        self.assertNotEqual(code, 0, out)
        self.assertIn(str(names), error)

    def test_pictures(self):
        reference = sonarx.WORK / "trust-reference.png"
        draw = ["render", "observation-map", OUT, "--size", "320x240"]
        self.sonarx(*draw, "--out", reference)
        self.refused(*draw, "--out", self.survey / "x.png", names=self.survey)
        self.refused(*draw, "--reference", reference, "--difference", self.survey / "x.png", names=self.survey)
        self.refused(*draw, "--reference", reference, "--difference", self.raw, names=self.raw)
        self.refused(*draw, "--out", self.renamed, names=self.renamed)

    def test_the_survey_of_the_products_is_known_by_their_plan(self):
        inside = SURVEY / "truth"
        before = snapshot(SURVEY)
        self.refused("render", "observation-map", OUT, "--out", inside / "x.png", names=inside)
        self.assertEqual(snapshot(SURVEY), before)

    def test_tables_maps_and_products(self):
        for to in ("csv", "gpkg", "geojson", "netcdf-mask"):
            self.refused("export", OUT, "--to", to, "--dest", self.survey, names=self.survey)
        out = self.folder / "out"
        shutil.copytree(OUT, out)
        shutil.copy(self.raw, out)
        before = contents(out)
        self.refused("merge", out, names=out)
        self.assertEqual(contents(out), before)
        shutil.rmtree(out)

    def test_reduced_recordings_replace_no_recording(self):
        dest = self.folder / "dest"
        dest.mkdir()
        name = sorted(p.name for p in SURVEY.glob("*.raw"))[0]
        shutil.copy(self.raw, dest / name)
        self.refused("export", OUT, "--to", "raw-reduced", "--survey", SURVEY, "--dest", dest, names=dest / name)
        self.assertEqual((dest / name).read_bytes(), self.raw.read_bytes())
        shutil.rmtree(dest)


if __name__ == "__main__":
    sonarx.main()
