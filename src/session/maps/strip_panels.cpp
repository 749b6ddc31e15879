// SPDX-License-Identifier: Apache-2.0
#include "session/maps/strip_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "base/number_text.h"

namespace sonar {
namespace {

/// The ping beside the last one that a school has without a break, from a ping on.
std::int64_t end_of(const SchoolMasks& school, std::int64_t from, int step) {
  std::int64_t ping = from;
  while (in_ping(school, ping) != nullptr) ping += step;
  return ping;
}

/// Why propagations ended, by the ping that they did not reach. The last one that says something of a ping counts.
std::map<std::int64_t, std::string> endings(const JournalState& state) {
  constexpr std::string_view kBackwards = "backwards: ";
  std::map<std::int64_t, std::string> notes;
  for (const Diagnostic& note : state.notes) {
    if (note.code != DiagnosticCode::propagation_ended) continue;
    const int step = note.text.starts_with(kBackwards) ? -1 : 1;
    // Of several schools in the ping the youngest is the one that was carried on last.
    const auto youngest = std::find_if(state.schools.rbegin(), state.schools.rend(), [&](const auto& school) {
      return in_ping(school->masks, note.ping_index) != nullptr;
    });
    if (youngest == state.schools.rend()) continue;
    notes[end_of((*youngest)->masks, note.ping_index, step)] =
        fmt::format("{}, {}", school_title(**youngest), note.text);
  }
  return notes;
}

}  // namespace

std::vector<PropagationPanel> strip_panels(const StripWish& wish, const MaskedPings& masks) {
  const auto notes = wish.state ? endings(*wish.state) : std::map<std::int64_t, std::string>{};
  const auto& context = wish.observation->context();
  std::vector<PropagationPanel> panels;
  for (std::int64_t ping = wish.first; ping < std::min(wish.first + wish.panes, wish.observation->pings()); ++ping) {
    PropagationPanel& panel = panels.emplace_back();
    panel.ping_index = ping;
    panel.current = ping == wish.ping;
    panel.searched = wish.searched;
    const auto i = static_cast<std::size_t>(ping);
    const PingNavigation& navigation = wish.observation->files().navigation[i];
    panel.time = navigation.time;
    panel.transducer_depth_m = navigation.transducer_depth_m;
    panel.bad = navigation.bad || (wish.state && is_bad(*wish.state, context.times[i]));
    if (const auto found = masks.pings.find(ping); found != masks.pings.end()) {
      panel.masks = found->second;
      for (const MosaicMask& mask : panel.masks) panel.school_ids.push_back(mask.school);
    }
    if (const auto found = notes.find(ping); found != notes.end()) panel.note = found->second;
  }
  return panels;
}

std::string strip_title(const StripWish& wish) {
  std::string title = fmt::format("{}, pings {} to {}", wish.observation->title(), wish.first,
                                  std::min(wish.first + wish.panes, wish.observation->pings()) - 1);
  if (!wish.running.empty()) {
    return title + fmt::format(" · propagating: {}, {} to {}", count_of(wish.running.size(), "ping"),
                               wish.running.begin()->first, wish.running.rbegin()->first);
  }
  if (wish.state && wish.selected != 0) {
    for (const auto& school : wish.state->schools) {
      if (school->number != wish.selected || school->masks.pings.empty()) continue;
      title += fmt::format(" · {} in pings {} to {}", school_title(*school), school->masks.pings.front().ping_index,
                           school->masks.pings.back().ping_index);
    }
  }
  return title;
}

}  // namespace sonar
