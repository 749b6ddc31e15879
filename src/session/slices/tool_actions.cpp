// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "session/slices/slice_actions.h"
#include "session/tools/brush_tool.h"
#include "session/tools/seed_tool.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&Schools";
constexpr int kLeastBrush_px = 2;
constexpr int kMostBrush_px = 100;

void add_tool(Desk& desk, const char* id, const char* text, const char* key, const char* tip, ToolName tool) {
  Workspace& workspace = desk.workspace;
  desk.actions.add({id,
                    kMenu,
                    text,
                    {key},
                    tip,
                    [&desk, &workspace, tool] {
                      desk.brush_tool->cancel();
                      workspace.tool.set(tool);
                    },
                    [&workspace] { return workspace.document.shown() != nullptr; },
                    [&workspace, tool] { return workspace.tool() == tool; }});
}

void add_brush_size(Desk& desk, const char* id, const char* text, const char* key, double factor) {
  Workspace& workspace = desk.workspace;
  desk.actions.add({id,
                    kMenu,
                    text,
                    {key},
                    "",
                    [&workspace, factor] {
                      const int step = factor > 1.0 ? 1 : -1;
                      const int px = static_cast<int>(workspace.brush_px() * factor) + step;
                      workspace.brush_px.set(std::clamp(px, kLeastBrush_px, kMostBrush_px));
                    },
                    [&workspace] { return workspace.tool() != ToolName::seed; }});
}

void copy_read_out(Desk& desk) {
  const auto& cursor = desk.workspace.cursor();
  if (cursor && desk.asking.copy) desk.asking.copy(read_out(desk.workspace, *cursor).line());
}

/// The drag, else what runs or waits for a click, else the selection: one key must not be two actions'.
void let_go(Desk& desk) {
  if (desk.brush_tool->drawing()) return desk.brush_tool->cancel();
  Document& document = desk.workspace.document;
  // Nothing else can be let go while the first survey is on its way.
  if (document.survey() == nullptr && !document.progress().stage.empty()) return document.cancel();
  const Action* stop = desk.actions.find("school.stop");
  if (stop != nullptr && stop->enabled()) return stop->run();
  desk.workspace.school.set(std::nullopt);
}

}  // namespace

void add_tool_actions(Desk& desk) {
  add_tool(
      desk, "tool.seed", "Seed", "S",
      "A click grows a school, a double click follows it through time; Shift adds, Ctrl takes away, Alt selects only",
      ToolName::seed);
  add_tool(desk, "tool.brush", "Brush", "B", "Paints voxels into the selected school, or into a new one",
           ToolName::brush);
  add_tool(desk, "tool.eraser", "Eraser", "E", "Takes voxels from the selected school, or from all", ToolName::eraser);
  add_brush_size(desk, "tool.larger", "Larger brush", "]", 1.25);
  add_brush_size(desk, "tool.smaller", "Smaller brush", "[", 0.8);
  desk.actions.add({"tool.cancel",
                    kMenu,
                    "Cancel, stop, or select nothing",
                    {"Esc"},
                    "Ends a drag; else stops what is being followed through time; else no school is selected any more",
                    [&desk] { let_go(desk); }});
  desk.actions.add({"cursor.copy",
                    "&Edit",
                    "Copy read-out",
                    {"Ctrl+Shift+C"},
                    "Everything that is known of the voxel under the pointer, as text",
                    [&desk] { copy_read_out(desk); },
                    [&desk] { return desk.workspace.cursor().has_value(); }});
}

}  // namespace sonar
