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


if __name__ == "__main__":
    sonarx.main()
