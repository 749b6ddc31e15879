// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/describe.h"
#include "base/result.h"

namespace sonar::synth::array {

/// How the receiving elements are weighted.
enum class Shading { uniform, taylor, dolph };
inline constexpr std::array<std::string_view, 3> kShadingNames = {"uniform", "taylor", "dolph"};

/// What the beam table says of the equivalent beam angle: the true pattern's, or more by psi_excess_db at 45 degrees of
/// elevation, growing as cos^-4 from none at 0.
enum class PsiLaw { exact, cos4 };
inline constexpr std::array<std::string_view, 2> kPsiLawNames = {"exact", "cos4"};

/// The array that sends and receives: a flat one that faces abeam.
struct Elements {
  int columns = 34;  ///< along the ship
  int rows = 21;     ///< upright
  double column_spacing_mm = 8.6;
  double row_spacing_mm = 7.6;
  Shading shading = Shading::taylor;
  double side_lobe_db = -25.0;
  double gain_scatter_db = 0.8;
  double phase_scatter_deg = 8.0;
  double failed = 0.02;
  double transmit_reach = 0.75;
  double transmit_taper = 0.3;
  double pulse_taper = 0.7;
  PsiLaw psi_law = PsiLaw::exact;
  double psi_excess_db = 6.0;
};

template <class Visitor>
void describe(Visitor& v, Elements& p) {
  v.field("columns", p.columns, {.min = 2, .max = 128, .text = "Number of elements along the ship."});
  v.field("rows", p.rows, {.min = 2, .max = 128, .text = "Number of elements upright."});
  v.field("column_spacing_mm", p.column_spacing_mm,
          {.unit = "mm", .min = 1, .max = 50, .text = "Spacing of the elements along the ship."});
  v.field("row_spacing_mm", p.row_spacing_mm,
          {.unit = "mm", .min = 1, .max = 50, .text = "Spacing of the elements upright."});
  v.choice("shading", p.shading, kShadingNames, "Weights of the receiving elements.");
  v.field("side_lobe_db", p.side_lobe_db,
          {.unit = "dB", .min = -60, .max = -14, .text = "Side lobes that the weights taylor and dolph are made for."});
  v.field("gain_scatter_db", p.gain_scatter_db,
          {.unit = "dB", .min = 0, .max = 6, .text = "Standard deviation of the elements' gains."});
  v.field("phase_scatter_deg", p.phase_scatter_deg,
          {.unit = "deg", .min = 0, .max = 60, .text = "Standard deviation of the elements' phases."});
  v.field("failed", p.failed, {.unit = "1", .min = 0, .max = 0.5, .text = "Share of the elements that do nothing."});
  v.field("transmit_reach", p.transmit_reach,
          {.unit = "1", .min = 0.3, .max = 1, .text = "Direction cosine along the ship up to which a fan is sent."});
  v.field("transmit_taper", p.transmit_taper,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "Share of the columns with falling amplitude; less gives more ripple."});
  v.field("pulse_taper", p.pulse_taper,
          {.unit = "1", .min = 0, .max = 1, .text = "Share of the pulse that its rise and fall take."});
  v.choice("psi_law", p.psi_law, kPsiLawNames, "Whether the equivalent beam angle stated in the file is the true one.");
  v.field("psi_excess_db", p.psi_excess_db,
          {.unit = "dB",
           .min = -10,
           .max = 10,
           .text = "Law cos4: stated minus true equivalent beam angle at 45 degrees of elevation."});
}

/// Single fish: their echoes and how they stand in the water.
struct FishParams {
  double length_min_cm = 20.0;
  double length_max_cm = 34.0;
  double length_spread = 0.08;
  double ts_offset_db = -68.0;
  double bladder = 0.25;
  double floor = 0.1;
  double heading_sd_deg = 14.0;
  double tilt_sd_deg = 10.0;
  double per_m3_min = 0.5;
  double per_m3_max = 8.0;
  int most_echoes = 30000;
};

template <class Visitor>
void describe(Visitor& v, FishParams& p) {
  v.field("length_min_cm", p.length_min_cm,
          {.unit = "cm", .min = 2, .max = 200, .text = "Least mean length of the fish of a school."});
  v.field("length_max_cm", p.length_max_cm,
          {.unit = "cm", .min = 2, .max = 200, .text = "Largest mean length of the fish of a school."});
  v.field("length_spread", p.length_spread,
          {.unit = "1", .min = 0, .max = 0.5, .text = "Standard deviation of length within a school, over its mean."});
  v.field("ts_offset_db", p.ts_offset_db,
          {.unit = "dB",
           .min = -100,
           .max = -40,
           .text = "Broadside target strength is 20 log10(length / 1 cm) plus this."});
  v.field(
      "bladder", p.bladder,
      {.unit = "1", .min = 0.01, .max = 1, .text = "Length of the part that scatters as a line, over the fish's own."});
  v.field(
      "floor", p.floor,
      {.unit = "1", .min = 0, .max = 1, .text = "Share of the broadside echo that comes back whatever the aspect."});
  v.field("heading_sd_deg", p.heading_sd_deg,
          {.unit = "deg", .min = 0, .max = 180, .text = "Standard deviation of the headings in a school."});
  v.field("tilt_sd_deg", p.tilt_sd_deg,
          {.unit = "deg", .min = 0, .max = 90, .text = "Standard deviation of the tilts in a school."});
  v.field("per_m3_min", p.per_m3_min,
          {.unit = "m-3", .min = 0.001, .max = 50, .text = "Density of the thinnest school."});
  v.field("per_m3_max", p.per_m3_max,
          {.unit = "m-3", .min = 0.001, .max = 50, .text = "Density of the densest school."});
  v.field(
      "most_echoes", p.most_echoes,
      {.min = 100,
       .max = 10000000,
       .text =
           "Most echoes of a school: where there are more fish, that many places echo with the amplitude of the sum."});
}

/// The water's own company: strengths from 0 (none) to 1 (strong).
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
  strength("hull_bubbles", p.hull_bubbles, "clouds of bubbles that the hull carries along");
  strength("plumes", p.plumes, "plumes of bubbles in rows down the wind; they stay in the water and fade in minutes");
  strength("surface", p.surface, "the sea surface's echo, in patches that last a minute");
  strength("layers", p.layers, "scattering layers");
  strength("single_fish", p.single_fish, "fish that keep to themselves");
  strength("seabed", p.seabed, "the seabed's echo and its roughness; 0 = no seabed");
  strength("other_sounders", p.other_sounders, "transmissions of other vessels, each in one ping");
  strength("refraction", p.refraction, "bending by a gradient of sound speed, downwards or upwards");
  strength("unsteady", p.unsteady, "roll and pitch that the stabilisation leaves: 1 = 1 degree");
  v.field(
      "noise_power_db", p.noise_power_db,
      {.unit = "dB re 1 W", .min = -300, .max = -50, .text = "Noise power in every sample, differing over the beams."});
  v.field("reverberation_sv_db", p.reverberation_sv_db,
          {.unit = "dB re 1 m-1", .min = -300, .max = 0, .text = "Sv of the water itself."});
  v.field("seabed_depth_m", p.seabed_depth_m, {.unit = "m", .min = 30, .max = 3000, .text = "Depth at the start."});
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
};

template <class Visitor>
void describe(Visitor& v, ArrayParams& p) {
  v.field("seed", p.seed,
          {.min = 0,
           .max = 2147483647,
           .text = "Seed of every random number; change it for another survey of the same kind."});
  v.field("observations", p.observations, {.min = 1, .max = 1000, .text = "Number of observations."});
  v.field("pings", p.pings, {.min = 1, .max = 100000, .text = "Number of pings in each observation."});
  v.field("schools", p.schools, {.min = 0, .max = 500, .text = "Number of schools in each observation."});
  v.choice("waters", p.waters, kWatersNames,
           "Whether the company's strengths stand as given here or are drawn for each observation from the seed.");
  v.field("speed_knots", p.speed_knots, {.unit = "kn", .min = 0, .max = 25, .text = "The ship's speed over ground."});
  v.field("ping_interval_s", p.ping_interval_s, {.unit = "s", .min = 1, .max = 60, .text = "Time between pings."});
  v.field("gap_s", p.gap_s, {.unit = "s", .min = 121, .max = 86400, .text = "Time between observations."});
  v.field("range_min_m", p.range_min_m,
          {.unit = "m", .min = 30, .max = 480, .text = "Range of the nearest school when it is abeam."});
  v.field("range_max_m", p.range_max_m,
          {.unit = "m", .min = 30, .max = 480, .text = "Range of the farthest school when it is abeam."});
  v.field("length_min_m", p.length_min_m, {.unit = "m", .min = 5, .max = 300, .text = "Shortest school."});
  v.field("length_max_m", p.length_max_m, {.unit = "m", .min = 5, .max = 300, .text = "Longest school."});
  v.field("own_speed_max_mps", p.own_speed_max_mps,
          {.unit = "m/s", .min = 0, .max = 5, .text = "Speed of the fastest school."});
  v.field("motion_deg", p.motion_deg,
          {.unit = "deg", .min = 0, .max = 10, .text = "Amplitude of yaw and pitch; roll is three times this."});
  v.field("file_mb", p.file_mb, {.unit = "MB", .min = 1, .max = 4000, .text = "A new file begins after this much."});
  v.group("elements", p.elements, "the array that sends and receives");
  v.group("fish", p.fish, "single fish");
  v.group("company", p.company, "what is in the water besides schools, from 0 (none) to 1 (strong)");
}

/// errors  bad_parameter: a field out of range, or a range upside down
[[nodiscard]] Result<void> check(const ArrayParams& params);

/// The company of one observation: as stated, or drawn from the seed, each kind absent in three waters of ten.
[[nodiscard]] Company company_of(const ArrayParams& params, int observation);

}  // namespace sonar::synth::array
