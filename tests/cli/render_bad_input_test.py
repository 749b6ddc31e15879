# SPDX-License-Identifier: Apache-2.0
"""What render says of input that it can't draw: one line, naming what and where."""
import json
import os
import struct
import unittest
import zlib
from pathlib import Path

import sonarx
from rendering import BOTH, DEPTHS, SIZE, render


def without_samples(source, to, ping):
    """A raw file whose one ping has its channels, each without a sample."""
    data, out, offset, times = source.read_bytes(), bytearray(), 0, []
    while offset + 16 <= len(data):
        (length,) = struct.unpack_from("<i", data, offset)
        body = bytearray(data[offset + 4:offset + 4 + length])
        if body[:4] == b"RAW0":
            if bytes(body[4:12]) not in times:
                times.append(bytes(body[4:12]))
            if len(times) == ping + 1:
                body = body[:12 + 72]
                struct.pack_into("<i", body, 12 + 68, 0)
        out += struct.pack("<i", len(body)) + body + struct.pack("<i", len(body))
        offset += length + 8
    to.write_bytes(out)


def write_png(path, side):
    """A grey square, for a reference of the wrong size."""
    rows = b"".join(b"\0" + b"\x80" * side for _ in range(side))
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class BadInput(unittest.TestCase):
    def refused(self, *arguments, code, says, environment=None):
        got, out, error = render(*arguments, environment=environment)
        lines = error.strip().splitlines()
        self.assertEqual(got, code, out + error)
        self.assertEqual(len(lines), 1, error)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, lines[0])

    def test_a_survey_without_a_grid(self):
        data = Path(os.environ.get("SONAR_DATA", sonarx.PROJECT.parent / "shared" / "data"))
        file = next(iter(sorted(data.glob("raw/**/D2007*.raw"))), None)
        if file is None:
            self.skipTest("no recorded EK60 file here")
        for kind in ("slice-top", "volume", "propagation", "timeline"):
            self.refused(kind, file, "--out", sonarx.WORK / "bad.png", code=1,
                         says=["make no grid", "does not look sideways in fans"])
        picture = ["--size", "640x480", "--out", sonarx.WORK / "ek60.png"]
        for options in ([], ["--channel", "2"], ["--channel", "120"], ["--channel", "38kHz", "--depth"]):
            code, out, error = render("echogram", file, *options, *picture)
            self.assertEqual((code, error), (0, ""), out)
        self.refused("echogram", file, "--channel", "70", *picture, code=2,
                     says=["no channel 70", "1 (18 kHz), 2 (38 kHz), 3 (120 kHz), 4 (200 kHz)"])
        self.refused("echogram", file, "--fan", "2", *picture, code=2, says="has no fans and beams")

    def test_one_fan_is_sliced_and_is_no_volume(self):
        folder = sonarx.Case.fresh("one_fan")
        columns = ("channel,count,elevation_deg,azimuth_deg,frequency_hz,vertical_width_deg,horizontal_width_deg,gain_db,psi_db,"
                   "sa_correction_db,power_w,absorption_db_per_m")
        rows = [f"{beam},800,-10,{2.5 * beam - 30},100000,3,3,27,-27,0,1000,0.03" for beam in range(25)]
        (folder / "beams.csv").write_text("\n".join([columns, *rows]) + "\n", encoding="ascii")
        code, out, error = sonarx.run("simulate", folder / "survey", "--preset", "easy", "--observations", "1", "--pings", "2",
                                      "--schools", "1", "--beams", folder / "beams.csv")
        self.assertEqual(code, 0, out + error)
        for kind in ("slice-top", "slice-side", "slice-range", "slice-plane", "timeline", "observation-map"):
            self.assertEqual(render(kind, folder / "survey", "--out", folder / "x.png")[0], 0, kind)
        self.refused("volume", folder / "survey", "--out", folder / "x.png", code=2, says=["1 x ", "2 of each"])

    def test_a_ping_without_data(self):
        folder = sonarx.Case.fresh("silent_ping")
        raw = sorted(sonarx.SURVEY.glob("*.raw"))[0]
        without_samples(raw, folder / raw.name, 4)
        picture = sonarx.WORK / "silent.png"
        for kind in ("slice-top", "slice-side", "slice-range", "slice-plane"):
            size = ["--size", "480x360"]
            self.assertEqual(render(kind, folder, "--ping", "4", *size, "--out", picture),
                             (0, f"{picture}\n", ""))
            self.assertEqual(render(kind, folder, "--ping", "3", *size, "--reference", picture)[0], 1, kind)
        self.refused("volume", folder, "--ping", "4", "--out", picture, code=2,
                     says=["a ping without data", "no sample"])
        self.assertEqual(render("observation-map", folder, "--ping", "4", "--out", picture)[0], 0)
        self.assertEqual(render("timeline", folder, "--out", picture)[0], 0)

    def test_what_is_not_there(self):
        picture = ["--out", sonarx.WORK / "bad.png"]
        self.refused("slice-top", sonarx.WORK / "nowhere", *picture, code=1, says=["nowhere", "no such file"])
        self.refused("slice-top", sonarx.WORK / "cache", *picture, code=2, says="nothing to draw")
        self.refused("slice-top", *BOTH, "--observation", "obs-0099", *picture, code=2, says=["obs-0099", "obs-0001"])
        self.refused("slice-top", *BOTH, "--ping", "9999", *picture, code=2, says=["no ping 9999", "0 to"])
        self.refused("slice-top", *BOTH, "--fan", "99", *picture, code=2, says="fan")
        self.refused("slice-range", *BOTH, "--range-m", "5000", *picture, code=2, says=["5000", "reach from"])
        self.refused("slice-plane", *BOTH, "--depth-m", "5000", *picture, code=2, says="does not meet")
        self.refused("survey-map", sonarx.OUT, "--depth-raster", sonarx.WORK / "none.tif", *picture, code=1,
                     says="none.tif")

    def test_a_raster_that_does_not_cover(self):
        raster = sonarx.WORK / "far.asc"
        raster.write_text("ncols 3\nnrows 3\nxllcorner -120\nyllcorner -40\ncellsize 0.1\n" + "-500 -500 -500\n" * 3,
                          encoding="ascii")
        for kind in ("survey-map", "volume"):
            self.refused(kind, *BOTH, "--depth-raster", raster, "--out", sonarx.WORK / "bad.png", code=1,
                         says=["far.asc", "cover"])

    def test_a_raster_that_is_none(self):
        raster = sonarx.WORK / "text.tif"
        raster.write_text("not a raster", encoding="ascii")
        self.refused("survey-map", sonarx.OUT, "--depth-raster", raster, "--out", sonarx.WORK / "bad.png", code=1,
                     says="text.tif")

    def test_transfer_functions(self):
        curve = sonarx.WORK / "bad_curve.json"
        picture = ["--transfer-function", curve, "--out", sonarx.WORK / "bad.png"]
        for text, code, says in (("", 1, "bad_curve.json"),
                                 ('{"tf_version":1,"opacity_length_m":10,"points":[]}', 2, "point"),
                                 ('{"tf_version":99,"opacity_length_m":10,"points":[]}', 1, "99")):
            curve.write_text(text, encoding="utf-8")
            for kind in ("volume", "slice-top"):
                self.refused(kind, *BOTH, *picture, code=code, says=says)
        # A curve that shows nothing is no mistake.
        curve.write_text(json.dumps({"tf_version": 1, "opacity_length_m": 10,
                                     "points": [{"sv_db": -60, "opacity": 0, "rgb": [0, 0, 1]},
                                                {"sv_db": -20, "opacity": 0, "rgb": [1, 0, 0]}]}), encoding="utf-8")
        self.assertEqual(render("volume", *BOTH, "--no-masks", *picture)[0], 0)

    def test_options(self):
        picture = ["--out", sonarx.WORK / "bad.png"]
        self.refused("slice-top", *BOTH, "--size", "12x12", *picture, code=2, says="--size 12x12")
        self.refused("slice-top", *BOTH, "--size", "8000x8000", "--scale", "4", *picture, code=2, says="million pixels")
        for option in ("--core", "--zoom", "--ship-length-m", "--threshold-db", "--low-db", "--first-hit-db"):
            self.refused("volume", *BOTH, option, "nan", *picture, code=2, says=[option, "nan", "is outside"])
        self.refused("slice-top", *BOTH, "--zoom", "3", *picture, code=2, says=["--zoom", "slice-top"])
        self.refused("timeline", *BOTH, "--depth-raster", DEPTHS, *picture, code=2, says="--depth-raster")
        self.refused("timeline", *BOTH, "--schools", "999", *picture, code=2, says="no school 999")
        self.refused("echogram", *BOTH, "--fan", "99", *picture, code=2, says="no fan 99 in obs-0001: it has fans 0 to 19")
        self.refused("echogram", *BOTH, "--beam", "25", *picture, code=2, says="no beam 25 in obs-0001: it has beams 0 to 24")
        self.refused("echogram", *BOTH, "--from-ping", "99", *picture, code=2, says=["no pings 99 to", "it has pings 0 to"])
        self.refused("echogram", *BOTH, "--channel", "38", *picture, code=2, says="choose them with fan and beam")
        self.refused("echogram", *BOTH, "--below", "auto", *picture, code=2, says="no sounder without fans ran")
        self.refused("slice-top", *BOTH, "--out", sonarx.WORK / "nofolder" / "x.png", code=1, says="nofolder")
        self.refused("slice-top", *BOTH, "--weak-db", "4", *picture, code=2, says="--weak")
        self.refused("slice-top", *BOTH, "--removed", "green", *picture, code=2, says=["--removed", "hatched"])
        self.refused("slice-top", *BOTH, "--size", "huge", *picture, code=2, says="--size huge")
        self.refused("slice-plane", *BOTH, "--point", "1,2", "--normal", "0,0,1", *picture, code=2, says="--point")
        self.refused("slice-plane", *BOTH, "--point", "1,2,3", *picture, code=2, says="--normal")
        self.refused("volume", *BOTH, "--eye", "1,2,3", *picture, code=2, says="--eye: goes with --target")
        self.refused("volume", *BOTH, "--target", "1,2,3", *picture, code=2, says="--target: goes with --eye")
        self.refused("volume", *BOTH, "--eye", "1,2", *picture, code=2, says="--eye: 1,2 is not X,Y,Z, 3 numbers between commas")
        self.refused("slice-plane", *BOTH, "--through", "1,2,3", *picture, code=2,
                     says="--through: 1,2,3 is not X,Y,X,Y, 4 numbers between commas")
        self.refused("volume", *BOTH, "--eye", "1,2,nan", "--target", "0,0,0", *picture, code=2, says="--eye")
        self.refused("slice-top", *BOTH, "--out", sonarx.WORK / "bad.gif", code=2, says=".png")
        self.refused("slice-top", *BOTH, code=2, says="--out")
        self.refused("teapot", *BOTH, *picture, code=2, says="teapot")

    def test_an_option_without_effect_is_refused_with_the_kinds_it_suits(self):
        # option and value -> a kind that has no use for it, one that has
        unsuited = [
            (["--observation", "obs-0001"], "survey-map", "timeline"),
            (["--ping", "3"], "timeline", "observation-map"),
            (["--filtered"], "propagation", "timeline"),
            (["--unfiltered"], "survey-map", "volume"),
            (["--map", "grey"], "survey-map", "timeline"),
            (["--low-db", "-70"], "observation-map", "survey-map"),
            (["--span-db", "40"], "propagation", "slice-side"),
            (["--threshold-db", "-60"], "survey-map", "slice-top"),
            (["--transfer-function", "curve.json"], "survey-map", "timeline"),
            (["--transfer-function", "curve.json"], "propagation", "volume"),
            (["--north-up"], "slice-side", "slice-top"),
            (["--removed", "hatched"], "timeline", "volume"),
            (["--keep-seabed"], "timeline", "slice-range"),
            (["--plane", "oblique"], "slice-top", "slice-plane"),
            (["--weak", "hatched"], "timeline", "slice-plane"),
            (["--grid"], "volume", "slice-range"),
            (["--core", "0.5"], "timeline", "propagation"),
            (["--core", "0.5"], "survey-map", "slice-plane"),
            (["--fuzzy", "0.1"], "slice-top", "volume"),
            (["--masks-alone"], "slice-top", "volume"),
            (["--refused"], "survey-map", "slice-top"),
            (["--tint"], "timeline", "volume"),
            (["--no-context"], "slice-top", "volume"),
            (["--lighting"], "slice-top", "volume"),
            (["--clip", "top-slice"], "slice-top", "volume"),
            (["--drop-lines", "all"], "timeline", "volume"),
            (["--slice-planes"], "slice-side", "volume"),
            (["--ship-length-m", "40"], "observation-map", "volume"),
            (["--depth-raster", str(DEPTHS)], "observation-map", "survey-map"),
            (["--neighbours", "1"], "volume", "propagation"),
            (["--along-log"], "slice-top", "timeline"),
            (["--along-log"], "volume", "echogram"),
            (["--of-fan"], "timeline", "echogram"),
            (["--channel", "38"], "slice-top", "echogram"),
            (["--fan", "3"], "slice-side", "echogram"),
            (["--maximum"], "volume", "timeline"),
            (["--whole-survey"], "survey-map", "timeline"),
            (["--y", "depth_m"], "survey-map", "chart"),
            (["--after", "median"], "slice-top", "noise-steps"),
            (["--no-water"], "chart", "frequency"),
            (["--curve", "tolerance"], "chart", "curves"),
        ]
        for option, kind, suits in unsuited:
            with self.subTest(option=option[0], kind=kind):
                self.refused(kind, *BOTH, *option, "--out", sonarx.WORK / "bad.png", code=2,
                             says=[option[0], f"no option of {kind}", suits])
        for options in (["--masks-alone", "--no-masks"], ["--tint", "--no-masks"]):
            self.refused("volume", *BOTH, *options, "--out", sonarx.WORK / "bad.png", code=2, says=[*options, "together"])
        self.refused("echogram", *BOTH, "--of-fan", "--beam", "3", "--out", sonarx.WORK / "bad.png", code=2,
                     says=["--beam", "--of-fan", "together"])
        self.refused("timeline", *BOTH, "--whole-survey", "--observation", "obs-0001", "--out", sonarx.WORK / "bad.png",
                     code=2, says=["--observation", "--whole-survey"])

    def test_a_ping_without_the_school_has_no_curve(self):
        rows = sonarx.read_csv(sonarx.OUT / "school_pings.csv")
        there = {(row["observation"], row["school_id"], row["ping_index"]) for row in rows}
        absent = next((o, s, p) for o, p in sorted({(o, p) for o, _, p in there})
                      for s in sorted({s for other, s, _ in there if other == o}) if (o, s, p) not in there)
        for options in (["--curve", "tolerance"], ["--one-ping"]):
            self.refused("curves", *BOTH, "--observation", absent[0], "--schools", absent[1], "--ping", absent[2], *options,
                         "--out", sonarx.WORK / "bad.png", code=1,
                         says=[absent[0], f"school {absent[1]} is not in ping {absent[2]}", "expected"])

    def test_every_option_is_taken_by_the_kinds_it_suits(self):
        picture = [*SIZE, "--out", sonarx.WORK / "taken.png"]
        for kind, options in (("observation-map", ["--observation", "obs-0001", "--ping", "2", "--core", "0.5"]),
                              ("survey-map", ["--low-db", "-70", "--span-db", "40", "--schools", "1"]),
                              ("propagation", ["--ping", "3", "--core", "0.5", "--neighbours", "1", "--side"]),
                              ("timeline", ["--filtered", "--map", "grey", "--low-db", "-80", "--span-db", "40",
                                            "--threshold-db", "-78", "--along-log", "--maximum"]),
                              ("echogram", ["--observation", "obs-0001", "--fan", "9", "--beam", "12", "--removed",
                                            "transparent", "--keep-seabed", "--refused", "--depth", "--map", "grey",
                                            "--low-db", "-80", "--threshold-db", "-78", "--along-log", "--to-ping", "5"]),
                              ("slice-top", ["--unfiltered", "--map", "grey", "--core", "0.5", "--north-up", "--grid"]),
                              ("chart", ["--observation", "obs-0001", "--schools", "1", "--table", "school_pings",
                                         "--x", "range_m", "--y", "", "--bins", "9"]),
                              ("noise-steps", ["--slice", "side", "--beam", "12", "--before", "unfiltered", "--after",
                                               "impulse-noise", "--map", "grey", "--low-db", "-70", "--no-mark"]),
                              ("noise-steps", ["--slice", "range", "--range-m", "150", "--mark-db", "3", "--no-masks"]),
                              ("frequency", ["--observation", "obs-0001", "--schools", "1", "--no-water"]),
                              ("curves", ["--observation", "obs-0001", "--schools", "1", "--one-ping"]),
                              ("lineage", ["--observation", "obs-0001", "--schools", "1"]),
                              ("volume", ["--frames", "0", "--unfiltered", "--no-context", "--fuzzy", "0.1"])):
            with self.subTest(kind):
                code, out, error = render(kind, *BOTH, *options, *picture)
                self.assertEqual((code, error), (0, ""), out)

    def test_nothing_is_written_beside_raw_files(self):
        self.refused("slice-top", sonarx.SURVEY, "--out", sonarx.SURVEY / "x.png", code=2, says="raw")
        self.assertFalse((sonarx.SURVEY / "x.png").exists())

    def test_references(self):
        arguments = ["propagation", sonarx.OUT, *SIZE, "--reference"]
        self.refused(*arguments, sonarx.WORK / "no_reference.png", code=1, says="no_reference.png")
        small = sonarx.WORK / "small.png"
        write_png(small, 16)
        code, out, _ = render(*arguments, small)
        self.assertEqual(code, 1)
        self.assertIn("16", out)
        small.write_bytes(b"no picture")
        self.refused(*arguments, small, code=1, says="small.png")

    def test_an_old_driver(self):
        self.refused("volume", *BOTH, "--renderer", "gl", "--frames", "0", "--out", sonarx.WORK / "bad.png", code=1,
                     says="3.3", environment={"MESA_GL_VERSION_OVERRIDE": "3.3"})


if __name__ == "__main__":
    unittest.main()
