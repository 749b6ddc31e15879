// SPDX-License-Identifier: Apache-2.0
#include "session/app_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "session/app_parts.h"
#include "session/numbers/fish_biomass.h"
#include "session/open/recent_surveys.h"

namespace sonar {
namespace {

/// A survey begins where its user left it, and notices name the keys that are in force.
DocumentOptions of_user(DocumentOptions options, const Preferences& preferences, const Actions& actions) {
  options.left_at = [&preferences](const auto& named) { return preferences.left_at_of(named); };
  options.with_keys = [&actions](std::string_view text) { return actions.with_keys(text); };
  return options;
}

}  // namespace

AppModel::AppModel(ChangeQueue& queue, DocumentOptions options)
    : workspace(queue, of_user(std::move(options), preferences, actions)),
      thumbnails(std::make_shared<KeptThumbnails>(*this)),
      transfer(std::make_unique<TransferEditor>(workspace)),
      panel(control_panel(workspace)) {
  add_slices(*this);
  add_volume(*this);
  add_maps(*this);
  add_transects(*this);
  add_charts(*this);
  add_noise_steps(*this);
  add_lists(*this);
  add_school_acts(*this);
  add_numbers(*this);
  add_exports(*this);
  add_window_preferences(*this);
  add_window_acts(*this);
}

AppModel::~AppModel() = default;

LivePicture* AppModel::picture(const std::string& id) {
  const auto found =
      std::find_if(pictures.begin(), pictures.end(), [&](const PictureDock& dock) { return dock.id == id; });
  return found == pictures.end() ? nullptr : found->picture.get();
}

Rows* AppModel::rows(const std::string& id) {
  const auto found = std::find_if(lists.begin(), lists.end(), [&](const RowsDock& dock) { return dock.id == id; });
  return found == lists.end() ? nullptr : found->rows.get();
}

std::string idle_text(const AppModel& app, const std::string& dock) {
  const Document& document = app.workspace.document;
  const bool has_figures =
      document.survey() != nullptr && (document.nothing_shown().empty() || !document.survey()->raw_gone.empty());
  if (has_figures && dock == "chart") {
    return "A chart of schools' figures stands here as soon as schools are measured.";
  }
  if (document.survey() != nullptr && dock == "frequency" && document.nothing_shown().empty()) {
    return "Select a school: its mean Sv stands here, fan by fan, over the fans' frequencies.";
  }
  if (document.survey() != nullptr && dock == "curves" && document.nothing_shown().empty()) {
    return "Select a school: how its Sv is distributed stands here, or its size over the tolerance that it grows with.";
  }
  if (document.survey() != nullptr && dock == "lineage" && document.nothing_shown().empty()) {
    return "Schools stand here over time, a lane each, as soon as there are some.";
  }
  if (document.survey() != nullptr) return document.nothing_shown();
  const Progress& now = document.progress();
  if (dock == "top_slice" && !now.stage.empty()) {
    const std::string words =
        now.stage == "simulate" ? "Making the simulated survey" : "Reading the survey: " + now.stage;
    const auto percent = now.total > 0 ? fmt::format(", {} %", 100 * now.done / now.total) : std::string{};
    const std::string glanced = document.glance() ? "\nThe list and the survey map show what the files' ends tell;\n"
                                                    "a double-click in the list opens a part alone."
                                                  : "";
    return words + percent + ".\nEsc, or Cancel below, stops it." + glanced;
  }
  if (dock != "top_slice") return "";
  return app.actions.with_keys(
      "Open a survey ([file.open_folder]), or drop a folder of raw files, or of results, here.\n"
      "File > Demo survey opens a simulated one.\n\n"
      "Simrad MS70: schools are detected, followed and measured.\n"
      "ME70 and similar sonars: the same where the beams form fans.\n"
      "EK60: shown as an echogram; schools are not detected in single beams yet.\n"
      "EK80: named, but not read yet.");
}

}  // namespace sonar
