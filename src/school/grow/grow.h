// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/array.h"
#include "base/result.h"
#include "base/sample_flags.h"
#include "model/grow_params.h"
#include "model/mask.h"
#include "model/transfer_function.h"
#include "school/runs.h"

namespace sonar {

/// Which Sv counts are members, and how surely: one byte for each of the 65536 counts, 0 = no member, else 255 f.
class MemberTable {
 public:
  /// Sv >= reference - tolerance; f = 1 at or above the reference, else 1 - (d/t)^2 in dB.
  [[nodiscard]] static MemberTable one_sided(double reference_db, double tolerance_db);
  /// The paper's: |opacity - centre| <= tolerance and opacity > 0; f = 1 - (d/t)^2. A member with f = 0 has q = 1.
  /// opacity  TransferFunction::table_i16()
  [[nodiscard]] static MemberTable by_opacity(std::span<const float> opacity, double centre, double tolerance);

  [[nodiscard]] std::uint8_t operator()(std::int16_t count) const {
    return q_[static_cast<std::size_t>(static_cast<std::int32_t>(count) + 32768)];
  }

 private:
  MemberTable() : q_(65536, 0) {}
  std::vector<std::uint8_t> q_;
};

struct GrowLimits {
  Connectivity connectivity = Connectivity::faces;
  std::optional<IndexBox> box;       ///< growth stays inside
  const PingMask* taken = nullptr;   ///< voxels of other schools: never members
  const PingMask* inside = nullptr;  ///< growth stays in its runs (confidences are not read)
};

/// Flood fill by runs along range; a row is thresholded when the front first touches it.
/// sv       [fan][beam][sample], median-filtered Sv counts
/// flags    same shape; kNeverMember voxels and those behind recorded_ends() are never members, faulty ones are where the
///          filter gave them a value
/// seeds    voxels that are no members start nothing
/// out      everything connected to a seed; empty where no seed is a member
/// threads  pure
/// source   Balabanian et al. 2007, section 4.3
[[nodiscard]] PingMask grow(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const MemberTable& members,
                            std::span<const VoxelIndex> seeds, const GrowLimits& limits);

/// One click. Mode paper: centre = the seed's opacity; else reference = the seed's Sv. Join several clicks by unite().
/// inside  growth stays in its runs, sorted; null = anywhere
/// errors  bad_parameter, one line: seed outside the volume, in crops or seabed, without data, with opacity 0, not
///         inside
[[nodiscard]] Result<PingMask> grow_from_click(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                               VoxelIndex seed, const TransferFunction& growth_curve,
                                               const GrowParams& params, const PingMask* inside = nullptr);

/// Voxels with confidence >= threshold (0..1): the core of a mask, or at a low threshold its fuzzy area.
[[nodiscard]] PingMask at_least(const PingMask& mask, double threshold);

/// Value below which a share of a mask's voxels lie (nearest rank), in Sv counts; kNoData where there are none.
/// share  0..1
[[nodiscard]] std::int16_t percentile(View3<const std::int16_t> sv, const PingMask& mask, double share);

}  // namespace sonar
