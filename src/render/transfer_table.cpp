// SPDX-License-Identifier: Apache-2.0
#include "render/transfer_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kFineEntries = 4096;

int refinement(int entries) { return std::max(4, (kFineEntries + entries - 2) / (entries - 1)); }

std::uint32_t ten_bits(double value) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 1.0) * 1023.0));
}

void fill_levels(TransferTable& out) {
  out.largest.push_back(out.extinction);
  for (std::size_t width = 1; 2 * width <= out.extinction.size(); width *= 2) {
    const auto& below = out.largest.back();
    std::vector<float> level(below.size() - width);
    for (std::size_t i = 0; i < level.size(); ++i) level[i] = std::max(below[i], below[i + width]);
    out.largest.push_back(std::move(level));
  }
}

struct Entries {
  int first;
  int last;
};

Entries entries_of(const TransferTable& table, int least_count, int largest_count) {
  const auto entry = [&](int count) {
    const float at = static_cast<float>(count) * table.per_count + table.first;
    return static_cast<int>(std::clamp(at, 0.0F, static_cast<float>(table.size() - 1)));
  };
  return {std::max(entry(least_count) - 1, 0), std::min(entry(largest_count) + 2, table.size() - 1)};
}

}  // namespace

std::array<double, 4> optics_at(const OpticalTable& table, double sv_db) {
  const auto last = static_cast<double>(table.rgb_extinction.size() - 1);
  const double at = std::clamp((sv_db - table.first_db) / (table.last_db - table.first_db) * last, 0.0, last);
  const auto i = std::min(static_cast<std::size_t>(at), table.rgb_extinction.size() - 2);
  const double f = at - static_cast<double>(i);
  std::array<double, 4> out{};
  for (std::size_t c = 0; c < 4; ++c) {
    out[c] = (1.0 - f) * static_cast<double>(table.rgb_extinction[i][c]) +
             f * static_cast<double>(table.rgb_extinction[i + 1][c]);
  }
  return out;
}

TransferTable transfer_table(const OpticalTable& table) {
  TransferTable out;
  const auto entries = static_cast<int>(table.rgb_extinction.size());
  const int size = (entries - 1) * refinement(entries) + 1;
  const double db_per_entry = (table.last_db - table.first_db) / (size - 1);
  out.per_count = static_cast<float>(kDbPerCount / db_per_entry);
  out.first = static_cast<float>(-table.first_db / db_per_entry);
  out.visible_before.push_back(0);
  out.lowest_visible_db = std::numeric_limits<double>::infinity();
  for (int i = 0; i < size; ++i) {
    const double db = table.first_db + i * db_per_entry;
    const auto [r, g, b, extinction] = optics_at(table, db);
    const auto e = static_cast<float>(extinction);
    out.extinction.push_back(e);
    out.entries.push_back({e, ten_bits(r) | ten_bits(g) << 10 | ten_bits(b) << 20});
    out.visible_before.push_back(out.visible_before.back() + (e > 0.0F ? 1 : 0));
    if (e > 0.0F && out.visible_before.back() == 1) {
      out.lowest_visible_db = i == 0 ? -std::numeric_limits<double>::infinity() : db - db_per_entry;
    }
  }
  fill_levels(out);
  return out;
}

bool TransferTable::visible(int least_count, int largest_count) const {
  const Entries e = entries_of(*this, least_count, largest_count);
  return visible_before[static_cast<std::size_t>(e.last) + 1] > visible_before[static_cast<std::size_t>(e.first)];
}

float TransferTable::largest_extinction(int least_count, int largest_count) const {
  const Entries e = entries_of(*this, least_count, largest_count);
  const auto width = static_cast<unsigned>(e.last - e.first + 1);
  const auto level = static_cast<std::size_t>(std::bit_width(width) - 1);
  const auto& row = largest[level];
  return std::max(row[static_cast<std::size_t>(e.first)],
                  row[static_cast<std::size_t>(e.last + 1) - (std::size_t{1} << level)]);
}

}  // namespace sonar
