// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <set>
#include <system_error>
#include <tuple>

#include "io/file_ends.h"
#include "io/recordings.h"
#include "pipeline/survey/observations.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

Result<void> list_folder(const fs::path& folder, std::vector<fs::path>& files) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (it->is_directory(ignored)) continue;
    if (is_named_recording(it->path())) found.push_back(it->path());
  }
  if (error) return fail(ErrorCode::io, error.message(), {.file = folder.string()});
  std::sort(found.begin(), found.end());
  files.insert(files.end(), found.begin(), found.end());
  return {};
}

std::tuple<bool, TimeNs, std::string, std::string> file_order(const SurveyFile& file) {
  const bool empty = file.index.pings.empty();
  return {empty, empty ? 0 : file.index.pings.front().time, file.path.filename().string(), file.path.string()};
}

bool leads_nowhere(const fs::path& path) {
  std::error_code error;
  (void)fs::status(path, error);
  return error == std::errc::too_many_symbolic_link_levels || error == std::errc::filename_too_long;
}

/// What a folder lists and can lead to no file, ever (a loop of links, too long a path), is left out with a note. A link
/// whose file is not there is an error like a file that cannot be read.
Diagnostics take_out_links(std::vector<SurveyFile>& files) {
  Diagnostics notes;
  std::erase_if(files, [&](const SurveyFile& file) {
    if (!file.error || !leads_nowhere(file.path)) return false;
    notes.push_back({DiagnosticCode::unreadable, file.path.string(), -1, -1, "is skipped: " + file.error->text});
    return true;
  });
  return notes;
}

}  // namespace

const ObservationFiles* SurveyFiles::find(std::string_view observation) const {
  const auto it = std::find_if(observations.begin(), observations.end(),
                               [&](const ObservationFiles& o) { return o.name == observation; });
  return it == observations.end() ? nullptr : &*it;
}

std::vector<SurveyPing> SurveyFiles::parts(const SurveyPing& ping) const {
  std::vector<SurveyPing> all{ping};
  if (const auto more = further_parts.find(ping); more != further_parts.end()) {
    all.insert(all.end(), more->second.begin(), more->second.end());
  }
  return all;
}

std::vector<InputFile> input_files(const SurveyFiles& survey, const ObservationFiles& observation) {
  std::vector<InputFile> files;
  for (const std::uint32_t f : observation.files) {
    const SurveyFile& file = survey.files[f];
    files.push_back({file.path.filename().string(), file.index.size, file.index.hash});
  }
  return files;
}

Result<std::vector<fs::path>> list_survey(std::span<const fs::path> paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) {
      return fail(ErrorCode::not_found, "no such file or folder", {.file = path.string()});
    }
    if (leads_nowhere(path)) return fail(ErrorCode::not_found, error.message(), {.file = path.string()});
    if (fs::is_directory(status)) {
      if (auto listed = list_folder(path, files); !listed) return pass_on(listed);
    } else {
      files.push_back(path);
    }
  }
  std::set<fs::path> seen;
  std::erase_if(files, [&](const fs::path& path) { return !seen.insert(path.lexically_normal()).second; });
  return files;
}

Result<void> require_files(const SurveyFiles& survey, std::span<const fs::path> paths) {
  if (!survey.files.empty() || paths.empty()) return {};
  return fail(ErrorCode::not_found, "holds no raw files (*.raw)", {paths.front().string()});
}

namespace {

Result<void> check_params(const SurveyParams& survey, const NavigationParams& navigation) {
  if (auto valid = validate(survey); !valid) return valid;
  if (auto valid = check_sound_speed(survey.sound_speed_mps); !valid) return valid;
  if (auto valid = check_profile(survey.sound_speed_profile); !valid) return valid;
  if (survey.bend_rays && survey.sound_speed_profile.empty()) {
    return fail(ErrorCode::bad_parameter,
                "survey.bend_rays: rays bend in a sound_speed_profile, and the recipe has none");
  }
  return validate(navigation);
}

/// Leaves out the pings before the first of those that are looked at; none where that is not there.
void begin_at(const SurveyFiles& survey, const SequenceStart& start, SounderSequence& sequence) {
  if (start.observations == 0) return;
  const auto first = std::find_if(sequence.pings.begin(), sequence.pings.end(), [&](const SurveyPing& ping) {
    return ping.entry == start.entry && survey.files[ping.file].path == start.file;
  });
  if (first != sequence.pings.end()) sequence.pings.erase(sequence.pings.begin(), first);
}

/// What is missing in a run of files of which only the ends are known nobody can tell, nor what its number will be.
void rename_by_file(const SurveyFiles& survey, ObservationFiles& observation) {
  observation.name = survey.files[observation.files.front()].path.stem().string();
  observation.diagnostics.clear();
  observation.cut_notes = 0;
}

/// survey  its files; observations are made of them
void arrange(SurveyFiles& survey, const SurveyParams& params, const NavigationParams& navigation,
             const SequenceStarts& starts = {}) {
  std::sort(survey.files.begin(), survey.files.end(),
            [](const SurveyFile& a, const SurveyFile& b) { return file_order(a) < file_order(b); });
  for (const SurveyFile& file : survey.files) {
    if (!file.error) continue;
    survey.diagnostics.push_back(
        {DiagnosticCode::unreadable, file.index.name, file.error->where.offset, -1, file.error->text});
  }
  std::size_t number = 0;
  for (SounderSequence& sequence : sequences_of(survey)) {
    const auto start = starts.find(sequence.sounder);
    const SequenceStart first = start == starts.end() ? SequenceStart{} : start->second;
    begin_at(survey, first, sequence);
    number += first.observations;
    auto cut = cut_sequence(survey, sequence, params);
    if (!cut.empty() && first.observations > 0) {
      cut.front().continues_cut = first.continues_cut;
      cut.front().cut_after = first.cut_after;
      cut.front().diagnostics = first.notes;
      cut.front().cut_notes = first.notes.size();
    }
    std::stable_sort(cut.begin(), cut.end(), [&](const ObservationFiles& a, const ObservationFiles& b) {
      return survey.ping_time(a, 0) < survey.ping_time(b, 0);
    });
    for (ObservationFiles& observation : cut) {
      observation.name = fmt::format("obs-{:04}", ++number);
      complete_observation(survey, observation, params, navigation);
      if (survey.from_ends) rename_by_file(survey, observation);
      survey.observations.push_back(std::move(observation));
    }
  }
}

}  // namespace

SurveyFiles arrange_survey(std::vector<SurveyFile> files, const SurveyParams& params,
                           const NavigationParams& navigation, const SequenceStarts& starts) {
  SurveyFiles survey;
  survey.files = std::move(files);
  arrange(survey, params, navigation, starts);
  return survey;
}

namespace {

/// A survey whose files are known as index_of() knows them.
Result<SurveyFiles> survey_of(std::span<const fs::path> paths, const SurveyParams& params,
                              const NavigationParams& navigation, bool from_ends, Work& work,
                              const std::function<Result<RawIndex>(const fs::path&)>& index_of) {
  if (auto valid = check_params(params, navigation); !valid) return pass_on(valid);
  const auto listed = list_survey(paths);
  if (!listed) return pass_on(listed);
  SurveyFiles survey;
  survey.from_ends = from_ends;
  survey.files.resize(listed->size());
  std::atomic<std::int64_t> done{0};
  SharedSettings settings;
  work.for_each(static_cast<std::int64_t>(survey.files.size()), [&](std::int64_t i) {
    SurveyFile& file = survey.files[static_cast<std::size_t>(i)];
    file.path = (*listed)[static_cast<std::size_t>(i)];
    file.index.name = file.path.string();
    auto index = index_of(file.path);
    if (index) {
      settings.share(*index);
      file.index = std::move(*index);
    } else {
      file.error = index.error();
    }
    work.progress(from_ends ? "looking at the files' ends" : "indexing", ++done, std::ssize(survey.files));
  });
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped while indexing");
  survey.diagnostics = take_out_links(survey.files);
  arrange(survey, params, navigation);
  return survey;
}

}  // namespace

Result<SurveyFiles> open_survey(std::span<const fs::path> paths, const SurveyParams& survey,
                                const NavigationParams& navigation, const IndexCache& cache, Work& work) {
  return survey_of(paths, survey, navigation, false, work,
                   [&](const fs::path& path) { return open_index(path, cache, work); });
}

Result<SurveyFiles> glance_at_survey(std::span<const fs::path> paths, const SurveyParams& survey,
                                     const NavigationParams& navigation, Work& work) {
  return survey_of(paths, survey, navigation, true, work, [&](const fs::path& path) -> Result<RawIndex> {
    const auto bytes = open_file(path);
    if (!bytes) return pass_on(bytes);
    return index_ends(*stoppable(*bytes, work));
  });
}

namespace {

/// Links followed as far as they lead; a loop of links, or a path that is too long, as it is written.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  if (error) return path;
  fs::path followed = fs::weakly_canonical(whole, error);
  return error ? whole.lexically_normal() : followed;
}

}  // namespace

Result<void> require_outside_raw(std::span<const std::filesystem::path> raw, const std::filesystem::path& folder) {
  std::error_code error;
  const fs::path there = resolved(folder.empty() ? "." : folder);
  for (const fs::path& path : raw) {
    // A folder that is gone is still taken for one.
    const bool file = fs::exists(fs::symlink_status(path, error)) && !fs::is_directory(path, error);
    const fs::path where = resolved(file ? fs::absolute(path, error).parent_path() : path);
    if (std::mismatch(where.begin(), where.end(), there.begin(), there.end()).first == where.end()) {
      return fail(ErrorCode::usage, "lies in the folder of the raw files, where nothing is ever written",
                  {folder.string()});
    }
  }
  return {};
}

Result<void> require_outside_raw(const SurveyFiles& survey, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const SurveyFile& file : survey.files) paths.push_back(file.path);
  return require_outside_raw(paths, folder);
}

Result<void> require_not_beneath_raw(const std::filesystem::path& folder) {
  fs::path above = resolved(folder).parent_path();
  for (;; above = above.parent_path()) {
    if (holds_recordings(above)) {
      return fail(ErrorCode::usage,
                  fmt::format("lies beneath the raw files of {}, where nothing is ever written", above.string()),
                  {folder.string()});
    }
    if (above == above.root_path() || above.empty()) return {};
  }
}

}  // namespace sonar
