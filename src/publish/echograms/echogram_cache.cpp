// SPDX-License-Identifier: Apache-2.0
#include "publish/echograms/echogram_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "io/sealed_file.h"
#include "pipeline/stages/observe.h"

namespace sonar {
namespace {

/// Raised when the same pings give another echogram, or its bytes another meaning.
constexpr int kVersion = 1;

using Bytes = std::vector<std::byte>;

static_assert(std::is_trivially_copyable_v<EchogramCell> && sizeof(EchogramCell) == 12, "cells are kept as they lie");

template <class T>
void put(Bytes& out, std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  out.insert(out.end(), bytes.begin(), bytes.end());
}
template <class T>
void put(Bytes& out, const T& value) {
  put(out, std::span<const T>(&value, 1));
}

/// Every read is checked against what is left.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  [[nodiscard]] bool take(T& value) {
    if (bytes_.size() < sizeof(T)) return false;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return true;
  }
  template <class T>
  [[nodiscard]] bool take(std::vector<T>& values, std::uint64_t count) {
    if (bytes_.size() / sizeof(T) < count) return false;
    values.resize(static_cast<std::size_t>(count));
    if (count > 0) std::memcpy(values.data(), bytes_.data(), values.size() * sizeof(T));
    bytes_ = bytes_.subspan(values.size() * sizeof(T));
    return true;
  }
  [[nodiscard]] bool at_end() const { return bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
};

Bytes head_of(const EchogramPyramid& echogram) {
  Bytes out;
  put(out, echogram.range().first_m);
  put(out, echogram.range().bin_m);
  put(out, std::int32_t{echogram.range().bins});
  put(out, std::int32_t{echogram.pings_per_column()});
  put(out, std::uint64_t{echogram.pings()});
  put(out, std::span<const TimeNs>(echogram.times()));
  put(out, std::span<const double>(echogram.distances_nmi()));
  return out;
}

Bytes level_of(const EchogramLevel& level) {
  Bytes out;
  out.reserve(16 + level.cells.size() * sizeof(EchogramCell));
  put(out, std::int32_t{level.bins});
  put(out, std::uint64_t{level.columns});
  put(out, std::span<const EchogramCell>(level.cells));
  return out;
}

std::optional<EchogramLevel> level_from(std::span<const std::byte> bytes) {
  Reader read(bytes);
  std::int32_t bins = 0;
  std::uint64_t columns = 0;
  if (!read.take(bins) || !read.take(columns) || bins < 1 || columns > bytes.size()) return std::nullopt;
  EchogramLevel level{bins, static_cast<std::size_t>(columns), {}};
  const bool whole = read.take(level.cells, columns * static_cast<std::uint64_t>(bins)) && read.at_end();
  return whole ? std::optional(std::move(level)) : std::nullopt;
}

template <class T>
void add(Hasher& hasher, const T& value) {
  hasher.add(std::as_bytes(std::span<const T>(&value, 1)));
}

}  // namespace

EchogramEntry echogram_entry(const IndexCache& cache, const SurveyFiles& survey, const ObservationFiles& observation,
                             const std::string& recipe_hash, bool filtered, SampleFlags hidden,
                             const EchogramRange& range) {
  if (cache.folder.empty() || observation.pings.empty()) return {};
  Hasher hasher;
  hasher.add(fmt::format("echogram {} {} {} {} {}\n", kVersion, kStageVersions, recipe_hash, filtered,
                         static_cast<unsigned>(hidden)));
  // Files by content and in order, not by their number in the survey: another file before them changes nothing.
  const std::string* file = nullptr;
  for (const SurveyPing& ping : observation.pings) {
    for (const SurveyPing& part : survey.parts(ping)) {
      const std::string& hash = survey.files[part.file].index.hash;
      if (file == nullptr || *file != hash) hasher.add(hash);
      file = &hash;
      add(hasher, part.entry);
    }
  }
  // Where the ship was and how deep its sonar decides where the surface is.
  for (const PingNavigation& n : observation.navigation) {
    add(hasher, n.time);
    for (const double v : {n.distance_nmi, n.pitch_deg, n.roll_deg, n.heave_m, n.transducer_depth_m}) add(hasher, v);
  }
  add(hasher, range.first_m);
  add(hasher, range.bin_m);
  add(hasher, range.bins);
  // The same observation keeps its place: an entry that is stale is written over.
  const std::string& first = survey.files[observation.pings.front().file].index.hash;
  const std::string name = fmt::format("{}\n{}\n{}", first, observation.pings.front().entry, filtered);
  return {cache.folder / (to_hex(hash_text(name)) + ".echogram"), to_hex(hasher.value())};
}

std::optional<EchogramPyramid> kept_echogram(const EchogramEntry& entry, int level) {
  if (entry.path.empty()) return std::nullopt;
  const auto file = SealedFile::open(entry.path, entry.key);
  if (!file || file->blocks() < 2) return std::nullopt;
  const auto head = file->block(0);
  if (!head) return std::nullopt;
  Reader read(*head);
  EchogramRange range;
  std::int32_t bins = 0;
  std::int32_t per_column = 0;
  std::uint64_t pings = 0;
  std::vector<TimeNs> times;
  std::vector<double> distances;
  if (!read.take(range.first_m) || !read.take(range.bin_m) || !read.take(bins) || !read.take(per_column) ||
      !read.take(pings) || !read.take(times, pings) || !read.take(distances, pings) || !read.at_end()) {
    return std::nullopt;
  }
  range.bins = bins;
  const auto last = static_cast<int>(file->blocks()) - 2;
  const int finest = std::clamp(level, 0, last);
  if (finest > 30) return std::nullopt;  // no survey has as many pings as its columns would hold
  std::vector<EchogramLevel> levels;
  for (int i = finest; i <= last; ++i) {
    const auto bytes = file->block(static_cast<std::size_t>(i) + 1);
    auto one = bytes ? level_from(*bytes) : std::nullopt;
    if (!one) return std::nullopt;
    levels.push_back(std::move(*one));
  }
  const EchogramRange shown = range.coarser(levels.front().bins);
  return EchogramPyramid::of_parts(shown, per_column << finest, std::move(times), std::move(distances),
                                   std::move(levels));
}

void keep_echogram(const EchogramEntry& entry, const EchogramPyramid& echogram) {
  if (entry.path.empty()) return;
  std::vector<Bytes> blocks{head_of(echogram)};
  for (int i = 0; i < echogram.levels(); ++i) blocks.push_back(level_of(echogram.level(i)));
  SealedFile::store(entry.path, entry.key, blocks);
}

int echogram_level(std::size_t pings, int width_px) {
  const std::size_t a_pixel = pings / static_cast<std::size_t>(std::max(1, width_px));
  int level = 0;
  while ((std::size_t{8} << static_cast<unsigned>(level)) <= a_pixel) ++level;
  return level;
}

}  // namespace sonar
