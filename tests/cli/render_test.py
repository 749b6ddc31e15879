# SPDX-License-Identifier: Apache-2.0
"""Every kind of picture beside its golden one, and what bad input gets.

    render_test.py --look FOLDER     writes all pictures there, to be looked at before they become golden
"""
import html
import json
import os
import re
import shutil
import struct
import sys
import unittest
import zlib
from pathlib import Path

import sonarx

GOLDEN = sonarx.PROJECT / "tests" / "golden"
DEPTHS = sonarx.TRUTH / "depth.tif"
BOTH = [sonarx.SURVEY, sonarx.OUT]

# Largest and mean difference of a channel, of 255. Drawing: another Cairo or FreeType may smooth an edge a little
# differently, never move it by a pixel, which would be 255 along it. Rays: vectors of another width sum in another
# order: a ray that just meets or just misses a mask, or just ends at 99 % opacity, differs, but such rays are few.
DRAWN, TRACED = (64, 0.2), (96, 0.05)

# Between the back-ends, two frames averaged. Of data alone nothing is sharp: rounding to 8 bits may fall to the other
# side, 1, and sums in another order may be as much again; a wrong sample would be anywhere above. A mask's surface is
# sharp: a ray that just meets or just misses it in one of both frames differs by half of its opacity of 0.35, which is
# 45; so few rays do that the mean stays below a step in one of a hundred pixels.
SMOOTH, SURFACES = (2, 0.01), (45, 0.01)

NEAR = ["--eye", "180,-60,-40", "--target", "30,-110,60"]
PICTURES = {
    "slice-top": (["slice-top", *BOTH], DRAWN),
    "slice-top-dark-north-up": (["slice-top", *BOTH, "--dark", "--north-up", "--map", "viridis"], DRAWN),
    "slice-side": (["slice-side", *BOTH], DRAWN),
    "slice-side-noise": (["slice-side", *BOTH, "--removed", "hatched", "--weak", "transparent"], DRAWN),
    "slice-range": (["slice-range", *BOTH], DRAWN),
    "slice-plane-horizontal": (["slice-plane", *BOTH, "--filtered"], DRAWN),
    "slice-plane-vertical": (["slice-plane", *BOTH, "--bearing-deg", "280"], DRAWN),
    "slice-plane-oblique": (["slice-plane", *BOTH, "--point", "75,-140,86", "--normal", "0.6,0.4,-1"], DRAWN),
    "slice-product-alone": (["slice-top", sonarx.OUT], DRAWN),
    "volume": (["volume", *BOTH, "--frames", "2"], TRACED),
    "volume-seabed": (["volume", *BOTH, "--frames", "2", "--depth-raster", DEPTHS, "--dark"], TRACED),
    "volume-first-hit": (["volume", *BOTH, "--frames", "0", "--mode", "first-hit", "--first-hit-db", "-42", "--map", "grey", "--lighting", "--no-masks"], TRACED),
    "volume-maximum": (["volume", *BOTH, "--frames", "0", "--mode", "maximum", "--no-masks"], TRACED),
    "volume-first-hit-masks": (["volume", *BOTH, "--frames", "0", "--mode", "first-hit", "--ping", "9", *NEAR], TRACED),
    "volume-maximum-masks": (["volume", *BOTH, "--frames", "0", "--mode", "maximum", "--ping", "9", *NEAR, "--dark"], TRACED),
    "volume-masks": (["volume", sonarx.OUT, "--frames", "2", "--masks-alone", "--lighting"], TRACED),
    "volume-mask-outline": (["volume", *BOTH, "--frames", "2", "--mask-outline", "--ping", "9", *NEAR], TRACED),
    "propagation-raw-alone": (["propagation", sonarx.SURVEY, "--ping", "0"], DRAWN),
    "survey-map-raw-alone": (["survey-map", sonarx.SURVEY], DRAWN),
    "propagation": (["propagation", sonarx.OUT, "--ping", "3"], DRAWN),
    "propagation-side": (["propagation", sonarx.OUT, "--ping", "3", "--side", "--neighbours", "1"], DRAWN),
    "observation-map": (["observation-map", sonarx.OUT], DRAWN),
    "observation-map-dark": (["observation-map", sonarx.OUT, "--observation", "obs-0002", "--ping", "2", "--dark"], DRAWN),
    "survey-map": (["survey-map", sonarx.OUT, "--depth-raster", DEPTHS], DRAWN),
    "survey-map-dark": (["survey-map", sonarx.OUT, "--depth-raster", DEPTHS, "--dark"], DRAWN),
    "survey-map-without-schools": (["survey-map", sonarx.OUT, "--no-masks"], DRAWN),
    "timeline": (["timeline", *BOTH], DRAWN),
    "timeline-without-schools": (["timeline", *BOTH, "--no-masks", "--along-log", "--dark"], DRAWN),
    "timeline-log": (["timeline", *BOTH, "--along-log", "--maximum", "--whole-survey"], DRAWN),
}
SIZE = ["--size", "640x480"]
# The smallest size there is, and print: twice the pixels.
PICTURES |= {f"small-{kind}": ([kind, *paths, *options, "--size", "320x240"], DRAWN) for kind, paths, options in (
    ("slice-top", BOTH, ["--ping", "10"]), ("volume", BOTH, ["--ping", "10", "--frames", "0", "--depth-raster", DEPTHS]),
    ("propagation", [sonarx.OUT], ["--ping", "10", "--side"]), ("observation-map", [sonarx.OUT], ["--ping", "10"]),
    ("survey-map", [sonarx.OUT], ["--depth-raster", DEPTHS]), ("timeline", BOTH, []))}
PICTURES |= {f"print-{kind}": ([kind, *BOTH, "--ping", "10", "--size", "480x360", "--scale", "2"], DRAWN)
             for kind in ("slice-side", "observation-map")}


def render(*arguments, environment=None):
    before = dict(os.environ)
    os.environ.update(environment or {})
    try:
        return sonarx.run("render", *arguments)
    finally:
        os.environ.clear()
        os.environ.update(before)


class Goldens(unittest.TestCase):
    maxDiff = None

    def test_every_picture_is_as_it_was_looked_at(self):
        for name, (arguments, (largest, mean)) in PICTURES.items():
            with self.subTest(name):
                size = [] if "--size" in arguments else SIZE
                code, out, error = render(*arguments, *size, "--reference", GOLDEN / f"{name}.png",
                                          "--largest-difference", largest, "--mean-difference", mean)
                self.assertEqual((code, error), (0, ""), out + error)

    def test_every_kind_has_a_golden_picture(self):
        code, out, _ = render("--help")
        self.assertEqual(code, 0)
        drawn = {arguments[0] for arguments, _ in PICTURES.values()}
        for kind in ("slice-top", "slice-side", "slice-range", "slice-plane", "volume", "propagation",
                     "observation-map", "survey-map", "timeline"):
            self.assertIn(kind, out)
            self.assertIn(kind, drawn)

    def test_a_changed_picture_is_found(self):
        for arguments in (["slice-top", *BOTH, "--fan", "2"], ["volume", *BOTH, "--frames", "2", "--orbit-deg", "2"]):
            kind = arguments[0]
            code, out, _ = render(*arguments, *SIZE, "--reference", GOLDEN / f"{kind}.png", "--largest-difference", 64,
                                  "--mean-difference", 0.2, "--difference", sonarx.WORK / "difference.png")
            self.assertEqual(code, 1, out)
            self.assertTrue((sonarx.WORK / "difference.png").exists())

    def test_both_back_ends_draw_the_same_volume(self):
        reference = sonarx.WORK / "cpu.png"
        for arguments, (largest, mean) in ((["--no-masks"], SMOOTH), ([], SURFACES), (["--masks-alone", "--lighting"], SURFACES)):
            with self.subTest(arguments):
                arguments = ["volume", *BOTH, "--frames", "2", *SIZE, *arguments]
                self.assertEqual(render(*arguments, "--renderer", "cpu", "--out", reference)[0], 0)
                code, out, error = render(*arguments, "--renderer", "gl", "--reference", reference,
                                          "--largest-difference", largest, "--mean-difference", mean)
                if "EGL" in error:
                    self.skipTest(error.strip())
                self.assertEqual((code, error), (0, ""), out)


class Files(unittest.TestCase):
    def test_png_svg_and_pdf(self):
        for ending, start in ((".png", b"\x89PNG\r\n\x1a\n"), (".svg", b"<?xml"), (".pdf", b"%PDF-1.")):
            file = sonarx.WORK / ("map" + ending)
            code, out, error = render("survey-map", sonarx.OUT, "--out", file)
            self.assertEqual((code, out.strip(), error), (0, str(file), ""))
            first = file.read_bytes()
            self.assertTrue(first.startswith(start))
            render("survey-map", sonarx.OUT, "--out", file)
            self.assertEqual(first, file.read_bytes(), "the same picture twice is the same file")

    def test_synthetic_stands_in_every_title(self):
        for kind in ("slice-top", "slice-side", "slice-range", "slice-plane", "volume", "propagation", "observation-map",
                     "survey-map", "timeline"):
            file = sonarx.WORK / f"title-{kind}.svg"
            self.assertEqual(render(kind, sonarx.OUT, "--out", file)[0], 0)
            self.assertTrue("SYNTHETIC" in file.read_text(encoding="utf-8"), kind)

    def test_slices_are_plain_unless_asked(self):
        plain = sonarx.WORK / "plain.png"
        self.assertEqual(render("slice-side", *BOTH, *SIZE, "--out", plain)[0], 0)
        for options, code in ((["--removed", "shown", "--weak", "shown", "--unfiltered"], 0), (["--removed", "hatched"], 1),
                              (["--removed", "transparent"], 1), (["--weak", "hatched"], 1), (["--filtered"], 1)):
            self.assertEqual(render("slice-side", *BOTH, *SIZE, *options, "--reference", plain,
                                    "--largest-difference", 0, "--mean-difference", 0)[0], code, options)

    def words(self, *arguments):
        """What stands in a picture: an SVG's words can be searched."""
        file = sonarx.WORK / "words.svg"
        code, out, error = render(*arguments, "--out", file)
        self.assertEqual((code, error), (0, ""), out)
        return [html.unescape(text) for text in re.findall(r"<text [^>]*>([^<]*)</text>", file.read_text(encoding="utf-8"))]

    def test_raw_files_alone_do_not_look_like_a_survey_without_schools(self):
        for kind in ("propagation", "survey-map", "observation-map", "timeline"):
            said = " ".join(self.words(kind, sonarx.SURVEY))
            self.assertIn("schools not looked for", said, kind)
            self.assertNotIn("0 schools", said, kind)
            self.assertNotIn("not looked for", " ".join(self.words(kind, *BOTH)), kind)
        self.assertIn("no masks: schools not looked for",
                      self.words("volume", sonarx.SURVEY, "--masks-alone", "--frames", "0"))

    def test_schools_that_were_left_out_are_counted(self):
        all_of = {name: sum(row["observation"] == name for row in sonarx.read_csv(sonarx.OUT / "schools.csv"))
                  for name in ("obs-0001", "obs-0002")}
        first, every = all_of["obs-0001"], sum(all_of.values())
        schools = lambda count: f"{count} school{'' if count == 1 else 's'}"
        for kind, count in (("observation-map", first), ("survey-map", every)):
            self.assertIn(f"{schools(count)}, not shown", " ".join(self.words(kind, sonarx.OUT, "--no-masks")), kind)
            self.assertNotIn("not shown", " ".join(self.words(kind, sonarx.OUT)), kind)
        said = self.words("propagation", sonarx.OUT, "--ping", "3", "--neighbours", "0", "--no-masks")
        self.assertIn("schools not shown", said)
        self.assertNotIn("no school", said)
        self.assertIn("schools not shown", " ".join(self.words("timeline", *BOTH, "--no-masks")))
        if first > 1:
            self.assertIn(f"1 of {schools(first)}", " ".join(self.words("observation-map", sonarx.OUT, "--schools", "1")))

    def test_the_first_ping_keeps_its_place_among_five(self):
        said = self.words("propagation", sonarx.OUT, "--ping", "0")
        self.assertEqual(said.count("before the first ping"), 2)
        self.assertEqual(sum(text.startswith("ping ") for text in said), 3)

    def test_what_filtering_takes_out_is_not_drawn(self):
        """The seabed, too: a key that says it was taken out lies nowhere on what is still drawn."""
        hidden = sonarx.WORK / "hidden.png"
        self.assertEqual(render("slice-side", *BOTH, *SIZE, "--filtered", "--removed", "transparent", "--out", hidden)[0], 0)
        self.assertEqual(render("slice-side", *BOTH, *SIZE, "--filtered", "--reference", hidden,
                                "--largest-difference", 0, "--mean-difference", 0)[0], 0)

    def test_the_largest_over_beams_has_limits_of_its_own(self):
        """A beam's own Sv, as in slices; the mean over all of them is weaker."""
        same = sonarx.WORK / "limits.png"
        self.assertEqual(render("timeline", *BOTH, *SIZE, "--maximum", "--low-db", "-60", "--out", same)[0], 0)
        for options, code in ((["--maximum"], 0), (["--maximum", "--low-db", "-75"], 1), ([], 1)):
            self.assertEqual(render("timeline", *BOTH, *SIZE, *options, "--reference", same,
                                    "--largest-difference", 0, "--mean-difference", 0)[0], code, options)

    def test_scale_gives_more_pixels(self):
        file = sonarx.WORK / "scaled.png"
        self.assertEqual(render("propagation", sonarx.OUT, *SIZE, "--scale", "2", "--out", file)[0], 0)
        self.assertEqual(struct.unpack(">II", file.read_bytes()[16:24]), (1280, 960))

    def test_what_contradicts_itself_is_refused(self):
        empty = sonarx.WORK / "empty-tf.json"
        empty.write_text('{"points": []}')
        for arguments, said in [(("slice-plane", *BOTH, "--depth-m", "50", "--bearing-deg", "3"), "one plane at a time"),
                                (("volume", *BOTH, "--core", "0.1", "--fuzzy", "0.9"), "--fuzzy 0.9 lies above --core 0.1"),
                                (("slice-top", *BOTH, "--transfer-function", empty), "needs at least one point")]:
            with self.subTest(arguments):
                code, _, error = render(*arguments, *SIZE, "--out", sonarx.WORK / "x.png")
                self.assertNotEqual(code, 0)
                self.assertIn(said, error)
                self.assertEqual(error.count("\n"), 1, error)

    def test_an_unfiltered_volume_shows_what_filtering_takes_out(self):
        """The seabed is in the recording; a picture "as recorded" has it."""
        pictures = [sonarx.WORK / f"as-recorded-{i}.png" for i in range(2)]
        for extra, picture in zip(([], ["--unfiltered"]), pictures):
            self.assertEqual(render("volume", *BOTH, "--ping", "10", "--frames", "0", "--no-masks", "--mode", "maximum",
                                    *extra, *SIZE, "--out", picture)[0], 0)
        code, out, _ = render("volume", *BOTH, "--ping", "10", "--frames", "0", "--no-masks", "--mode", "maximum", *SIZE,
                              "--unfiltered", "--reference", pictures[0], "--largest-difference", 64,
                              "--mean-difference", 1)
        self.assertEqual(code, 1, out)

    def test_only_schools_that_were_asked_for(self):
        ids = {row["school_id"] for row in sonarx.read_csv(sonarx.OUT / "schools.csv") if row["observation"] == "obs-0001"}
        code, _, error = render("observation-map", sonarx.OUT, "--schools", "999", "--out", sonarx.WORK / "x.png")
        self.assertEqual(code, 2)
        self.assertIn("no school 999 in obs-0001", error)
        self.assertEqual(render("observation-map", sonarx.OUT, "--schools", sorted(ids)[0], "--out",
                                sonarx.WORK / "x.png")[0], 0)


def silence(path):
    """Every sample of a raw file becomes as weak as it can be; its size and the time of its last change stay."""
    before = path.stat()
    data = bytearray(path.read_bytes())
    offset = 0
    while offset + 16 <= len(data):
        (length,) = struct.unpack_from("<i", data, offset)
        if data[offset + 4:offset + 8] == b"RAW0":
            (count,) = struct.unpack_from("<i", data, offset + 16 + 68)
            first = offset + 16 + 72
            data[first:first + 2 * count] = struct.pack("<h", -32000) * count
        offset += length + 8
    path.write_bytes(data)
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


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


class KeptEchogram(unittest.TestCase):
    def test_a_second_timeline_is_equal_and_reads_no_raw_data(self):
        survey, kept, other = (sonarx.Case.fresh(name) for name in ("kept_survey", "kept_cache", "other_cache"))
        for raw in sonarx.SURVEY.glob("*.raw"):
            shutil.copy2(raw, survey)
        file = sonarx.WORK / "kept.png"

        def timeline(cache):
            code, out, error = sonarx.run("render", "timeline", survey, *SIZE, "--out", file, cache=cache)
            self.assertEqual((code, error), (0, ""), out)
            return file.read_bytes()

        first = timeline(kept)
        self.assertTrue(list(kept.rglob("*.echogram")))
        # Raw data that were read again would now show nothing: that a picture without the cache is another says so.
        for raw in survey.glob("*.raw"):
            silence(raw)
        self.assertEqual(timeline(kept), first)
        self.assertNotEqual(timeline(other), first)


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
        for kind in ("propagation", "observation-map"):
            self.assertEqual(render(kind, folder, "--ping", "4", "--out", picture)[0], 0, kind)
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
            self.refused("volume", *BOTH, option, "nan", *picture, code=2, says=[option, "nan", "expected a number"])
        self.refused("slice-top", *BOTH, "--zoom", "3", *picture, code=2, says=["--zoom", "slice-top"])
        self.refused("timeline", *BOTH, "--depth-raster", DEPTHS, *picture, code=2, says="--depth-raster")
        self.refused("timeline", *BOTH, "--schools", "999", *picture, code=2, says="no school 999")
        self.refused("slice-top", *BOTH, "--out", sonarx.WORK / "nofolder" / "x.png", code=1, says="nofolder")
        self.refused("slice-top", *BOTH, "--weak-db", "4", *picture, code=2, says="--weak")
        self.refused("slice-top", *BOTH, "--removed", "green", *picture, code=2, says=["--removed", "hatched"])
        self.refused("slice-top", *BOTH, "--size", "huge", *picture, code=2, says="--size huge")
        self.refused("slice-plane", *BOTH, "--point", "1,2", "--normal", "0,0,1", *picture, code=2, says="--point")
        self.refused("slice-plane", *BOTH, "--point", "1,2,3", *picture, code=2, says="--normal")
        self.refused("volume", *BOTH, "--eye", "1,2,3", *picture, code=2, says="--target")
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
            (["--removed", "hatched"], "volume", "slice-range"),
            (["--weak", "hatched"], "timeline", "slice-plane"),
            (["--grid"], "volume", "slice-range"),
            (["--core", "0.5"], "timeline", "propagation"),
            (["--core", "0.5"], "survey-map", "slice-plane"),
            (["--fuzzy", "0.1"], "slice-top", "volume"),
            (["--masks-alone"], "slice-top", "volume"),
            (["--mask-outline"], "slice-top", "volume"),
            (["--no-context"], "slice-top", "volume"),
            (["--ship-length-m", "40"], "observation-map", "volume"),
            (["--depth-raster", str(DEPTHS)], "observation-map", "survey-map"),
            (["--neighbours", "1"], "volume", "propagation"),
            (["--along-log"], "slice-top", "timeline"),
            (["--maximum"], "volume", "timeline"),
            (["--whole-survey"], "survey-map", "timeline"),
        ]
        for option, kind, suits in unsuited:
            with self.subTest(option=option[0], kind=kind):
                self.refused(kind, *BOTH, *option, "--out", sonarx.WORK / "bad.png", code=2,
                             says=[option[0], f"no option of {kind}", suits])
        for options in (["--masks-alone", "--no-masks"], ["--mask-outline", "--no-masks"], ["--mask-outline", "--masks-alone"]):
            self.refused("volume", *BOTH, *options, "--out", sonarx.WORK / "bad.png", code=2, says=[*options, "together"])
        self.refused("timeline", *BOTH, "--whole-survey", "--observation", "obs-0001", "--out", sonarx.WORK / "bad.png",
                     code=2, says=["--observation", "--whole-survey"])

    def test_every_option_is_taken_by_the_kinds_it_suits(self):
        picture = [*SIZE, "--out", sonarx.WORK / "taken.png"]
        for kind, options in (("observation-map", ["--observation", "obs-0001", "--ping", "2", "--core", "0.5"]),
                              ("survey-map", ["--low-db", "-70", "--span-db", "40", "--schools", "1"]),
                              ("propagation", ["--ping", "3", "--core", "0.5", "--neighbours", "1", "--side"]),
                              ("timeline", ["--filtered", "--map", "grey", "--low-db", "-80", "--span-db", "40",
                                            "--threshold-db", "-78", "--along-log", "--maximum"]),
                              ("slice-top", ["--unfiltered", "--map", "grey", "--core", "0.5", "--north-up", "--grid"]),
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


def look(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, (arguments, _) in PICTURES.items():
        size = [] if "--size" in arguments else SIZE
        code, _, error = render(*arguments, *size, "--out", folder / f"{name}.png")
        print(name, code, error.strip())


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--look":
        look(Path(sys.argv[2]).resolve())
    else:
        unittest.main()
