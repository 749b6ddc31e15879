# SPDX-License-Identifier: Apache-2.0
"""What the programs' own headers say: where they take code from, what an overrun meets, and what they tell of their maker.
Called with the programs' paths and the folder of the sources; reads them with binutils' readelf."""
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import unittest

PROGRAMS = [pathlib.Path(name) for name in sys.argv[1:-1]]
SOURCES = sys.argv[-1]
ENDBR64 = b"\xf3\x0f\x1e\xfa"
READELF = shutil.which("readelf")


def told(program, *options):
    return subprocess.run([READELF, "-W", *options, program], check=True, capture_output=True, text=True).stdout


@unittest.skipIf(READELF is None, "no readelf here")
class Hardening(unittest.TestCase):
    def test_libraries_come_from_the_system_alone(self):
        for program in PROGRAMS:
            dynamic = told(program, "-d")
            self.assertTrue("(NEEDED)" in dynamic, program)
            self.assertEqual([line for line in dynamic.splitlines() if "RPATH" in line or "RUNPATH" in line], [], program)

    def test_tables_are_read_only_and_stacks_no_code(self):
        for program in PROGRAMS:
            self.assertTrue(re.search(r"\(FLAGS(_1)?\).*NOW", told(program, "-d")), program)
            segments = told(program, "-l")
            self.assertTrue("GNU_RELRO" in segments, program)
            stack = next(line for line in segments.splitlines() if "GNU_STACK" in line)
            self.assertNotIn("E", stack.split()[-2])
            self.assertIn("DYN", told(program, "-h"))  # may lie anywhere

    def test_overruns_are_caught(self):
        for program in PROGRAMS:
            symbols = told(program, "--dyn-syms")
            if "__asan_init" in symbols or "__tsan_init" in symbols:
                self.skipTest("a sanitizer does that here")
            self.assertTrue("__stack_chk_fail" in symbols, program)
            self.assertTrue(re.search(r"__(mem|str|p?read|v?snprintf|v?fprintf|realpath)\w*_chk", symbols), program)

    @unittest.skipIf(platform.machine() != "x86_64", "CET is x86's")
    def test_jumps_land_on_marks(self):
        # The linker's own note is there only where the system's start-up code is marked too; Debian 12's is not.
        for program in PROGRAMS:
            self.assertGreater(program.read_bytes().count(ENDBR64), 1000, program)

    def test_nothing_tells_where_it_was_built(self):
        for program in PROGRAMS:
            self.assertEqual(program.read_bytes().count(SOURCES.encode()), 0, program)


if __name__ == "__main__":
    assert PROGRAMS, "no program named"
    unittest.main(argv=[sys.argv[0]], verbosity=2)
