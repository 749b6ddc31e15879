// SPDX-License-Identifier: Apache-2.0
#include "io/product_grid_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

namespace sonar {
namespace {

using netcdf::Reader;

constexpr std::size_t kMostBeams = 1 << 16;
constexpr int kMostSamples = 1 << 24;
constexpr double kLeastSpacing_deg = 1e-6;  ///< angles that rise by less may be equal in radians

double scalar(Reader& in, int group, const char* name) {
  const auto value = in.values<double>(group, name, 1);
  return value.empty() ? 0.0 : value.front();
}

bool rises(const std::vector<double>& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x) && std::abs(x) <= 720.0; }) &&
         std::adjacent_find(v.begin(), v.end(), [](double a, double b) { return b - a < kLeastSpacing_deg; }) ==
             v.end();
}

/// What Sector and the voxel loops rely on.
bool is_sound(const GridRecord& record) {
  const std::vector<int>& channel = record.grid.channel;
  std::vector<bool> seen(channel.size(), false);
  for (const int c : channel) {
    if (c < 0 || static_cast<std::size_t>(c) >= seen.size() || seen[static_cast<std::size_t>(c)]) return false;
    seen[static_cast<std::size_t>(c)] = true;
  }
  const RangeAxis& range = record.range;
  return rises(record.grid.elevation_deg) && rises(record.grid.azimuth_deg) && range.spacing_m > 0.0 &&
         std::isfinite(range.spacing_m) && std::isfinite(range.first_m) && range.count >= 0 &&
         range.count <= kMostSamples;
}

struct RunTable {
  std::vector<std::int64_t> school_id;
  std::vector<std::int64_t> ping_index;
  std::vector<std::int32_t> channel;
  std::vector<std::int32_t> first_sample;
  std::vector<std::int32_t> sample_count;
  std::vector<std::uint8_t> confidence;
  std::vector<std::uint8_t> fault;  ///< empty = not known
  std::vector<std::size_t> first_voxel;
};

/// Names the first run that does not fit the pings and the grid.
bool check_runs(Reader& in, const ObservationProduct& product, RunTable& table) {
  const std::size_t channels = product.grid ? product.grid->grid.channel.size() : 0;
  const int samples = product.grid ? product.grid->range.count : 0;
  std::size_t voxels = 0;
  for (std::size_t i = 0; i < table.school_id.size(); ++i) {
    const std::int32_t count = table.sample_count[i];
    const bool fits = table.ping_index[i] >= 0 &&
                      table.ping_index[i] < static_cast<std::int64_t>(product.pings.size()) && table.channel[i] >= 0 &&
                      static_cast<std::size_t>(table.channel[i]) < channels && table.first_sample[i] >= 0 &&
                      count > 0 && count <= samples && table.first_sample[i] <= samples - count;
    if (!fits || static_cast<std::size_t>(count) > table.confidence.size() - voxels) {
      in.refuse(ErrorCode::format, fmt::format("run {} of the mask does not fit the pings and the grid", i));
      return false;
    }
    table.first_voxel.push_back(voxels);
    voxels += static_cast<std::size_t>(count);
  }
  if (voxels != table.confidence.size()) in.refuse(ErrorCode::format, "the mask has voxels without a run");
  const auto no_fault = std::find_if(table.fault.begin(), table.fault.end(), [](auto f) { return f > 1; });
  if (no_fault != table.fault.end()) {
    in.refuse(ErrorCode::format, fmt::format("'fault' of voxel {} of the mask is {}, expected 0 or 1",
                                             no_fault - table.fault.begin(), *no_fault));
  }
  return in.ok();
}

void append_runs(const RunTable& table, const std::vector<std::size_t>& order, const std::vector<int>& row_of_channel,
                 ObservationProduct& product) {
  for (const std::size_t i : order) {
    if (product.masks.empty() || product.masks.back().school_id != table.school_id[i] ||
        product.masks.back().ping_index != table.ping_index[i]) {
      product.masks.push_back({table.school_id[i], table.ping_index[i], {}});
    }
    PingMask& mask = product.masks.back().mask;
    mask.runs.push_back(
        {row_of_channel[static_cast<std::size_t>(table.channel[i])], table.first_sample[i], table.sample_count[i]});
    const auto first = table.confidence.begin() + static_cast<std::ptrdiff_t>(table.first_voxel[i]);
    mask.confidence.insert(mask.confidence.end(), first, first + table.sample_count[i]);
    if (table.fault.empty()) continue;
    const auto fault = table.fault.begin() + static_cast<std::ptrdiff_t>(table.first_voxel[i]);
    std::vector<bool>& faults = product.masks.back().fault;
    std::transform(fault, fault + table.sample_count[i], std::back_inserter(faults), [](auto f) { return f == 1; });
  }
}

}  // namespace

void read_grid(Reader& in, ObservationProduct& product) {
  const int group = in.find_group(in.root(), "grid");
  if (group < 0 || !in.has_variable(group, "elevation")) return;
  const std::size_t fans = in.dimension(group, "fan");
  const std::size_t beams = in.dimension(group, "beam");
  if (in.ok() && (fans == 0 || beams == 0 || fans > kMostBeams || beams > kMostBeams || fans * beams > kMostBeams)) {
    in.refuse(ErrorCode::format, fmt::format("a grid of {} fans x {} beams", fans, beams));
  }
  if (!in.ok()) return;
  GridRecord record;
  BeamGrid& grid = record.grid;
  grid.elevation_deg = in.values<double>(group, "elevation", fans);
  grid.azimuth_deg = in.values<double>(group, "azimuth", beams);
  grid.mounting_azimuth_deg = scalar(in, group, "mounting_azimuth");
  grid.frequency_hz = in.values<double>(group, "frequency", fans);
  grid.channel = in.values<std::int32_t>(group, "channel", fans * beams);
  grid.vertical_width_deg = in.values<double>(group, "vertical_width", fans * beams);
  grid.horizontal_width_deg = in.values<double>(group, "horizontal_width", fans * beams);
  if (in.has_variable(group, "psi_stated")) grid.psi_stated_db = in.values<double>(group, "psi_stated", fans * beams);
  if (in.has_variable(group, "psi_used")) record.psi_used_db = in.values<double>(group, "psi_used", fans * beams);
  record.sample_count = in.values<std::int32_t>(group, "sample_count", fans);
  record.range = {scalar(in, group, "range_of_first_sample"), scalar(in, group, "sample_spacing"), 0};
  const auto count = in.values<std::int32_t>(group, "sample_count_of_grid", 1);
  record.range.count = count.empty() ? 0 : count.front();
  record.sound_speed_mps = scalar(in, group, "sound_speed");
  if (in.ok() && !is_sound(record)) in.refuse(ErrorCode::format, "the grid makes no sense");
  if (in.ok()) product.grid = std::move(record);
}

void read_mask(Reader& in, ObservationProduct& product) {
  const int group = in.group(in.root(), "mask");
  const std::size_t runs = in.dimension(group, "run");
  RunTable table;
  table.school_id = in.values<std::int64_t>(group, "school_id", runs);
  table.ping_index = in.values<std::int64_t>(group, "ping_index", runs);
  table.channel = in.values<std::int32_t>(group, "channel", runs);
  table.first_sample = in.values<std::int32_t>(group, "first_sample", runs);
  table.sample_count = in.values<std::int32_t>(group, "sample_count", runs);
  table.confidence = in.values<std::uint8_t>(group, "confidence", in.dimension(group, "voxel"));
  if (in.has_variable(group, "fault")) table.fault = in.values<std::uint8_t>(group, "fault", table.confidence.size());
  if (!in.ok() || runs == 0 || !check_runs(in, product, table)) return;
  const std::vector<int> row_of_channel = product.grid->grid.row_of_channel();
  std::vector<std::size_t> order(runs);
  for (std::size_t i = 0; i < runs; ++i) order[i] = i;
  const auto key = [&](std::size_t i) {
    return std::tuple(table.school_id[i], table.ping_index[i],
                      row_of_channel[static_cast<std::size_t>(table.channel[i])], table.first_sample[i]);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < runs; ++i) {
    const auto [id, ping, row, first] = key(order[i - 1]);
    const auto [id2, ping2, row2, first2] = key(order[i]);
    if (std::tie(id, ping, row) == std::tie(id2, ping2, row2) && first2 - first < table.sample_count[order[i - 1]]) {
      in.refuse(ErrorCode::format, fmt::format("runs of school {} overlap in ping {}", id, ping));
      return;
    }
  }
  append_runs(table, order, row_of_channel, product);
}

}  // namespace sonar
