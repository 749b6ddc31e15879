// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/describe.h"
#include "base/result.h"
#include "synth/array/element_params.h"
#include "synth/array/sphere_params.h"

namespace sonar::synth::array {

/// Single fish: their echoes and how they stand in the water.
struct FishParams {
  double length_min_cm = 20.0;
  double length_max_cm = 34.0;
  double length_spread = 0.08;
  double ts_offset_db = -68.0;
  double bladder = 0.25;
  double any_aspect_share = 0.1;
  double heading_sd_deg = 14.0;
  double tilt_sd_deg = 10.0;
  double per_m3_min = 0.5;
  double per_m3_max = 8.0;
  int most_echoes = 30000;
};

template <class Visitor>
void describe(Visitor& v, FishParams& p) {
  v.field("length_min_cm", p.length_min_cm,
          {.unit = "cm",
           .min = 2,
           .max = 200,
           .text = "Mean fish length in the school with the smallest fish. Lower it to test schools of small fish, "
                   "whose echoes are weak."});
  v.field("length_max_cm", p.length_max_cm,
          {.unit = "cm",
           .min = 2,
           .max = 200,
           .text = "Mean fish length in the school with the largest fish. Raise it to test large fish, whose echoes "
                   "are strong and depend much on aspect."});
  v.field("length_spread", p.length_spread,
          {.unit = "1",
           .min = 0,
           .max = 0.5,
           .text = "Standard deviation of fish length within a school, as a share of its mean. Raise it to test "
                   "schools of mixed sizes; set it to 0 for fish of one length."});
  v.field("ts_offset_db", p.ts_offset_db,
          {.unit = "dB",
           .min = -100,
           .max = -40,
           .text = "Target strength broadside is 20 log10(length / 1 cm) plus this. Change it for another species; "
                   "lower it for fish without a swim bladder."});
  v.field("bladder", p.bladder,
          {.unit = "1",
           .min = 0.01,
           .max = 1,
           .text = "Length of the part of a fish that scatters as a line, as a share of its length. Raise it to test "
                   "echoes that depend more on aspect; lower it for fish that echo alike from all sides."});
  v.field("any_aspect_share", p.any_aspect_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "Share of the broadside echo that comes back at any aspect. Raise it for fish that echo alike from "
                   "all sides; set it to 0 to test schools that nearly vanish end on."});
  v.field("heading_sd_deg", p.heading_sd_deg,
          {.unit = "deg",
           .min = 0,
           .max = 180,
           .text = "Standard deviation of the headings of the fish in a school. Lower it to test schools whose echo "
                   "depends on aspect; raise it for fish that head anywhere."});
  v.field("tilt_sd_deg", p.tilt_sd_deg,
          {.unit = "deg",
           .min = 0,
           .max = 90,
           .text = "Standard deviation of the tilts of the fish in a school. Raise it to test fish that feed or dive; "
                   "set it to 0 for fish that swim level."});
  v.field("per_m3_min", p.per_m3_min,
          {.unit = "m-3",
           .min = 0.001,
           .max = 50,
           .text = "Number of fish per cubic metre in the thinnest school. Lower it to test how thin a school may be "
                   "and still be detected."});
  v.field("per_m3_max", p.per_m3_max,
          {.unit = "m-3",
           .min = 0.001,
           .max = 50,
           .text = "Number of fish per cubic metre in the densest school. Raise it to test very strong echoes; lower "
                   "it for a survey of thin schools alone."});
  v.field("most_echoes", p.most_echoes,
          {.min = 100,
           .max = 10000000,
           .text = "Most echoes of a school; where there are more fish, each echo is the sum of several. Lower it to "
                   "simulate faster; raise it to test that this changes no result."});
}

/// Other scatterers, and the state of the water: strengths from 0 (none) to 1 (strong).
struct Company {
  double hull_bubbles = 0.5;
  double plumes = 0.5;
  double surface = 0.5;
  double layers = 0.5;
  double single_fish = 0.5;
  double seabed = 0.5;
  double other_sounders = 0.3;
  double refraction = 0.3;
  double unsteady = 0.3;
  double noise_power_db = -168.0;
  double reverberation_sv_db = -88.0;
  double seabed_depth_m = 160.0;
};

template <class Visitor>
void describe(Visitor& v, Company& p) {
  const auto strength = [&v](std::string_view name, double& value, std::string_view text) {
    v.field(name, value, {.unit = "1", .min = 0, .max = 2, .text = text});
  };
  strength("hull_bubbles", p.hull_bubbles,
           "Strength of bubble clouds that the hull carries along: 0 none, 1 strong. Raise it to test that what "
           "travels with the ship is not called a school.");
  strength("plumes", p.plumes,
           "Strength of bubble plumes, in rows down the wind, that stay in place and fade in minutes: 0 none, 1 "
           "strong. Raise it to test for false schools near the surface.");
  strength("surface", p.surface,
           "Strength of the sea surface's echo, in patches that last a minute: 0 none, 1 strong. Raise it to test "
           "schools below a rough surface.");
  strength("layers", p.layers,
           "Strength of scattering layers: 0 none, 1 strong. Raise it to test that layers are not called schools, and "
           "that schools inside them are still detected.");
  strength(
      "single_fish", p.single_fish,
      "How many fish keep to themselves: 0 none, 1 many. Raise it to test that single fish are not called schools.");
  strength("seabed", p.seabed,
           "Strength of the seabed's echo and its roughness: 0 no seabed, 1 strong. Raise it to test schools above "
           "rough ground; set it to 0 for deep water.");
  strength("other_sounders", p.other_sounders,
           "How often another vessel's sounder is heard: 0 never, 1 in three pings of ten. Raise it to test that its "
           "pulses are flagged and not called schools.");
  strength("refraction", p.refraction,
           "How much a gradient of sound speed bends the beams up or down: 0 not at all, 1 strongly. Raise it to test "
           "the errors in depth that this causes.");
  strength("unsteady", p.unsteady,
           "Roll in degrees that beam stabilisation leaves; pitch is half of it. Raise it to test masks that shift "
           "from ping to ping; set it to 0 for perfect stabilisation.");
  v.field("noise_power_db", p.noise_power_db,
          {.unit = "dB re 1 W",
           .min = -300,
           .max = -50,
           .text = "Background noise power in every sample, differing over the beams. Raise it to test how far away "
                   "schools are detected from a noisy ship; lower it for a quiet ship."});
  v.field("reverberation_sv_db", p.reverberation_sv_db,
          {.unit = "dB re 1 m-1",
           .min = -300,
           .max = 0,
           .text = "Sv of the water itself, everywhere. Raise it to test water with plankton, in which weak schools "
                   "hardly rise above the background."});
  v.field("seabed_depth_m", p.seabed_depth_m,
          {.unit = "m",
           .min = 30,
           .max = 3000,
           .text = "Water depth at the start. Lower it to bring the seabed echo to the ranges of the schools; raise it "
                   "for deep water whose seabed is out of reach."});
}

enum class Waters { stated, random };
inline constexpr std::array<std::string_view, 2> kWatersNames = {"stated", "random"};

/// A synthetic survey by array elements and single fish.
struct ArrayParams {
  int seed = 1;
  int observations = 3;
  int pings = 60;
  int schools = 10;
  Waters waters = Waters::random;
  double speed_knots = 6.0;
  double ping_interval_s = 5.0;
  double gap_s = 600.0;
  double range_min_m = 60.0;
  double range_max_m = 400.0;
  double length_min_m = 15.0;
  double length_max_m = 70.0;
  double own_speed_max_mps = 1.0;
  double motion_deg = 1.0;
  double file_mb = 100.0;
  Elements elements;
  FishParams fish;
  Company company;
  SphereParams sphere;
};

template <class Visitor>
void describe(Visitor& v, ArrayParams& p) {
  v.field("seed", p.seed,
          {.min = 0,
           .max = 2147483647,
           .text = "Seed of every random number; change it for another survey of the same kind."});
  v.field("observations", p.observations,
          {.min = 1,
           .max = 1000,
           .text = "Number of observations. Raise it for a longer survey, whose results rest on more schools; lower it "
                   "for a quick trial."});
  v.field("pings", p.pings,
          {.min = 1,
           .max = 100000,
           .text = "Number of pings in each observation. Raise it for longer tracks and more room for schools; lower "
                   "it for a quick trial."});
  v.field("schools", p.schools,
          {.min = 0,
           .max = 500,
           .text = "Number of schools in each observation. Raise it to test crowded water; set it to 0 for a survey in "
                   "which every detection is false."});
  v.choice("waters", p.waters, kWatersNames,
           "Whether the strengths of other scatterers are drawn for each observation from the seed, for varied waters "
           "(random), or stand as given, to test one kind alone (stated).");
  v.field("speed_knots", p.speed_knots,
          {.unit = "kn",
           .min = 0,
           .max = 25,
           .text = "The ship's speed over ground. Raise it to test tracks of schools that are seen in few pings; lower "
                   "it for more pings of each school."});
  v.field("ping_interval_s", p.ping_interval_s,
          {.unit = "s",
           .min = 1,
           .max = 60,
           .text = "Time between pings. Raise it to test tracks of schools that are seen in few pings and move far "
                   "between them."});
  v.field("gap_s", p.gap_s,
          {.unit = "s",
           .min = 121,
           .max = 86400,
           .text = "Time without pings between two observations. Lower it to test that short gaps, too, divide a "
                   "survey into observations."});
  v.field("range_min_m", p.range_min_m,
          {.unit = "m",
           .min = 30,
           .max = 480,
           .text = "Range of the nearest school when it is abeam. Lower it to test schools close to the ship, of which "
                   "the sector holds only a part."});
  v.field("range_max_m", p.range_max_m,
          {.unit = "m",
           .min = 30,
           .max = 480,
           .text = "Range of the farthest school when it is abeam. Raise it to test far schools, where beams are wide "
                   "and signal-to-noise is low."});
  v.field("length_min_m", p.length_min_m,
          {.unit = "m",
           .min = 5,
           .max = 300,
           .text = "Length of the shortest school. Lower it to test whether schools smaller than a beam is wide are "
                   "detected, and whether their size is corrected well."});
  v.field("length_max_m", p.length_max_m,
          {.unit = "m",
           .min = 5,
           .max = 300,
           .text = "Length of the longest school. Raise it to test large schools, which the border of the sector cuts "
                   "in many pings."});
  v.field("own_speed_max_mps", p.own_speed_max_mps,
          {.unit = "m s-1",
           .min = 0,
           .max = 5,
           .text = "Speed of the fastest school. Raise it to test tracks of schools that move far between pings; set "
                   "it to 0 for schools that stand still."});
  v.field("motion_deg", p.motion_deg,
          {.unit = "deg",
           .min = 0,
           .max = 10,
           .text = "Amplitude of the ship's yaw and pitch; roll is three times this. Raise it for a rough sea; set it "
                   "to 0 for a ship that does not move with the waves."});
  v.field("file_mb", p.file_mb,
          {.unit = "MB",
           .min = 1,
           .max = 4000,
           .text = "Size at which a new raw file begins. Lower it to test schools that are seen across the border of "
                   "two raw files."});
  v.group("elements", p.elements, "the array that sends and receives");
  v.group("fish", p.fish, "single fish");
  v.group("company", p.company, "other scatterers and the state of the water, for waters = stated");
  v.group("sphere", p.sphere, "a calibration sphere that is steered through the beams");
}

/// errors  bad_parameter: a field out of range, or a range upside down
[[nodiscard]] Result<void> check(const ArrayParams& params);

/// A run for calibration: a ship at anchor in quiet water without schools, a sphere of tungsten carbide of 38.1 mm that is
/// steered through some 60 beams, and stated gains and sa corrections that err.
[[nodiscard]] ArrayParams sphere_run();

/// The other scatterers of one observation: as stated, or drawn from the seed, each kind absent in three waters of ten.
[[nodiscard]] Company company_of(const ArrayParams& params, int observation);

}  // namespace sonar::synth::array
