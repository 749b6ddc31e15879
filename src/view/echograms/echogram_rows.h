// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "view/timelines/echogram_pyramid.h"

namespace sonar {

/// What an echogram's upright axis is.
enum class EchogramHeight : std::uint8_t {
  range,  ///< slant range from the transducer
  depth,  ///< below the mean sea surface, heave, attitude and rays of each ping included
};
inline constexpr std::array<std::string_view, 2> kEchogramHeightNames{"range", "depth"};

/// What of each ping an echogram shows.
struct EchogramOf {
  std::optional<int> fan;   ///< empty = the beams of all fans
  std::optional<int> beam;  ///< of that fan; empty = all its beams, their linear mean weighted by volume
  EchogramHeight height = EchogramHeight::range;
  friend auto operator<=>(const EchogramOf&, const EchogramOf&) = default;
};

/// Where a beam's samples lie along the upright axis in one ping: evenly between places on its way, which is straight or
/// bends along a ray.
struct EchogramRow {
  int row = 0;                              ///< fan * beams + beam
  double apart = 1.0;                       ///< samples from a place to the next
  std::vector<double> heights_m{0.0, 1.0};  ///< of samples 0, apart, 2 apart ...; two at least
  [[nodiscard]] double height_m(double sample) const;
  /// The sample whose cell lies at a height, the nearest to the sonar where the ray comes there more than once; empty where
  /// none does, or all of them.
  [[nodiscard]] std::optional<double> sample_at(double height_m) const;
  friend bool operator==(const EchogramRow&, const EchogramRow&) = default;
};

/// Every sample has a cell of its own up to so many: what an echogram of one beam keeps of a ping.
inline constexpr int kMostBeamBins = 4096;

/// The beams that an echogram takes in, in their order, and where their samples lie in a ping.
/// of         names a fan and a beam that the sector has
/// placement  of the ping
[[nodiscard]] std::vector<EchogramRow> echogram_rows(const Sector& sector, const Placement& placement,
                                                     const EchogramOf& of);

/// Bins for those rows over all pings: no finer than the samples, so that none stays empty between two that have one;
/// along range each sample lies in the middle of its bin. Nothing above the sea surface has a bin of a depth axis.
/// most  bins; coarser ones where there would be more
[[nodiscard]] EchogramRange echogram_range(const Sector& sector, std::span<const Placement> pings, const EchogramOf& of,
                                           int most = kMostBeamBins);

/// One ping's column of some rows, flagged samples left out: as echogram_column() of all beams.
/// sv, flags  [fan][beam][sample] on the sector's grid
[[nodiscard]] std::vector<EchogramCell> echogram_column(const Sector& sector, View3<const std::int16_t> sv,
                                                        View3<const SampleFlags> flags, SampleFlags hidden,
                                                        std::span<const EchogramRow> rows, const EchogramRange& range);

}  // namespace sonar
