// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/work.h"
#include "synth/array/array_terrain.h"
#include "synth/array/fish.h"
#include "synth/array/form.h"
#include "synth/voyage.h"

namespace sonar::synth::array {

/// One echo of a school: a fish, or `together` of them in one place.
struct SchoolEcho {
  Point<Own> at_rest;
  double broadside_m2 = 0.0;  ///< of all together
};

/// A school of single fish in east, north, up about the scene's origin (z = -depth).
struct School {
  explicit School(Form body) : form(std::move(body)) {}

  int id = 0;
  Form form;
  Point<Enu> centre_m;  ///< at the first ping
  Point<Enu> velocity_mps;
  double axis_rad = 0.0;     ///< bearing of its length
  double heading_rad = 0.0;  ///< of the fish
  double fish_length_cm = 0.0;
  double per_m3 = 0.0;  ///< where the form's density is 1
  int together = 1;
  double volume_m3 = 0.0;  ///< at rest, where there are fish
  std::vector<SchoolEcho> echoes;
  std::vector<MeanAspect> mean_aspect;  ///< one

  [[nodiscard]] Point<Enu> centre_at(double seconds) const { return centre_m + velocity_mps * seconds; }
  /// A fish's place from the centre.
  [[nodiscard]] Point<Enu> offset_at(const Point<Own>& at_rest, double seconds) const;
  [[nodiscard]] double fish() const { return static_cast<double>(echoes.size()) * together; }
};

/// Fills a school whose form and numbers are set with its fish.
void fill_school(School& school, const FishParams& params, double wave_number, std::uint64_t seed,
                 std::uint32_t observation);

/// What schools are drawn for.
struct SchoolSetting {
  const ArrayParams& params;
  const Voyage& voyage;
  const Terrain& terrain;
  double wave_number = 0.0;
  std::uint32_t observation = 0;
};
/// Draws the schools of an observation: kinds in turn from one that the seed chooses, near the surface, between and near
/// the seabed, each abeam at another time; fewer than asked for where there is no room.
[[nodiscard]] std::vector<School> make_schools(const SchoolSetting& setting, Work& work);

}  // namespace sonar::synth::array
