// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "school/track/track.h"

namespace sonar {

std::string_view name(TrackEventKind kind) {
  switch (kind) {
    case TrackEventKind::birth:
      return "birth";
    case TrackEventKind::death:
      return "death";
    case TrackEventKind::split:
      return "split";
    case TrackEventKind::merge:
      return "merge";
  }
  return "";
}

std::string to_text(const TrackEvent& event) {
  switch (event.kind) {
    case TrackEventKind::birth:
      return fmt::format("ping {}: school {} first seen", event.ping_index, event.school_id);
    case TrackEventKind::death:
      return fmt::format("ping {}: school {} last seen", event.ping_index, event.school_id);
    case TrackEventKind::split:
      return fmt::format("ping {}: school {} split from school {}", event.ping_index, event.school_id, event.other_id);
    case TrackEventKind::merge:
      return fmt::format("ping {}: school {} merged into school {}", event.ping_index, event.school_id, event.other_id);
  }
  return {};
}

}  // namespace sonar
