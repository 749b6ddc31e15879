// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "pipeline/commands/state.h"
#include "pipeline/stages/placed_events.h"
#include "session/open/open_observation.h"
#include "view/lineage/lineage.h"

namespace sonar {

/// The schools of an observation as its journal leaves them, with what the tracker noted of whoever has its fish now. Bad
/// pings are left out, as in tables. Nobody is selected.
[[nodiscard]] LineageData lineage_data(const OpenObservation& observation, const JournalState& state,
                                       std::span<const PlacedEvent> events);

/// "split from school 3 in ping 12".
[[nodiscard]] std::string edge_text(const TrackEdge& edge);

}  // namespace sonar
