// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "session/actions.h"
#include "session/open/workspace.h"

namespace sonar {

struct LoadedPreferences;

/// Absolute, without dots and a slash at its end: one name for one place.
[[nodiscard]] std::filesystem::path whole_path(const std::filesystem::path& path);

/// A survey of the list of those to be run.
struct ListedSurvey {
  std::vector<std::filesystem::path> paths;
  std::filesystem::path out;  ///< where its results go; empty = nobody has said where yet
  friend bool operator==(const ListedSurvey&, const ListedSurvey&) = default;
};

/// Survey -> a file that was chosen for it, kept for the next time.
using FileOfSurvey = std::map<std::string, std::string>;
/// Empty = none.
[[nodiscard]] std::filesystem::path file_of(const FileOfSurvey& files, const std::filesystem::path& survey);
/// file  empty = no longer any
void set_file(FileOfSurvey& files, const std::filesystem::path& survey, const std::filesystem::path& file);

/// What a user wants of the window: never part of a result, never in a hash.
struct Preferences {
  static constexpr std::size_t kMostRecent = 10;
  static constexpr std::size_t kMostSpecies = 9;

  std::filesystem::path path;                              ///< empty = they are kept nowhere
  std::vector<std::vector<std::filesystem::path>> recent;  ///< what was opened, newest first
  std::vector<ListedSurvey> batch;                         ///< surveys to be run, in their order
  std::string window_layout;                               ///< whatever the window wrote, base64
  bool dark = false;
  DisplayParams display;
  SelectParams select;
  VolumeParams volume;
  TimelineLimits timelines;
  ViewSwitches views;
  PictureFileParams picture_file;
  ReduceParams reduce;
  IntegrateParams integrate;
  FishParams fish;                               ///< tables that were opened are not kept
  std::optional<TransferFunction> view_curve;    ///< that a human drew; empty = the scale's
  std::optional<TransferFunction> growth_curve;  ///< empty = the default
  bool curves_linked = false;
  FileOfSurvey charts;     ///< rasters of depths
  FileOfSurvey transects;  ///< their tables
  /// Survey -> observation and ping that it was left at.
  std::map<std::string, std::pair<std::string, std::int64_t>> left_at;
  std::string operator_name;
  WindowParams window;
  FigureParams figure;  ///< without its words, which are of one survey
  Actions::Keys keys;   ///< of actions that have not their usual ones
  std::vector<std::string> species{"herring", "mackerel", "capelin", "blue whiting", "sprat",
                                   "cod",     "saithe",   "krill",   "other"};  ///< digits 1 to 9
  bool advance = true;  ///< review goes on to the next school after a decision

  /// $XDG_CONFIG_HOME/sonar-explorer/preferences.json, else below ~/.config; empty where neither is known.
  [[nodiscard]] static std::filesystem::path path_of_user();
  /// A file that is not there is the defaults. Members that are unknown, of another type or out of range are passed over.
  [[nodiscard]] static LoadedPreferences load(const std::filesystem::path& path);
  /// Writes them whole or not at all.
  /// errors  io, no_space
  [[nodiscard]] Result<void> save() const;

  void apply(Workspace& workspace) const;
  void take(const Workspace& workspace);
  /// The raster of depths that was last chosen for a survey; empty = none.
  [[nodiscard]] std::filesystem::path chart_of(const std::filesystem::path& survey) const;
  void set_chart(const std::filesystem::path& survey, const std::filesystem::path& raster);
  [[nodiscard]] std::optional<std::pair<std::string, std::int64_t>> left_at_of(
      const std::vector<std::filesystem::path>& survey) const;
  void set_left_at(const std::vector<std::filesystem::path>& survey, const std::string& observation, std::int64_t ping);
  /// What was opened comes first among the recent.
  void remember(std::vector<std::filesystem::path> opened);

 private:
  void forget_a_place();
};

struct LoadedPreferences {
  Preferences preferences;
  std::string notice;  ///< what a user must be told: a damaged file, names of an earlier version; empty = nothing
};

/// SURVEY-out beside a survey, say; empty where the survey's folder has no name.
/// survey  a folder of raw files, or a raw file
/// ending  "-out"
[[nodiscard]] std::filesystem::path folder_beside(const std::filesystem::path& survey, const std::string& ending);

/// The same, or SURVEY-out-2 and so on: the first that is not taken. Empty where there is none, as beneath raw files.
[[nodiscard]] std::filesystem::path free_folder_beside(const std::filesystem::path& survey, const std::string& ending,
                                                       const std::function<bool(const std::filesystem::path&)>& taken);

/// Where the journal of a survey goes: SURVEY-work beside the survey, else a folder of the user's own. Never where raw
/// files lie.
/// survey  a folder of raw files, or a raw file
[[nodiscard]] std::vector<std::filesystem::path> journal_folders_for(const std::filesystem::path& survey);

}  // namespace sonar
