// SPDX-License-Identifier: Apache-2.0
#include "session/open/recent_surveys.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "publish/picture_output.h"
#include "session/open/thumbnails.h"

namespace sonar {

namespace fs = std::filesystem;

std::vector<RecentSurvey> recent_surveys(const AppModel& app) {
  std::vector<RecentSurvey> out;
  for (const std::vector<fs::path>& paths : app.preferences.recent) {
    std::error_code absent;
    const fs::path first = paths.front().has_filename() ? paths.front() : paths.front().parent_path();
    RecentSurvey& one = out.emplace_back();
    one.name = first.filename().string();
    one.place = first.parent_path().string();
    if (paths.size() > 1) one.place += fmt::format(", with {} more", paths.size() - 1);
    one.there = fs::exists(first, absent);
    const fs::path thumbnail = thumbnail_file(app.workspace.document.options().cache.folder, paths);
    if (!thumbnail.empty() && fs::is_regular_file(thumbnail, absent)) one.thumbnail = thumbnail;
  }
  return out;
}

KeptThumbnails::KeptThumbnails(AppModel& app) : app_(app) {
  listening_.to(app.workspace.document.changes(), [this](DocumentChange change) {
    if (change != DocumentChange::survey) return;
    keep();
    const Document& document = app_.workspace.document;
    of_ = document.survey() == nullptr ? std::vector<fs::path>{} : document.named();
  });
}

void KeptThumbnails::keep() const {
  const LivePicture* picture = app_.picture("top_slice");
  const fs::path file = of_.empty() ? fs::path{} : thumbnail_file(app_.workspace.document.options().cache.folder, of_);
  if (file.empty() || picture == nullptr || picture->image().pixels.empty()) return;
  (void)write_pixels(reduced(picture->image(), kThumbnail), file);
}

}  // namespace sonar
