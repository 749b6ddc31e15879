// SPDX-License-Identifier: Apache-2.0
#include "session/volume/volume_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "pipeline/stages/placements.h"
#include "publish/movies/between_pings.h"
#include "publish/volumes/volume_figure.h"
#include "session/looks/screen_theme.h"
#include "session/looks/selection.h"
#include "session/review/refused_layer.h"
#include "session/slices/school_layers.h"
#include "view/theme.h"
#include "view/volume/earth_pose.h"

namespace sonar {
namespace {

constexpr std::size_t kMostMasks = 250;  ///< that back-ends tell apart, with room for those that are only tried

Rgba8 colour_of(const MaskLayer& layer) {
  const auto byte = [](float share) { return static_cast<std::uint8_t>(std::lround(share * 255.0F)); };
  return {byte(layer.rgb[0]), byte(layer.rgb[1]), byte(layer.rgb[2]), 255};
}

void add_masks(LiveVolumeInput& input, const std::vector<SchoolLayer>& layers) {
  for (const SchoolLayer& school : layers) {
    if (!school.layer.mask || school.layer.mask->empty()) continue;
    const bool tried = school.number == 0;
    if (!tried && input.masks.size() >= kMostMasks) continue;
    input.masks.push_back(school.layer);
    input.masks.back().selected = school.selected;
    input.names.push_back(tried ? std::string() : std::to_string(school.number));
    if (tried) ++input.tried;
    if (school.casts_shadow) input.casting_shadow.push_back(school.layer.mask);
    if (!tried) input.legend.emplace_back(colour_of(school.layer), school.title);
  }
}

/// The schools of the observation on show through all their pings.
TrailSubject trail_subject(const Workspace& workspace, const OpenObservationPtr& shown, const Theme& theme) {
  const Document& document = workspace.document;
  TrailSubject out{std::shared_ptr<const std::vector<PingNavigation>>(shown, &shown->files().navigation),
                   document.recipe().navigation.beams_stabilised,
                   {}};
  const DisplayParams& display = workspace.display.values();
  const std::set<SchoolName> selected = selection(workspace);
  for (const auto& school : document.state().schools) {
    if (!display.masks) break;
    if (school->masks.decided.status == "rejected" && !display.rejected) continue;
    TrailSchool trail{school, drawn_colour(*school, theme), selected.contains({shown->index(), school->number}), {}};
    for (const auto& there : school->masks.pings) trail.pings.push_back({there.ping_index, &there.mask});
    out.schools.push_back(std::move(trail));
  }
  return out;
}

/// The ping that playing goes to from the one that has arrived; null where it rests there.
StagedPingPtr moves_to(const Workspace& workspace, const PictureLook& look) {
  const MotionBetween& motion = workspace.motion();
  const bool moves = !look.panel && motion.from && motion.from == workspace.document.staged();
  return moves ? motion.to : nullptr;
}

/// The ship where it is on its way, below an eye that stands where it stood if it is to stand still.
void move_ship(LiveVolumeInput& input, const PingNavigation& next, double fraction) {
  const PingNavigation from = input.navigation;
  input.navigation = navigation_between(from, next, fraction);
  input.towards_next = fraction;
  const auto place = volume_place(input.options, input.scale);
  if (!input.options.volume.earth_fixed || !place) return;
  const Camera eye = input.options.camera ? *input.options.camera : overview(*input.sector, place->rays);
  if (const auto stands = standing_still(eye, from, input.navigation)) input.options.camera = stands;
}

}  // namespace

std::optional<LiveVolumeInput> volume_input(const Workspace& workspace, const std::optional<Camera>& camera,
                                            const PictureLook& look) {
  const Document& document = workspace.document;
  if (!document.shown() || !document.staged()) return std::nullopt;
  const OpenObservationPtr& shown = document.shown();
  LiveVolumeInput input;
  input.staged = document.staged();
  input.sector = std::shared_ptr<const Sector>(shown, &shown->sector());
  input.navigation = shown->files().navigation[static_cast<std::size_t>(input.staged->ping_index)];
  input.moved = moves_places(shown->recipe(), input.navigation);
  input.title = shown->title();
  input.title_line = fmt::format("{}   ping {}", input.title, input.staged->ping_index);
  input.options.display = workspace.display.values();
  input.options.volume = workspace.volume.values();
  input.options.size = look.size;
  input.options.least_text_px = kLeastText_px;
  input.options.panel = look.panel;
  input.options.dark = look.dark;
  input.options.units = look.units;
  input.options.transfer = workspace.view_curve();
  input.options.camera = camera;
  input.scale = look.scale;
  input.next = moves_to(workspace, look);
  std::int64_t nearer = input.staged->ping_index;  // whose schools are shown
  if (input.next) {
    const double fraction = workspace.motion().fraction;
    if (!(fraction < 0.5)) nearer = input.next->ping_index;
    move_ship(input, shown->files().navigation[static_cast<std::size_t>(input.next->ping_index)], fraction);
    input.title_line = fmt::format("{}   ping {} to {}", input.title, input.staged->ping_index, input.next->ping_index);
  }
  input.refused = refused_layer_in(workspace, nearer);
  input.options.depth_raster = workspace.depth_raster();
  // Slices are put right when the observation on show is another one; until then the old places are kept.
  input.fan = std::clamp(workspace.slices().fan, 0, shown->sector().fans() - 1);
  input.beam = std::clamp(workspace.slices().beam, 0, shown->sector().beams() - 1);
  input.scale_bar = workspace.curve_follows_scale();
  input.moving_budget_s = workspace.volume.values().moving_budget_ms / 1e3;
  input.currents =
      volume_currents(document.recipe(), *input.sector, input.navigation, input.options.volume, input.options.units);
  input.extinction = document.recipe().measure.extinction;
  if (trail_params(input.options.volume).any()) {
    input.trails = trail_subject(workspace, shown, theme_of(input.options));
  }
  add_masks(input, school_layers(workspace, nearer, theme_of(input.options)));
  return input;
}

}  // namespace sonar
