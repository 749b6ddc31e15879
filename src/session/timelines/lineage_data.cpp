// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/lineage_data.h"

#include <fmt/format.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "pipeline/exports/track_edges.h"

namespace sonar {

LineageData lineage_data(const OpenObservation& observation, const JournalState& state,
                         std::span<const PlacedEvent> events) {
  LineageData data;
  data.title = observation.title() + ": lineage of schools";
  for (const PingNavigation& ping : observation.files().navigation) data.times.push_back(ping.time);
  const std::vector<TimeNs>& clock = observation.context().times;
  SeenPings seen;
  std::vector<NumberedMasks> numbered;
  for (const auto& school : state.schools) {
    LineageSchool lane{school->number, school->masks.decided.status, {}};
    for (const SchoolMasks::InPing& there : school->masks.pings) {
      if (!is_bad(state, clock[static_cast<std::size_t>(there.ping_index)])) lane.pings.push_back(there.ping_index);
    }
    if (lane.pings.empty()) continue;
    numbered.push_back({school->number, &school->masks});
    seen[school->number] = lane.pings;
    data.schools.push_back(std::move(lane));
  }
  data.edges = track_edges(seen, events_now(events, numbered), std::ssize(data.times));
  return data;
}

std::string edge_text(const TrackEdge& edge) {
  switch (edge.kind) {
    case TrackEdgeKind::born:
      return fmt::format("first seen in ping {}", edge.ping_index);
    case TrackEdgeKind::split:
      return fmt::format("split from school {} in ping {}", edge.other_id, edge.ping_index);
    case TrackEdgeKind::merged:
      return fmt::format("merged into school {} after ping {}", edge.other_id, edge.ping_index);
    case TrackEdgeKind::lost:
      return fmt::format("lost after ping {}", edge.ping_index);
    case TrackEdgeKind::refound:
      return fmt::format("seen again in ping {}", edge.ping_index);
  }
  return {};
}

}  // namespace sonar
