// SPDX-License-Identifier: Apache-2.0
#include "io/product_mask_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <vector>

namespace sonar {
namespace {

using netcdf::Reader;

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

void read_mask(netcdf::Reader& in, ObservationProduct& product) {
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
