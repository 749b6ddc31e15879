// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sonar {

/// Neighbouring samples of one beam.
struct Run {
  std::int32_t row = 0;  ///< fan * beams + beam (files use the channel; BeamGrid maps one to the other)
  std::int32_t first_sample = 0;
  std::int32_t count = 0;
  [[nodiscard]] std::int32_t end() const { return first_sample + count; }
  friend auto operator<=>(const Run&, const Run&) = default;
};

/// A school's voxels in one ping: runs sorted by (row, first_sample), without overlap, and a confidence for each voxel.
struct PingMask {
  std::vector<Run> runs;
  std::vector<std::uint8_t> confidence;  ///< 1..255 = 255 f, in run order

  [[nodiscard]] std::size_t voxels() const { return confidence.size(); }
  [[nodiscard]] bool empty() const { return runs.empty(); }
  friend bool operator==(const PingMask&, const PingMask&) = default;
};

/// 1..255 = 255 f of a voxel; 0 where it is not in the mask.
[[nodiscard]] std::uint8_t confidence_at(const PingMask& mask, int row, int sample);
/// Number of voxels that two masks share.
[[nodiscard]] std::size_t overlap(const PingMask& a, const PingMask& b);
/// 2 |a and b| / (|a| + |b|); 0 where both are empty.
[[nodiscard]] double dice(const PingMask& a, const PingMask& b);
/// All voxels of both; where both have one the larger confidence stays.
[[nodiscard]] PingMask unite(const PingMask& a, const PingMask& b);
/// The voxels of `a` that are not in `b`.
[[nodiscard]] PingMask subtract(const PingMask& a, const PingMask& b);
/// q = max(1, round(255 f)).
[[nodiscard]] std::uint8_t quantised_confidence(double confidence);

}  // namespace sonar
