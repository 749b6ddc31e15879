// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/work.h"
#include "synth/array/array_truth.h"
#include "synth/array/diffuse.h"
#include "synth/array/fish_school.h"
#include "synth/array/receiver.h"
#include "synth/array/sphere.h"

namespace sonar::synth::array {

/// The grid as a product carries it.
/// errors  unsupported: the beams make no product grid in the order of fans and azimuths
[[nodiscard]] Result<GridRecord> grid_of(const Receiver& receiver, const std::vector<Beam>& stated);

/// One observation: what is in its water, and who passes it.
struct Scene {
  Voyage voyage;
  std::uint32_t observation = 0;
  std::uint64_t seed = 1;
  FishParams fish;
  Sea sea;
  std::vector<School> schools;
  SphereParams sphere;
};

struct ArrayPing {
  Array3<std::int16_t> counts;  ///< [fan][beam][sample], re 1 W
  std::vector<SchoolTruth> schools;
  std::vector<BodyTruth> bodies;
  std::vector<FishTruth> fish;
  std::vector<CompanyTruth> company;
  std::vector<SphereTruth> sphere;  ///< one, or none
};

/// The array at work in one observation.
/// threads  const functions may run on any number of threads at once; the same bits always
/// cost     some tenths of a second a ping with schools in view
class ArraySonar {
 public:
  ArraySonar(const Receiver& receiver, const GridRecord& grid, const Scene& scene);

  /// What is made after the work was cancelled is of no use.
  [[nodiscard]] ArrayPing ping(int ping, const Work& work) const;
  [[nodiscard]] const Scene& scene() const { return scene_; }

 private:
  struct Heard;
  [[nodiscard]] View view(int ping) const;
  void hear_school(const School& school, const View& view, int ping, const Work& work, Heard& heard) const;
  void hear_company(const View& view, int ping, const Work& work, Heard& heard) const;
  void hear_sphere(const View& view, int ping, Heard& heard) const;
  [[nodiscard]] std::vector<RowLimits> limits(const View& view) const;
  void tell_schools(const View& view, int ping, Heard& heard, ArrayPing& out) const;

  const Receiver& receiver_;
  const GridRecord& grid_;
  const Scene& scene_;
  Sector sector_;
  double wave_number_;
  Diffuse diffuse_;
  Array3<float> power_per_sv_;
  std::vector<double> sphere_m_;  ///< [fan] amplitude of the sphere; empty = there is none
};

/// Wave number in the middle of the sonar's band: what the fish's own directivity is worked out with.
[[nodiscard]] double middle_wave_number(const Pattern& pattern);

}  // namespace sonar::synth::array
