# SPDX-License-Identifier: Apache-2.0
"""Asked to stop, by a human or by a batch system, a run ends soon, says so, and leaves whole files; and a file that the
user's limits do not allow is an error like any other."""
import os
import resource
import shutil
import signal
import subprocess
import time

import sonarx
from sonarx import OUT, PROGRAM, SURVEY, WORK, Case

LIMIT_BYTES = 20_000


def environment():
    return {**os.environ, "XDG_CACHE_HOME": str(WORK / "cache")}


class Stop(Case):
    def stopped(self, out, sent):
        """Exit code and words of a run that was asked to stop while it was at work."""
        process = subprocess.Popen([PROGRAM, "run", str(SURVEY), "--out", str(out), "--jobs", "1"],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   text=True, env=environment())
        while not (out / "plan.json").exists() and process.poll() is None:
            time.sleep(0.002)
        process.send_signal(sent)
        return process.wait(60), process.stderr.read()

    def test_every_way_of_stopping_is_clean(self):
        for sent in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(sent.name):
                folder = self.fresh(f"stop-{sent.name}")
                out = folder / "out"
                code, said = self.stopped(out, sent)
                self.assertEqual(code, 130, said)
                self.assertIn("interrupted", said)
                products = sorted(p.name for p in (out / "products").glob("*")) if (out / "products").exists() else []
                self.assertLess(len(products), 2, products)
                for product in products:
                    self.assertRegex(product, r"^obs-\d{4}\.nc$")
                self.sonarx("run", SURVEY, "--out", out)
                self.assertEqual((out / "schools.csv").read_bytes(), (OUT / "schools.csv").read_bytes())
                shutil.rmtree(folder)

    def test_a_file_larger_than_allowed_is_an_error(self):
        folder = self.fresh("stop-limit")
        done = subprocess.run([PROGRAM, "run", SURVEY, "--out", folder / "out"], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, env=environment(),
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT_BYTES, LIMIT_BYTES)))
        self.assertGreater(done.returncode, 0, "not killed by a signal")
        self.assertIn("obs-0001", done.stderr)
        self.assertEqual([p for p in (folder / "out").rglob("*.nc")], [])
        shutil.rmtree(folder)


    def test_half_a_simulation_leaves_nothing(self):
        for sent in (signal.SIGINT, signal.SIGTERM):
            for physics in ("standard", "array"):
                folder = self.fresh("stop-simulate")
                out = folder / "made"
                process = subprocess.Popen([PROGRAM, "simulate", out, "--physics", physics, "--pings", "400",
                                            "--observations", "3", "--file-mb", "1"], stdin=subprocess.DEVNULL,
                                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                while not list(out.glob("*.raw")) and process.poll() is None:
                    time.sleep(0.01)
                self.assertIsNone(process.poll(), "it came to its end too soon")
                process.send_signal(sent)
                self.assertEqual(process.wait(60), 130, process.stderr.read())
                process.stderr.close()
                self.assertEqual(list(folder.iterdir()), [], (sent, physics))
                shutil.rmtree(folder)

    def test_a_simulation_that_fails_leaves_nothing_of_its_own(self):
        folder = self.fresh("stop-simulate-limit")
        (folder / "notes.txt").write_text("somebody's own")
        done = subprocess.run([PROGRAM, "simulate", folder, "--pings", "6"], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT_BYTES, LIMIT_BYTES)))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual([p.name for p in folder.rglob("*")], ["notes.txt"])
        shutil.rmtree(folder)

    def test_too_little_memory_is_told_in_a_sentence(self):
        folder = self.fresh("stop-memory")
        told = 0
        for megabytes in (220, 260, 300, 340, 380, 420):
            limit = megabytes << 20
            done = subprocess.run([PROGRAM, "run", SURVEY, "--out", folder / "out", "--jobs", "1"], capture_output=True,
                                  text=True, stdin=subprocess.DEVNULL, env=environment(),
                                  preexec_fn=lambda limit=limit: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            self.assertGreaterEqual(done.returncode, 0, f"killed by a signal at {megabytes} MB: {done.stderr}")
            if done.returncode != 0:
                self.assertIn("memory", done.stderr)
                told += 1
        self.assertGreater(told, 0)
        shutil.rmtree(folder)

    def test_small_stacks_are_enough(self):
        folder = self.fresh("stop-stack")
        out = folder / "out"
        done = subprocess.run([PROGRAM, "run", SURVEY, "--out", out], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, env=environment(),
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_STACK, (256 << 10, 256 << 10)))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((out / "schools.csv").read_bytes(), (OUT / "schools.csv").read_bytes())
        shutil.rmtree(folder)


if __name__ == "__main__":
    sonarx.main()
