// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "session/slices/slice_actions.h"
#include "session/tools/brush_tool.h"
#include "session/tools/measure_tool.h"
#include "session/tools/seed_tool.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&Schools";
constexpr int kLeastBrush_px = 2;
constexpr int kMostBrush_px = 100;

void add_tool(AppModel& app, const char* id, const char* text, const char* key, const char* tip, ToolName tool) {
  Workspace& workspace = app.workspace;
  app.actions.add({id,
                   kMenu,
                   text,
                   {key},
                   tip,
                   [&app, &workspace, tool] {
                     app.brush_tool->cancel();
                     workspace.tool.set(tool);
                   },
                   [&workspace] { return workspace.document.shown() != nullptr; },
                   [&workspace, tool] { return workspace.tool() == tool; }});
}

void add_brush_size(AppModel& app, const char* id, const char* text, const char* key, double factor) {
  Workspace& workspace = app.workspace;
  app.actions.add(
      {id,
       kMenu,
       text,
       {key},
       "",
       [&workspace, factor] {
         const int step = factor > 1.0 ? 1 : -1;
         const int px = static_cast<int>(workspace.brush_px() * factor) + step;
         workspace.brush_px.set(std::clamp(px, kLeastBrush_px, kMostBrush_px));
       },
       [&workspace] { return workspace.tool() == ToolName::brush || workspace.tool() == ToolName::eraser; }});
}

void copy_read_out(AppModel& app) {
  const auto& cursor = app.workspace.cursor();
  if (cursor && app.dialogs.copy) app.dialogs.copy(read_out(app.workspace, *cursor).line());
}

void copy_figures(AppModel& app) {
  const auto& measured = app.workspace.measurement();
  if (measured && on_show(app.workspace, *measured) && app.dialogs.copy)
    app.dialogs.copy(table_text(*measured, app.workspace.units()));
}

void add_measuring(AppModel& app) {
  Workspace& workspace = app.workspace;
  app.actions.add({"measure.all_fans",
                   "&Edit",
                   "Measure through all fans",
                   {"Shift+G"},
                   "A box or a lasso in the slice from above takes in every fan, not the one on show alone",
                   [&workspace] { workspace.measure_all_fans.set(!workspace.measure_all_fans()); },
                   {},
                   [&workspace] { return workspace.measure_all_fans(); }});
  app.actions.add({"measure.copy",
                   "&Edit",
                   "Copy figures",
                   {"Ctrl+Shift+G"},
                   "What was measured, with units, for a spreadsheet; Ctrl+C in a view does the same",
                   [&app] { copy_figures(app); },
                   [&workspace] { return !measured_text(workspace).empty(); }});
}

/// The drag, else what runs or waits for a click, else the selection: one key must not be two actions'.
void let_go(AppModel& app) {
  if (app.brush_tool->drawing()) return app.brush_tool->cancel();
  if (std::ranges::any_of(app.pictures, [](const PictureDock& dock) { return dock.picture->cancel_drag(); })) return;
  if (app.workspace.tool() == ToolName::section) return app.workspace.tool.set(ToolName::seed);
  const bool measuring = app.workspace.tool() == ToolName::measure && app.workspace.measurement();
  if (app.measure_tool->drawing() || measuring) return app.measure_tool->cancel();
  Document& document = app.workspace.document;
  // Nothing else can be let go while the first survey is on its way.
  if (document.survey() == nullptr && !document.progress().stage.empty()) return document.cancel();
  const Action* stop = app.actions.find("school.stop");
  if (stop != nullptr && stop->enabled()) return stop->run();
  if (app.workspace.measurement()) return app.measure_tool->cancel();
  app.workspace.school.set(std::nullopt);
}

}  // namespace

void add_tool_actions(AppModel& app) {
  add_tool(
      app, "tool.seed", "Seed", "S",
      "A click grows a school, a double click follows it through time; Shift adds, Ctrl takes away, Alt selects only",
      ToolName::seed);
  Workspace& workspace = app.workspace;
  app.actions.add({"tool.seed_here",
                   kMenu,
                   "Seed where the slices cross",
                   {"Shift+S"},
                   "As a click with the seed tool on the voxel at the fan, beam and range of the slices",
                   [&app, &workspace] {
                     const SlicePlaces at = workspace.slices();
                     app.seed_tool->press({at.fan, at.beam, at.sample}, false, false, false);
                     app.seed_tool->leave();  // no pointer is there
                   },
                   [&workspace] { return workspace.document.staged() != nullptr; }});
  add_tool(app, "tool.brush", "Brush", "B", "Paints voxels into the selected school, or into a new one",
           ToolName::brush);
  add_tool(app, "tool.eraser", "Eraser", "E", "Takes voxels from the selected school, or from all", ToolName::eraser);
  add_tool(app, "tool.measure", "Measure", "G",
           "A drag measures a line; in slices with Shift a box, with Ctrl a lasso; in the volume click both ends",
           ToolName::measure);
  add_brush_size(app, "tool.larger", "Larger brush", "]", 1.25);
  add_brush_size(app, "tool.smaller", "Smaller brush", "[", 0.8);
  app.actions.add(
      {"tool.cancel",
       kMenu,
       "Cancel, stop, or select nothing",
       {"Esc"},
       "Ends a drag or what was measured; else stops what is being followed through time; else selects no school",
       [&app] { let_go(app); }});
  app.actions.add({"cursor.copy",
                   "&Edit",
                   "Copy read-out",
                   {"Ctrl+Shift+C"},
                   "Everything that is known of the voxel under the pointer, as text",
                   [&app] { copy_read_out(app); },
                   [&app] { return app.workspace.cursor().has_value(); }});
  add_measuring(app);
}

}  // namespace sonar
