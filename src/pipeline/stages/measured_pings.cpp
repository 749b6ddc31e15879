// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/measured_pings.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "io/byte_archive.h"
#include "io/sealed_file.h"

namespace sonar {
namespace {

/// Raised when a member comes, goes or changes its meaning.
constexpr int kVersion = 4;

/// Hands every column of a row to an archive.
template <class Io>
struct ArchivedColumns {
  Io& io;
  void operator()(std::string_view, std::string_view, auto& value) { io(value); }
  void operator()(std::string_view, std::string_view, TimeColumn column) { io(column.value); }
  void operator()(std::string_view, std::string_view, DegreesColumn column) { io(column.value); }
};

std::string versioned(const std::string& key) { return fmt::format("measured {} {}", kVersion, key); }

}  // namespace

void fields(auto& io, Archived<SchoolPingRow> auto& row) {
  // Columns are visited to be changed; what is written is a copy.
  if constexpr (std::is_const_v<std::remove_reference_t<decltype(row)>>) {
    SchoolPingRow copy = row;
    ArchivedColumns<std::remove_reference_t<decltype(io)>> all{io};
    columns(all, copy);
  } else {
    ArchivedColumns<std::remove_reference_t<decltype(io)>> all{io};
    columns(all, row);
  }
}

void fields(auto& io, Archived<LevelMoments> auto& level) { io(level.sums); }

void fields(auto& io, Archived<HeightLikelihood> auto& height) {
  io(height.at);
  io(height.freedom);
}

void fields(auto& io, Archived<BodyEcho> auto& body) {
  io(body.known);
  io(body.total);
  io(body.blur);
  io(body.upright);
  io(body.sideways);
  io(body.two_way_area);
  io(body.centre.x);
  io(body.centre.y);
  io(body.centre.z);
  io(body.mean_range2_m2);
  io(body.level);
  io(body.looks);
  io(body.heights);
}

void fields(auto& io, Archived<MeasuredMask> auto& mask) {
  io(mask.school.row);
  io(mask.school.body);
  io(mask.fault);
  io(mask.repeats);
}

std::filesystem::path measured_file(const IndexCache& cache, const SurveyFiles& survey,
                                    const ObservationFiles& observation) {
  if (cache.folder.empty() || observation.pings.empty()) return {};
  const SurveyPing& first = observation.pings.front();
  const std::string name = fmt::format("{}\n{}\nmeasured", survey.files[first.file].index.hash, first.entry);
  return cache.folder / (to_hex(hash_text(name)) + ".measured");
}

MeasuredPings kept_measured(const std::filesystem::path& file, const std::string& key) {
  const auto sealed = file.empty() ? std::nullopt : SealedFile::open(file, versioned(key));
  const auto bytes = sealed ? sealed->block(0) : std::nullopt;
  return bytes ? measured_from(*bytes) : MeasuredPings{};
}

MeasuredPings measured_from(std::span<const std::byte> bytes) {
  ArchiveReader reader(bytes);
  std::uint64_t count = 0;
  reader(count);
  MeasuredPings measured;
  for (std::uint64_t i = 0; i < count && reader.sound(); ++i) {
    std::int64_t ping_index = 0;
    std::pair<Hash128, std::vector<MeasuredMask>> ping;
    reader(ping_index);
    reader(ping.first.high);
    reader(ping.first.low);
    reader(ping.second);
    measured.pings.emplace(ping_index, std::move(ping));
  }
  if (!reader.sound_to_the_end()) return {};
  return measured;
}

std::vector<std::byte> measured_bytes(const MeasuredPings& measured) {
  ArchiveWriter writer;
  writer(static_cast<std::uint64_t>(measured.pings.size()));
  for (const auto& [ping_index, ping] : measured.pings) {
    writer(ping_index);
    writer(ping.first.high);
    writer(ping.first.low);
    writer(ping.second);
  }
  return writer.take();
}

void keep_measured(const std::filesystem::path& file, const std::string& key, MeasuredPings& measured) {
  if (file.empty()) return;
  const std::array blocks{measured_bytes(measured)};
  SealedFile::store(file, versioned(key), blocks, Beside::own_folder);
  measured.changed = false;
}

}  // namespace sonar
