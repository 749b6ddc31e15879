// SPDX-License-Identifier: Apache-2.0
#include "session/review/refused_layer.h"

#include <algorithm>

#include "session/open/survey_schools.h"
#include "session/slices/slice_places.h"

namespace sonar {
namespace {

std::optional<RefusedSightings> sightings_of(const std::vector<RefusedEcho>& rows, std::int64_t id) {
  const std::vector<RefusedSightings> all = refused_sightings(rows);
  const auto found =
      std::ranges::find_if(all, [id](const RefusedSightings& one) { return one.loudest->echo_id == id; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

RefusedPtr refused_layer(const Workspace& workspace, std::size_t observation) {
  static const auto kOff = std::make_shared<const std::vector<RefusedEcho>>();
  return workspace.display.values().refused_echoes ? workspace.document.refused(observation) : kOff;
}

std::vector<RefusedMark> refused_layer_in(const Workspace& workspace, std::int64_t ping_index) {
  const auto& shown = workspace.document.shown();
  if (!shown) return {};
  return refused_marks(*refused_layer(workspace, shown->index()), ping_index, shown->grid(), shown->sector(),
                       chosen_echo(workspace, shown->index()));
}

std::int64_t chosen_echo(const Workspace& workspace, std::size_t observation) {
  const auto& echo = workspace.echo();
  return echo && echo->observation == observation ? echo->id : 0;
}

std::string why_no_school(const Document& document, const EchoName& echo) {
  const RefusedPtr rows = document.refused(echo.observation);
  const auto sightings = sightings_of(*rows, echo.id);
  return sightings ? why_no_school(*sightings->loudest) : std::string{};
}

std::string refused_hint(const Workspace& workspace, const EchoName& echo) {
  const std::string why = why_no_school(workspace.document, echo);
  return why.empty() ? why : why + "\nI takes it in after all";
}

std::optional<Voxel> loudest_on_show(const Workspace& workspace, const EchoName& echo) {
  const auto& shown = workspace.document.shown();
  if (!shown || shown->index() != echo.observation) return std::nullopt;
  const auto marks = refused_marks(*workspace.document.refused(echo.observation), workspace.document.ping(),
                                   shown->grid(), shown->sector());
  const auto found = std::ranges::find(marks, echo.id, &RefusedMark::echo_id);
  return found == marks.end() ? std::nullopt : std::optional(found->loudest);
}

void go_to_echo(Workspace& workspace, const EchoName& echo) {
  const RefusedPtr rows = workspace.document.refused(echo.observation);
  const auto sightings = sightings_of(*rows, echo.id);
  if (!sightings) return;
  go_to_ping(workspace, echo.observation, sightings->loudest->ping_index);
  if (const auto voxel = loudest_on_show(workspace, echo)) lay_slices_through(workspace, *voxel);
  workspace.echo.set(echo);
}

}  // namespace sonar
