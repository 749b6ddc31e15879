// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "model/mask_middle.h"
#include "session/app_parts.h"
#include "session/tools/seed_tool.h"
#include "session/volume/volume_model.h"

namespace sonar {
namespace {

struct Side {
  VolumeSide side;
  const char* id;
  const char* text;
  const char* key;
  const char* tip;
};
constexpr std::array<Side, 5> kSides{{
    {VolumeSide::above, "volume.above", "Volume: from above", "Ctrl+1", "Straight down, the bow upwards"},
    {VolumeSide::starboard, "volume.starboard", "Volume: from starboard", "Ctrl+2", "Level, the bow to the right"},
    {VolumeSide::port, "volume.port", "Volume: from port", "Ctrl+3", "Level, the bow to the left"},
    {VolumeSide::behind, "volume.behind", "Volume: from behind", "Ctrl+4", "Level, along the ship's course"},
    {VolumeSide::overview, "volume.overview", "Volume: overview", "Ctrl+5", "The whole sector, obliquely from above"},
}};

/// Of the selected school in the ping looked at; empty where it is not there.
std::optional<Point<Sonar>> middle_of_selected(const Workspace& workspace) {
  const auto selected = workspace.selected();
  if (!selected) return std::nullopt;
  const Document& document = workspace.document;
  const auto* there = in_ping(document.state().schools[*selected]->masks, document.ping());
  if (there == nullptr) return std::nullopt;
  const Sector& sector = document.shown()->sector();
  const auto middle = mask_middle(there->mask, sector.beams());
  return middle ? std::optional(sector.centre(middle->fan, middle->beam, middle->sample)) : std::nullopt;
}

/// A switch of what the volume shows.
Action turn(AppModel& app, const VolumeModel* volume, const char* id, const char* text, const char* key,
            const char* tip, std::function<bool(const VolumeParams&)> on,
            std::function<void(VolumeParams&, bool)> set) {
  Action action{id, "&View", text, {key}, tip, [&app, on, set = std::move(set)] {
                  VolumeParams params = app.workspace.volume.values();
                  set(params, !on(params));
                  app.workspace.volume.assign(params);
                }};
  action.enabled = [volume] { return volume->seen(); };
  action.checked = [&app, on = std::move(on)] { return on(app.workspace.volume.values()); };
  return action;
}

constexpr int kTrailPings = 10;  ///< of a trail that was never longer or shorter

void add_past(AppModel& app, const VolumeModel* volume) {
  app.actions.add(turn(
      app, volume, "volume.earth_fixed", "Volume: earth-fixed", "Ctrl+7",
      "While pings pass the eye stands still on the earth, and the ship sails through the view",
      [](const VolumeParams& params) { return params.earth_fixed; },
      [](VolumeParams& params, bool on) { params.earth_fixed = on; }));
  app.actions.add(turn(
      app, volume, "volume.interpolated", "Volume: interpolated motion", "Ctrl+9",
      "While pings play the volume moves evenly from one to the next, and says that it is interpolated",
      [](const VolumeParams& params) { return params.interpolated; },
      [](VolumeParams& params, bool on) { params.interpolated = on; }));
  app.actions.add(turn(
      app, volume, "volume.trails", "Volume: tracks and trails", "Ctrl+8",
      "The ship's track, those of schools, and where schools were in the pings before",
      [](const VolumeParams& params) { return trail_params(params).any(); },
      [pings = kTrailPings](VolumeParams& params, bool on) mutable {
        if (params.trail_pings > 0) pings = params.trail_pings;
        params.ship_track = params.school_tracks = on;
        params.trail_pings = on ? pings : 0;
        if (on) params.context = true;
      }));
}

}  // namespace

void add_volume(AppModel& app) {
  auto model = std::make_unique<VolumeModel>(app.workspace);
  VolumeModel* volume = model.get();
  // Tools are made by whatever part comes first; they are there when somebody points.
  volume->hooks.press = [&app](const Voxel& voxel, bool shift, bool control, bool double_press) {
    if (app.seed_tool) app.seed_tool->press(voxel, shift, control, double_press);
  };
  volume->hooks.select = [&app](const Voxel& voxel) {
    if (app.seed_tool) app.seed_tool->select(voxel);
  };
  volume->hooks.hover = [&app](const Voxel& voxel, bool shift, bool control) {
    if (app.seed_tool) app.seed_tool->hover(voxel, shift, control);
  };
  volume->hooks.leave = [&app] {
    if (app.seed_tool) app.seed_tool->leave();
  };
  app.actions.add({"volume.school",
                   "&View",
                   "Volume: centre on school",
                   {"Ctrl+6"},
                   "The selected school in the middle; turning goes round it",
                   [&app, volume] {
                     if (const auto middle = middle_of_selected(app.workspace)) volume->look_at(*middle);
                   },
                   [&app, volume] { return volume->seen() && middle_of_selected(app.workspace).has_value(); }});
  app.pictures.push_back({"volume", "Volume", DockPlace::centre, "volume", std::move(model)});
  for (const Side& side : kSides) {
    app.actions.add({side.id,
                     "&View",
                     side.text,
                     {side.key},
                     side.tip,
                     [volume, side] { volume->look_from(side.side); },
                     [volume] { return volume->seen(); }});
  }
  add_past(app, volume);
}

}  // namespace sonar
