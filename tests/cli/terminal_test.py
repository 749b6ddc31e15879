# SPDX-License-Identifier: Apache-2.0
"""What somebody at a terminal sees of long work: a line that is drawn over itself, and above it with -v the steps."""
import os
import pty
import re
import subprocess
import termios

import sonarx
from sonarx import SURVEY, WORK, Case


class Terminal(Case):
    def shown(self, *arguments):
        """(all that was sent, the lines that stay on the screen) of standard error, a terminal of its own"""
        terminal, theirs = pty.openpty()
        termios.tcsetwinsize(theirs, (50, 2000))  # no line is broken
        process = subprocess.Popen([sonarx.PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=theirs, env={**os.environ, "XDG_CACHE_HOME": str(WORK / "cache")})
        os.close(theirs)
        sent = b""
        try:
            while read := os.read(terminal, 65536):
                sent += read
        except OSError:  # the other end is closed
            pass
        os.close(terminal)
        self.assertEqual(process.wait(timeout=60), 0, sent[-2000:])
        text = sent.decode()
        plain = re.sub(r"\x1b\[\d*m", "", text)
        return plain, [re.split(r"\r|\x1b\[K", line)[-1] for line in plain.split("\r\n")]

    def test_steps_stand_above_the_progress(self):
        sent, stays = self.shown("run", SURVEY, "-o", self.fresh("terminal-steps"), "-v")
        for step in ("observation 1 of 2", "observation 2 of 2", "merge: 2", "map: 2"):
            self.assertEqual(stays.count(step), 1, stays)
        self.assertLess(stays.index("observation 2 of 2"), stays.index("merge: 2"))
        self.assertRegex(sent, r"\robservation 1 of 2: \w+ +\[[#.]{30}\] \d+/\d+")
        self.assertEqual([line for line in stays if "[" in line], [], "the progress itself is taken away")

    def test_without_v_nothing_stays(self):
        sent, stays = self.shown("run", SURVEY, "-o", self.fresh("terminal-quiet"))
        self.assertRegex(sent, r"\robservation 2 of 2: ")
        self.assertEqual([line for line in stays if not line.startswith("note ")], [""])

    def test_a_volume_tells_what_draws_it(self):
        _, stays = self.shown("render", "volume", SURVEY, "--renderer", "cpu", "--frames", "2", "-v", "--out",
                              self.fresh("terminal-volume") / "volume.png")
        self.assertEqual(sum(bool(re.fullmatch(r"drawing by cpu \(\w+\): 2", line)) for line in stays), 1, stays)

    def test_what_follows_the_observations_belongs_to_none(self):
        sent, _ = self.shown("run", SURVEY, "-o", self.fresh("terminal-merge"))
        for stage in ("merge", "map"):
            self.assertRegex(sent, rf"\r{stage} +\[#+\] 2/2")
            self.assertNotRegex(sent, rf"observation \d of \d: {stage}")


if __name__ == "__main__":
    sonarx.main()
