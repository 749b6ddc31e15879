// SPDX-License-Identifier: Apache-2.0
#include "session/control_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonar {
namespace {

std::string in_db(const Workspace& workspace, double confidence) {
  const SelectParams& select = workspace.select.values();
  if (select.mode == GrowMode::paper) return "in units of opacity: 1 = as opaque as the seed";
  return fmt::format("{:.1f} dB below the reference", db_below_reference(confidence, select.tolerance_db));
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

std::vector<PanelSection> control_panel(Workspace& workspace) {
  const auto display = std::make_shared<SourceOf<DisplayParams>>(workspace.display);
  const auto select = std::make_shared<SourceOf<SelectParams>>(workspace.select);
  const auto volume = std::make_shared<SourceOf<VolumeParams>>(workspace.volume);
  const auto pictures = std::make_shared<SourceOf<PictureFileParams>>(workspace.picture_file);
  const auto views = std::make_shared<SourceOf<ViewSwitches>>(workspace.views);
  const auto core = [&workspace] { return in_db(workspace, workspace.display.values().core_at); };
  const auto fuzzy = [&workspace] { return in_db(workspace, workspace.display.values().fuzzy_above); };
  const auto plane = std::make_shared<SourceOf<PlanePlace>>(workspace.plane);
  const auto lies = [&workspace] { return workspace.plane.values().lies; };
  const auto mode = [&workspace] { return workspace.select.values().mode; };
  return {
      {"Selection",
       select,
       {},
       {},
       true,
       {},
       {{"tolerance_db", [mode] { return mode() != GrowMode::paper; }},
        {"margin_db", [mode] { return mode() != GrowMode::paper; }},
        {"tolerance_opacity", [mode] { return mode() == GrowMode::paper; }}}},
      {"Schools",
       display,
       {"masks", "tint", "core_at", "fuzzy_above", "rejected", "refused_echoes"},
       {{"core_at", core, select}, {"fuzzy_above", fuzzy, select}}},
      {"Colours",
       display,
       {"scale.map", "scale.low_db", "scale.span_db", "scale.threshold_db"},
       {},
       true,
       {{"scale.low_db", "", {-100.0, 0.0}},
        {"scale.span_db", "", {6.0, 80.0}},
        {"scale.threshold_db", "none", {-100.0, 0.0}}}},
      {"Noise",
       display,
       {"filtered", "take_out.near_field", "take_out.surface", "take_out.corrupted_packets", "take_out.interference",
        "take_out.impulse_noise", "take_out.seabed", "removed", "weak", "weak_below_db"}},
      {"Slices", display, {"grid_lines", "north_up"}, {}, false},
      {"Plane slice",
       plane,
       {},
       {},
       false,
       {{"bearing_deg", "", {0.0, 360.0}}, {"tilt_deg", "", {1.0, 90.0}}},
       {{"depth_m", [lies] { return lies() == PlaneSlice::Kind::horizontal; }},
        {"bearing_deg", [lies] { return lies() != PlaneSlice::Kind::horizontal; }},
        {"tilt_deg", [lies] { return lies() == PlaneSlice::Kind::oblique; }},
        {"offset_m", [lies] { return lies() != PlaneSlice::Kind::horizontal; }}}},
      {"Volume", volume, {}, {}, false},
      {"Charts", pictures, {"chart.table", "chart.x", "chart.y", "chart.bins"}, {}, false, {}, {}, picture_words()},
      {"Views", views, {}, {}, false},
  };
}

}  // namespace sonar
