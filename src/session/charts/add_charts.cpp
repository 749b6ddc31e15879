// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <utility>

#include "session/app_parts.h"
#include "session/charts/chart_model.h"
#include "session/charts/curves_model.h"
#include "session/charts/frequency_model.h"

namespace sonar {

void add_charts(AppModel& app) {
  constexpr const char* kMenu = "&View";
  Workspace& workspace = app.workspace;
  auto chart = std::make_unique<ChartModel>(workspace);
  app.actions.add(
      {.id = "chart.columns",
       .menu = kMenu,
       .text = "Columns of the chart...",
       .keys = {},
       .tip = "Which figures of schools the chart shows, one over another or the histogram of one",
       .run = [&app] {
         (void)asked(app, "Chart", app.workspace.picture_file, {"chart.table", "chart.x", "chart.y", "chart.bins"});
       }});
  app.actions.add({.id = "chart.all",
                   .menu = kMenu,
                   .text = "Show whole chart",
                   .keys = {},
                   .tip = "Undo zooming and panning of the chart",
                   .run = [chart = chart.get()] { chart->show_all(); },
                   .enabled = [chart = chart.get()] { return chart->zoomed(); }});
  app.pictures.push_back({"chart", "Charts", DockPlace::bottom, "chart", std::move(chart)});
  app.actions.add({.id = "frequency.choose",
                   .menu = kMenu,
                   .text = "Schools over frequency...",
                   .keys = {},
                   .tip = "Of which pings the chart over frequency is, and whether it shows the water round schools",
                   .run = [&app] {
                     (void)asked(app, "Schools over frequency", app.workspace.picture_file,
                                 {"frequency.one_ping", "frequency.water"});
                   }});
  app.pictures.push_back(
      {"frequency", "Frequency", DockPlace::bottom, "frequency", std::make_unique<FrequencyModel>(workspace)});
  app.actions.add(
      {.id = "curves.choose",
       .menu = kMenu,
       .text = "Curves of schools...",
       .keys = {},
       .tip = "Which curves are shown: of Sv in schools, of their size over the tolerance, or against the ship",
       .run = [&app] {
         (void)asked(app, "Curves of schools", app.workspace.picture_file,
                     {"curves.curve", "curves.one_ping", "curves.over"});
       }});
  app.pictures.push_back({"curves", "Curves", DockPlace::bottom, "curves", std::make_unique<CurvesModel>(workspace)});
}

}  // namespace sonar
