// SPDX-License-Identifier: Apache-2.0
#include "session/marks/marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <variant>

#include "publish/picture_output.h"
#include "session/marks/bookmarked_view.h"
#include "session/open/survey_schools.h"
#include "session/open/thumbnails.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

std::int64_t ping_from(const OpenObservation& observation, TimeNs time) {
  const auto& times = observation.context().times;
  const auto at = std::lower_bound(times.begin(), times.end(), time) - times.begin();
  return std::clamp<std::int64_t>(at, 0, std::max<std::int64_t>(0, observation.pings() - 1));
}

std::int64_t ping_until(const OpenObservation& observation, TimeNs time) {
  const auto& times = observation.context().times;
  const auto after = std::upper_bound(times.begin(), times.end(), time) - times.begin();
  return std::clamp<std::int64_t>(after - 1, 0, std::max<std::int64_t>(0, observation.pings() - 1));
}

fs::path file_of(const Document& document, const EventCommand& bookmark) {
  return thumbnail_file(document.options().cache.folder, document.named(),
                        fmt::format("{} {} {}", bookmark.time, bookmark.text, bookmark.view));
}

}  // namespace

std::vector<SurveyMark> survey_marks(const Document& document) {
  std::vector<SurveyMark> marks;
  for (const auto& [index, state] : document.choices().states) {
    const OpenObservationPtr open = document.open_observation(index);
    if (!open || !state) continue;
    for (const EventCommand& event : state->events) {
      const std::int64_t ping = ping_from(*open, event.time);
      marks.push_back({{index, event}, open, ping, ping});
    }
    for (const BadPingsCommand& bad : state->bad_pings) {
      marks.push_back({{index, bad}, open, ping_from(*open, bad.first), ping_until(*open, bad.last)});
    }
  }
  std::ranges::stable_sort(marks, {},
                           [](const SurveyMark& one) { return std::pair(one.mark.observation, one.first_ping); });
  return marks;
}

void go_to_mark(Workspace& workspace, const SurveyMark& mark) {
  const SurveyMark there = mark;  // what follows may make the marks anew
  go_to_ping(workspace, there.mark.observation, there.first_ping);
  const auto* event = std::get_if<EventCommand>(&there.mark.what);
  const auto view = event == nullptr || event->view.empty() ? std::nullopt : bookmarked_view(event->view);
  const auto& shown = workspace.document.shown();
  if (view && shown && shown->index() == there.mark.observation) look_again(workspace, *view);
  workspace.mark.set(there.mark);
}

void keep_thumbnail(AppModel& app, const EventCommand& bookmark) {
  const std::string in_use = app.dialogs.view_in_use ? app.dialogs.view_in_use() : std::string{};
  const LivePicture* picture = app.picture(in_use);
  if (picture == nullptr || picture->image().pixels.empty()) picture = app.picture("top_slice");
  const fs::path file = file_of(app.workspace.document, bookmark);
  if (file.empty() || picture == nullptr || picture->image().pixels.empty()) return;
  (void)write_pixels(reduced(picture->image(), kThumbnail), file);
}

fs::path thumbnail_of(const Document& document, const EventCommand& bookmark) {
  const fs::path file = file_of(document, bookmark);
  std::error_code absent;
  return !file.empty() && fs::is_regular_file(file, absent) ? file : fs::path{};
}

}  // namespace sonar
