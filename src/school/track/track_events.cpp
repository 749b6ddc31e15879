// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <system_error>

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

std::optional<TrackEvent> event_from_text(std::string_view text) {
  TrackEvent event;
  std::vector<std::int64_t*> numbers{&event.ping_index, &event.school_id, &event.other_id};
  std::size_t known = 0;
  for (std::size_t at = 0; at < text.size() && known < numbers.size();) {
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + at, end, *numbers[known]);
    if (read.ec == std::errc{}) ++known;
    at = read.ec == std::errc{} ? static_cast<std::size_t>(read.ptr - text.data()) : at + 1;
  }
  // Whatever a text looks like, it is an event's where that event would be told so.
  for (const TrackEventKind kind :
       {TrackEventKind::birth, TrackEventKind::death, TrackEventKind::split, TrackEventKind::merge}) {
    event.kind = kind;
    if (to_text(event) == text) return event;
  }
  return std::nullopt;
}

}  // namespace sonar
