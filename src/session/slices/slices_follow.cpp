// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slices_follow.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "session/open/survey_schools.h"
#include "session/slices/slice_places.h"
#include "view/slices/slice_cuts.h"

namespace sonar {
namespace {

/// The same plane, lying otherwise and not moved: what the choice of another kind leaves.
bool lies_otherwise(PlanePlace before, const PlanePlace& now) {
  const bool other = before.lies != now.lies;
  before.lies = now.lies;
  return other && before == now;
}

}  // namespace

SlicesFollow::SlicesFollow(Workspace& workspace) : workspace_(workspace), plane_(workspace.plane.values()) {
  listening_.to(workspace.school.changed(), [this] {
    go_to_selected();
    follow();
  });
  listening_.to(workspace.slices_locked.changed(), [this] { follow(); });
  listening_.to(workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::ping && another_ping()) follow();
  });
  listening_.to(workspace.plane, [this](const PlanePlace& now) {
    if (lies_otherwise(std::exchange(plane_, now), now)) lay_plane(workspace_);
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
  const Sector& sector = document.shown()->sector();
  std::vector<SliceKind> missing;
  for (const SliceKind kind : kSliceKinds) {
    if (!cuts(sector, live_slice(workspace_, kind, document.ping()), there->mask)) missing.push_back(kind);
  }
  if (!missing.empty()) lay_slices_through(workspace_, middle_of(there->mask, sector.beams()), missing);
}

}  // namespace sonar
