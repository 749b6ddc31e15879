// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "model/beam_grid.h"
#include "model/product.h"
#include "model/volume.h"
#include "synth/scene.h"
#include "synth/truth.h"

namespace sonar::synth {

/// A rendered ping. Rows are those of the grid (fan * beams + beam); without a grid row = channel and there is one fan.
struct SyntheticPing {
  Volume power;                      ///< counts re 1 W; flags: dropout where nothing was recorded, none else
  std::vector<bool> recorded;        ///< [row]; false = the channel is missing from this ping
  std::vector<SchoolTruth> schools;  ///< by school_id; only those with a voxel that counts; empty without a grid
  std::vector<BodyTruth> bodies;     ///< by school_id; every school
};

/// The sonar at work in a scene; what does not change between pings is made once.
/// threads  const functions may run on any number of threads at once; the same bits always
/// cost     some 20 ms a ping of 500 beams
class SyntheticSonar {
 public:
  explicit SyntheticSonar(Scene scene);
  ~SyntheticSonar();
  SyntheticSonar(const SyntheticSonar&) = delete;
  SyntheticSonar& operator=(const SyntheticSonar&) = delete;
  SyntheticSonar(SyntheticSonar&&) noexcept;
  SyntheticSonar& operator=(SyntheticSonar&&) noexcept;

  [[nodiscard]] const Scene& scene() const;
  /// The grid's record as a product carries it; empty where the beams make no product grid.
  [[nodiscard]] const std::optional<GridRecord>& grid() const;
  /// 0-based channel of each row.
  [[nodiscard]] const std::vector<int>& channel_of_row() const;

  [[nodiscard]] SyntheticPing ping(int ping) const;
  /// Expected sv (linear, m^-1) of the schools alone, beam pattern and pulse included: no noise, no water.
  [[nodiscard]] Array3<float> expected_school_sv(int ping) const;
  /// Expected sv of everything else: water, surface, seabed and background noise, without events.
  [[nodiscard]] Array3<float> expected_background_sv(int ping) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

/// One ping's power, as SyntheticSonar(scene).ping(ping).power.
[[nodiscard]] Volume render_ping(const Scene& scene, int ping);

}  // namespace sonar::synth
