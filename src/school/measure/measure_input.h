// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "model/beam_grid.h"
#include "model/mask.h"
#include "model/school.h"
#include "school/detect/noise_level.h"
#include "school/seabed/seabed.h"

namespace sonar {

struct EchoClaims;

/// From where a beam hears the seabed, by its edge first: what lies beyond is a school's where it is a member, else not. The
/// record's end where none is heard.
/// seabed  null = none seen
[[nodiscard]] inline int seabed_heard(const Seabed* seabed, int row, int samples) {
  return seabed == nullptr || seabed->heard_sample.empty() ? samples
                                                           : seabed->heard_sample[static_cast<std::size_t>(row)];
}

/// What one ping offers for measuring; borrowed.
struct MeasureInput {
  View3<const std::int16_t> sv;        ///< unfiltered Sv counts
  View3<const std::int16_t> filtered;  ///< median-filtered Sv counts: stands in at faulty samples for sizes only
  View3<const SampleFlags> flags;      ///< seabed included
  const Sector* sector = nullptr;
  const BeamGrid* grid = nullptr;
  Background background;
  Placement placement;
  std::shared_ptr<const Refraction> rays;  ///< of a known profile, bent along or not; null = none known
  double pulse_m = 0.0;                    ///< extent of the pulse along range, c tau / 2
  double two_way_area = 1.0;               ///< of the beams: two_way_beam.h
  /// [fan][beam] dB: echo as calibrated over what another equivalent beam angle would make of it, and standard error of
  /// the calibration; empty = not known.
  std::span<const double> psi_error_db;
  std::span<const double> calibration_se_db;
  const Seabed* seabed = nullptr;      ///< null = none seen
  const PingMask* others = nullptr;    ///< voxels of all other schools of the ping; null = none
  const EchoClaims* claims = nullptr;  ///< what each school of the ping reaches for; null = there is no other
  double threshold_db = kUnknown;      ///< the mask's, for the record

  [[nodiscard]] int seabed_heard(int row) const { return sonar::seabed_heard(seabed, row, sv.shape().samples); }
};

}  // namespace sonar
