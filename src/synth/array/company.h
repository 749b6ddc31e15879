// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "synth/array/array_terrain.h"
#include "synth/array/params.h"
#include "synth/array/receiver.h"
#include "synth/array/view.h"

namespace sonar::synth::array {

/// What else than a school may lie in a place; the names are those of truth/company.csv.
enum class CompanyKind { hull_bubbles, plume, single_fish, layer, surface, seabed, other_sounder };
inline constexpr std::array<std::string_view, 7> kCompanyNames = {"hull_bubbles", "plume",  "single_fish",  "layer",
                                                                  "surface",      "seabed", "other_sounder"};

/// A cloud that the hull carries along: fixed in the ship's frame, metres to the bow, to port, depth.
struct HullCloud {
  double bow_m, port_m, depth_m;
  double long_m, wide_m, high_m;  ///< standard deviations
  double backscatter_m2;
  double period_s, phase;  ///< it swells and shrinks
};
/// A plume of bubbles under the surface: fixed in the water, in the scene's frame.
struct Plume {
  double east_m, north_m;
  double length_m, width_m, depth_m;  ///< down the wind, across; e-folding depth
  double backscatter_m2;              ///< at its birth
  double born_s, fades_s;
};
struct LoneFish {
  Point<Enu> at_m;
  Point<Enu> velocity_mps;
  double broadside_m2 = 0.0;
  double length_cm = 0.0;
};
struct Layer {
  double depth_m = 0.0;
  double thickness_m = 0.0;  ///< standard deviation of a Gaussian
  double sv = 0.0;
  Ripples patches;
};
struct OtherPing {
  int ping = 0;
  int fan = 0;
  Direction from;
  int first_sample = 0;
  int samples = 0;
  double power_w = 0.0;  ///< in a beam that looks straight at it
};

/// The water of one observation, drawn once.
struct Sea {
  Company company;
  Terrain terrain;
  double gradient_per_s = 0.0;
  double wind_rad = 0.0;        ///< the bearing that plumes' rows have
  double surface_per_m2 = 0.0;  ///< backscatter
  double patches_mps = 0.3;     ///< drift of the surface's patches
  double patches_last_s = 60.0;
  double reverberation_sv = 0.0;
  std::vector<HullCloud> hull;
  std::vector<Plume> plumes;
  std::vector<LoneFish> lone;
  std::vector<Layer> layers;
  std::vector<OtherPing> others;
  Ripples surface_patches, surface_patches_later;

  /// dB by which the surface's echo at a place differs from its mean, standard deviation 3: correlated over
  /// patches_last_s.
  [[nodiscard]] double surface_patch_db(double east_m, double north_m, double seconds) const;
};
[[nodiscard]] Sea make_sea(const ArrayParams& params, const Voyage& voyage, std::uint32_t observation, int fans);

/// One thing that was made of echoes, in one ping.
struct CompanyEchoes {
  CompanyKind kind;
  std::vector<Echo> echoes;
  std::vector<Point<Enu>> places;  ///< from the transducer
};
/// Everything of the sea that is made of echoes as the ping sees it: hull clouds, plumes, lone fish. What cannot be
/// heard is left out.
void for_each_company(const Sea& sea, const FishParams& fish, double wave_number, const View& view, std::uint64_t seed,
                      std::uint32_t observation, int ping, double reach_m,
                      const std::function<void(const CompanyEchoes&)>& use);

}  // namespace sonar::synth::array
