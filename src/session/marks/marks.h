// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "session/app_model.h"

namespace sonar {

inline constexpr std::string_view kBookmark = "bookmark";  ///< EventCommand::kind of one

/// A mark in the time of a survey: a trawl, a station, an event, a bookmark, or pings that take no part in measures.
struct SurveyMark {
  ChosenMark mark;
  OpenObservationPtr observation;
  std::int64_t first_ping = 0;
  std::int64_t last_ping = 0;
  friend bool operator==(const SurveyMark& a, const SurveyMark& b) { return a.mark == b.mark; }
};

/// Of all observations that are open, in the order of time.
[[nodiscard]] std::vector<SurveyMark> survey_marks(const Document& document);

/// Looks at its first ping, of a bookmark with the slices, the volume's side and the school as they were; it is chosen then,
/// so that Delete is about it.
void go_to_mark(Workspace& workspace, const SurveyMark& mark);

/// Keeps in the user's cache what a bookmark shows: the view in use, in small.
void keep_thumbnail(AppModel& app, const EventCommand& bookmark);
/// Empty where there is none, as on another machine.
[[nodiscard]] std::filesystem::path thumbnail_of(const Document& document, const EventCommand& bookmark);

}  // namespace sonar
