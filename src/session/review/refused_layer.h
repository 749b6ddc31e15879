// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "session/open/workspace.h"
#include "view/refused_marks.h"

namespace sonar {

/// What detection refused in an observation, where the layer is on; else nothing. Never null.
[[nodiscard]] RefusedPtr refused_layer(const Workspace& workspace, std::size_t observation);
/// Of a ping of the observation on show.
[[nodiscard]] std::vector<RefusedMark> refused_layer_in(const Workspace& workspace, std::int64_t ping_index);
/// Id of the echo that is highlighted in an observation; 0 = none.
[[nodiscard]] std::int64_t chosen_echo(const Workspace& workspace, std::size_t observation);

/// "no school: 3.8 m along range, 5 at least (judge size)", of its loudest sighting; empty where there is no such echo.
[[nodiscard]] std::string why_no_school(const Document& document, const EchoName& echo);
/// The same for who points at it in a picture: with what can be done about it.
[[nodiscard]] std::string refused_hint(const Workspace& workspace, const EchoName& echo);

/// Its loudest voxel in the ping on show; empty where it is not seen there.
[[nodiscard]] std::optional<Voxel> loudest_on_show(const Workspace& workspace, const EchoName& echo);
/// Chooses it, looks at the ping in which it was loudest, and lays the slices through it.
void go_to_echo(Workspace& workspace, const EchoName& echo);

}  // namespace sonar
