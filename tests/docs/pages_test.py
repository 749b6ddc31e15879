#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The pages: links lead somewhere, the manual has them all, every room and package is described, columns agree with the
code."""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from links import broken

PROJECT = Path(__file__).resolve().parent.parent.parent
PAGES = [*sorted(PROJECT.glob("*.md")), *sorted((PROJECT / "docs").glob("*.md"))]


class Pages(unittest.TestCase):
    def test_links_between_pages(self):
        self.assertEqual(broken(PAGES), [])

    def test_links_of_the_pages_that_are_installed(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-B", PROJECT / "packaging/make_pages", "--out", folder], check=True)
            made = sorted(Path(folder).glob("*.md"))
            self.assertEqual({p.name for p in made}, {p.name for p in PAGES})
            self.assertEqual(broken(made), [])

    def test_the_manual_has_every_page(self):
        nav = (PROJECT / "packaging/mkdocs.yml.in").read_text().split("\nnav:\n")[1]
        # packaging/make_man makes commands.md.
        self.assertEqual(sorted(re.findall(r": (\S+\.md)$", nav, re.MULTILINE)),
                         sorted(["commands.md", *(p.name for p in PAGES)]))

    def test_every_room_of_the_check_is_described_with_its_includes(self):
        check = {}
        exec(compile(re.search(r"ROOMS = \{.*?\n\}", (PROJECT / "tools/check_layers").read_text(), re.DOTALL).group(0),
                     "rooms", "exec"), check)
        text = (PROJECT / "docs/architecture.md").read_text()
        rows = dict(re.findall(r"^\| `(\w+)` \| [^|]+ \| ([^|]+) \|", text, re.MULTILINE))
        self.assertEqual(list(rows), list(check["ROOMS"]))
        for room, allowed in check["ROOMS"].items():
            self.assertEqual(set(re.findall(r"\w+", rows[room])), set(allowed), room)
        self.assertEqual({p.name for p in (PROJECT / "src").iterdir() if p.is_dir()} - set(rows), set())

    def test_every_installed_package_is_described(self):
        setup = (PROJECT / "tools/setup.sh").read_text()
        described = (PROJECT / "docs/dependencies.md").read_text()
        for group in re.findall(r"^(?:build|test|full|bench|readers|cluster|packages)=\(([^)]*)\)", setup, re.MULTILINE):
            for package in group.split():
                self.assertIn(f"`{package}`", described)

    def test_pages_agree_how_many_parameters_a_user_sets(self):
        recipe = (PROJECT / "docs/parameters.md").read_text().split("\n## For experts\n")[0]
        number = len(re.findall(r"^- `", recipe, re.MULTILINE))
        for page in ("CHANGELOG.md", "docs/guide.md"):
            said = re.findall(r"(\S+) parameters that a user sets", re.sub(r"\s+", " ", (PROJECT / page).read_text()))
            self.assertTrue(said, page)
            self.assertEqual(set(said), {str(number)}, page)

    def test_columns_of_the_tables(self):
        text = (PROJECT / "docs/interfaces.md").read_text()
        source = (PROJECT / "src/model/school.h").read_text()
        descriptors = (PROJECT / "src/model/school_descriptors.h").read_text()
        shared = "".join(f'v("{name}"' for name in re.findall(r'\{"(\w+)", "[^"]*", &SchoolDescriptors', descriptors))
        self.assertTrue(shared)
        source = re.sub(r"for \(const DescriptorColumn&[^;]*;", lambda _: shared, source)
        lists = [",".join(re.findall(r'v\("(\w+)"', body)) for body in source.split("void columns(")[1:]]
        self.assertEqual(len(lists), 2)
        for columns in lists:
            self.assertIn(columns, re.sub(r"\s+", "", text))


if __name__ == "__main__":
    unittest.main()
