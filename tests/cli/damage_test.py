# SPDX-License-Identifier: Apache-2.0
"""Damaged and foreign files: what is sound is read, the rest is named, nothing crashes."""
import json
import shutil

import sonarx
from sonarx import SURVEY, Case, run


class Damage(Case):
    def setUp(self):
        self.raw = sorted(SURVEY.glob("*.raw"))[0]

    def info(self, *paths, codes=(0,)):
        code, out, err = run("info", *paths, "--json")
        self.assertIn(code, codes, err)
        return json.loads(out)

    def test_truncated_file_is_read_up_to_its_end(self):
        folder = self.fresh("truncated")
        whole = self.info(self.raw)["files"][0]
        data = self.raw.read_bytes()
        for cut in (len(data) - 7, len(data) // 2, 200000):
            (folder / self.raw.name).write_bytes(data[:cut])
            file = self.info(folder)["files"][0]
            self.assertIn("file-truncated", [n["code"] for n in file["notes"]])
            self.assertLessEqual(file["pings"], whole["pings"])
            for note in file["notes"]:
                self.assertLessEqual(note["offset"], cut)

    def test_flipped_bits_leave_the_rest(self):
        folder = self.fresh("flipped")
        data = bytearray(self.raw.read_bytes())
        middle = data.index(b"RAW0", len(data) // 2) - 4
        data[middle:middle + 4] = b"\xff\xff\xff\x7f"
        (folder / self.raw.name).write_bytes(data)
        file = self.info(folder)["files"][0]
        self.assertIn("bad-length", [n["code"] for n in file["notes"]])
        self.assertGreaterEqual(file["pings"], self.info(self.raw)["files"][0]["pings"] - 1)
        self.sonarx("run", folder, "--out", self.fresh("flipped-out"))

    def test_a_run_says_what_is_wrong_with_its_data_and_a_merge_again(self):
        folder, out = self.fresh("cut-short"), self.fresh("cut-short-out")
        data = self.raw.read_bytes()
        (folder / self.raw.name).write_bytes(data[:len(data) - 7])
        for arguments in (("run", folder, "--out", out, "--pings", "0:1"), ("merge", out)):
            code, text, err = run(*arguments)
            self.assertEqual(code, 0, err)
            # The simulated sonar states a recorded MS70's equivalent beam angles, which no transmit beam explains.
            self.assertEqual([line.split(": ")[:2] for line in err.splitlines()],
                             [["note file-truncated", "obs-0001"], ["note psi-against-widths", "obs-0001"]])
            self.assertNotIn("note", text)

    def test_a_file_that_is_no_raw_file_is_listed_and_costs_exit_code_three(self):
        folder = self.fresh("junk")
        shutil.copy(self.raw, folder)
        (folder / "junk.raw").write_bytes(bytes(range(256)) * 100)
        info = self.info(folder, codes=(3,))
        self.assertEqual(len(info["files"]), 2)
        junk = next(f for f in info["files"] if f["path"].endswith("junk.raw"))
        self.assertTrue(junk["notes"])
        self.assertEqual(len(info["observations"]), 1)

    def test_a_run_names_files_that_gave_nothing_and_why(self):
        folder, out = self.fresh("nothing-read"), self.fresh("nothing-read-out")
        shutil.copy(self.raw, folder)
        bad = {"empty.raw": b"", "junk.raw": bytes(range(256)) * 100}
        says = {"empty.raw": "the file is empty", "junk.raw": "no datagram of a known format was found"}
        for name, data in bad.items():
            (folder / name).write_bytes(data)
        code, _, err = run("run", folder, "--out", out, "--pings", "0:1")
        self.assertEqual(code, 3, err)
        for name, why in says.items():
            self.assertIn(f"sonarx: {folder / name}: byte 0: {why}", err.splitlines())
        failures = json.loads((out / "survey.json").read_text())["failures"]
        self.assertEqual(failures, [{"observation": None, "error": f"{folder / name}: byte 0: {why}"}
                                    for name, why in says.items()])

    def test_empty_file_and_empty_folder(self):
        folder = self.fresh("empty")
        code, _, err = run("run", folder, "--out", self.fresh("empty-out"))
        self.assertEqual(code, 1)
        self.assertEqual(len(err.strip().splitlines()), 1)
        (folder / "notes.txt").write_text("nothing to read")
        self.one_line_error("info", folder, code=1, names=f"{folder}: holds no raw files")
        self.one_line_error("info", folder, "--json", code=1, names=f"{folder}: holds no raw files")
        (folder / "empty.raw").write_bytes(b"")
        self.assertEqual(run("info", folder, "--json")[0], 3)

    def test_the_same_file_twice_counts_once(self):
        folder = self.fresh("twice")
        shutil.copy(self.raw, folder / self.raw.name)
        once = self.info(folder)
        shutil.copy(self.raw, folder / "copy.raw")
        twice = self.info(folder)
        self.assertEqual([o["pings"] for o in twice["observations"]], [o["pings"] for o in once["observations"]])
        out = self.fresh("twice-out")
        self.sonarx("run", folder, "--out", out, "--pings", "0:1")
        notes = json.loads((out / "survey.json").read_text())["notes"]
        self.assertEqual([n["code"] for n in notes], ["duplicate-file"])
        self.assertNotIn("/", notes[0]["file"])

    def test_output_that_cannot_be_written(self):
        folder = self.fresh("blocked")
        (folder / "file").write_text("in the way")
        self.assertEqual(run("run", SURVEY, "--out", folder / "file")[0], 1)
        self.assertEqual(run("simulate", folder / "file" / "below", "--pings", "1")[0], 1)


if __name__ == "__main__":
    sonarx.main()
