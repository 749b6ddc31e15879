// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/track_edges.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

#include "model/school_totals.h"
#include "pipeline/stages/placed_events.h"

namespace sonar {

SeenPings seen_pings(const ObservationProduct& product) {
  SeenPings seen;
  for (const SchoolPingRow& row : product.school_pings) seen[row.school_id].push_back(row.ping_index);
  for (auto& [school, pings] : seen) {
    std::ranges::sort(pings);
    pings.erase(std::ranges::unique(pings).begin(), pings.end());
  }
  return seen;
}

std::vector<TrackEdge> track_edges(const SeenPings& seen, std::span<const TrackEvent> noted, std::int64_t pings) {
  std::vector<TrackEdge> edges;
  for (const auto& [school, own] : seen) {
    if (own.empty()) continue;
    // Noted of this school in the pings after one up to another; 0 = none, or with a school that is gone.
    const auto other_in = [&, id = school](TrackEventKind kind, std::int64_t after, std::int64_t last) {
      for (const TrackEvent& event : noted) {
        const bool fits = event.kind == kind && event.school_id == id && seen.contains(event.other_id);
        if (fits && after < event.ping_index && event.ping_index <= last) return event.other_id;
      }
      return std::int64_t{0};
    };
    const auto add_gone = [&, id = school](std::int64_t after, std::int64_t last) {
      const std::int64_t into = other_in(TrackEventKind::merge, after, last);
      edges.push_back({id, into == 0 ? TrackEdgeKind::lost : TrackEdgeKind::merged, after, into});
    };
    const std::int64_t parent = other_in(TrackEventKind::split, -1, own.front());
    edges.push_back({school, parent == 0 ? TrackEdgeKind::born : TrackEdgeKind::split, own.front(), parent});
    for (auto at = std::next(own.begin()); at != own.end(); ++at) {
      const std::int64_t before = *std::prev(at);
      if (*at == before + 1) continue;
      add_gone(before, *at - 1);
      edges.push_back({school, TrackEdgeKind::refound, *at, 0});
    }
    if (own.back() + 1 < pings) add_gone(own.back(), pings - 1);
  }
  return edges;
}

std::vector<TrackEdgeRow> track_edges(const ObservationProduct& product) {
  const std::int64_t end = std::ssize(product.pings);
  std::vector<TrackEdgeRow> rows;
  for (const TrackEdge& edge : track_edges(seen_pings(product), noted_events(product), end)) {
    const std::int64_t ping = edge.ping_index;
    const TimeNs time = ping >= 0 && ping < end ? product.pings[static_cast<std::size_t>(ping)].time : 0;
    rows.push_back({product.observation, edge.school_id, std::string(name(edge.kind)), ping, time,
                    edge.other_id == 0 ? std::string{} : school_name(product.observation, edge.other_id)});
  }
  return rows;
}

}  // namespace sonar
