// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/reduced_ping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include "base/units.h"

namespace sonar {
namespace {

/// Calls body(row, record) for every beam of the grid that has a record.
template <class Body>
void for_each_record(std::span<const ChannelPing> heads, std::span<const int> row_of_channel, const Body& body) {
  std::vector<bool> told(row_of_channel.size(), false);
  const auto tell = [&](int channel, const ReducedRow& record) {
    if (channel < 0 || static_cast<std::size_t>(channel) >= row_of_channel.size()) return;
    const auto at = static_cast<std::size_t>(channel);
    if (row_of_channel[at] >= 0 && !told[at]) body(row_of_channel[at], record);
    told[at] = true;
  };
  for (const ChannelPing& head : heads) {
    if (head.reduced) tell(head.channel, head.reduced->row);
  }
  // What a channel says of itself comes first: parts of a ping in two files each list what they do not hold.
  for (const ChannelPing& head : heads) {
    if (!head.reduced) continue;
    for (const ReducedChannel& beam : head.reduced->short_beams) tell(beam.channel, beam.row);
  }
}

}  // namespace

bool is_reduced(std::span<const ChannelPing> heads) {
  return std::any_of(heads.begin(), heads.end(), [](const ChannelPing& head) { return head.reduced.has_value(); });
}

std::vector<int> reduced_lengths(std::span<const ChannelPing> heads, std::span<const int> row_of_channel) {
  std::vector<int> lengths(row_of_channel.size(), -1);
  for_each_record(heads, row_of_channel, [&](int row, const ReducedRow& record) {
    lengths[static_cast<std::size_t>(row)] = record.recorded_samples;
  });
  return lengths;
}

void open_reduced(std::span<const ChannelPing> heads, std::span<const int> row_of_channel, Volume& volume) {
  const auto counts = volume.counts.all();
  const auto flags = volume.flags.all();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    // Reading clamps kReducedFault to the least count there is.
    const bool faulty = counts[i] == kMinCount;
    if (counts[i] == kNoData) counts[i] = kMinCount;
    if (faulty) counts[i] = kNoData;
    flags[i] = faulty ? SampleFlags::dropout : SampleFlags::none;
  }
  for_each_record(heads, row_of_channel, [&](int row, const ReducedRow& record) {
    const auto in_row = volume.counts.view().row(row);
    const auto row_flags = volume.flags.view().row(row);
    for (auto s = static_cast<std::size_t>(record.recorded_samples); s < in_row.size(); ++s) {
      in_row[s] = kNoData;
      row_flags[s] = SampleFlags::dropout;
    }
  });
}

void fill_reduced(Volume& volume) {
  const auto counts = volume.counts.all();
  const auto flags = volume.flags.all();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == kNoData && !any(flags[i] & SampleFlags::dropout)) counts[i] = kMinCount;
  }
}

std::vector<float> reduced_background_db(std::span<const ChannelPing> heads, std::span<const int> row_of_channel) {
  std::vector<float> levels(row_of_channel.size(), std::numeric_limits<float>::quiet_NaN());
  for_each_record(heads, row_of_channel, [&](int row, const ReducedRow& record) {
    if (std::isfinite(record.background_db)) levels[static_cast<std::size_t>(row)] = record.background_db;
  });
  return levels;
}

namespace {

bool fits(const WaterLevels& water, const Shape3& shape) {
  if (water.block_samples < 1 || water.blocks < 1 || water.places < 1) return false;
  // as many blocks as the samples need
  if (water.block_samples > std::max(shape.samples, 1)) return false;
  if (water.blocks > shape.samples / water.block_samples + 1) return false;
  if (water.level.size() != static_cast<std::size_t>(water.places) * static_cast<std::size_t>(shape.fans)) return false;
  if (water.reach.size() != water.level.size()) return false;
  if (!water.patch.empty() && water.patch.size() != static_cast<std::size_t>(water.blocks) * shape.rows()) return false;
  if (!water.stretch.empty() && water.stretch.size() != shape.rows()) return false;
  if (!std::all_of(water.stretch.begin(), water.stretch.end(), [](float by) { return by > 0.1F && by < 10.0F; }))
    return false;
  const auto inside = [&](const EchoCell& cell) {
    return cell.row >= 0 && cell.row < static_cast<int>(shape.rows()) && cell.block >= 0 && cell.block < water.blocks &&
           std::isfinite(cell.evidence);
  };
  const auto place = [](const EchoCell& cell) { return std::pair(cell.row, cell.block); };
  return std::all_of(water.cells.begin(), water.cells.end(), inside) &&
         std::ranges::adjacent_find(water.cells, std::greater_equal<>{}, place) == water.cells.end();
}

}  // namespace

WaterLevels reduced_water(std::span<const ChannelPing> heads, const Shape3& shape) {
  const auto teller = std::find_if(heads.begin(), heads.end(),
                                   [](const ChannelPing& head) { return head.reduced && head.reduced->water; });
  return teller == heads.end() || !fits(*teller->reduced->water, shape) ? WaterLevels{} : *teller->reduced->water;
}

Seabed reduced_seabed(std::span<const ChannelPing> heads, std::span<const int> row_of_channel, int samples) {
  Seabed seabed;
  for (const ChannelPing& head : heads) {
    if (!head.reduced || !head.reduced->seabed) continue;
    const ReducedSeabed& plane = *head.reduced->seabed;
    seabed.found = true;
    seabed.offset_m = plane.offset_m;
    seabed.slope_x = plane.slope_x;
    seabed.slope_y = plane.slope_y;
    seabed.min_x = plane.min_x;
    seabed.max_x = plane.max_x;
    seabed.min_y = plane.min_y;
    seabed.max_y = plane.max_y;
    break;
  }
  seabed.first_sample.assign(row_of_channel.size(), samples);
  seabed.heard_sample.assign(row_of_channel.size(), samples);
  for_each_record(heads, row_of_channel, [&](int row, const ReducedRow& record) {
    // 0.1.0 wrote stretches that begin later: water round schools in a beam-edge echo of which nothing else is known
    const bool edge_echo = record.open_first == record.seabed_sample && record.open_end > record.open_first;
    const auto r = static_cast<std::size_t>(row);
    seabed.first_sample[r] = std::min(edge_echo ? record.open_end : record.seabed_sample, samples);
    seabed.heard_sample[r] = std::min(record.seabed_sample, samples);
  });
  return seabed;
}

void flag_reduced_seabed(std::span<const ChannelPing> heads, std::span<const int> row_of_channel,
                         View3<SampleFlags> flags) {
  for_each_record(heads, row_of_channel, [&](int row, const ReducedRow& record) {
    const auto row_flags = flags.row(row);
    const auto end = std::min(row_flags.size(), static_cast<std::size_t>(record.recorded_samples));
    for (auto s = static_cast<std::size_t>(record.seabed_sample); s < end; ++s) {
      // schools in its beam-edge echo
      const bool is_open = std::cmp_greater_equal(s, record.open_first) && std::cmp_less(s, record.open_end);
      if (!is_open) row_flags[s] |= SampleFlags::seabed;
    }
  });
}

}  // namespace sonar
