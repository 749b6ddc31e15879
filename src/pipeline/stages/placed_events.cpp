// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/placed_events.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>

namespace sonar {
namespace {

using InPing = SchoolMasks::InPing;

InPing nearest(std::span<const SchoolMasks> found, std::int64_t track_id, std::int64_t ping_index) {
  const auto school = std::ranges::find(found, track_id, &SchoolMasks::track_id);
  if (school == found.end() || school->pings.empty()) return {};
  return *std::ranges::min_element(school->pings, {},
                                   [&](const InPing& there) { return std::abs(there.ping_index - ping_index); });
}

/// The school that has most of the voxels.
std::optional<std::int64_t> owner(const InPing& voxels, std::span<const NumberedMasks> schools) {
  std::optional<std::int64_t> best;
  std::size_t most = 0;
  for (const auto& [number, masks] : schools) {
    const auto there = std::ranges::lower_bound(masks->pings, voxels.ping_index, {}, &InPing::ping_index);
    if (there == masks->pings.end() || there->ping_index != voxels.ping_index) continue;
    const std::size_t shared = overlap(there->mask, voxels.mask);
    if (shared <= most) continue;
    most = shared;
    best = number;
  }
  return best;
}

}  // namespace

std::vector<PlacedEvent> placed_events(std::span<const TrackEvent> events, std::span<const SchoolMasks> found) {
  std::vector<PlacedEvent> placed;
  for (const TrackEvent& event : events) {
    PlacedEvent& one = placed.emplace_back(PlacedEvent{event, {}, {}});
    if (event.other_id == 0) continue;
    one.school = nearest(found, event.school_id, event.ping_index);
    one.other = nearest(found, event.other_id, event.ping_index);
  }
  return placed;
}

std::vector<TrackEvent> events_now(std::span<const PlacedEvent> placed, std::span<const SchoolMasks> schools) {
  std::vector<NumberedMasks> numbered;
  for (const SchoolMasks& school : schools) numbered.push_back({school.decided.school_id, &school});
  return events_now(placed, numbered);
}

std::vector<TrackEvent> events_now(std::span<const PlacedEvent> placed, std::span<const NumberedMasks> schools) {
  std::map<std::int64_t, std::int64_t> of_track;
  for (const auto& [number, masks] : schools) {
    if (masks->track_id != 0) of_track[masks->track_id] = number;
  }
  const auto now = [&](const InPing& voxels, std::int64_t track_id) -> std::int64_t {
    if (const auto has = owner(voxels, schools)) return *has;
    const auto known = of_track.find(track_id);
    return known == of_track.end() ? 0 : known->second;
  };
  std::vector<TrackEvent> events;
  for (const PlacedEvent& one : placed) {
    TrackEvent event = one.event;
    const bool of_two = event.other_id != 0;
    event.school_id = now(one.school, event.school_id);
    if (of_two) event.other_id = now(one.other, event.other_id);
    if (event.school_id == 0 || event.school_id == event.other_id || (of_two && event.other_id == 0)) continue;
    events.push_back(event);
  }
  return events;
}

Diagnostics event_notes(std::span<const TrackEvent> events) {
  Diagnostics notes;
  for (const TrackEvent& event : events) {
    notes.push_back({DiagnosticCode::track_event, "", -1, event.ping_index, to_text(event)});
  }
  return notes;
}

std::vector<TrackEvent> noted_events(const ObservationProduct& product) {
  std::vector<TrackEvent> noted;
  for (const Diagnostic& note : product.diagnostics) {
    if (note.code != DiagnosticCode::track_event) continue;
    if (const auto event = event_from_text(note.text)) noted.push_back(*event);
  }
  return noted;
}

}  // namespace sonar
