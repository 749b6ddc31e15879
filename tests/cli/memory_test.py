# SPDX-License-Identifier: Apache-2.0
"""A 3 GB observation under 600 MB resident: one small file over and over, each copy's datagrams later in time."""
import json
import os
import resource
import shutil
import struct

import sonarx
from sonarx import SURVEY, Case

BYTES = int(float(os.environ.get("SONAR_MEMORY_GB", "3")) * 1e9)
LIMIT_KB = 600 * 1024


def times(data):
    """Offsets of the datagrams' time stamps (FILETIME, 100 ns)."""
    at, offsets = 0, []
    while at + 16 <= len(data):
        offsets.append(at + 8)
        at += struct.unpack_from("<i", data, at)[0] + 8
    return offsets


class Memory(Case):
    def test_long_observation(self):
        folder = self.fresh("memory")
        raw, out = folder / "raw", folder / "out"
        raw.mkdir()
        data = bytearray(sorted(SURVEY.glob("*.raw"))[0].read_bytes())
        offsets = times(data)
        stamps = [struct.unpack_from("<Q", data, at)[0] for at in offsets]
        step = stamps[-1] - stamps[0] + 50_000_000
        copies = -(-BYTES // len(data))
        for copy in range(copies):
            for at, stamp in zip(offsets, stamps):
                struct.pack_into("<Q", data, at, stamp + copy * step)
            (raw / f"part-{copy:05}.raw").write_bytes(data)
        recipe = json.loads(self.sonarx("recipe"))
        recipe["survey"]["observation_max_s"] = 0
        (folder / "recipe.json").write_text(json.dumps(recipe))
        self.sonarx("run", raw, "--out", out, "--recipe", folder / "recipe.json", timeout=1500)
        survey = json.loads((out / "survey.json").read_text())
        self.assertEqual(survey["summary"]["observations"], 1)
        self.assertEqual(survey["summary"]["pings"], 14 * copies)
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, LIMIT_KB)
        shutil.rmtree(folder)


if __name__ == "__main__":
    sonarx.main()
