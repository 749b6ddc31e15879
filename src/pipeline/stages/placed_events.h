// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/product.h"
#include "pipeline/stages/measure_schools.h"
#include "school/track/track.h"

namespace sonar {

/// What the tracker noted, and the voxels that it is about: whoever has them later is meant, so that an event follows its
/// fish where a human cuts, joins or hands over tracks.
struct PlacedEvent {
  TrackEvent event;  ///< under the numbers of what was found
  // Of a split or a merge: each school's mask in its ping nearest to the event; else empty.
  SchoolMasks::InPing school;
  SchoolMasks::InPing other;
};

/// found  as the tracker left them, each known by its track_id
[[nodiscard]] std::vector<PlacedEvent> placed_events(std::span<const TrackEvent> events,
                                                     std::span<const SchoolMasks> found);

/// The events under the numbers (decided.school_id) of the schools that there are now. Of a split or a merge each side is
/// the school that has most of its voxels, or the one of its track where nobody has any; what happened within one school,
/// or to one that is gone, is no event.
[[nodiscard]] std::vector<TrackEvent> events_now(std::span<const PlacedEvent> placed,
                                                 std::span<const SchoolMasks> schools);
/// The same of schools that have their numbers elsewhere. A view.
struct NumberedMasks {
  std::int64_t number = 0;
  const SchoolMasks* masks = nullptr;
};
[[nodiscard]] std::vector<TrackEvent> events_now(std::span<const PlacedEvent> placed,
                                                 std::span<const NumberedMasks> schools);

/// Notes of a product, and back.
[[nodiscard]] Diagnostics event_notes(std::span<const TrackEvent> events);
[[nodiscard]] std::vector<TrackEvent> noted_events(const ObservationProduct& product);

}  // namespace sonar
