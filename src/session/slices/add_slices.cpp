// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "session/app_parts.h"
#include "session/live/live_watch.h"
#include "session/looks/first_sight.h"
#include "session/playing/playback.h"
#include "session/slices/slice_actions.h"
#include "session/slices/slice_model.h"
#include "session/slices/slices_follow.h"
#include "session/tools/measure_tool.h"

namespace sonar {

void add_slices(AppModel& app) {
  Workspace& workspace = app.workspace;
  app.seed_tool = std::make_shared<SeedTool>(workspace, app.animations);
  app.brush_tool = std::make_shared<BrushTool>(workspace);
  app.measure_tool = std::make_shared<MeasureTool>(workspace);
  app.playback = std::make_shared<Playback>(workspace, app.animations);
  app.slices_follow = std::make_shared<SlicesFollow>(workspace);
  app.first_sight = std::make_shared<FirstSight>(workspace);
  app.live = std::make_shared<LiveWatch>(workspace, app.animations);
  const auto add = [&](const char* id, const char* title, SliceKind kind) {
    app.pictures.push_back({id, title, DockPlace::centre, id,
                            std::make_unique<SliceModel>(kind, workspace, *app.seed_tool, *app.brush_tool)});
  };
  add("top_slice", "Slice from above", SliceKind::top);
  add("side_slice", "Slice from the side", SliceKind::side);
  add("range_slice", "Range slice", SliceKind::range);
  add("plane_slice", "Plane slice", SliceKind::plane);
  add_navigation_actions(app);
  add_tool_actions(app);
  add_display_actions(app);
}

}  // namespace sonar
