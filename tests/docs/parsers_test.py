#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/trust.md lists every source that reads bytes from outside, each with a fuzz target; every target has a corpus that the
tests replay, and words of its own where it has a dictionary."""
import re
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent.parent
SOURCES, KEPT = PROJECT / "src", PROJECT / "tests" / "data" / "fuzz"
MOST_KEPT_BYTES = 3_000_000
# Whatever opens a file, takes from a stream, or hands bytes to a parser.
READS = re.compile(
    r"\b(read_csv|parse_csv|read_csv_rows<\w+>|read_file|read_json_file|parse_json|open_file|run_command|json::parse|restoreState"
    r"|load_buffer|nc_open\w*|GDALOpen\w*|H5Fopen|SealedFile::open|cairo_image_surface_create_from_png_stream|fread|fopen"
    r"|std::getline)\(|(?<![\w:>])::p?read\(|\bifstream\b|\bnetcdf::Reader in_|\bArchiveReader\b|\bQFile\b|\bQSettings\b")
# Declarations, what tests are made of, and words of the program's own.
PASSED_OVER = re.compile(r"_test\.cpp$|/fuzz_|/test_|/product_example\.h$|/netcdf_model\.h$|^session/words/all_words\.cpp$")
DECLARED_ONLY = {"io/atomic_file.h", "io/byte_source.h", "io/csv_table.h", "io/external_command.h",
                 "pipeline/recipe/json_file.h"}


def rows():
    """(sources, targets) of each row of the table."""
    page = (PROJECT / "docs" / "trust.md").read_text()
    table = page.split("| What is read |", 1)[1].split("\n\n", 1)[0].splitlines()[2:]
    for line in table:
        _, _, sources, targets, _ = line.split("|")
        yield set(re.findall(r"`([^`]+)`", sources)), set(re.findall(r"`([^`]+)`", targets))


class Parsers(unittest.TestCase):
    def test_every_reader_is_listed(self):
        listed = {source for sources, _ in rows() for source in sources}
        reading = set()
        for file in sorted([*SOURCES.rglob("*.cpp"), *SOURCES.rglob("*.h")]):
            name = file.relative_to(SOURCES).as_posix()
            if not PASSED_OVER.search(name) and name not in DECLARED_ONLY and READS.search(file.read_text()):
                reading.add(name.rsplit(".", 1)[0])
        self.assertGreater(len(reading), 30)
        self.assertEqual(reading - listed, set(), "reads bytes from outside: name it and its fuzz target in docs/trust.md")
        for source in listed:
            self.assertTrue(list(SOURCES.glob(source + ".*")), f"docs/trust.md: there is no src/{source}")

    def test_every_target_is_listed_replayed_and_has_a_corpus(self):
        targets = {file.stem for file in (PROJECT / "fuzz").glob("*.cpp")}
        self.assertEqual({target for _, named in rows() for target in named}, targets)
        self.assertEqual({folder.name for folder in KEPT.iterdir()}, targets)
        replayed = {name for test in SOURCES.glob("*/fuzz_corpus_test.cpp")
                    for name in re.findall(r'replay\("(\w+)"', re.sub(r"\(\s+", "(", test.read_text()))}
        self.assertEqual(replayed, targets)
        words = {file.stem for file in (PROJECT / "fuzz" / "dictionaries").iterdir()}
        self.assertEqual(words - targets, set())

    def test_corpora_stay_small(self):
        self.assertLess(sum(file.stat().st_size for file in KEPT.rglob("*") if file.is_file()), MOST_KEPT_BYTES)


if __name__ == "__main__":
    unittest.main(verbosity=2)
