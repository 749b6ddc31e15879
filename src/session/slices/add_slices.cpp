// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "session/desk_parts.h"
#include "session/live_watch.h"
#include "session/playback.h"
#include "session/slices/slice_actions.h"
#include "session/slices/slice_model.h"

namespace sonar {

void add_slices(Desk& desk) {
  Workspace& workspace = desk.workspace;
  desk.seed_tool = std::make_shared<SeedTool>(workspace, desk.pulse);
  desk.brush_tool = std::make_shared<BrushTool>(workspace);
  desk.playback = std::make_shared<Playback>(workspace, desk.pulse);
  desk.live = std::make_shared<LiveWatch>(workspace, desk.pulse);
  desk.pictures.push_back({"top_slice", "Slice from above", DockPlace::centre, "top_slice",
                           std::make_unique<SliceModel>(SliceSide::top, workspace, *desk.seed_tool, *desk.brush_tool)});
  desk.pictures.push_back(
      {"side_slice", "Slice from the side", DockPlace::centre, "side_slice",
       std::make_unique<SliceModel>(SliceSide::side, workspace, *desk.seed_tool, *desk.brush_tool)});
  add_navigation_actions(desk);
  add_tool_actions(desk);
  add_display_actions(desk);
}

}  // namespace sonar
