// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/track_edges.h"

#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <vector>

#include "model/school_totals.h"
#include "school/track/track.h"

namespace sonar {
namespace {

std::vector<TrackEvent> noted_events(const ObservationProduct& product) {
  std::vector<TrackEvent> noted;
  for (const Diagnostic& note : product.diagnostics) {
    if (note.code != DiagnosticCode::track_event) continue;
    if (const auto event = event_from_text(note.text)) noted.push_back(*event);
  }
  return noted;
}

}  // namespace

std::vector<TrackEdgeRow> track_edges(const ObservationProduct& product) {
  std::map<std::int64_t, std::set<std::int64_t>> seen;
  for (const SchoolPingRow& row : product.school_pings) seen[row.school_id].insert(row.ping_index);
  const std::vector<TrackEvent> noted = noted_events(product);
  const std::int64_t end = std::ssize(product.pings);
  std::vector<TrackEdgeRow> edges;
  const auto add = [&](std::int64_t school, const char* event, std::int64_t ping, std::int64_t other = 0) {
    const TimeNs time = ping >= 0 && ping < end ? product.pings[static_cast<std::size_t>(ping)].time : 0;
    edges.push_back({product.observation, school, event, ping, time,
                     other == 0 ? std::string{} : school_name(product.observation, other)});
  };
  for (const auto& [school, pings] : seen) {
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
      add(id, into == 0 ? "lost" : "merged", after, into);
    };
    const std::int64_t parent = other_in(TrackEventKind::split, -1, *pings.begin());
    add(school, parent == 0 ? "born" : "split", *pings.begin(), parent);
    for (auto at = std::next(pings.begin()); at != pings.end(); ++at) {
      const std::int64_t before = *std::prev(at);
      if (*at == before + 1) continue;
      add_gone(before, *at - 1);
      add(school, "refound", *at);
    }
    if (*pings.rbegin() + 1 < end) add_gone(*pings.rbegin(), end - 1);
  }
  return edges;
}

}  // namespace sonar
