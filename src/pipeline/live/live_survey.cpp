// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live/live_survey.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

namespace sonar {
namespace {

namespace fs = std::filesystem;
using std::chrono::duration_cast;

/// A recorder writes on within this time, or has begun another file.
constexpr std::chrono::seconds kStillWriting{2};

LiveClock::duration gap_of(const SurveyParams& params) {
  return duration_cast<LiveClock::duration>(std::chrono::duration<double>(params.observation_gap_s));
}

bool holds(const RawIndex& index, const Sounder& sounder) {
  return std::any_of(index.configs.begin(), index.configs.end(),
                     [&](const SounderConfig& config) { return sounder_of(config) == sounder; });
}

bool same_sounder(const RawIndex& a, const RawIndex& b) {
  return std::any_of(a.configs.begin(), a.configs.end(),
                     [&](const SounderConfig& config) { return holds(b, sounder_of(config)); });
}

}  // namespace

LiveSurvey::LiveSurvey(std::vector<fs::path> paths, const SurveyParams& params, const NavigationParams& navigation,
                       IndexCache cache)
    : paths_(std::move(paths)), params_(params), navigation_(navigation), cache_(std::move(cache)) {}

Result<LiveSurvey::News> LiveSurvey::look(LiveClock::time_point now, Work& work) {
  News news;
  ++looks_;
  if (grew_at_ == LiveClock::time_point{}) grew_at_ = now;
  list(now, news, work);
  for (auto& [path, file] : files_) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    read(file, now, news);
  }
  if (news.bytes > 0 || news.cannot) grew_at_ = now;  // whether it grows meanwhile nobody knows
  finish_files(now, news);
  if (news.pings > 0 || news.changed) {
    news.changed = true;
    arrange();
    drop_late(news);
  }
  return news;
}

/// A file that has not been written to for longer than a gap is whole: its index may be known.
void LiveSurvey::take_whole(File& file, News& news, Work& work) {
  std::error_code unknown;
  const auto changed = fs::last_write_time(file.path, unknown);
  if (unknown || fs::file_time_type::clock::now() - changed <= gap_of(params_)) return;
  auto index = open_index(file.path, cache_, work);
  if (!index) return;
  file.size = index->size;
  news.bytes += index->size;
  news.pings += index->pings.size();
  file.pings = ping_source(file.bytes, std::move(*index));
}

void LiveSurvey::list(LiveClock::time_point now, News& news, Work& work) {
  const auto listed = list_survey(paths_);
  if (!listed) {
    news.cannot = listed.error();
    return;
  }
  drop_vanished(*listed, news);
  for (const fs::path& path : *listed) {
    if (files_.contains(path) || let_go_.contains(path)) continue;
    File& file = files_[path];
    file.path = path;
    file.bytes = growing_file(path);
    file.appeared = looks_;
    file.grew_at = now;
    file.pings = ping_source(file.bytes);
    take_whole(file, news, work);
    news.changed = true;
    if (work.cancelled()) return;
  }
}

/// What somebody removed, or gave another name. Where nothing is left the disk is gone, not its files.
void LiveSurvey::drop_vanished(const std::vector<fs::path>& listed, News& news) {
  const auto gone = [&](const auto& entry) {
    return std::find(listed.begin(), listed.end(), entry.first) == listed.end();
  };
  if (files_.empty() || std::none_of(files_.begin(), files_.end(), gone)) return;
  if (std::all_of(files_.begin(), files_.end(), gone)) {
    news.cannot = Error{ErrorCode::not_found, "none of its files is there any more", {.file = paths_.front().string()}};
    return;
  }
  std::erase_if(files_, gone);
  news.changed = news.replaced = true;
}

/// A file whose pings lie before what is looked at: only a run over all can place them.
void LiveSurvey::drop_late(News& news) {
  if (starts_.empty()) return;
  std::set<fs::path> in_use;
  for (const ObservationFiles& observation : survey_->observations) {
    for (const std::uint32_t f : observation.files) in_use.insert(survey_->files[f].path);
  }
  std::erase_if(files_, [&](const auto& entry) {
    const auto& [path, file] = entry;
    if (file.pings->count() == 0 || in_use.contains(path)) return false;
    news.cannot =
        Error{ErrorCode::mismatch,
              "its pings lie before what is followed by now, or are another file's: a run over all will place them",
              {.file = path.string()}};
    let_go_.insert(path);
    return true;
  });
}

void LiveSurvey::read(File& file, LiveClock::time_point now, News& news) {
  const auto size = file.bytes->size();
  if (!size && size.error().code == ErrorCode::mismatch) {
    // Another file of that name: nothing that was known of the one before holds.
    file.bytes = growing_file(file.path);
    file.pings = ping_source(file.bytes);
    file.size = 0;
    news.changed = news.replaced = true;
    return read(file, now, news);
  }
  const bool was_there = !file.error;
  file.error.reset();
  if (!size) {
    file.error = size.error();
  } else if (*size != file.size) {
    if (file.pings->final()) file.pings = ping_source(file.bytes);  // it went on after all
    const auto fresh = file.pings->refresh();
    if (!fresh) {
      file.error = fresh.error();
    } else {
      news.pings += *fresh;
      news.bytes += *size - file.size;
      file.size = *size;
      file.grew_at = now;
    }
  }
  if (file.error) {
    file.grew_at = now;  // whether it grows meanwhile nobody knows
    news.cannot = file.error;
  }
  news.changed = news.changed || was_there == file.error.has_value();
}

bool LiveSurvey::is_succeeded(const File& file) const {
  const RawIndex& own = file.pings->index();
  return std::any_of(files_.begin(), files_.end(), [&](const auto& entry) {
    const RawIndex& other = entry.second.pings->index();
    const bool later = entry.second.appeared != file.appeared ? entry.second.appeared > file.appeared
                                                              : other.first_datagram_time > own.last_datagram_time;
    return &entry.second != &file && later && same_sounder(own, other);
  });
}

void LiveSurvey::finish_files(LiveClock::time_point now, News& news) {
  for (auto& [path, file] : files_) {
    if (file.error || file.pings->final()) continue;
    const auto quiet = now - file.grew_at;
    const bool over = ended_ || quiet > std::max<LiveClock::duration>(gap_of(params_), kStillWriting) ||
                      (quiet >= kStillWriting && is_succeeded(file));
    if (!over) continue;
    const std::size_t before = file.pings->count();
    if (auto done = file.pings->finish(); !done) {
      file.error = done.error();
      news.cannot = file.error;
      file.pings = ping_source(file.bytes);
      file.size = 0;  // from its first byte, when it can be read again
    } else {
      keep_index(path, cache_, file.pings->index());
    }
    news.pings += file.pings->count() - std::min(before, file.pings->count());
    news.changed = true;
  }
}

void LiveSurvey::arrange() {
  std::vector<SurveyFile> files;
  for (const auto& [path, file] : files_) {
    SurveyFile known{file.path, file.pings->index(), {}};
    known.index.name = file.path.string();
    if (known.index.pings.empty()) known.error = file.error;
    files.push_back(std::move(known));
  }
  survey_ = std::make_shared<const SurveyFiles>(arrange_survey(std::move(files), params_, navigation_, starts_));
}

bool LiveSurvey::over(const ObservationFiles& observation) const {
  const bool all_final = std::all_of(observation.files.begin(), observation.files.end(),
                                     [&](std::uint32_t f) { return files_.at(survey_->files[f].path).pings->final(); });
  if (!all_final) return false;
  const auto any_later = [&](const ObservationFiles& other) {
    return sounder_of(other.config) == sounder_of(observation.config) && &other > &observation;
  };
  const bool others_final = std::all_of(files_.begin(), files_.end(), [&](const auto& entry) {
    const File& file = entry.second;
    const RawIndex& index = file.pings->index();
    const bool of_others = !index.configs.empty() && !holds(index, sounder_of(observation.config));
    return file.pings->final() || of_others || (file.error && file.pings->count() == 0);
  });
  return others_final || std::any_of(survey_->observations.begin(), survey_->observations.end(), any_later);
}

void LiveSurvey::let_go_before(const std::string& observation) {
  const ObservationFiles* kept = survey_->find(observation);
  if (kept == nullptr || !survey_->further_parts.empty()) return;
  const Sounder sounder = sounder_of(kept->config);
  SequenceStart start;
  start.file = survey_->files[kept->pings.front().file].path;
  start.entry = kept->pings.front().entry;
  start.continues_cut = kept->continues_cut;
  start.cut_after = kept->cut_after;
  start.notes.assign(kept->diagnostics.begin(),
                     kept->diagnostics.begin() + static_cast<std::ptrdiff_t>(kept->cut_notes));
  std::set<fs::path> in_use;
  start.observations = starts_[sounder].observations;
  for (const ObservationFiles& other : survey_->observations) {
    const bool before = sounder_of(other.config) == sounder && &other < kept;
    if (before) ++start.observations;
    if (before) continue;
    for (const std::uint32_t f : other.files) in_use.insert(survey_->files[f].path);
  }
  if (start.observations == starts_[sounder].observations) return;
  starts_[sounder] = std::move(start);
  std::erase_if(files_, [&](const auto& entry) {
    const bool done = entry.second.pings->final() && entry.second.pings->count() > 0 && !in_use.contains(entry.first);
    if (done) let_go_.insert(entry.first);
    return done;
  });
  arrange();
}

}  // namespace sonar
