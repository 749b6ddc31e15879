// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/named_surveys.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "io/recordings.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/plan.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// The folders in it that hold raw files, by name.
std::vector<fs::path> surveys_in(const fs::path& folder) {
  std::vector<fs::path> surveys;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code unknown;
    if (it->is_directory(unknown) && holds_recordings(it->path())) surveys.push_back(it->path());
  }
  std::sort(surveys.begin(), surveys.end());
  return surveys;
}

}  // namespace

Result<std::vector<NamedSurvey>> named_surveys(const std::vector<fs::path>& paths) {
  std::vector<NamedSurvey> named;
  NamedSurvey files;
  for (const fs::path& path : paths) {
    std::error_code absent;
    if (!fs::is_directory(path, absent)) {
      files.paths.push_back(path);
    } else if (fs::exists(path / "plan.json", absent)) {
      auto survey = planned_survey(path);
      if (!survey) return pass_on(survey);
      named.push_back({std::move(*survey), path});
    } else {
      const auto inside = holds_recordings(path) ? std::vector<fs::path>{} : surveys_in(path);
      // One without any is told to be so when it is run.
      if (inside.empty()) named.push_back({{path}, {}});
      for (const fs::path& survey : inside) named.push_back({{survey}, {}});
    }
  }
  if (!files.paths.empty()) named.push_back(std::move(files));
  return named;
}

std::string text_of(const std::vector<fs::path>& paths) {
  const std::string first = paths.front().string();
  return paths.size() == 1 ? first : fmt::format("{} and {} more", first, paths.size() - 1);
}

Result<RawSize> raw_size(std::span<const fs::path> paths) {
  const auto files = list_survey(paths);
  if (!files) return pass_on(files);
  RawSize size{files->size(), 0};
  for (const fs::path& file : *files) {
    std::error_code unknown;
    const auto bytes = fs::file_size(file, unknown);
    if (!unknown) size.bytes += bytes;
  }
  return size;
}

bool are_nested(const fs::path& a, const fs::path& b) {
  return !require_outside_raw(std::span(&a, 1), b) || !require_outside_raw(std::span(&b, 1), a);
}

}  // namespace sonar
