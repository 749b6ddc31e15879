# SPDX-License-Identifier: Apache-2.0
"""What 0.1.0 made is opened: a journal and a product, which stand in made_by_0.1.0 as that program wrote them.

The survey is `simulate --preset easy --observations 1 --pings 8 --schools 3 --seed 12`. The journal accepts school 1 by a
voxel in its middle, calls school 2 herring by the first sample of its longest run, rejects school 3 by the last one of
its, and says something of a voxel of open water, which no program can place.
"""
import gzip
import json
import shutil

import sonarx
from sonarx import PROJECT, Case

try:
    import netCDF4
except ImportError:
    netCDF4 = None

KEPT = PROJECT / "tests" / "cli" / "made_by_0.1.0"
EXPECTED = {1: ("accepted", "", ""), 2: ("unreviewed", "herring", "at its near rim"), 3: ("rejected", "", "")}


def masks(path):
    """{school: {(time of the ping, channel, sample)}}"""
    product = netCDF4.Dataset(path)
    product.set_auto_mask(False)
    pings = product["pings"]
    times = pings["time_ns" if "time_ns" in pings.variables else "time"][:].tolist()
    table = product["mask"]
    runs = zip(*(table[k][:].tolist() for k in ("school_id", "ping_index", "channel", "first_sample", "sample_count")))
    found = {}
    for school, ping, channel, first, count in runs:
        found.setdefault(school, set()).update((times[ping], channel, s) for s in range(first, first + count))
    product.close()
    return found


class EarlierVersion(Case):
    def setUp(self):
        if netCDF4 is None:
            self.skipTest("python3-netcdf4 is not installed")
        self.folder = self.fresh("earlier-version")
        self.survey = self.folder / "survey"
        self.sonarx("simulate", self.survey, "--preset", "easy", "--observations", 1, "--pings", 8, "--schools", 3,
                    "--seed", 12)

    def out_of_0_1_0(self, name):
        """A folder that holds its product, and that product's file."""
        product = self.folder / name / "products" / "obs-0001.nc"
        product.parent.mkdir(parents=True)
        product.write_bytes(gzip.decompress((KEPT / "obs-0001.nc.gz").read_bytes()))
        kept = self.folder / f"{name}.nc"
        shutil.copy(product, kept)
        return self.folder / name, kept

    def decided(self, out, kept):
        """{school of 0.1.0: (status, species, comment) of the school that has most of it now}"""
        rows = {int(r["school_id"]): r for r in sonarx.read_csv(out / "schools.csv")}
        now, then = masks(out / "products" / "obs-0001.nc"), masks(kept)
        heirs = {old: max(now, key=lambda school: len(now[school] & voxels)) for old, voxels in then.items()}
        self.assertEqual(len(set(heirs.values())), 3, heirs)
        return {old: (rows[n]["status"], rows[n]["species"], rows[n]["comment"]) for old, n in heirs.items()}

    def notes(self, out):
        return json.loads((out / "survey.json").read_text())["observations"][0]["notes"]

    def test_its_tables_are_read(self):
        out, _ = self.out_of_0_1_0("merged")
        self.sonarx("merge", out)
        rows = sonarx.read_csv(out / "schools.csv")
        self.assertEqual({int(r["school_id"]): (r["status"], r["species"], r["comment"]) for r in rows}, EXPECTED)
        self.assertEqual({r["ended_at_reach"] for r in rows}, {""})
        summary = json.loads((out / "survey.json").read_text())["summary"]
        self.assertEqual((summary["schools"], summary["school_rows"], summary["school_rows_rejected"]), (2, 3, 1))

    def test_decisions_go_to_the_schools_found_now(self):
        out, kept = self.out_of_0_1_0("again")
        session = KEPT / "session.jsonl"
        self.sonarx("run", self.survey, "--out", out, "--session", session)
        self.assertEqual(self.decided(out, kept), EXPECTED)
        self.assertEqual(self.notes(out)["decision-lost"], 1)

    def test_decisions_whose_voxels_are_nobodys_now_are_carried(self):
        out, kept = self.out_of_0_1_0("moved")
        recipe = json.loads(self.sonarx("recipe"))
        recipe["detect"]["tolerance_db"] = 5  # masks draw in from their rims
        (self.folder / "tight.json").write_text(json.dumps(recipe))
        run = ["run", self.survey, "--out", out, "--recipe", self.folder / "tight.json", "--session"]
        self.sonarx(*run, KEPT / "session.jsonl")
        self.assertEqual(self.decided(out, kept), EXPECTED)
        notes = self.notes(out)
        self.assertEqual((notes["decision-lost"], notes["decision-carried"]), (1, 2))
        # With another journal the older product is that of now, whose masks have not these voxels: nothing is forgotten.
        shorter = self.folder / "shorter.jsonl"
        lines = (KEPT / "session.jsonl").read_text().splitlines()
        shorter.write_text("\n".join(lines[:-1]) + "\n")
        self.sonarx(*run, shorter)
        self.assertEqual(self.decided(out, kept), EXPECTED)
        self.assertEqual(self.notes(out)["decision-carried"], 2)
        self.assertNotIn("decision-lost", self.notes(out))


if __name__ == "__main__":
    sonarx.main()
