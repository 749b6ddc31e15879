# SPDX-License-Identifier: Apache-2.0
"""Two readers of one survey: the run as it is, and one click on one school. Dice worked out again from the masks."""
import json
import unittest

import sonarx
from propagate_test import netCDF4, seed
from sonarx import OUT, SURVEY, Case


def voxels(path):
    """{(school, ping): set of (channel, sample)} of a product."""
    product = netCDF4.Dataset(path)
    names = ("school_id", "ping_index", "channel", "first_sample", "sample_count")
    out = {}
    for school, ping, channel, first, count in zip(*(product["mask"][name][:].tolist() for name in names)):
        out.setdefault((school, ping), set()).update((channel, first + i) for i in range(count))
    product.close()
    return out


@unittest.skipIf(netCDF4 is None, "python3-netcdf4 is not installed")
class Agree(Case):
    @classmethod
    def setUpClass(cls):
        cls.one = cls.fresh("agree-one")
        place, _ = seed()
        code, _, err = sonarx.run("propagate", SURVEY, "--observation", "obs-0001", "--seed", place, "--tolerance-db", "10",
                                  "--out", cls.one)
        assert code == 0, err

    def agreement(self, a, b, *more):
        return json.loads(self.sonarx("agree", a, b, "--json", *more))

    def test_with_itself_is_perfect(self):
        told = self.agreement(OUT, OUT)
        self.assertEqual(len(told["schools"]), len(sonarx.read_csv(OUT / "schools.csv")))
        for school in told["schools"]:
            self.assertEqual((school["dice_low"], school["volume_ratio"], school["backscatter_difference_db"]), (1, 1, 0))
        self.assertEqual(told["kappa_schools"]["agreed_fraction"], 1)
        self.assertIsNone(told["kappa_schools"]["kappa"])  # nobody rejected anything
        self.assertEqual(told["pings"], 28)

    def test_dice_of_the_pair_is_that_of_its_masks(self):
        told = self.agreement(OUT, self.one)
        pairs = [school for school in told["schools"] if school["school_a"] and school["school_b"]]
        self.assertEqual(len(pairs), 1)
        run, one = voxels(OUT / "products/obs-0001.nc"), voxels(self.one / "products/obs-0001.nc")
        school_a = int(pairs[0]["school_a"].split("/")[1])
        a = {ping: mask for (school, ping), mask in run.items() if school == school_a}
        b = {ping: mask for (_, ping), mask in one.items()}
        dice = [2 * len(a.get(p, set()) & b.get(p, set())) / (len(a.get(p, set())) + len(b.get(p, set())))
                for p in a.keys() | b.keys()]
        self.assertAlmostEqual(pairs[0]["dice"], sum(dice) / len(dice), 9)
        self.assertAlmostEqual(pairs[0]["dice_low"], min(dice), 9)
        self.assertEqual(told["voxels"]["b"], sum(map(len, b.values())))

    def test_swapped_it_mirrors(self):
        forth, back = self.agreement(OUT, self.one), self.agreement(self.one, OUT)
        self.assertEqual([(s["school_a"], s["school_b"], s["dice"]) for s in forth["schools"]],
                         [(s["school_b"], s["school_a"], s["dice"]) for s in back["schools"]])
        self.assertEqual(forth["kappa_schools"]["kappa"], back["kappa_schools"]["kappa"])

    def test_table_and_pictures(self):
        folder = self.fresh("agree-table")
        told = self.agreement(OUT, self.one, "--out", folder)
        rows = sonarx.read_csv(folder / "agreement.csv")
        self.assertEqual([row["school_a"] for row in rows], [school["school_a"] or "" for school in told["schools"]])
        self.assertIn("kappa", self.sonarx("agree", OUT, self.one))
        self.sonarx("render", "slice-side", OUT, "--against", self.one, "--size", "640x480", "-o", folder / "side.svg")
        drawn = (folder / "side.svg").read_text()
        self.assertIn("only in A", drawn)
        self.one_line_error("render", "timeline", OUT, "--against", self.one, "-o", folder / "t.png", code=2,
                            names="--against")

    def test_what_is_refused(self):
        self.one_line_error("agree", OUT, SURVEY / "truth" / "none", code=1, names="none")
        self.one_line_error("agree", OUT, self.one, "--out", SURVEY, code=2, names=SURVEY)


if __name__ == "__main__":
    sonarx.main()
