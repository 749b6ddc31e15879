# SPDX-License-Identifier: Apache-2.0
"""Movies: how many pictures, how long, what stands in them, and what is left when they cannot be made."""
import os
import shutil
import signal
import struct
import subprocess
import time
import unittest

import sonarx
from rendering import BOTH, SIZE, render

QUICK = ["--frames", "0", *SIZE]
FFMPEG = shutil.which("ffmpeg") and shutil.which("ffprobe")


def chunks(data):
    at = 8
    while at < len(data):
        (length,) = struct.unpack_from(">I", data, at)
        yield data[at + 4:at + 8], data[at + 8:at + 8 + length]
        at += 12 + length


def animated(file):
    """(pictures, plays, delays in s) of an animated PNG."""
    parts = list(chunks(file.read_bytes()))
    pictures, plays = struct.unpack(">II", next(body for kind, body in parts if kind == b"acTL"))
    delays = [struct.unpack(">HH", body[20:24]) for kind, body in parts if kind == b"fcTL"]
    numbers = [struct.unpack(">I", body[:4])[0] for kind, body in parts if kind in (b"fcTL", b"fdAT")]
    assert numbers == list(range(len(numbers))), "in their order"
    return pictures, plays, [over / under for over, under in delays]


def probed(file):
    said = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                           "stream=width,height,nb_read_frames,pix_fmt,codec_name:format=duration:format_tags=title,comment",
                           "-of", "default=noprint_wrappers=1", str(file)], capture_output=True, text=True, check=True)
    return dict(line.split("=", 1) for line in said.stdout.splitlines())


class Movies(sonarx.Case):
    def made(self, *arguments, environment=None):
        code, out, error = render("movie", *arguments, environment=environment)
        self.assertEqual((code, error), (0, ""), out)
        return out.strip()

    def test_an_animated_png_has_a_picture_for_each_ping(self):
        file = self.fresh("movie-png") / "movie.png"
        self.made(*BOTH, "--of", "slice-top", *SIZE, "--pictures-per-second", "4", "--out", file)
        self.assertEqual(animated(file), (14, 0, [0.25] * 14))

    def test_pings_can_be_named_or_are_those_of_a_school(self):
        folder = self.fresh("movie-pings")
        self.made(*BOTH, "--of", "slice-top", *SIZE, "--first-ping", "3", "--last-ping", "5", "--between", "2", "--out", folder / "a.png")
        self.assertEqual(animated(folder / "a.png")[0], 7)
        school = sonarx.read_csv(sonarx.OUT / "school_pings.csv")[0]
        pings = [int(row["ping_index"]) for row in sonarx.read_csv(sonarx.OUT / "school_pings.csv")
                 if (row["observation"], row["school_id"]) == (school["observation"], school["school_id"])]
        self.made(*BOTH, "--of", "observation-map", *SIZE, "--observation", school["observation"], "--schools", school["school_id"],
                  "--out", folder / "b.png")
        self.assertEqual(animated(folder / "b.png")[0], max(pings) - min(pings) + 1)

    def test_what_is_interpolated_differs_and_single_pictures_can_be_had(self):
        folder = self.fresh("movie-each")
        self.made(*BOTH, "--of", "slice-side", *SIZE, "--first-ping", "3", "--last-ping", "4", "--between", "1", "--each-picture",
                  "--out", folder / "m.png")
        self.assertEqual(sorted(p.name for p in folder.iterdir()), ["m-0000.png", "m-0001.png", "m-0002.png", "m.png"])
        self.assertEqual(len({p.read_bytes() for p in folder.glob("m-*.png")}), 3)

    def test_a_turntable_and_the_track(self):
        folder = self.fresh("movie-motion")
        self.made(*BOTH, *QUICK, "--motion", "turntable", "--turntable-pictures", "6", "--ping", "9", "--out", folder / "t.png")
        self.assertEqual(animated(folder / "t.png")[0], 6)
        self.made(*BOTH, *QUICK, "--motion", "along-track", "--last-ping", "4", "--out", folder / "l.png")
        self.assertEqual(animated(folder / "l.png")[0], 5)

    @unittest.skipUnless(FFMPEG, "there is no ffmpeg")
    def test_an_mp4_plays_everywhere(self):
        folder = self.fresh("movie-mp4")
        self.assertEqual(self.made(*BOTH, "--of", "slice-top", "--size", "641x481", "--first-ping", "2", "--last-ping", "7",
                                   "--pictures-per-second", "4", "--out", folder / "m.mp4"), str(folder / "m.mp4"))
        said = probed(folder / "m.mp4")
        self.assertEqual((said["width"], said["height"]), ("642", "482"))
        self.assertEqual((said["codec_name"], said["pix_fmt"], said["nb_read_frames"]), ("h264", "yuv420p", "6"))
        self.assertAlmostEqual(float(said["duration"]), 1.5, places=3)
        self.assertIn("SYNTHETIC", said["TAG:title"])
        self.assertRegex(said["TAG:comment"], r"^Made by Sonar Explorer \d+\.\d+\.\d+; recipe [0-9a-f]+; data \d{4}-")
        self.assertEqual([p.name for p in folder.iterdir()], ["m.mp4"])
        data = (folder / "m.mp4").read_bytes()
        self.assertLess(data.index(b"moov"), data.index(b"mdat"), "plays before all of it has come")

    def test_without_ffmpeg_it_is_an_animated_png_and_a_line(self):
        folder = self.fresh("movie-without")
        nothing = {"PATH": str(folder)}
        arguments = ["movie", *BOTH, "--of", "slice-top", *SIZE, "--last-ping", "1", "--out", folder / "m.mp4"]
        code, out, error = render(*arguments, environment=nothing)
        self.assertEqual((code, out.strip()), (0, str(folder / "m.png")))
        self.assertEqual(error.count("\n"), 1)
        self.assertIn("there is no program ffmpeg", error)
        self.assertEqual(animated(folder / "m.png")[0], 2)
        before = (folder / "m.png").read_bytes()
        code, out, error = render(*arguments, environment=nothing)
        self.assertEqual((code, out), (1, ""))
        self.assertIn("m.png is there already", error)
        self.assertEqual((folder / "m.png").read_bytes(), before)

    @unittest.skipUnless(FFMPEG, "there is no ffmpeg")
    def test_what_ffmpeg_complains_about_is_told(self):
        folder = self.fresh("movie-broken")
        broken = folder / "bin" / "ffmpeg"
        broken.parent.mkdir()
        broken.write_text("#!/bin/sh\necho one line >&2\necho 'Unknown encoder libx264' >&2\nexit 1\n")
        broken.chmod(0o755)
        code, out, error = render("movie", *BOTH, "--of", "slice-top", *SIZE, "--out", folder / "m.mp4",
                                  environment={"PATH": str(broken.parent) + ":/bin:/usr/bin"})
        self.assertEqual((code, out), (1, ""))
        self.assertEqual(error.count("\n"), 1, error)
        self.assertIn("m.mp4: ffmpeg failed: Unknown encoder libx264", error)
        self.assertEqual([p.name for p in folder.iterdir()], ["bin"])

    def test_a_movie_that_is_stopped_leaves_nothing(self):
        endings = ["mp4", "png"] if FFMPEG else ["png"]
        for ending in endings:
            with self.subTest(ending):
                folder = self.fresh(f"movie-stop-{ending}")
                process = subprocess.Popen(
                    [sonarx.PROGRAM, "render", "movie", *map(str, BOTH), "--motion", "turntable", "--turntable-pictures", "5000",
                     *QUICK, "--each-picture", "--out", str(folder / f"m.{ending}")], stdin=subprocess.DEVNULL,
                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                    env={**os.environ, "XDG_CACHE_HOME": str(sonarx.WORK / "cache")})
                while not (folder / ".m-0001.png").exists() and process.poll() is None:
                    time.sleep(0.01)
                process.send_signal(signal.SIGINT)
                begun = time.monotonic()
                out, error = process.communicate(timeout=60)
                self.assertLess(time.monotonic() - begun, 10)
                self.assertEqual(process.returncode, 130, out + error)
                self.assertEqual(list(folder.iterdir()), [])

    def test_what_does_not_go_together_is_one_line(self):
        file = self.fresh("movie-refused") / "m.png"
        for arguments, said in ((["--of", "slice-top", "--motion", "turntable"], "a camera, which a volume alone has"),
                                (["--of", "propagation", "--between", "2"], "interpolates samples"),
                                (["--ping", "3"], "--ping: goes with --motion turntable"),
                                (["--motion", "turntable", "--last-ping", "3"], "--last-ping: not together with"),
                                (["--of", "slice-top", "--mode", "maximum"], "no option of a movie of slice-top; it suits volume"),
                                (["--first-ping", "9", "--last-ping", "2"], "last ping, 2, lies before its first, 9"),
                                (["--last-ping", "99"], "no ping 99"),
                                (["--size", "400x260"], "no room for its caption"),
                                (["--schools", "999"], "no school 999")):
            with self.subTest(arguments):
                code, out, error = render("movie", *BOTH, *arguments, "--out", file)
                self.assertEqual((code, out), (2, ""), error)
                self.assertIn(said, error)
                self.assertEqual(error.count("\n"), 1, error)
        self.one_line_error("render", "movie", *BOTH, "--out", file.with_suffix(".avi"), code=2, names="ends in .mp4 or .png")
        self.one_line_error("render", "movie", *BOTH, "--out", sonarx.SURVEY / "m.png", code=2, names="raw")
        self.one_line_error("render", "slice-top", *BOTH, "--between", "2", "--out", file, code=2, names="--between: no option of")


if __name__ == "__main__":
    sonarx.main()
