// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "session/app_model.h"
#include "session/listening.h"
#include "session/open/thumbnails.h"

namespace sonar {

/// A survey that was opened before, as a start page shows it.
struct RecentSurvey {
  std::string name;                 ///< of its folder or first file
  std::string place;                ///< where that lies, and how many more were opened with it
  std::filesystem::path thumbnail;  ///< a PNG of kThumbnail; empty = none
  bool there = true;                ///< it can be opened: its disk is here
};

/// In the order of Preferences::recent.
[[nodiscard]] std::vector<RecentSurvey> recent_surveys(const AppModel& app);

/// Keeps in the user's cache what a survey looked like when it was let go.
/// threads  the window's
class KeptThumbnails {
 public:
  /// Listens before the views do, which forget a survey that is gone. The app outlives it.
  explicit KeptThumbnails(AppModel& app);
  ~KeptThumbnails() { keep(); }
  KeptThumbnails(const KeptThumbnails&) = delete;
  KeptThumbnails& operator=(const KeptThumbnails&) = delete;

 private:
  void keep() const;

  AppModel& app_;
  std::vector<std::filesystem::path> of_;  ///< the survey on show, as it was named; empty = none
  Listening listening_;
};

}  // namespace sonar
