// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/score_index.h"

#include <algorithm>
#include <set>

namespace sonar {
namespace {

constexpr TimeNs kSamePing_ns = 1'000'000;

}  // namespace

PingMask with_rows(const PingMask& mask, const std::vector<int>& new_row) {
  struct Piece {
    Run run;
    std::size_t first;
  };
  std::vector<Piece> pieces;
  std::size_t voxel = 0;
  for (const Run& run : mask.runs) {
    const auto row = static_cast<std::size_t>(run.row);
    if (row < new_row.size() && new_row[row] >= 0) {
      pieces.push_back({{new_row[row], run.first_sample, run.count}, voxel});
    }
    voxel += static_cast<std::size_t>(run.count);
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.run < b.run; });
  PingMask out;
  for (const Piece& piece : pieces) {
    out.runs.push_back(piece.run);
    const auto first = mask.confidence.begin() + static_cast<std::ptrdiff_t>(piece.first);
    out.confidence.insert(out.confidence.end(), first, first + piece.run.count);
  }
  return out;
}

Indexed index_side(const ScoreSide& side, Rejected rejected_schools) {
  Indexed out;
  for (std::size_t o = 0; o < side.observations.size(); ++o) {
    const ObservationProduct& product = side.observations[o];
    std::set<std::int64_t> rejected;
    for (const SchoolRow& school : product.schools) {
      if (school.status == "rejected" && rejected_schools == Rejected::left_out) {
        rejected.insert(school.school_id);
      } else {
        out.schools[{o, school.school_id}] = &school;
      }
    }
    for (const SchoolPingRow& row : product.school_pings) {
      if (!rejected.contains(row.school_id)) out.rows[{o, row.school_id, row.ping_index}] = &row;
    }
    if (!product.grid) continue;
    for (const SchoolMask& m : product.masks) {
      if (m.mask.empty() || rejected.contains(m.school_id)) continue;
      out.masks[{o, m.school_id, m.ping_index}] = with_rows(m.mask, product.grid->grid.channel);
      out.in_ping[{o, m.ping_index}].push_back(m.school_id);
    }
    for (std::size_t p = 0; p < product.pings.size(); ++p) {
      out.pings[product.pings[p].time] = {o, static_cast<std::int64_t>(p)};
    }
  }
  return out;
}

std::optional<std::pair<std::size_t, std::int64_t>> ping_at(const Indexed& side, TimeNs time) {
  const auto found = side.pings.lower_bound(time - kSamePing_ns);
  if (found == side.pings.end() || found->first > time + kSamePing_ns) return std::nullopt;
  return found->second;
}

bool share_pings(const ScoreSide& found, const ScoreSide& truth) {
  const Indexed there = index_side(found);
  for (const ObservationProduct& product : truth.observations) {
    for (const PingNavigation& ping : product.pings) {
      if (ping_at(there, ping.time)) return true;
    }
  }
  return false;
}

std::map<SchoolKey, TrackLikeness> look_back(const Indexed& found, const ScoreSide& found_side, const Indexed& truth) {
  std::map<SchoolKey, TrackLikeness> out;
  for (const auto& [key, mask] : found.masks) {
    const auto& [observation, school_id, ping_index] = key;
    const TimeNs time = found_side.observations[observation].pings[static_cast<std::size_t>(ping_index)].time;
    const auto there = ping_at(truth, time);
    if (!there) continue;
    TrackLikeness& track = out[{observation, school_id}];
    track.voxels += mask.voxels();
    const auto schools = truth.in_ping.find(*there);
    if (schools == truth.in_ping.end()) continue;
    std::size_t most = 0;
    std::optional<SchoolKey> like;
    for (const std::int64_t id : schools->second) {
      const std::size_t shared = overlap(mask, truth.masks.at({there->first, id, there->second}));
      track.inside += shared;
      if (shared <= most) continue;
      most = shared;
      like = SchoolKey{there->first, id};
    }
    if (like) ++track.pings[*like];
  }
  return out;
}

}  // namespace sonar
