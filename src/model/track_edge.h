// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sonar {

/// What became of a track: it was first seen, came out of another school, went into one, was not seen any more, or again.
enum class TrackEdgeKind : std::uint8_t { born, split, merged, lost, refound };
inline constexpr std::array<std::string_view, 5> kTrackEdgeNames{"born", "split", "merged", "lost", "refound"};
[[nodiscard]] constexpr std::string_view name(TrackEdgeKind kind) {
  return kTrackEdgeNames[static_cast<std::size_t>(kind)];
}

/// An edge of the graph of an observation's tracks.
struct TrackEdge {
  std::int64_t school_id = 0;
  TrackEdgeKind kind = TrackEdgeKind::born;
  std::int64_t ping_index = 0;  ///< of the school: its first one there (born, split, refound), else its last
  std::int64_t other_id = 0;    ///< split: the school that it came from; merged: that it went into; else 0
  friend bool operator==(const TrackEdge&, const TrackEdge&) = default;
};

}  // namespace sonar
