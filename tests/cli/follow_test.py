# SPDX-License-Identifier: Apache-2.0
"""follow: while the files are written, it tells of schools; in the end all is as run makes it of the finished files."""
import json
import os
import random
import shutil
import signal
import socket
import subprocess
import time

import propagate_test
import sonarx
from sonarx import OUT, PROGRAM, SURVEY, WORK, Case, run

RESULTS = ("schools.csv", "school_pings.csv", "plan.json", "products/obs-0001.nc", "products/obs-0002.nc")


class Follow(Case):
    def start(self, live, out, *options):
        self.follow = subprocess.Popen(
            [PROGRAM, "follow", str(live), "--out", str(out), *map(str, options)], stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            env={**os.environ, "XDG_CACHE_HOME": str(WORK / "cache")})
        self.addCleanup(self.follow.kill)

    def end(self):
        out, err = self.follow.communicate(timeout=300)
        return self.follow.returncode, out, err

    @staticmethod
    def record(live, seed=1, pause=0.02):
        """Writes the survey's files again in pieces that end anywhere."""
        pieces = random.Random(seed)
        for file in sorted(SURVEY.glob("*.raw")):
            data, at = file.read_bytes(), 0
            with (live / file.name).open("ab", buffering=0) as stream:
                while at < len(data):
                    piece = pieces.randint(1, 400000)
                    stream.write(data[at:at + piece])
                    at += piece
                    time.sleep(pause)

    def expect_run(self, live, out, but=("survey",)):
        for name in RESULTS:
            ours, theirs = (folder / name for folder in (out, OUT))
            if name.endswith(".json"):
                a, b = (json.loads(f.read_text()) for f in (ours, theirs))
                for member in but:
                    a.pop(member), b.pop(member)
                self.assertEqual(a, b)
            else:
                self.assertEqual(ours.read_bytes(), theirs.read_bytes(), name)
        self.sonarx("compare", OUT, out)

    def test_ends_where_a_run_does_and_tells_of_schools_on_the_way(self):
        folder = self.fresh("follow")
        live, out = folder / "live", folder / "out"
        live.mkdir()
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as bridge:
            bridge.bind(("127.0.0.1", 0))
            bridge.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
            bridge.settimeout(5)
            self.start(live, out, "--idle-exit", 3, "--json", "--alarm", "range_m < 1000", "--nmea",
                       f"127.0.0.1:{bridge.getsockname()[1]}")
            self.record(live)
            code, text, err = self.end()
            self.assertEqual(code, 0, err)
            sentence = bridge.recv(200).decode()
        self.assertRegex(sentence, r"^\$SSTLL,\d\d,\d{4}\.\d{4},[NS],\d{5}\.\d{4},[EW],school \d+,\d{6}\.\d\d,T,\*..\r\n$")
        self.expect_run(live, out)
        events = [json.loads(line) for line in text.splitlines() if line.startswith("{")]
        kinds = {event["event"] for event in events}
        self.assertLessEqual({"school", "alarm", "finished", "status"}, kinds)
        told = [event for event in events if event["event"] == "school"]
        self.assertTrue(all(event["provisional"] == 1 for event in told))
        # Each school of the result was told of where it is.
        for row in sonarx.read_csv(OUT / "schools.csv"):
            near = [event for event in told if event["observation"] == row["observation"]
                    and abs(event["range_m"] - self.range_of(row)) < 50]
            self.assertTrue(near, row)

    @staticmethod
    def range_of(school):
        rows = [float(r["range_m"]) for r in sonarx.read_csv(OUT / "school_pings.csv")
                if (r["observation"], r["school_id"]) == (school["observation"], school["school_id"])]
        return sum(rows) / len(rows)

    def test_ctrl_c_leaves_what_is_known_and_a_run_goes_on_from_there(self):
        for stop in (signal.SIGINT, signal.SIGTERM):
            folder = self.fresh(f"follow-stopped-{stop}")
            live, out = folder / "live", folder / "out"
            live.mkdir()
            first = sorted(SURVEY.glob("*.raw"))[0]
            data = first.read_bytes()
            (live / first.name).write_bytes(data[:-100000])
            self.start(live, out)
            deadline = time.monotonic() + 120
            while not self.follow.stdout.readline() and time.monotonic() < deadline:
                pass
            self.follow.send_signal(stop)
            code, _, err = self.end()
            self.assertEqual(code, 130, err)
            rows = sonarx.read_csv(out / "school_pings.csv")
            self.assertTrue(rows)
            self.assertEqual({row["provisional"] for row in rows}, {"1"})
            self.assertEqual([p.name for p in (out / "products").iterdir()], ["obs-0001.nc"])
            for file in SURVEY.glob("*.raw"):
                shutil.copy(file, live)
            self.sonarx("run", live, "--out", out)
            self.expect_run(live, out)

    def wait_for(self, words, timeout=120):
        deadline = time.monotonic() + timeout
        while time.monotonic() < deadline:
            if words in self.follow.stdout.readline():
                return
        self.fail(f"nothing said '{words}'")

    def test_what_is_over_is_right_before_a_run_has_the_last_word(self):
        folder = self.fresh("follow-over")
        live, out = folder / "live", folder / "out"
        shutil.copytree(SURVEY, live, ignore=shutil.ignore_patterns("truth"), copy_function=shutil.copyfile)
        self.start(live, out)
        self.wait_for("obs-0001 is over")
        self.follow.send_signal(signal.SIGINT)
        self.assertEqual(self.end()[0], 130)
        self.assertEqual((out / "products/obs-0001.nc").read_bytes(), (OUT / "products/obs-0001.nc").read_bytes())
        self.assertEqual({row["observation"] for row in sonarx.read_csv(out / "schools.csv")}, {"obs-0001", "obs-0002"})

    def test_ctrl_c_amid_a_look_loses_nothing_that_it_took_in(self):
        for wait_s in (0.05, 0.3, 0.6):
            folder = self.fresh("follow-amid")
            live, out = folder / "live", folder / "out"
            shutil.copytree(SURVEY, live, ignore=shutil.ignore_patterns("truth"), copy_function=shutil.copyfile)
            self.start(live, out)
            time.sleep(wait_s)
            self.follow.send_signal(signal.SIGINT)
            code, _, err = self.end()
            self.assertIn(code, (130, -signal.SIGINT), err)
            if code == 130:
                self.assertEqual(len(list((out / "products").iterdir())), 2, wait_s)

    def test_with_decisions_it_keeps_what_was_found_as_a_run_does(self):
        """A window that opens the results carries the decisions out on that."""
        folder = self.fresh("follow-decided")
        clicked, live, out, ran = (folder / name for name in ("clicked", "live", "out", "ran"))
        self.sonarx("propagate", SURVEY, "--observation", "obs-0001", "--seed", propagate_test.seed()[0], "--reach", 1, "--out", clicked)
        recipe = folder / "r.json"
        recipe.write_text('{"recipe_version": 1, "automatic": true}')
        session = ["--session", clicked / "session.jsonl", "--recipe", recipe]
        self.sonarx("run", SURVEY, "--out", ran, *session)
        shutil.copytree(SURVEY, live, ignore=shutil.ignore_patterns("truth"), copy_function=shutil.copyfile)
        self.start(live, out, "--idle-exit", 1, *session)
        self.assertEqual(self.end()[0], 0)
        found = sorted(file.name for file in (ran / "found").iterdir())
        self.assertEqual(found, ["obs-0001.nc"])
        self.assertEqual(sorted(file.name for file in (out / "found").iterdir()), found)
        self.assertNotEqual((ran / "products/obs-0001.nc").read_bytes(), (ran / "found/obs-0001.nc").read_bytes())
        for name in ("products/obs-0001.nc", "products/obs-0002.nc", "found/obs-0001.nc"):
            self.assertEqual((out / name).read_bytes(), (ran / name).read_bytes(), name)

    def test_nothing_is_written_beside_the_recording(self):
        folder = self.fresh("follow-clean")
        live = folder / "live"
        live.mkdir()
        shutil.copy(sorted(SURVEY.glob("*.raw"))[0], live)
        before = sonarx.snapshot(live)
        self.start(live, folder / "out", "--idle-exit", 1)
        self.assertEqual(self.end()[0], 0)
        self.assertEqual(sonarx.snapshot(live), before)

    def test_bad_calls(self):
        folder = self.fresh("follow-bad")
        self.one_line_error("follow", folder / "nowhere", "--out", folder / "out", code=1, names=folder / "nowhere")
        for options, names in ((("--alarm", "big > 3"), "big > 3"), (("--nmea", "chart"), "chart"),
                               (("--idle-exit", "-1"), "--idle-exit")):
            self.one_line_error("follow", SURVEY, "--out", folder / "out", *options, code=2, names=names)
        self.one_line_error("follow", SURVEY, "--out", SURVEY / "out", code=2, names=SURVEY / "out")
        self.assertFalse((folder / "out").exists())


if __name__ == "__main__":
    sonarx.main()
