// SPDX-License-Identifier: Apache-2.0
#include "session/recipes/control_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace sonar {
namespace {

std::string in_db(const Workspace& workspace, double confidence) {
  const SelectParams& select = workspace.select.values();
  if (select.mode == GrowMode::paper) return "in units of opacity: 1 = as opaque as the seed";
  return fmt::format("{:.1f} dB below the reference", db_below_reference(confidence, select.tolerance_db));
}

/// The settings that matter first, each with a sentence that can be read alone.
struct First {
  const char* name;
  const char* sentence;
};
using Firsts = std::span<const First>;
constexpr std::array<First, 3> kSelection{
    {{"tolerance_db", "How far below the clicked voxel's Sv members may lie. Larger takes in more."},
     {"margin_db", "How far above the noise of their beam members must lie."},
     {"reach_pings", "How many pings a school is followed to each side."}}};
constexpr std::array<First, 3> kSchools{{{"masks", "The outlines of schools lie over the data."},
                                         {"rejected", "Schools that a human rejected are shown in grey."},
                                         {"refused_echoes", "Diamonds mark echoes that were judged no schools."}}};
constexpr std::array<First, 4> kColours{{{"scale.map", "The colours of Sv in all views."},
                                         {"scale.low_db", "Sv of the first colour. Nothing is drawn below it."},
                                         {"scale.span_db", "How many dB there are from the first colour to the last."},
                                         {"scale.threshold_db", "Samples below this Sv are not drawn."}}};
constexpr std::array<First, 2> kNoise{
    {{"filtered", "Slices show Sv after the median filter, on which schools are grown."},
     {"weak", "How samples look that hardly rise above the background noise."}}};

PanelSection first_section(const char* title, const std::shared_ptr<ParameterSource>& source, Firsts firsts) {
  PanelSection section{title, source};
  for (const First& one : firsts) {
    section.names.emplace_back(one.name);
    section.notes.push_back({one.name, [sentence = one.sentence] { return std::string(sentence); }});
  }
  return section;
}

}  // namespace

double db_below_reference(double confidence, double tolerance_db) {
  return tolerance_db * std::sqrt(std::clamp(1.0 - confidence, 0.0, 1.0));
}

std::vector<PanelSection::Words> picture_words() {
  const ChoiceNames columns = chart_column_names();
  std::vector<std::string> names(columns.begin(), columns.end());
  PanelSection::Words x{"chart.x", names};
  names.insert(names.begin(), std::string{});
  return {std::move(x), {"chart.y", std::move(names)}};
}

std::vector<std::string> noise_steps_settings() {
  return {"noise-steps.slice", "noise-steps.before",  "noise-steps.after",
          "noise-steps.mark",  "noise-steps.mark_db", "noise-steps.difference_db"};
}

PanelSection colours_section(Workspace& workspace) {
  PanelSection colours =
      first_section("Colours", std::make_shared<SourceOf<DisplayParams>>(workspace.display), kColours);
  colours.looks = {{"scale.low_db", "", {-100.0, 0.0}},
                   {"scale.span_db", "", {6.0, 80.0}},
                   {"scale.threshold_db", "none", {-100.0, 0.0}}};
  return colours;
}

std::vector<PanelSection> control_panel(Workspace& workspace) {
  const auto display = std::make_shared<SourceOf<DisplayParams>>(workspace.display);
  const auto select = std::make_shared<SourceOf<SelectParams>>(workspace.select);
  const auto volume = std::make_shared<SourceOf<VolumeParams>>(workspace.volume);
  const auto pictures = std::make_shared<SourceOf<PictureFileParams>>(workspace.picture_file);
  const auto timelines = std::make_shared<SourceOf<TimelineLimits>>(workspace.timelines);
  const auto own_limits = [&workspace] { return workspace.timelines.values().own_limits; };
  const auto views = std::make_shared<SourceOf<ViewSwitches>>(workspace.views);
  const auto core = [&workspace] { return in_db(workspace, workspace.display.values().core_at); };
  const auto fuzzy = [&workspace] { return in_db(workspace, workspace.display.values().fuzzy_above); };
  const auto plane = std::make_shared<SourceOf<PlanePlace>>(workspace.plane);
  const auto lies = [&workspace] { return workspace.plane.values().lies; };
  const auto mode = [&workspace] { return workspace.select.values().mode; };
  const auto mode_is = [mode](bool paper) { return [mode, paper] { return (mode() == GrowMode::paper) == paper; }; };
  const auto curve_is = [&workspace](SchoolCurve one) {
    return [&workspace, one] { return workspace.picture_file.values().kind.curves.curve == one; };
  };
  PanelSection selection = first_section("Selection", select, kSelection);
  selection.uses = {{"tolerance_db", mode_is(false)}, {"margin_db", mode_is(false)}};
  PanelSection more{
      "More of selection", select, {"mode", "tolerance_opacity", "connectivity", "backwards", "forwards"}, {}, false};
  more.uses.push_back({"tolerance_opacity", mode_is(true)});
  return {
      std::move(selection),
      first_section("Schools", display, kSchools),
      colours_section(workspace),
      first_section("Noise", display, kNoise),
      std::move(more),
      {"More of schools",
       display,
       {"tint", "core_at", "fuzzy_above"},
       {{"core_at", core, select}, {"fuzzy_above", fuzzy, select}},
       false},
      {"More of noise",
       display,
       {"take_out.near_field", "take_out.surface", "take_out.corrupted_packets", "take_out.interference",
        "take_out.impulse_noise", "take_out.seabed", "removed", "weak_below_db"},
       {},
       false},
      {"Slices", display, {"shadow", "shadow_db", "grid_lines", "north_up"}, {}, false},
      {.title = "Plane slice",
       .source = plane,
       .open = false,
       .looks = {{"bearing_deg", "", {0.0, 360.0}}, {"tilt_deg", "", {1.0, 90.0}}},
       .uses = {{"depth_m", [lies] { return lies() == PlaneSlice::Kind::horizontal; }},
                {"bearing_deg", [lies] { return lies() != PlaneSlice::Kind::horizontal; }},
                {"tilt_deg", [lies] { return lies() == PlaneSlice::Kind::oblique; }},
                {"offset_m", [lies] { return lies() != PlaneSlice::Kind::horizontal; }}}},
      {"Volume", volume, {}, {}, false},
      {.title = "Timelines",
       .source = timelines,
       .open = false,
       .looks = {{"low_db", "", {-100.0, 0.0}}, {"span_db", "", {6.0, 80.0}}},
       .uses = {{"low_db", own_limits}, {"span_db", own_limits}}},
      {.title = "Charts",
       .source = pictures,
       .names = {"chart.table", "chart.x", "chart.y", "chart.bins"},
       .open = false,
       .words = picture_words()},
      {.title = "Schools over frequency",
       .source = pictures,
       .names = {"frequency.one_ping", "frequency.water"},
       .open = false},
      {.title = "Curves of schools",
       .source = pictures,
       .names = {"curves.curve", "curves.one_ping", "curves.over"},
       .open = false,
       .uses = {{"curves.one_ping", curve_is(SchoolCurve::distribution)},
                {"curves.over", curve_is(SchoolCurve::avoidance)}}},
      {.title = "Noise steps", .source = pictures, .names = noise_steps_settings(), .open = false},
      {"Views", views, {}, {}, false},
  };
}

}  // namespace sonar
