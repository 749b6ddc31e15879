// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "base/time.h"
#include "model/mask.h"
#include "model/school.h"
#include "pipeline/score/score.h"

namespace sonar {

using SchoolKey = std::pair<std::size_t, std::int64_t>;               ///< observation, school
using PingKey = std::tuple<std::size_t, std::int64_t, std::int64_t>;  ///< observation, school, ping

/// One side with its masks by channel (grids may number rows differently) and its rows at hand.
struct Indexed {
  std::map<PingKey, const SchoolPingRow*> rows;
  std::map<PingKey, PingMask> masks;
  std::map<SchoolKey, const SchoolRow*> schools;
  std::map<std::pair<std::size_t, std::int64_t>, std::vector<std::int64_t>> in_ping;  ///< (observation, ping): schools
  std::map<TimeNs, std::pair<std::size_t, std::int64_t>> pings;
};

/// A mask whose runs lie in other rows: new_row[row]; those of rows that have none (-1, or beyond the list) are left out.
[[nodiscard]] PingMask with_rows(const PingMask& mask, const std::vector<int>& new_row);

/// Whether schools that are marked as rejected are there.
enum class Rejected : std::uint8_t { left_out, kept };
/// Borrows the side's rows.
[[nodiscard]] Indexed index_side(const ScoreSide& side, Rejected rejected_schools = Rejected::left_out);

/// (observation, ping) of a side at a time, within 1 ms.
[[nodiscard]] std::optional<std::pair<std::size_t, std::int64_t>> ping_at(const Indexed& side, TimeNs time);

/// What a found track is like, over those of its pings that the truth has.
struct TrackLikeness {
  std::map<SchoolKey, int> pings;  ///< true school -> pings in which the track's mask overlaps it most
  std::size_t voxels = 0;
  std::size_t inside = 0;  ///< voxels in any true school's mask
};
[[nodiscard]] std::map<SchoolKey, TrackLikeness> look_back(const Indexed& found, const ScoreSide& found_side,
                                                           const Indexed& truth);

}  // namespace sonar
