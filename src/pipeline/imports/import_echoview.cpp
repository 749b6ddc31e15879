// SPDX-License-Identifier: Apache-2.0
#include "pipeline/imports/import_echoview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "io/echoview_reader.h"
#include "io/echoview_text.h"

namespace sonar {
namespace {

/// What the format rounds times down to.
constexpr TimeNs kTickNs = 100'000;
/// What regions without a class are in.
constexpr std::array<std::string_view, 2> kNoClass{"Unclassified regions", kNoSpecies};

TimeNs rounded(TimeNs time) { return time - time % kTickNs; }

/// "obs-0001/3": what an export calls a region, which is no name of a school.
bool is_of_export(std::string_view name) {
  const std::size_t slash = name.rfind('/');
  const bool numbered = slash != std::string_view::npos && slash + 1 < name.size();
  return numbered && name.find_first_not_of("0123456789", slash + 1) == std::string_view::npos;
}

/// Pings of an observation, from the first to before the end.
struct PingSpan {
  std::int64_t first = 0;
  std::int64_t end = 0;
  [[nodiscard]] bool empty() const { return first >= end; }
};

/// Those that a region lies over.
PingSpan pings_in(const ObservationFiles& observation, const EchoviewRegion& region) {
  const auto [first, last] = std::ranges::minmax(region.corners, {}, &EchoviewCorner::time);
  const auto at = [&](TimeNs time) {
    return std::ranges::lower_bound(observation.navigation, time, {}, &PingNavigation::time) -
           observation.navigation.begin();
  };
  return {at(first.time), at(last.time + kTickNs)};
}

/// Samples from the first to before the end.
struct SampleSpan {
  int first = 0;
  int end = 0;
};
SampleSpan samples_in(const DepthSpan& depths, const RangeAxis& range, int count) {
  const auto cut = [&](double sample) { return static_cast<int>(std::clamp(sample, 0.0, static_cast<double>(count))); };
  return {cut(std::ceil(range.sample_at(depths.first_m))), cut(std::floor(range.sample_at(depths.last_m)) + 1.0)};
}

/// One region in one observation.
class RegionCells {
 public:
  /// errors  usage, format
  static Result<RegionCells> of(const EchoviewRegion& region, const EchoviewCells& told,
                                const ObservationFiles& observation, const ImportPlace& place) {
    RegionCells cells(region, told, observation);
    const BeamGrid& grid = *observation.grid;
    if (!told.fan && !place.fan) return fail(ErrorCode::usage, "its notes name no fan; name it with --fan");
    cells.fan_ = told.fan ? *told.fan : *place.fan;
    if (cells.fan_ < 0 || cells.fan_ >= grid.fans()) {
      return fail(ErrorCode::usage,
                  fmt::format("fan {}: {} has fans 0 to {}", cells.fan_, observation.name, grid.fans() - 1));
    }
    cells.beams_ = {0, grid.beams() - 1};
    if (place.beams) cells.beams_ = *place.beams;
    if (told.beams) cells.beams_ = {told.beams->first, told.beams->last};
    int last = cells.beams_.last;
    for (const EchoviewCells::InPing& ping : told.pings) {
      for (const EchoviewCells::InBeam& run : ping.runs) last = std::max(last, run.beam);
    }
    if (cells.beams_.first >= 0 && last < grid.beams()) return cells;
    return fail(ErrorCode::usage,
                fmt::format("beam {}: {} has beams 0 to {}", last, observation.name, grid.beams() - 1));
  }

  [[nodiscard]] std::vector<RunKey> in_ping(std::int64_t ping) const {
    const TimeNs time = rounded(observation_.navigation[static_cast<std::size_t>(ping)].time);
    const int count = observation_.sample_count[static_cast<std::size_t>(fan_)];
    const auto told = std::ranges::lower_bound(told_.pings, time, {}, &EchoviewCells::InPing::time);
    const bool is_told = told != told_.pings.end() && told->time == time;
    std::vector<RunKey> runs;
    for (const DepthSpan& depths : depths_at(region_.corners, time)) {
      const SampleSpan samples = samples_in(depths, observation_.range, count);
      if (is_told) {
        add_told(told->runs, samples, runs);
      } else {
        add_all(samples, runs);
      }
    }
    return runs;
  }

 private:
  RegionCells(const EchoviewRegion& region, const EchoviewCells& told, const ObservationFiles& observation)
      : region_(region), told_(told), observation_(observation) {}

  void add(int beam, const SampleSpan& samples, std::vector<RunKey>& runs) const {
    if (samples.first >= samples.end) return;
    const int row = fan_ * observation_.grid->beams() + beam;
    runs.push_back(
        {observation_.grid->channel[static_cast<std::size_t>(row)], samples.first, samples.end - samples.first});
  }
  void add_all(const SampleSpan& samples, std::vector<RunKey>& runs) const {
    for (int beam = beams_.first; beam <= beams_.last; ++beam) add(beam, samples, runs);
  }
  /// The told cells say what is in the outline that was exported; what a human has added to it lies before and behind them.
  void add_told(const std::vector<EchoviewCells::InBeam>& told, const SampleSpan& samples,
                std::vector<RunKey>& runs) const {
    int first = samples.end;
    int end = samples.first;
    for (const EchoviewCells::InBeam& run : told) {
      add(run.beam, {std::max(run.first_sample, samples.first), std::min(run.end(), samples.end)}, runs);
      first = std::min(first, run.first_sample);
      end = std::max(end, run.end());
    }
    add_all({samples.first, first}, runs);
    add_all({end, samples.end}, runs);
  }

  const EchoviewRegion& region_;
  const EchoviewCells& told_;
  const ObservationFiles& observation_;
  int fan_ = 0;
  BeamSpan beams_;
};

/// Reads the regions of one file.
class Regions {
 public:
  Regions(const std::string& file, const ImportPlace& place, Imported& imported, const Work& work)
      : file_(file), place_(place), imported_(imported), work_(work) {}

  Result<void> add(const EchoviewRegion& region) {
    if (work_.cancelled()) return stop();
    switch (region.type) {
      case EchoviewType::analysis:
      case EchoviewType::fish_track:
        return add_school(region);
      case EchoviewType::marker:
        add_mark(region);
        return {};
      case EchoviewType::bad_no_data:
        add_bad(region);
        return {};
      case EchoviewType::bad_empty_water:
        leave_out(region, "bad data (empty water); expected schools, marks, or bad data over the whole range");
        return {};
    }
    return {};
  }

 private:
  [[nodiscard]] static tl::unexpected<Error> stop() { return fail(ErrorCode::cancelled, "stopped on request"); }
  [[nodiscard]] std::string at(const EchoviewRegion& region, std::string_view text) const {
    return fmt::format("line {}: region {}: {}", region.line, printable(region.name), text);
  }
  void leave_out(const EchoviewRegion& region, std::string_view text) {
    imported_.left_out.push_back(fmt::format("{}: {}", printable(file_), at(region, text)));
  }
  [[nodiscard]] const ObservationFiles& observation(std::size_t index) const {
    return place_.survey->observations[index];
  }
  /// As a journal takes it: one line, no longer than it may be.
  std::string text_of(const EchoviewRegion& region, std::string text) {
    std::ranges::replace(text, '\t', ' ');
    if (text.size() <= kMostTextBytes) return text;
    const auto is_inside_character = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; };
    std::size_t end = kMostTextBytes;
    while (end > 0 && is_inside_character(text[end])) --end;
    text.resize(end);
    leave_out(region, fmt::format("its text beyond {} bytes", kMostTextBytes));
    return text;
  }

  Result<void> add_school(const EchoviewRegion& region) {
    const auto told = cells_of(region, file_, &work_);
    if (!told) return pass_on(told);
    const bool ours = !told->pings.empty();
    bool empty = true;
    for (const std::size_t index : place_.observations) {
      const PingSpan pings = pings_in(observation(index), region);
      if (pings.empty()) continue;
      const auto cells = RegionCells::of(region, *told, observation(index), place_);
      if (!cells) return fail(cells.error().code, at(region, cells.error().text), {file_});
      ImportedSchool school;
      for (std::int64_t ping = pings.first; ping < pings.end; ++ping) {
        if (work_.cancelled()) return stop();
        auto runs = cells->in_ping(ping);
        runs_ += runs.size();
        if (runs_ > place_.most_runs) {
          return fail(ErrorCode::format,
                      at(region, fmt::format("the regions up to here hold over {} runs of samples; expected fewer",
                                             place_.most_runs)),
                      {file_});
        }
        if (!runs.empty()) school.pings[ping] = std::move(runs);
      }
      if (school.pings.empty()) continue;
      empty = false;
      add_to(imported_.school(ours ? region.name : std::string{}, index), region, *told, std::move(school.pings));
    }
    if (empty) leave_out(region, "no sample of the survey lies in it");
    return {};
  }

  void add_to(ImportedSchool& school, const EchoviewRegion& region, const EchoviewCells& told,
              std::map<std::int64_t, std::vector<RunKey>> pings) {
    for (auto& [ping, runs] : pings) {
      auto& all = school.pings[ping];
      all.insert(all.end(), runs.begin(), runs.end());
    }
    if (std::ranges::find(kNoClass, region.region_class) == kNoClass.end()) {
      school.species = text_of(region, region.region_class);
    }
    const bool named_by_export = !told.pings.empty() && is_of_export(region.name);
    if (!named_by_export) school.name = text_of(region, region.name);
    const std::string words = text_of(region, told.words);
    // Of a school in several fans each may say the same.
    if (school.comment.find(words) != std::string::npos) return;
    school.comment = text_of(region, school.comment + (school.comment.empty() ? "" : "; ") + words);
  }

  void add_mark(const EchoviewRegion& region) {
    const TimeNs time = region.corners.front().time;
    const auto told = cells_of(region, file_, &work_);
    std::string text = region.name;
    if (told && !told->words.empty()) text += (text.empty() ? "" : ": ") + told->words;
    for (const std::size_t index : place_.observations) {
      const auto& pings = observation(index).navigation;
      if (time < rounded(pings.front().time) || time > pings.back().time) continue;
      // What the format rounded away must not put a mark before the first ping.
      const TimeNs offset = pings.front().time - place_.survey->ping_time(observation(index), 0);
      const TimeNs first = place_.survey->ping_time(observation(index), 0);
      imported_.events.push_back({"other", std::max(first, time - offset), text_of(region, text)});
      return;
    }
    leave_out(region, "no observation of the survey was made at its time");
  }

  void add_bad(const EchoviewRegion& region) {
    bool seen = false;
    bool part = false;
    for (const std::size_t index : place_.observations) {
      const ObservationFiles& one = observation(index);
      const PingSpan pings = pings_in(one, region);
      if (pings.empty()) continue;
      seen = true;
      if (!covers(region, one, pings)) {
        part = true;
        continue;
      }
      imported_.bad.push_back({place_.survey->ping_time(one, static_cast<std::size_t>(pings.first)),
                               place_.survey->ping_time(one, static_cast<std::size_t>(pings.end - 1))});
    }
    if (!seen) leave_out(region, "no ping of the survey lies in it");
    if (part) leave_out(region, "bad data of a part of the range; expected all of it, as only whole pings can be bad");
  }

  /// Whether the region holds every sample of the pings.
  [[nodiscard]] bool covers(const EchoviewRegion& region, const ObservationFiles& one, const PingSpan& pings) const {
    const double near_m = std::max(0.0, one.range.range_m(0));
    const double far_m = one.range.range_m(one.range.count - 1);
    for (std::int64_t ping = pings.first; ping < pings.end && !work_.cancelled(); ++ping) {
      const TimeNs time = rounded(one.navigation[static_cast<std::size_t>(ping)].time);
      const bool whole = std::ranges::any_of(depths_at(region.corners, time), [&](const DepthSpan& depths) {
        return depths.first_m <= near_m && depths.last_m >= far_m;
      });
      if (!whole) return false;
    }
    return true;
  }

  const std::string& file_;
  const ImportPlace& place_;
  Imported& imported_;
  const Work& work_;
  std::size_t runs_ = 0;  ///< of schools so far
};

}  // namespace

Result<void> import_evr(const std::string& text, const std::string& file, const ImportPlace& place, Imported& imported,
                        const Work& work) {
  const auto regions = parse_evr(text, file, &work);
  if (!regions) return pass_on(regions);
  Regions reader(file, place, imported, work);
  for (const EchoviewRegion& region : *regions) {
    if (auto added = reader.add(region); !added) return added;
  }
  // What was read of the last one may be a part of it.
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  return {};
}

}  // namespace sonar
