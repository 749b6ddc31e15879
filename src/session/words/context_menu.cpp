// SPDX-License-Identifier: Apache-2.0
#include "session/words/context_menu.h"

#include <algorithm>
#include <array>

namespace sonar {
namespace {

using Id = std::string_view;

constexpr std::array<Id, 4> kTools{"tool.seed", "tool.brush", "tool.eraser", "tool.measure"};
constexpr std::array<Id, 3> kMeasure{"measure.all_fans", "measure.copy", "cursor.copy"};
constexpr std::array<Id, 2> kMeasureMap{"tool.measure", "measure.copy"};
constexpr std::array<Id, 6> kDecide{"review.accept",  "review.reject", "review.unreview",
                                    "school.species", "school.rename", "school.comment"};
constexpr std::array<Id, 5> kFollow{"school.propagate", "school.propagate_forwards", "school.propagate_backwards",
                                    "school.continue", "school.stop"};
constexpr std::array<Id, 7> kShape{"school.fill_holes",  "school.smooth", "school.largest_part", "school.split",
                                   "school.split_piece", "school.merge",  "school.delete"};
constexpr std::array<Id, 4> kReview{"review.next", "review.rule", "schools.detect", "schools.detect_all"};
constexpr std::array<Id, 4> kParts{"school.split", "school.merge", "school.delete", "school.none"};
constexpr std::array<Id, 2> kEcho{"school.take_in", "display.refused"};
constexpr std::array<Id, 3> kSliceLook{"display.all", "display.filtered", "display.masks"};
constexpr std::array<Id, 4> kPlane{"slice.plane_horizontal", "slice.plane_vertical", "slice.plane_oblique",
                                   "slice.section"};
constexpr std::array<Id, 5> kSides{"volume.overview", "volume.above", "volume.starboard", "volume.port",
                                   "volume.behind"};
constexpr std::array<Id, 3> kReadOut{"tool.measure", "measure.copy", "cursor.copy"};
constexpr std::array<Id, 3> kChart{"map.all", "map.depths", "map.no_depths"};
constexpr std::array<Id, 1> kMap{"map.all"};
constexpr std::array<Id, 2> kFigures{"chart.columns", "chart.all"};
constexpr std::array<Id, 1> kOverFrequency{"frequency.choose"};
constexpr std::array<Id, 1> kOfCurves{"curves.choose"};
constexpr std::array<Id, 4> kNoiseSteps{"noise.choose", "noise.next", "noise.previous", "noise.all"};
constexpr std::array<Id, 1> kStrip{"strip.side"};
constexpr std::array<Id, 5> kEvents{"event.trawl", "event.station", "event.noise", "event.other", "event.bookmark"};
constexpr std::array<Id, 1> kBookmark{"event.bookmark"};
constexpr std::array<Id, 3> kBad{"bad.ping", "bad.interval", "good.interval"};
constexpr std::array<Id, 1> kMark{"mark.remove"};
constexpr std::array<Id, 2> kNextEvent{"event.previous", "event.next"};
constexpr std::array<Id, 2> kTimelineLook{"timelines.filtered", "timelines.maximum"};
constexpr std::array<Id, 5> kEchogramLook{"echogram.fan", "echogram.depth", "echogram.hold", "echogram.other",
                                          "echogram.channel"};
constexpr std::array<Id, 2> kPicture{"file.copy_view", "file.save_view"};
constexpr std::array<Id, 2> kSearch{"schools.detect", "schools.detect_all"};
constexpr std::array<Id, 4> kResults{"export.results", "export.csv", "export.gpkg", "file.open_folder"};
constexpr std::array<Id, 1> kAllPings{"list.pings_of_all"};
constexpr std::array<Id, 2> kUndo{"edit.undo", "edit.redo"};
constexpr std::array<Id, 1> kRows{"list.copy"};

constexpr std::array<ActionGroup, 8> kSlice{kTools, kDecide, kFollow, kShape, kEcho, kSliceLook, kMeasure, kPicture};
constexpr std::array<ActionGroup, 9> kPlaneSlice{kPlane, kTools,     kDecide,  kFollow, kShape,
                                                 kEcho,  kSliceLook, kMeasure, kPicture};
constexpr std::array<ActionGroup, 7> kVolume{kDecide, kFollow, kParts, kEcho, kSides, kReadOut, kPicture};
constexpr std::array<ActionGroup, 6> kObservationMap{kDecide, kFollow, kEcho, kMap, kMeasureMap, kPicture};
constexpr std::array<ActionGroup, 4> kSurveyMap{kDecide, kChart, kMeasureMap, kPicture};
constexpr std::array<ActionGroup, 4> kPropagation{kFollow, kShape, kStrip, kPicture};
constexpr std::array<ActionGroup, 7> kTimeline{kMark, kEvents, kBad, kEcho, kNextEvent, kTimelineLook, kPicture};
constexpr std::array<ActionGroup, 5> kLineage{kDecide, kParts, kBad, kMap, kPicture};
constexpr std::array<ActionGroup, 4> kEchogram{kEvents, kBad, kEchogramLook, kPicture};
constexpr std::array<ActionGroup, 3> kCharts{kDecide, kFigures, kPicture};
constexpr std::array<ActionGroup, 3> kFrequency{kDecide, kOverFrequency, kPicture};
constexpr std::array<ActionGroup, 3> kCurves{kDecide, kOfCurves, kPicture};
constexpr std::array<ActionGroup, 2> kNoise{kNoiseSteps, kPicture};
constexpr std::array<ActionGroup, 3> kTree{kSearch, kResults, kRows};
constexpr std::array<ActionGroup, 4> kSchoolRows{kDecide, kParts, kReview, kRows};
constexpr std::array<ActionGroup, 4> kPingRows{kDecide, kShape, kAllPings, kRows};
constexpr std::array<ActionGroup, 2> kRefusedRows{kEcho, kRows};
constexpr std::array<ActionGroup, 3> kMarkRows{kMark, kBookmark, kRows};
constexpr std::array<ActionGroup, 2> kJournal{kUndo, kRows};
constexpr std::array<ActionGroup, 1> kNotes{kRows};

/// Of the menu bar: the first of what belongs together, after others.
constexpr std::array<Id, 40> kBegin{"edit.undo",
                                    "transects.open",
                                    "file.recipe",
                                    "file.calibration",
                                    "file.run_surveys",
                                    "file.save_view",
                                    "file.quit",
                                    "export.ply",
                                    "export.ices",
                                    "export.movie",
                                    "volume.above",
                                    "volume.earth_fixed",
                                    "map.all",
                                    "chart.columns",
                                    "noise.choose",
                                    "slices.lock",
                                    "tool.larger",
                                    "view.top_slice",
                                    "view.dark",
                                    "ping.play",
                                    "slice.fan_up",
                                    "event.trawl",
                                    "event.previous",
                                    "bad.ping",
                                    "schools.detect",
                                    "school.propagate_forwards",
                                    "school.fill_holes",
                                    "school.split",
                                    "school.species",
                                    "school.delete",
                                    "numbers.integrate",
                                    "display.filtered",
                                    "timelines.filtered",
                                    "echogram.fan",
                                    "slice.plane_horizontal",
                                    "slice.range_out",
                                    "view.volume",
                                    "view.observation_map",
                                    "view.timeline",
                                    "list.pings_of_all"};

struct Menu {
  Id dock;
  std::span<const ActionGroup> groups;
};
constexpr std::array<Menu, 24> kMenus{
    {{"top_slice", kSlice},          {"side_slice", kSlice},        {"range_slice", kSlice},
     {"plane_slice", kPlaneSlice},   {"volume", kVolume},           {"observation_map", kObservationMap},
     {"survey_map", kSurveyMap},     {"propagation", kPropagation}, {"observation_timeline", kTimeline},
     {"survey_timeline", kTimeline}, {"echogram", kEchogram},       {"lineage", kLineage},
     {"survey_tree", kTree},         {"schools", kSchoolRows},      {"review", kSchoolRows},
     {"school_pings", kPingRows},    {"refused", kRefusedRows},     {"marks", kMarkRows},
     {"journal", kJournal},          {"diagnostics", kNotes},       {"chart", kCharts},
     {"noise_steps", kNoise},        {"frequency", kFrequency},     {"curves", kCurves}}};

}  // namespace

std::span<const ActionGroup> context_menu(std::string_view dock) {
  const auto found = std::find_if(kMenus.begin(), kMenus.end(), [&](const Menu& menu) { return menu.dock == dock; });
  return found == kMenus.end() ? std::span<const ActionGroup>{} : found->groups;
}

bool begins_group(std::string_view action) { return std::find(kBegin.begin(), kBegin.end(), action) != kBegin.end(); }

std::span<const std::string_view> group_beginnings() { return kBegin; }

}  // namespace sonar
