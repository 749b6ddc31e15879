# SPDX-License-Identifier: Apache-2.0
"""The setup check of the small survey, against numpy on its tables."""
import json
import math

import sonarx
from sonarx import Case, run


class Check(Case):
    def test_a_simulated_setup_is_right_within_its_errors(self):
        code, said, err = run("check", sonarx.OUT, "--json")
        self.assertEqual(code, 0, err)
        told = json.loads(said)
        self.assertEqual(told["schools"], sum(1 for s in sonarx.read_csv(sonarx.OUT / "schools.csv") if s["speed_mps"]))
        self.assertEqual(sum(leg["schools"] for leg in told["legs"]), told["schools"])
        self.assertLess(abs(told["bearing_error_deg"]), 4 * told["bearing_error_se_deg"])
        self.assertLess(abs(told["range_scale"] - 1), 4 * told["range_scale_se"])
        self.assertTrue(math.isclose(told["proposed_sound_speed_mps"] * told["range_scale"], told["sound_speed_mps"]))
        code, said, err = run("check", sonarx.OUT)
        self.assertEqual(code, 0, err)
        self.assertIn("navigation.mounting_azimuth_deg 270 -> ", said)

    def test_an_empty_folder_is_named(self):
        folder = self.fresh("check")
        code, _, err = run("check", folder)
        self.assertNotEqual(code, 0)
        self.assertIn(str(folder), err)


if __name__ == "__main__":
    sonarx.main()
