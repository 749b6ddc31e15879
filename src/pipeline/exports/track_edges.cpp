// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/track_edges.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "model/school_totals.h"
#include "school/track/track.h"

namespace sonar {
namespace {

/// (school, kind) -> the event that the tracker noted last.
using Noted = std::map<std::pair<std::int64_t, TrackEventKind>, TrackEvent>;

Noted noted_events(const ObservationProduct& product) {
  Noted noted;
  for (const Diagnostic& note : product.diagnostics) {
    if (note.code != DiagnosticCode::track_event) continue;
    if (const auto event = event_from_text(note.text)) noted[{event->school_id, event->kind}] = *event;
  }
  return noted;
}

}  // namespace

std::vector<TrackEdgeRow> track_edges(const ObservationProduct& product) {
  std::map<std::int64_t, std::set<std::int64_t>> seen;
  for (const SchoolPingRow& row : product.school_pings) seen[row.school_id].insert(row.ping_index);
  const Noted noted = noted_events(product);
  const std::int64_t end = std::ssize(product.pings);
  std::vector<TrackEdgeRow> edges;
  const auto add = [&](std::int64_t school, const char* event, std::int64_t ping, std::int64_t other = 0) {
    const TimeNs time = ping >= 0 && ping < end ? product.pings[static_cast<std::size_t>(ping)].time : 0;
    edges.push_back({product.observation, school, event, ping, time,
                     other == 0 ? std::string{} : school_name(product.observation, other)});
  };
  for (const auto& [school, pings] : seen) {
    const auto split = noted.find({school, TrackEventKind::split});
    const bool was_split = split != noted.end() && seen.contains(split->second.other_id);
    add(school, was_split ? "split" : "born", *pings.begin(), was_split ? split->second.other_id : 0);
    for (auto at = std::next(pings.begin()); at != pings.end(); ++at) {
      const std::int64_t before = *std::prev(at);
      if (*at == before + 1) continue;
      add(school, "lost", before);
      add(school, "refound", *at);
    }
    const auto merge = noted.find({school, TrackEventKind::merge});
    const bool merged = merge != noted.end() && seen.contains(merge->second.other_id);
    if (merged) {
      add(school, "merged", *pings.rbegin(), merge->second.other_id);
    } else if (*pings.rbegin() + 1 < end) {
      add(school, "lost", *pings.rbegin());
    }
  }
  return edges;
}

}  // namespace sonar
