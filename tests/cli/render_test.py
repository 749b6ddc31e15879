# SPDX-License-Identifier: Apache-2.0
"""Every kind of picture beside its golden one, and what stands in them.

    render_test.py --look FOLDER     writes all pictures there, to be looked at before they become golden
"""
import html
import os
import re
import shutil
import struct
import subprocess
import sys
import unittest
import zlib
from pathlib import Path

import netCDF4
import numpy
import sonarx
from rendering import BOTH, DEPTHS, SIZE, render


def png_texts(data):
    """iTXt chunks by keyword, and pixels a metre."""
    texts, per_metre, at = {}, None, 8
    while at < len(data):
        (length,) = struct.unpack_from(">I", data, at)
        kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        assert struct.unpack_from(">I", data, at + 8 + length)[0] == zlib.crc32(kind + body)
        if kind == b"pHYs":
            per_metre = struct.unpack(">IIB", body)[0]
        if kind == b"iTXt":
            keyword, text = body.split(b"\0", 1)
            texts[keyword.decode()] = text[4:].decode()
        at += 12 + length
    return texts, per_metre


def png_pixels(data):
    """[row][column][channel], 0 to 255, of an 8-bit PNG that is not interlaced (PNG specification, 9.2: filters)."""
    at, body = 8, b""
    while at < len(data):
        (length,) = struct.unpack_from(">I", data, at)
        kind = data[at + 4:at + 8]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack_from(">IIBB", data, at + 8)
            channels = {2: 3, 6: 4}[colour]
            assert depth == 8
        if kind == b"IDAT":
            body += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, stride = zlib.decompress(body), width * channels
    rows, above = [], bytearray(stride)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = line[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            if kind == 1:
                line[i] = line[i] + left & 255
            elif kind == 2:
                line[i] = line[i] + above[i] & 255
            elif kind == 3:
                line[i] = line[i] + (left + above[i]) // 2 & 255
            elif kind == 4:
                guess = left + above[i] - corner
                line[i] = line[i] + min((left, above[i], corner), key=lambda near: abs(guess - near)) & 255
        rows.append(line)
        above = line
    return numpy.frombuffer(b"".join(rows), numpy.uint8).reshape(height, width, channels)


GOLDEN = sonarx.PROJECT / "tests" / "golden"

# Largest and mean difference of a channel, of 255. Drawing: another Cairo or FreeType may smooth an edge a little
# differently, never move it by a pixel, which would be 255 along it. Rays: vectors of another width sum in another
# order: a ray that just meets or just misses a mask, or just ends at 99 % opacity, differs, but such rays are few.
DRAWN, TRACED = (64, 0.2), (96, 0.05)

# Between the back-ends, two frames averaged. Of data alone nothing is sharp: rounding to 8 bits may fall to the other
# side, 1, and sums in another order may be as much again; a wrong sample would be anywhere above. A mask's surface is
# sharp: a ray that just meets or just misses it in one of both frames differs by half of its opacity of 0.35, which is
# 45; so few rays do that the mean stays below a step in one of a hundred pixels.
SMOOTH, SURFACES = (2, 0.01), (45, 0.01)

# What makes a survey's schools refused echoes: none is 15 fans high.
TALL = '{"recipe_version": 1, "detect": {"min_fans": 15}}'
REFUSED = sonarx.WORK / "refused"
WITH_REFUSED = [sonarx.SURVEY, REFUSED, "--refused"]

NEAR = ["--eye", "180,-60,-40", "--target", "30,-110,60"]
PICTURES = {
    "slice-top": (["slice-top", *BOTH], DRAWN),
    "slice-top-dark-north-up": (["slice-top", *BOTH, "--dark", "--north-up", "--map", "ek500"], DRAWN),
    "slice-side": (["slice-side", *BOTH], DRAWN),
    "slice-side-tint": (["slice-side", *BOTH, "--tint", "--map", "ek500"], DRAWN),
    "slice-side-noise": (["slice-side", *BOTH, "--removed", "hatched", "--weak", "transparent"], DRAWN),
    "slice-range": (["slice-range", *BOTH], DRAWN),
    "slice-plane-horizontal": (["slice-plane", *BOTH, "--filtered"], DRAWN),
    "slice-plane-vertical": (["slice-plane", *BOTH, "--bearing-deg", "280"], DRAWN),
    "slice-plane-oblique": (["slice-plane", *BOTH, "--point", "75,-140,86", "--normal", "0.6,0.4,-1"], DRAWN),
    "slice-product-alone": (["slice-top", sonarx.OUT], DRAWN),
    "volume": (["volume", *BOTH, "--frames", "2"], TRACED),
    "volume-seabed": (["volume", *BOTH, "--frames", "2", "--depth-raster", DEPTHS, "--dark"], TRACED),
    "volume-first-hit": (["volume", *BOTH, "--frames", "0", "--mode", "first-hit", "--first-hit-db", "-42", "--map", "grey", "--no-masks"], TRACED),
    "volume-maximum": (["volume", *BOTH, "--frames", "0", "--mode", "maximum", "--no-masks", "--no-lighting"], TRACED),
    "volume-first-hit-masks": (["volume", *BOTH, "--frames", "0", "--mode", "first-hit", "--ping", "9", *NEAR], TRACED),
    "volume-maximum-masks": (["volume", *BOTH, "--frames", "0", "--mode", "maximum", "--ping", "9", *NEAR, "--dark"], TRACED),
    "volume-masks": (["volume", sonarx.OUT, "--frames", "2", "--masks-alone"], TRACED),
    "volume-tint": (["volume", *BOTH, "--frames", "2", "--tint", "--ping", "9", *NEAR], TRACED),
    "volume-many-lines": (["volume", *BOTH, "--frames", "2", "--ping", "9", *NEAR, "--map", "ek500", "--no-lighting"], TRACED),
    "volume-cut-open": (["volume", *BOTH, "--frames", "2", "--ping", "9", "--clip", "both-slices", "--slice-planes", "--no-masks"], TRACED),
    "survey-map-raw-alone": (["survey-map", sonarx.SURVEY], DRAWN),
    "propagation": (["propagation", sonarx.OUT, "--ping", "3"], DRAWN),
    "propagation-side": (["propagation", sonarx.OUT, "--ping", "3", "--side", "--neighbours", "1"], DRAWN),
    "observation-map": (["observation-map", sonarx.OUT], DRAWN),
    "observation-map-dark": (["observation-map", sonarx.OUT, "--observation", "obs-0002", "--ping", "2", "--dark"], DRAWN),
    "survey-map": (["survey-map", sonarx.OUT, "--depth-raster", DEPTHS], DRAWN),
    "survey-map-dark": (["survey-map", sonarx.OUT, "--depth-raster", DEPTHS, "--dark"], DRAWN),
    "survey-map-without-schools": (["survey-map", sonarx.OUT, "--no-masks"], DRAWN),
    "timeline": (["timeline", *BOTH], DRAWN),
    "slice-top-refused": (["slice-top", *WITH_REFUSED, "--ping", "10", "--fan", "18"], DRAWN),
    "slice-side-refused": (["slice-side", *WITH_REFUSED, "--ping", "7", "--beam", "6", "--dark"], DRAWN),
    "observation-map-refused": (["observation-map", REFUSED, "--refused"], DRAWN),
    "timeline-refused": (["timeline", *WITH_REFUSED], DRAWN),
    "volume-refused": (["volume", *WITH_REFUSED, "--ping", "10", "--frames", "0"], TRACED),
    "timeline-without-schools": (["timeline", *BOTH, "--no-masks", "--along-log", "--dark"], DRAWN),
    "echogram": (["echogram", *BOTH], DRAWN),
    "echogram-depth-filtered": (["echogram", *BOTH, "--depth", "--filtered", "--dark", "--from-ping", "2", "--to-ping", "9"], DRAWN),
    "echogram-fan": (["echogram", *BOTH, "--of-fan", "--fan", "6", "--map", "ek500", "--along-log"], DRAWN),
    "echogram-product-alone": (["echogram", sonarx.OUT], DRAWN),
    "timeline-log": (["timeline", *BOTH, "--along-log", "--maximum", "--whole-survey"], DRAWN),
    "chart": (["chart", sonarx.OUT, "--observation", "obs-0001"], DRAWN),
    "chart-histogram-dark": (["chart", sonarx.OUT, "--x", "depth_m", "--y", "", "--bins", "20", "--dark"], DRAWN),
    "chart-schools": (["chart", sonarx.OUT, "--table", "schools", "--x", "longitude", "--y", "latitude"], DRAWN),
}
# The smallest size there is, and print: twice the pixels.
PICTURES |= {f"small-{kind}": ([kind, *paths, *options, "--size", "320x240"], DRAWN) for kind, paths, options in (
    ("slice-top", BOTH, ["--ping", "10"]), ("volume", BOTH, ["--ping", "10", "--frames", "0", "--depth-raster", DEPTHS]),
    ("propagation", [sonarx.OUT], ["--ping", "10", "--side"]), ("observation-map", [sonarx.OUT], ["--ping", "10"]),
    ("survey-map", [sonarx.OUT], ["--depth-raster", DEPTHS]), ("timeline", BOTH, []), ("echogram", BOTH, []),
    ("chart", [sonarx.OUT], ["--x", "volume_m3", "--y", "depth_m"]))}
PICTURES |= {f"print-{kind}": ([kind, *BOTH, "--ping", "10", "--size", "480x360", "--scale", "2"], DRAWN)
             for kind in ("slice-side", "observation-map")}


def make_refused():
    recipe = sonarx.WORK / "tall.json"
    recipe.write_text(TALL, encoding="utf-8")
    code, out, error = sonarx.run("run", sonarx.SURVEY, "--out", REFUSED, "--recipe", recipe)
    assert code == 0, out + error


class Goldens(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        make_refused()

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
                     "observation-map", "survey-map", "timeline", "echogram", "chart"):
            self.assertIn(kind, out)
            self.assertIn(kind, drawn)

    def test_where_nothing_was_refused_nothing_is_marked(self):
        """The small survey's product tells no refused echo, as no product does that is older than refusals."""
        for name in ("slice-top", "slice-product-alone", "observation-map", "timeline"):
            arguments, (largest, mean) = PICTURES[name]
            code, out, error = render(*arguments, "--refused", *SIZE, "--reference", GOLDEN / f"{name}.png",
                                      "--largest-difference", largest, "--mean-difference", mean)
            self.assertEqual((code, error), (0, ""), out + error)
        code, out, error = render("slice-top", sonarx.SURVEY, "--refused", *SIZE, "--out", sonarx.WORK / "raw-alone.png")
        self.assertEqual((code, error), (0, ""), out)

    def test_a_changed_picture_is_found(self):
        for arguments in (["slice-top", *BOTH, "--fan", "2"], ["volume", *BOTH, "--frames", "2", "--orbit-deg", "2"]):
            kind = arguments[0]
            code, out, _ = render(*arguments, *SIZE, "--reference", GOLDEN / f"{kind}.png", "--largest-difference", 64,
                                  "--mean-difference", 0.2, "--difference", sonarx.WORK / "difference.png")
            self.assertEqual(code, 1, out)
            self.assertTrue((sonarx.WORK / "difference.png").exists())

    def test_both_back_ends_draw_the_same_volume(self):
        reference = sonarx.WORK / "cpu.png"
        for arguments, (largest, mean) in ((["--no-masks", "--no-lighting"], SMOOTH), (["--tint"], SURFACES), (["--masks-alone"], SURFACES),
                                            (["--no-masks", "--no-lighting", "--clip", "both-slices"], SMOOTH)):
            with self.subTest(arguments):
                arguments = ["volume", *BOTH, "--frames", "2", *SIZE, *arguments]
                self.assertEqual(render(*arguments, "--renderer", "cpu", "--out", reference)[0], 0)
                code, out, error = render(*arguments, "--renderer", "gl", "--reference", reference,
                                          "--largest-difference", largest, "--mean-difference", mean)
                if "EGL" in error:
                    self.skipTest(error.strip())
                self.assertEqual((code, error), (0, ""), out)


class Files(sonarx.Case):
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
                     "survey-map", "timeline", "chart"):
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

    def test_curves_of_schools(self):
        said = self.words("curves", *BOTH, "--schools", "1")
        for words in ("school 1", "water round school 1", "mean background there", "share of the volume (% per dB)"):
            self.assertIn(words, said)
        said = self.words("curves", *BOTH, "--curve", "tolerance", "--schools", "1")
        for words in ("school 1 as it is stored", "tolerance used", "volume (dB re that used)", "backscatter (dB re that used)"):
            self.assertIn(words, said)
        self.assertTrue(any(words.startswith("grown again from its strongest voxel, ping ") for words in said), said)
        said = self.words("curves", sonarx.OUT, "--curve", "avoidance", "--over", "range")
        self.assertIn("range from the ship (m)", said)
        self.assertNotIn("bearing from the bow (degrees)", said)

    def test_what_is_so_anyway_may_be_said(self):
        pictures = [sonarx.WORK / f"said-{n}.png" for n in (1, 2)]
        for picture, said in zip(pictures, ([], ["--lighting", "--context", "--masks"])):
            code, out, error = render("volume", *BOTH, *SIZE, "--frames", "0", *said, "--out", picture)
            self.assertEqual((code, error), (0, ""), out + error)
        self.assertEqual(pictures[0].read_bytes(), pictures[1].read_bytes())

    def test_what_stands_round_a_volume_says_what_it_is(self):
        said = self.words("volume", *BOTH, "--ping", "9", "--frames", "0")
        for word in ("range ", "depth "):
            self.assertTrue(any(text.startswith(word) and text.endswith(" m") for text in said), said)
        self.assertTrue(any(text.endswith(" m at the view's centre") for text in said), said)
        self.assertIn("seabed, fitted to the ping's echoes", said)
        self.assertEqual([text for text in said if text in ("1", "2")], ["1", "2"], "numbers beside the schools")
        self.assertFalse(any(text.startswith("slice from") for text in said), said)
        said = self.words("volume", *BOTH, "--ping", "9", "--frames", "0", "--slice-planes", "--depth-raster", DEPTHS)
        self.assertIn("slice from above", said)
        self.assertIn("seabed, of the depth chart", said)
        self.assertNotIn("seabed, fitted to the ping's echoes", said)
        said = " ".join(self.words("volume", *BOTH, "--ping", "9", "--frames", "0", "--no-context"))
        self.assertNotIn("range", said)
        self.assertNotIn("centre", said)

    def test_a_volume_is_cut_open_at_the_slices(self):
        plain = sonarx.WORK / "uncut.png"
        view = ["volume", *BOTH, "--ping", "9", "--frames", "0", *SIZE]
        self.assertEqual(render(*view, "--clip", "none", "--out", plain)[0], 0)
        for options, code in (([], 0), (["--fan", "3"], 0), (["--clip", "top-slice"], 1), (["--clip", "side-slice"], 1),
                              (["--clip", "both-slices", "--fan", "3", "--beam", "3"], 1), (["--drop-lines", "none"], 1),
                              (["--no-seabed"], 1), (["--slice-planes"], 1)):
            self.assertEqual(render(*view, *options, "--reference", plain, "--largest-difference", 0,
                                    "--mean-difference", 0)[0], code, options)
        code, _, error = render(*view, "--fan", "99", "--out", sonarx.WORK / "x.png")
        self.assertNotEqual(code, 0)
        self.assertIn("there is no fan 99", error)

    def test_raw_files_alone_do_not_look_like_a_survey_without_schools(self):
        for kind in ("survey-map", "observation-map", "timeline"):
            said = " ".join(self.words(kind, sonarx.SURVEY))
            self.assertIn("schools not detected", said, kind)
            self.assertNotIn("0 schools", said, kind)
            self.assertNotIn("not detected", " ".join(self.words(kind, *BOTH)), kind)
        self.assertIn("no masks: schools not detected",
                      self.words("volume", sonarx.SURVEY, "--masks-alone", "--frames", "0"))

    def test_a_propagation_of_nothing_is_none(self):
        make_refused()
        for path in (sonarx.SURVEY, REFUSED):
            self.one_line_error("render", "propagation", path, "--out", sonarx.WORK / "none.png", code=1,
                                names="there are no schools to draw a propagation of")

    def test_surfaces_of_raw_files_alone_are_of_the_ping_that_has_most(self):
        """The middle ping may have none: the louder the level, the fewer pings reach it, and the last one is drawn."""
        view = ("volume", sonarx.SURVEY, *SIZE, "--frames", "0")
        at = lambda db, *more: (*view, "--mode", "first-hit", "--first-hit-db", db, *more)
        ping_of = lambda words: re.search(r"ping (\d+)", " ".join(words))[1]
        silent = lambda words: any(text.startswith("nothing reaches") for text in words)
        middle = ping_of(self.words(*view))
        level = next(db for db in range(-50, 0, 3) if silent(self.words(*at(db, "--ping", middle))))
        full = self.words(*at(level))
        self.assertFalse(silent(full), level)
        self.assertEqual(ping_of(self.words(*view, "--mode", "volume-and-surface", "--first-hit-db", level)), ping_of(full))
        self.assertTrue(silent(self.words(*at(20))))

        def turned(*ping):
            file = self.fresh("turned") / "t.png"
            made = render("movie", *at(level, *ping)[1:], "--motion", "turntable", "--turntable-pictures", "2", "--each-picture",
                          "--out", file)
            self.assertEqual((made[0], made[2]), (0, ""), made[1])
            return file.with_name("t-0000.png").read_bytes()

        self.assertEqual(turned(), turned("--ping", ping_of(full)))
        self.assertNotEqual(turned(), turned("--ping", middle))

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

    def test_without_masks_the_same_slice_is_shown(self):
        """Ping, fan or beam, and time stand in the title: they are those of the picture with its schools."""
        for kind, begins in (("slice-top", "Top: fan"), ("slice-side", "Side: beam")):
            titles = [[text for text in self.words(kind, *BOTH, *options) if text.startswith(begins) or "   ping " in text or text.endswith("UTC")]
                      for options in ([], ["--no-masks"])]
            self.assertGreaterEqual(len(titles[0]), 3, titles)
            self.assertEqual(titles[0], titles[1])

    def test_inside_its_outline_a_school_keeps_the_colours_of_the_bar(self):
        """Where a tint reaches, outlines alone change little, and other pixels are the palette's, but for rings that cross it."""
        slice_ = ["slice-top", *BOTH, "--ping", "10"]
        plain = self.pixels(*slice_, "--no-masks")
        outlined = self.pixels(*slice_)
        inside = (self.pixels(*slice_, "--tint") != outlined).any(axis=2)
        kept = inside & (outlined == plain).all(axis=2)
        self.assertGreater(inside.sum(), 200)
        self.assertGreater(kept.sum(), 0.5 * inside.sum())
        high = self.pixels(*slice_, "--no-masks", "--size", "1600x1200")[:, 1200:]
        columns = [numpy.unique(high[:, x], axis=0) for x in range(high.shape[1])]
        colours = max(columns, key=len)
        self.assertGreater(len(colours), 200, "the bar")
        away = [numpy.abs(colours - pixel).max(axis=1).min() for pixel in outlined[kept]]
        self.assertGreater(numpy.mean(numpy.array(away) <= 4.0), 0.95, "a range ring crosses it")

    def pixels(self, *arguments):
        file = sonarx.WORK / "pixels.png"
        code, out, error = render(*arguments, "--out", file)
        self.assertEqual((code, error), (0, ""), out)
        return png_pixels(file.read_bytes()).astype(float)

    def test_without_masks_nothing_else_of_a_volume_changes(self):
        """What differs lies where a picture of the masks alone has something: on a school, a pixel's width beside it, or in the legend."""
        volume = ["volume", *BOTH, "--ping", "9", "--frames", "0", "--renderer", "cpu", "--no-context", "--size", "320x240"]
        for mode in ([], ["--mode", "maximum"]):
            differs = (self.pixels(*volume, *mode) != self.pixels(*volume, *mode, "--no-masks")).any(axis=2)
            alone = self.pixels(*volume, "--masks-alone")
            colours, counts = numpy.unique(alone.reshape(-1, 3), axis=0, return_counts=True)
            near = numpy.pad((alone != colours[counts.argmax()]).any(axis=2), 3)
            height, width = differs.shape
            near = numpy.any([near[y:y + height, x:x + width] for y in range(7) for x in range(7)], axis=0)
            self.assertGreater(differs.sum(), 100)
            self.assertEqual((differs & ~near).sum(), 0)
            self.assertFalse(differs[:30].any(), "the title")

    def test_scale_traces_more_rays(self):
        """Four rays a pixel, averaged, are not the one in its middle, and nearer to the mean of sixteen frames, whose rays
        stand elsewhere in the pixel."""
        volume = ["volume", *BOTH, "--ping", "9", "--renderer", "cpu", "--no-context", "--no-masks", "--mode", "maximum", "--size", "320x240"]
        inside = (slice(60, 200), slice(20, 240))
        one = self.pixels(*volume, "--frames", "0")
        scaled = self.pixels(*volume, "--frames", "0", "--scale", "2")
        averaged = self.pixels(*volume, "--frames", "16")
        many = scaled.reshape(240, 2, 320, 2, 3).mean(axis=(1, 3))
        error = lambda picture: numpy.square(picture - averaged)[inside].mean()
        self.assertGreater(error(one), 0.0)
        self.assertLess(error(many), 0.6 * error(one))

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
        for options, code in ((["--maximum"], 0), ([], 0), (["--low-db", "-75"], 1), (["--no-maximum"], 1)):
            self.assertEqual(render("timeline", *BOTH, *SIZE, *options, "--reference", same,
                                    "--largest-difference", 0, "--mean-difference", 0)[0], code, options)

    def test_scale_gives_more_pixels(self):
        file = sonarx.WORK / "scaled.png"
        self.assertEqual(render("propagation", sonarx.OUT, *SIZE, "--scale", "2", "--out", file)[0], 0)
        self.assertEqual(struct.unpack(">II", file.read_bytes()[16:24]), (1280, 960))

    def test_files_say_where_they_are_from(self):
        """Program, recipe and the data's time in every format, and how large a pixel is in PNG; no more than that."""
        with netCDF4.Dataset(sonarx.OUT / "products" / "obs-0001.nc") as product:
            recipe = product.recipe_hash
        rows = sonarx.read_csv(sonarx.OUT / "school_pings.csv")
        first = min(r["time_utc"] for r in rows if r["observation"] == "obs-0001")
        folder = self.fresh("origins")
        for ending in ("png", "svg", "pdf"):
            self.sonarx("render", "slice-top", *BOTH, "--out", folder / f"slice.{ending}", "--scale", "2")
        texts, dots_per_m = png_texts((folder / "slice.png").read_bytes())
        self.assertEqual(dots_per_m, round(192 / 0.0254))
        self.assertEqual(set(texts), {"Title", "Software", "Recipe", "Data Time"})
        self.assertRegex(texts["Software"], r"^Sonar Explorer \d+\.\d+\.\d+$")
        self.assertEqual(texts["Recipe"], recipe)
        begin, end = texts["Data Time"].split("/")
        self.assertLessEqual(begin, first)
        self.assertLess(begin, end)
        svg = (folder / "slice.svg").read_text()
        self.assertIn(f"<desc>Made by {texts['Software']}; recipe {recipe}; data {begin}/{end}</desc>", svg)
        pdf = (folder / "slice.pdf").read_bytes()
        self.assertIn(b"/Subject", pdf)
        self.assertIn(texts["Software"].encode(), pdf)

    def test_a_dash_is_standard_output(self):
        file = self.fresh("dash") / "map.png"
        self.sonarx("render", "survey-map", sonarx.OUT, *SIZE, "--out", file)
        done = subprocess.run([sonarx.PROGRAM, "render", "survey-map", sonarx.OUT, *SIZE, "--out", "-"], check=True,
                              capture_output=True, timeout=300)
        self.assertEqual(done.stdout, file.read_bytes())

    def test_what_contradicts_itself_is_refused(self):
        empty = sonarx.WORK / "empty-tf.json"
        empty.write_text('{"points": []}')
        for arguments, said in [(("slice-plane", *BOTH, "--depth-m", "50", "--bearing-deg", "3"), "one plane at a time"),
                                (("volume", *BOTH, "--core", "0.1", "--fuzzy", "0.9"), "--fuzzy 0.9 lies above core 0.1"),
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


def look(folder):
    folder.mkdir(parents=True, exist_ok=True)
    make_refused()
    for name, (arguments, _) in PICTURES.items():
        size = [] if "--size" in arguments else SIZE
        code, _, error = render(*arguments, *size, "--out", folder / f"{name}.png")
        print(name, code, error.strip())


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--look":
        look(Path(sys.argv[2]).resolve())
    else:
        unittest.main()
