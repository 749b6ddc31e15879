# SPDX-License-Identifier: Apache-2.0
"""Runs the built sonarx for the tests beside this file. SONARX = the program, SONAR_WORK = a folder to write in."""
import csv
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent.parent
PROGRAM = os.environ.get("SONARX", "sonarx")
WORK = Path(os.environ.get("SONAR_WORK", PROJECT / "build" / "tests-cli")).resolve()
SURVEY, OUT = WORK / "survey", WORK / "out"
TRUTH = SURVEY / "truth"

VERBS = ["info", "simulate", "calibrate", "run", "plan", "follow", "merge", "submit", "status", "check", "integrate", "biomass", "propagate", "import", "export", "score", "agree", "compare", "recipe", "render"]
SCHOOL_PINGS = (
    "observation,school_id,ping_index,time_utc,latitude,longitude,depth_m,range_m,bearing_deg,n_voxels,n_beams,n_fans,"
    "volume_m3,length_m,width_m,height_m,axis_deg,depth_min_m,depth_max_m,sv_mean_db,sv_p95_db,sv_max_db,backscatter_m2,"
    "valid_fraction,volume_corrected_m3,length_corrected_m,width_corrected_m,height_corrected_m,sv_corrected_db,snr_db,"
    "threshold_db,edge_flags,edge_fraction,touches_edge,bottom_depth_m,provisional,backscatter_psi_error_db,"
    "backscatter_calibration_se_db,"
    "backscatter_total_m2,backscatter_total_se_m2,survey_school,"
    "surface_m2,area_m2,equivalent_radius_m,box_length_m,box_width_m,box_thickness_m,sphericity,roughness,"
    "n_vacuoles,vacuole_fraction,n_nuclei,sv_p5_db,sv_p50_db,sv_robust_mean_db,sv_variation,sv_skewness,"
    "sv_kurtosis,core_edge_db,nasc_m2_nmi2,surface_distance_m,bottom_distance_m,horizontal_range_m,"
    "incidence_deg,diner_nb_across,diner_nb_height,box_bearing_deg,box_tilt_deg,mass_latitude,mass_longitude,"
    "mass_depth_m,"
    "speed_smoothed_mps,speed_smoothed_se_mps,course_smoothed_deg,vertical_speed_smoothed_mps,"
    "speed_water_smoothed_mps,course_water_smoothed_deg,relative_bearing_deg,ship_speed_mps,course_away_deg,"
    "speed_away_mps,speed_away_se_mps,speed_away_water_mps,time_to_cpa_s,cpa_m,wake_distance_m,depth_error_m,"
    "extinction_loss_db,extinction_share,extinction_share_low,extinction_share_high,extinction_corrected,"
    "course_smoothed_se_deg,vertical_speed_smoothed_se_mps,speed_water_smoothed_se_mps,course_water_smoothed_se_deg,"
    "course_away_se_deg,speed_away_water_se_mps,time_to_cpa_se_s,cpa_se_m").split(",")
SCHOOLS = (
    "observation,school_id,continues,first_time_utc,last_time_utc,n_pings,n_pings_whole,latitude,longitude,depth_m,"
    "volume_m3,volume_corrected_m3,length_m,width_m,height_m,sv_mean_db,sv_corrected_db,backscatter_m2,speed_mps,"
    "speed_se_mps,course_deg,vertical_speed_mps,touches_edge_fraction,origin,status,operator,decided_utc,species,"
    "comment,name,backscatter_psi_error_db,backscatter_calibration_se_db,"
    "backscatter_total_m2,backscatter_total_se_m2,ended_at_reach,survey_school,"
    "surface_m2,area_m2,equivalent_radius_m,box_length_m,box_width_m,box_thickness_m,sphericity,roughness,"
    "n_vacuoles,vacuole_fraction,n_nuclei,sv_p5_db,sv_p50_db,sv_robust_mean_db,sv_variation,sv_skewness,"
    "sv_kurtosis,core_edge_db,nasc_m2_nmi2,surface_distance_m,bottom_distance_m,horizontal_range_m,"
    "incidence_deg,diner_nb_across,diner_nb_height,"
    "course_se_deg,vertical_speed_se_mps,tortuosity,tortuosity_se,speed_water_mps,speed_water_se_mps,"
    "course_water_deg,course_water_se_deg,current_east_mps,current_north_mps,current_se_mps,depth_error_m,"
    "extinction_loss_db,extinction_share,extinction_share_low,extinction_share_high,extinction_corrected,"
    "depth_se_m,volume_se_m3,length_se_m,width_se_m,height_se_m,sv_mean_se_db,backscatter_se_m2,surface_se_m2,"
    "area_se_m2,equivalent_radius_se_m,box_length_se_m,box_width_se_m,box_thickness_se_m,sphericity_se,"
    "roughness_se,n_vacuoles_se,vacuole_fraction_se,n_nuclei_se,sv_p5_se_db,sv_p50_se_db,sv_robust_mean_se_db,"
    "sv_variation_se,sv_skewness_se,sv_kurtosis_se,core_edge_se_db,nasc_se_m2_nmi2,surface_distance_se_m,"
    "bottom_distance_se_m,horizontal_range_se_m,diner_nb_across_se,diner_nb_height_se,"
    "volume_corrected_se_m3,sv_corrected_se_db").split(",")


def run(*arguments, timeout=600, cache=WORK / "cache"):
    """(exit code, standard output, standard error); `cache` = where indexes and echograms are kept"""
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache)}
    for display in ("DISPLAY", "WAYLAND_DISPLAY"):
        environment.pop(display, None)
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          timeout=timeout, env=environment, check=False)
    return done.returncode, done.stdout, done.stderr


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def header(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return next(csv.reader(stream))


def snapshot(folder):
    """Every file under the folder with size, time and bytes' hash: equal snapshots, untouched folder."""
    import hashlib
    return {p.relative_to(folder).as_posix(): (p.stat().st_size, p.stat().st_mtime_ns,
                                               hashlib.sha1(p.read_bytes()).hexdigest())
            for p in sorted(folder.rglob("*")) if p.is_file()}


def contents(folder):
    """The same without times."""
    return {name: (size, digest) for name, (size, _, digest) in snapshot(folder).items()}


def simulate_tiny(folder, observations, pings):
    """A survey of 160 beams, a third of the tests' own, for what is done a hundred times: its raw files' folder."""
    beams = [f"{16 * fan + beam},900,{2.5 * fan - 30},{-20 + 2.5 * beam},{80000 + 2000 * fan},3,3,27,-27,0,1000,0.03"
             for fan in range(10) for beam in range(16)]
    columns = ("channel,count,elevation_deg,azimuth_deg,frequency_hz,vertical_width_deg,horizontal_width_deg,gain_db,psi_db,"
               "sa_correction_db,power_w,absorption_db_per_m")
    (folder / "beams.csv").write_text("\n".join([columns, *beams]) + "\n", encoding="ascii")
    code, _, err = run("simulate", folder / "sound", "--preset", "easy", "--seed", 5, "--observations", observations,
                       "--pings", pings, "--schools", 2, "--beams", folder / "beams.csv")
    assert code == 0, err
    return folder / "sound"


class Case(unittest.TestCase):
    def sonarx(self, *arguments, code=0, timeout=600):
        got, out, err = run(*arguments, timeout=timeout)
        self.assertEqual(got, code, f"sonarx {' '.join(map(str, arguments))}\n{out[-2000:]}\n{err[-2000:]}")
        return out

    def one_line_error(self, *arguments, code, names=""):
        """Fails with one line on standard error that names what was wrong, nothing on standard output."""
        got, out, err = run(*arguments)
        self.assertEqual(got, code, f"sonarx {' '.join(map(str, arguments))}\n{out[-2000:]}\n{err[-2000:]}")
        self.assertEqual(len(err.strip().splitlines()), 1, err)
        self.assertIn(str(names), err)
        self.assertEqual(out, "")

    @staticmethod
    def fresh(name):
        """An empty folder of this test's own."""
        folder = WORK / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder


def main():
    unittest.main(argv=[sys.argv[0]], verbosity=2)
