// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "session/app_parts.h"
#include "session/echograms/echogram_actions.h"
#include "session/echograms/echogram_model.h"
#include "session/maps/observation_map_model.h"
#include "session/maps/strip_model.h"
#include "session/maps/survey_map_model.h"
#include "session/timelines/echograms.h"
#include "session/timelines/lineage_model.h"
#include "session/timelines/timeline_actions.h"
#include "session/timelines/timeline_model.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&View";
constexpr const char* kRasters =
    "Rasters of depths (*.tif *.tiff *.nc *.asc *.grd *.TIF *.TIFF *.NC *.ASC *.GRD);;All files (*)";

void add_chart_actions(AppModel& app) {
  app.actions.add({.id = "map.depths",
                   .menu = kMenu,
                   .text = "Depth chart…",
                   .keys = {},
                   .tip = "A raster of depths (GEBCO, EMODnet, GeoTIFF, netCDF) to lie under the survey map",
                   .run =
                       [&app] {
                         if (!app.dialogs.file_to_open) return;
                         const std::string file = app.dialogs.file_to_open("Depth chart", kRasters);
                         if (!file.empty()) app.workspace.depth_raster.set(file);
                       },
                   .enabled = [&app] { return app.workspace.document.survey() != nullptr; }});
  app.actions.add({.id = "map.no_depths",
                   .menu = kMenu,
                   .text = "No depth chart",
                   .keys = {},
                   .tip = "Plain sea under the survey map",
                   .run = [&app] { app.workspace.depth_raster.set({}); },
                   .enabled = [&app] { return !app.workspace.depth_raster().empty(); }});
}

/// Each survey has its own chart, kept for the next time.
void remember_charts(AppModel& app) {
  Workspace& workspace = app.workspace;
  const auto survey = [&workspace] {
    const auto& paths = workspace.document.paths();
    return paths.empty() ? std::filesystem::path{} : paths.front();
  };
  app.listening.to(workspace.document.changes(), [&app, &workspace, survey](DocumentChange change) {
    if (change == DocumentChange::survey) workspace.depth_raster.set(app.preferences.chart_of(survey()));
  });
  app.listening.to(workspace.depth_raster.changed(), [&app, &workspace, survey] {
    if (survey().empty() || app.preferences.chart_of(survey()) == workspace.depth_raster()) return;
    app.preferences.set_chart(survey(), workspace.depth_raster());
    keep_preferences(app);
  });
}

}  // namespace

void add_maps(AppModel& app) {
  Workspace& workspace = app.workspace;
  remember_charts(app);
  auto map = std::make_unique<ObservationMapModel>(workspace);
  auto strip = std::make_unique<StripModel>(workspace);
  auto survey = std::make_unique<SurveyMapModel>(workspace);
  const auto echograms = std::make_shared<Echograms>(workspace.queue, workspace.document);
  auto of_one = std::make_unique<TimelineModel>(workspace, echograms, TimelineOf::observation);
  auto of_all = std::make_unique<TimelineModel>(workspace, echograms, TimelineOf::survey);
  const std::array timelines{of_one.get(), of_all.get()};
  auto lineage = std::make_unique<LineageModel>(workspace);
  auto echogram = std::make_unique<EchogramModel>(workspace, echograms);
  app.actions.add(
      {.id = "map.all",
       .menu = kMenu,
       .text = "Show whole maps, timelines and echograms",
       .keys = {"Shift+Home"},
       .tip = "Undo zooming and panning of maps, timelines and echograms",
       .run =
           [map = map.get(), survey = survey.get(), echogram = echogram.get(), lineage = lineage.get(), timelines] {
             map->show_all();
             survey->show_all();
             for (TimelineModel* one : timelines) one->show_all();
             echogram->show_all();
             lineage->show_all();
           },
       .enabled = [&workspace] { return workspace.document.survey() != nullptr; }});
  app.actions.add({.id = "strip.side",
                   .menu = kMenu,
                   .text = "Propagation strip from the side",
                   .keys = {"Shift+V"},
                   .tip = "Masks of neighbouring pings from the side instead of from above",
                   .run =
                       [strip = strip.get()] {
                         const bool above = strip->aspect() == MaskAspect::above;
                         strip->set_aspect(above ? MaskAspect::side : MaskAspect::above);
                       },
                   .checked = [strip = strip.get()] { return strip->aspect() == MaskAspect::side; }});
  add_chart_actions(app);
  add_timeline_actions(app);
  add_echogram_actions(app, *echogram);
  const auto dock = [&](std::string id, std::string title, DockPlace place, std::string view_switch,
                        std::unique_ptr<LivePicture> picture) {
    app.pictures.push_back({std::move(id), std::move(title), place, std::move(view_switch), std::move(picture)});
  };
  dock("observation_map", "Observation map", DockPlace::right, "observation_map", std::move(map));
  dock("propagation", "Propagation", DockPlace::bottom, "propagation", std::move(strip));
  dock("survey_map", "Survey map", DockPlace::centre, "survey_map", std::move(survey));
  dock("observation_timeline", "Observation timeline", DockPlace::bottom, "timeline", std::move(of_one));
  dock("survey_timeline", "Survey timeline", DockPlace::bottom, "timeline", std::move(of_all));
  dock("lineage", "Lineage", DockPlace::bottom, "lineage", std::move(lineage));
  dock("echogram", "Echogram", DockPlace::bottom, "echogram", std::move(echogram));
}

}  // namespace sonar
