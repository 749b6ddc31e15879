// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/reduce.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <system_error>
#include <utility>

#include "base/units.h"
#include "io/atomic_file.h"
#include "io/recording_copy.h"
#include "pipeline/exports/reduce_ping.h"
#include "pipeline/stages/engine.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr std::int16_t kMissing = -20000;

/// A ping that stays.
struct KeptPing {
  std::size_t observation = 0;  ///< in the list of observations
  std::size_t ping_index = 0;
  std::vector<const PingMask*> masks;  ///< empty: no samples stay
  bool keeps_ends = false;             ///< the first after a gap shows how far the beams reach
  bool tracked = false;                ///< some school's track runs here or begins soon
};

/// An observation being reduced, with the stages that tell faulty samples.
struct Reduced {
  const ObservationFiles* files = nullptr;
  const ObservationProduct* product = nullptr;
  std::unique_ptr<Engine> engine;
  std::unique_ptr<GroupWater> waters;
  std::map<std::size_t, KeptPing> pings;  ///< by ping index
};

/// Kept pings of one file by time stamp.
using KeptOfFile = std::map<TimeNs, const KeptPing*>;

Result<void> same_pings(const ObservationFiles& files, const ObservationProduct& product) {
  const auto wrong = [&](std::string text) {
    return fail(ErrorCode::mismatch, fmt::format("{}: {}", product.observation, std::move(text)));
  };
  if (!files.grid || !product.grid || files.grid->channel != product.grid->grid.channel) {
    return wrong("the raw files have another beam grid than the product");
  }
  if (files.pings.size() != product.pings.size()) {
    return wrong(fmt::format("{} pings in the raw files, {} in the product", files.pings.size(), product.pings.size()));
  }
  for (std::size_t i = 0; i < product.pings.size(); ++i) {
    if (files.navigation[i].time != product.pings[i].time) return wrong("the pings have other times");
  }
  return {};
}

/// Which pings stay: all of a school from its first to its last, and some beside them.
void choose_pings(const ObservationProduct& product, std::size_t observation, const ReduceParams& params,
                  Reduced& out) {
  const auto last_ping = static_cast<std::int64_t>(product.pings.size()) - 1;
  std::map<std::int64_t, std::pair<std::int64_t, std::int64_t>> spans;
  for (const SchoolMask& m : product.masks) {
    if (m.mask.empty()) continue;
    const auto [span, is_new] = spans.try_emplace(m.school_id, m.ping_index, m.ping_index);
    span->second.first = std::min(span->second.first, m.ping_index);
    span->second.second = std::max(span->second.second, m.ping_index);
    out.pings[static_cast<std::size_t>(m.ping_index)].masks.push_back(&m.mask);
  }
  for (const auto& [school, span] : spans) {
    for (std::int64_t i = span.first - params.margin_pings; i <= span.second + params.margin_pings; ++i) {
      if (i < 0 || i > last_ping) continue;
      KeptPing& ping = out.pings[static_cast<std::size_t>(i)];
      // What became no school is kept up to a school's end: behind that nothing may bridge the pings that go.
      ping.tracked = ping.tracked || i <= span.second;
    }
  }
  std::size_t expected = 0;
  for (auto& [index, ping] : out.pings) {
    ping.observation = observation;
    ping.ping_index = index;
    ping.keeps_ends = index == 0 || index != expected;
    expected = index + 1;
  }
}

/// What is left of a channel's row, without the ends that hold nothing; empty where nothing is.
std::optional<ChannelPing> channel_left(ChannelPing head, std::span<const std::int16_t> row, ReducedRecord record,
                                        bool even_if_empty, std::vector<std::int16_t>& counts) {
  std::size_t first = 0;
  std::size_t end = row.size();
  while (end > 0 && row[end - 1] == kNoData) --end;
  while (first < end && row[first] == kNoData) ++first;
  if (first == end && !even_if_empty) return std::nullopt;
  counts.assign(row.begin() + static_cast<std::ptrdiff_t>(first), row.begin() + static_cast<std::ptrdiff_t>(end));
  std::replace(counts.begin(), counts.end(), kNoData, kMissing);
  if (counts.empty()) counts.push_back(kMissing);
  head.offset = static_cast<int>(first);
  head.power_count = counts;
  head.reduced = std::move(record);
  return head;
}

/// What stays of one file's channels.
class FileReducer {
 public:
  FileReducer(std::vector<Reduced>& observations, const ReduceParams& params, const KeptOfFile& kept)
      : observations_(observations), params_(params), kept_(kept) {}

  Result<std::optional<ChannelPing>> in_place(TimeNs time, const ChannelPing& recorded) {
    const auto kept = kept_.find(time);
    if (kept == kept_.end()) return std::nullopt;
    const bool is_first = ping_ != kept->second;
    if (is_first) {
      if (auto begun = begin(*kept->second); !begun) return pass_on(begun);
    }
    if (recorded.channel < 0 || static_cast<std::size_t>(recorded.channel) >= row_of_channel_.size()) {
      return std::nullopt;
    }
    const int row = row_of_channel_[static_cast<std::size_t>(recorded.channel)];
    if (row < 0) return std::nullopt;
    // A ping's first channel tells of roll, heave, heading, seabed, water and beams that are missing: it stays in any
    // case.
    ReducedRecord record{ping_rows_.record[static_cast<std::size_t>(row)]};
    if (is_first) {
      record.seabed = ping_rows_.seabed;
      record.water = ping_rows_.water;
      record.short_beams = ping_rows_.short_beams;
    }
    return channel_left(recorded, std::as_const(ping_rows_.counts).view().row(row), std::move(record), is_first,
                        counts_);
  }

 private:
  Result<void> begin(const KeptPing& ping) {
    Reduced& observation = observations_[ping.observation];
    auto reduced = reduce_ping(*observation.engine, *observation.waters, static_cast<std::int64_t>(ping.ping_index),
                               ping.masks, {ping.keeps_ends, ping.tracked}, params_);
    if (!reduced) return pass_on(reduced);
    ping_rows_ = std::move(*reduced);
    row_of_channel_ = observation.files->grid->row_of_channel();
    ping_ = &ping;
    return {};
  }

  std::vector<Reduced>& observations_;
  const ReduceParams& params_;
  const KeptOfFile& kept_;
  ReducedPing ping_rows_;
  std::vector<int> row_of_channel_;
  std::vector<std::int16_t> counts_;
  const KeptPing* ping_ = nullptr;
};

Result<std::vector<Reduced>> choose(const SurveyFiles& survey, std::span<const ObservationProduct> products,
                                    const Recipe& recipe, const ReduceParams& params) {
  std::vector<Reduced> observations;
  for (const ObservationProduct& product : products) {
    if (product.masks.empty()) continue;
    const ObservationFiles* files = survey.find(product.observation);
    if (files == nullptr) {
      return fail(ErrorCode::mismatch, fmt::format("{}: the raw files have no such observation", product.observation));
    }
    if (auto same = same_pings(*files, product); !same) return pass_on(same);
    Reduced reduced;
    reduced.files = files;
    reduced.product = &product;
    reduced.engine = std::make_unique<Engine>(survey, *files, recipe);
    reduced.waters = std::make_unique<GroupWater>(*reduced.engine);
    // Detection and the seabed stood on the background that the product holds.
    const auto& levels = product.background_db;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      reduced.engine->give_background(static_cast<std::int64_t>(i), levels[i]);
    }
    choose_pings(product, observations.size(), params, reduced);
    observations.push_back(std::move(reduced));
  }
  return observations;
}

/// What the schools' own samples take; what is kept beside them comes on top.
std::uint64_t least_bytes(const std::vector<Reduced>& observations) {
  std::uint64_t bytes = kLeastFreeBytes;
  for (const Reduced& observation : observations) {
    for (const auto& [index, ping] : observation.pings) {
      for (const PingMask* mask : ping.masks) bytes += mask->voxels() * sizeof(std::int16_t);
    }
  }
  return bytes;
}

std::map<std::uint32_t, KeptOfFile> by_file(const SurveyFiles& survey, const std::vector<Reduced>& observations) {
  std::map<std::uint32_t, KeptOfFile> kept;
  for (const Reduced& observation : observations) {
    for (const auto& [index, ping] : observation.pings) {
      for (const SurveyPing& at : survey.parts(observation.files->pings[index])) {
        kept[at.file][survey.entry(at).time] = &ping;
      }
    }
  }
  return kept;
}

}  // namespace

Result<ReduceReport> reduce_survey(const SurveyFiles& survey, std::span<const ObservationProduct> products,
                                   const Recipe& recipe, const fs::path& dest, const ReduceParams& params, Work& work) {
  if (auto checked = require_outside_raw(survey, dest); !checked) return pass_on(checked);
  auto observations = choose(survey, products, recipe, params);
  if (!observations) return pass_on(observations);
  if (auto space = require_free_space(dest, least_bytes(*observations)); !space) return pass_on(space);
  const auto kept = by_file(survey, *observations);
  std::error_code error;
  fs::create_directories(dest, error);
  if (error) return fail(ErrorCode::io, error.message(), {.file = dest.string()});
  ReduceReport report;
  for (std::uint32_t f = 0; f < survey.files.size(); ++f) {
    const SurveyFile& file = survey.files[f];
    if (file.error || !file.index.gives_samples()) continue;
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const auto source = open_file(file.path);
    if (!source) return pass_on(source);
    auto out = RawFileWriter::create(dest / file.path.filename());
    if (!out) return pass_on(out);
    const auto of_file = kept.find(f);
    const KeptOfFile none;
    FileReducer reducer(*observations, params, of_file == kept.end() ? none : of_file->second);
    const auto in_place = [&](TimeNs time, const ChannelPing& recorded) { return reducer.in_place(time, recorded); };
    if (auto copied = copy_recording(*stoppable(*source, work), in_place, *out); !copied) return pass_on(copied);
    report.files.push_back(out->path());
    report.pings_before += std::ssize(file.index.pings);
    report.pings_kept += of_file == kept.end() ? 0 : std::ssize(of_file->second);
    report.bytes_before += file.index.size;
    report.bytes_kept += out->size();
    work.progress("reduce", static_cast<std::int64_t>(f) + 1, static_cast<std::int64_t>(survey.files.size()));
  }
  return report;
}

}  // namespace sonar
