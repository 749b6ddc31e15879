// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slices_follow.h"

#include <algorithm>
#include <cstdlib>

#include "session/survey_schools.h"

namespace sonar {
namespace {

/// Whether a mask has a voxel in a fan (of the top slice), or in a beam (of the side slice).
struct Cut {
  bool top = false;
  bool side = false;
};
Cut cut_by(const PingMask& mask, const SlicePlaces& places, int beams) {
  Cut cut;
  for (const Run& run : mask.runs) {
    cut.top = cut.top || run.row / beams == places.fan;
    cut.side = cut.side || run.row % beams == places.beam;
  }
  return cut;
}

}  // namespace

SlicesFollow::SlicesFollow(Workspace& workspace) : workspace_(workspace) {
  listening_.to(workspace.school.changed(), [this] {
    go_to_selected();
    follow();
  });
  listening_.to(workspace.slices_locked.changed(), [this] { follow(); });
  listening_.to(workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::ping && another_ping()) follow();
  });
}

bool SlicesFollow::another_ping() {
  const auto& shown = workspace_.document.shown();
  const std::pair now(shown ? shown->identity() : nullptr, workspace_.document.ping());
  return std::exchange(last_, now) != now;
}

void SlicesFollow::go_to_selected() {
  const auto selected = workspace_.selected();
  if (workspace_.slices_locked() || !selected) return;
  Document& document = workspace_.document;
  const auto& pings = document.state().schools[*selected]->masks.pings;
  const auto away = [&](const SchoolMasks::InPing& one) { return std::abs(one.ping_index - document.ping()); };
  const auto nearest = std::ranges::min_element(pings, {}, away);
  if (nearest != pings.end() && away(*nearest) > 0) document.look_at(nearest->ping_index);
}

void SlicesFollow::follow() {
  if (workspace_.slices_locked()) return;
  const auto selected = workspace_.selected();
  if (!selected) return;
  const Document& document = workspace_.document;
  const auto* there = in_ping(document.state().schools[*selected]->masks, document.ping());
  if (there == nullptr) return;
  const int beams = document.shown()->sector().beams();
  SlicePlaces places = workspace_.slices();
  const Cut cut = cut_by(there->mask, places, beams);
  const SlicePlaces middle = middle_of(there->mask, beams);
  if (!cut.top) places.fan = middle.fan;
  if (!cut.side) places.beam = middle.beam;
  workspace_.slices.set(places);
}

}  // namespace sonar
