# SPDX-License-Identifier: Apache-2.0
"""Numbers of fish, worked out again from the tables of the run by formulas of docs/interfaces.md."""
import csv
import io
import math
import shutil
from collections import defaultdict

import sonarx
from sonarx import OUT, Case, header, read_csv

COUNTS = {24: 5, 27: 60, 31: 35}
A, B = 0.005, 3.1


def mean(of):
    return sum(n * of(cm) for cm, n in COUNTS.items()) / sum(COUNTS.values())


class Biomass(Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.fresh("biomass")
        cls.out = cls.folder / "out"
        shutil.copytree(OUT, cls.out)
        cls.lengths = cls.folder / "lengths.csv"
        cls.lengths.write_text("length_cm,count\n" + "".join(f"{cm},{n}\n" for cm, n in COUNTS.items()))

    def biomass(self, *arguments, **keys):
        return self.sonarx("biomass", self.out, "--lengths", self.lengths, *arguments, **keys)

    def test_numbers_are_echo_over_cross_section(self):
        said = self.biomass("--ts", "herring-ona", "--weight-a", A, "--weight-b", B)
        self.assertIn("recalled: check it", said)
        rows = [r for r in read_csv(OUT / "schools.csv") if r["status"] != "rejected"]
        parts = {r["continues"] for r in rows} | {f"{r['observation']}/{r['school_id']}" for r in rows if r["continues"]}
        pings = defaultdict(list)
        for r in read_csv(OUT / "school_pings.csv"):
            pings[r["observation"], r["school_id"]].append(r)
        told = {(r["observation"], r["school_id"]): r for r in read_csv(self.out / "biomass.csv")}
        checked = 0
        for r in rows:
            key = r["observation"], r["school_id"]
            if "/".join(key) in parts:
                continue
            used = [p for p in pings[key] if p["backscatter_total_m2"]]
            used = [p for p in used if p["touches_edge"] == "0"] or used
            if not used:
                continue
            echo = sum(float(p["backscatter_total_m2"]) for p in used)
            sigma = sum(mean(lambda cm: 10**((20 * math.log10(cm) - 65.4 - 2.3 * math.log10(1 + float(p["depth_m"]) / 10)) / 10))
                        for p in used)
            if any(not p["backscatter_total_m2"] for p in pings[key]) or echo <= 0:
                continue
            numbers = echo / sigma
            row = told[key]
            self.assertAlmostEqual(float(row["numbers"]) / numbers, 1, 9)
            self.assertAlmostEqual(float(row["biomass_t"]) / (numbers * mean(lambda cm: A * cm**B) * 1e-6), 1, 9)
            self.assertLess(float(row["numbers_low"]), numbers)
            self.assertGreater(float(row["numbers_high"]), numbers)
            checked += 1
        self.assertGreater(checked, 0)
        seen = [float(r["numbers"]) for r in told.values() if r["numbers"]]
        self.assertAlmostEqual(float(read_csv(self.out / "biomass_strata.csv")[-1]["numbers_seen"]) / sum(seen), 1, 9)

    def test_relations_can_be_replaced(self):
        table = list(csv.DictReader(io.StringIO(self.sonarx("biomass", "--print-ts"))))
        self.assertEqual(len(table), len(self.sonarx("biomass", "--list-ts").splitlines()))
        own = self.folder / "ts.csv"
        with open(own, "w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, table[0].keys())
            writer.writeheader()
            writer.writerow({**table[0], "name": "mine", "b_db": "-60", "source": "me"})
        self.assertIn("mine: herring, TS = 20 log10 L - 60 dB", self.biomass("--ts-table", own, "--ts", "mine"))
        self.assertIn("aspect_deg", header(self.out / "biomass_pings.csv"))

    def test_bad_input_is_named(self):
        self.one_line_error("biomass", self.out, "--ts", "cod", code=2, names="--lengths")
        self.one_line_error("biomass", self.out, "--lengths", self.lengths, "--ts", "whale", code=1, names="'whale'")
        bad = self.folder / "bad.csv"
        bad.write_text("length_cm,count\n20,few\n")
        self.one_line_error("biomass", self.out, "--lengths", bad, "--ts", "cod", code=1, names="line 2")
        areas = self.folder / "areas.csv"
        areas.write_text("stratum,area_nmi2\nnowhere,10\n")
        self.one_line_error("biomass", self.out, "--lengths", self.lengths, "--ts", "cod", "--areas", areas, code=1,
                            names="'nowhere'")


if __name__ == "__main__":
    sonarx.main()
