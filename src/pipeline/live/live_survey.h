// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "io/index_cache.h"
#include "io/ping_source.h"
#include "pipeline/survey/survey.h"

namespace sonar {

using LiveClock = std::chrono::steady_clock;

/// A survey that is being recorded: looked at again and again, it is made anew of what its files hold so far. Nothing is
/// locked or written where they lie, and they may be gone for a while. Files whose observations are over are let go, so that
/// what is held and worked on does not grow with the days.
/// threads  one
class LiveSurvey {
 public:
  /// paths  as of open_survey(): folders in which files appear, or files
  /// cache  where indexes of files are kept that are final
  LiveSurvey(std::vector<std::filesystem::path> paths, const SurveyParams& params, const NavigationParams& navigation,
             IndexCache cache);

  struct News {
    std::size_t pings = 0;        ///< published since the last look
    std::uint64_t bytes = 0;      ///< written since
    bool changed = false;         ///< survey() is another
    bool replaced = false;        ///< a file is another one of the same name: what was worked out of its pings is void
    std::optional<Error> cannot;  ///< why some of it cannot be read now; what is known stays
  };
  /// Takes in what was written since the last look.
  /// now     rises from look to look
  /// errors  cancelled; bad_parameter
  [[nodiscard]] Result<News> look(LiveClock::time_point now, Work& work);
  /// Nothing more will come: every file is final at the next look.
  void end() { ended_ = true; }

  /// What is known, without the observations that were let go; their number stands before the names of those that are here.
  [[nodiscard]] std::shared_ptr<const SurveyFiles> survey() const { return survey_; }
  /// Whether nothing more will come to an observation of survey(): all its files are final, and another one of its sounder has
  /// begun, or no file of it, or of a sounder not known yet, is being written.
  [[nodiscard]] bool over(const ObservationFiles& observation) const;
  /// Lets go of the files of observations before the one named: they are over, and their products are kept.
  void let_go_before(const std::string& observation);

  /// Since when nothing was written.
  [[nodiscard]] LiveClock::duration quiet(LiveClock::time_point now) const { return now - grew_at_; }

 private:
  struct File {
    std::filesystem::path path;
    std::shared_ptr<const ByteSource> bytes;
    std::unique_ptr<PingSource> pings;
    std::uint64_t size = 0;
    std::int64_t appeared = 0;  ///< at which look
    LiveClock::time_point grew_at;
    std::optional<Error> error;
  };
  void list(LiveClock::time_point now, News& news, Work& work);
  void take_whole(File& file, News& news, Work& work);
  void read(File& file, LiveClock::time_point now, News& news);
  void finish_files(LiveClock::time_point now, News& news);
  [[nodiscard]] bool is_succeeded(const File& file) const;
  void drop_vanished(const std::vector<std::filesystem::path>& listed, News& news);
  void drop_late(News& news);
  void arrange();

  std::vector<std::filesystem::path> paths_;
  SurveyParams params_;
  NavigationParams navigation_;
  IndexCache cache_;
  std::map<std::filesystem::path, File> files_;
  std::set<std::filesystem::path> let_go_;  ///< files that are done with
  SequenceStarts starts_;
  bool ended_ = false;
  std::int64_t looks_ = 0;
  LiveClock::time_point grew_at_;
  std::shared_ptr<const SurveyFiles> survey_ = std::make_shared<SurveyFiles>();
};

}  // namespace sonar
