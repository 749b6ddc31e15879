# SPDX-License-Identifier: Apache-2.0
"""The setup check says what it lacks, and never guesses; its figures are tested where tracks are known (setup_check_test)."""
import json

import sonarx
from sonarx import Case, run


class Check(Case):
    def test_too_few_schools_are_told(self):
        """The small survey has fewer schools that were seen long enough than the check needs."""
        with_speed = sum(1 for school in sonarx.read_csv(sonarx.OUT / "schools.csv") if school["speed_mps"])
        code, said, err = run("check", sonarx.OUT, "--json")
        if with_speed < 3:
            self.assertEqual((code, said), (1, ""))
            self.assertIn(f"expected 3 or more, found {with_speed}", err)
            return
        told = json.loads(said)
        self.assertEqual((code, told["schools"]), (0, with_speed), err)
        self.assertEqual(told["proposed_mounting_azimuth_deg"] is None, told["drift"] is None)

    def test_an_empty_folder_is_named(self):
        folder = self.fresh("check")
        code, _, err = run("check", folder)
        self.assertEqual(code, 1)
        self.assertIn(str(folder), err)

    def test_a_name_that_is_no_pictures_is_refused_before_the_work(self):
        """Nothing of the sphere run or the results is read first: neither is there."""
        for verb in (("check", "absent"), ("calibrate", "absent", "--sphere", "wc38.1", "-o", "gains.csv")):
            code, _, err = run(*verb, "--picture", "chart.txt")
            self.assertEqual((code, err.strip()), (2, "sonarx: chart.txt: expected a name that ends in .png, .svg or .pdf"))


if __name__ == "__main__":
    sonarx.main()
