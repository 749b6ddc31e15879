// SPDX-License-Identifier: Apache-2.0
#include "io/echoview_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "base/utf8.h"

namespace sonar {
namespace {

constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
constexpr const char* kEnd = "\r\n";
constexpr const char* kProgram = "10.0.0.0";  ///< a version of Echoview that reads these formats
constexpr int kAnalysis = 1;                  ///< type of a region
constexpr int kMadeElsewhere = 2;             ///< creation type
constexpr int kUnverified = 1;                ///< status of a line's point

/// CCYYMMDD HHmmSSssss, the last in 0.1 ms.
std::string echoview_time(TimeNs time) {
  const std::string name = raw_name_time(time);  // "20261121-T195726"
  return fmt::format("{} {}{:04}", name.substr(0, 8), name.substr(10), time % kSecondNs / 100'000);
}

/// A text of the file: one line.
std::string one_line(std::string_view words) {
  std::string text = clean_utf8(words);
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20U; }, ' ');
  return text;
}

/// A school in a fan of one ping: from its first sample to its last.
struct Stretch {
  std::int64_t ping = 0;
  double near_m = 0.0;
  double far_m = 0.0;
  std::vector<Run> runs;  ///< row = beam of the fan
};

std::vector<Stretch> stretches(const ObservationProduct& product, std::int64_t school, int fan) {
  const int beams = product.grid->grid.beams();
  const RangeAxis& range = product.grid->range;
  std::vector<Stretch> out;
  // Masks are sorted by school: of a large survey only this one's are looked at.
  for (const SchoolMask& mask : std::ranges::equal_range(product.masks, school, {}, &SchoolMask::school_id)) {
    if (mask.ping_index < 0 || mask.ping_index >= std::ssize(product.pings)) continue;
    int first = range.count;
    int end = 0;
    std::vector<Run> runs;
    for (const Run& run : mask.mask.runs) {
      if (run.row / beams != fan) continue;
      first = std::min(first, run.first_sample);
      end = std::max(end, run.end());
      runs.push_back({run.row % beams, run.first_sample, run.count});
    }
    if (runs.empty()) continue;
    out.push_back({mask.ping_index, range.range_m(first - 0.5), range.range_m(end - 0.5), std::move(runs)});
  }
  return out;
}

/// Half way to a neighbouring ping; where there is none, as far as on the other side.
TimeNs half_way(const ObservationProduct& product, std::int64_t ping, int step) {
  const auto at = [&](std::int64_t i) { return product.pings[static_cast<std::size_t>(i)].time; };
  const auto is_there = [&](std::int64_t i) { return i >= 0 && i < std::ssize(product.pings); };
  if (is_there(ping + step)) return at(ping) + (at(ping + step) - at(ping)) / 2;
  if (is_there(ping - step)) return at(ping) + (at(ping) - at(ping - step)) / 2;
  return at(ping) + step * kSecondNs / 2;
}

struct Corner {
  TimeNs time = 0;
  double range_m = 0.0;
};

/// Along the near side in time, back along the far one.
std::vector<Corner> polygon(const ObservationProduct& product, std::span<const Stretch> pings) {
  const TimeNs begin = half_way(product, pings.front().ping, -1);
  const TimeNs end = half_way(product, pings.back().ping, 1);
  std::vector<Corner> near = {{begin, pings.front().near_m}};
  std::vector<Corner> far = {{begin, pings.front().far_m}};
  for (const Stretch& one : pings) {
    const TimeNs time = product.pings[static_cast<std::size_t>(one.ping)].time;
    near.push_back({time, one.near_m});
    far.push_back({time, one.far_m});
  }
  near.push_back({end, pings.back().near_m});
  far.push_back({end, pings.back().far_m});
  near.insert(near.end(), far.rbegin(), far.rend());
  return near;
}

/// What an outline does not hold: the fan, its beams, and the cells of each ping, so that they can be read back.
std::vector<std::string> notes(const ObservationProduct& product, int fan, std::span<const Stretch> pings) {
  int first = std::numeric_limits<int>::max();
  int last = 0;
  std::vector<std::string> lines(2);
  for (const Stretch& one : pings) {
    lines.push_back("cells " + echoview_time(product.pings[static_cast<std::size_t>(one.ping)].time));
    for (const Run& run : one.runs) {
      first = std::min(first, run.row);
      last = std::max(last, run.row);
      lines.back() += fmt::format(" {} {} {}", run.row, run.first_sample, run.count);
    }
  }
  lines[0] = fmt::format("fan {}", fan);
  lines[1] = fmt::format("beams {} {}", first, last);
  return lines;
}

std::string region(const ObservationProduct& product, const SchoolRow& school, int fan, std::span<const Stretch> pings,
                   std::size_t number) {
  const std::vector<Corner> corners = polygon(product, pings);
  const auto [top, bottom] = std::ranges::minmax(corners, {}, &Corner::range_m);
  std::string out = fmt::format("{}13 {} {} 0 {} -1 1 {} {:.4f} {} {:.4f}{}", kEnd, corners.size(), number,
                                kMadeElsewhere, echoview_time(corners.front().time), top.range_m,
                                echoview_time(half_way(product, pings.back().ping, 1)), bottom.range_m, kEnd);
  const std::vector<std::string> lines = notes(product, fan, pings);
  out += fmt::format("{}{}", lines.size(), kEnd);
  for (const std::string& line : lines) out += line + kEnd;
  out += fmt::format("0{}{}{}", kEnd, school.species.empty() ? kNoSpecies : one_line(school.species), kEnd);
  for (const Corner& corner : corners) out += fmt::format("{} {:.4f} ", echoview_time(corner.time), corner.range_m);
  return out + fmt::format("{}{}{}/{}{}", kAnalysis, kEnd, product.observation, school.school_id, kEnd);
}

}  // namespace

std::string evr_text(const ObservationProduct& product, int fan) {
  std::string regions;
  std::size_t number = 0;
  for (const SchoolRow& school : product.schools) {
    if (school.status == "rejected") continue;
    const std::vector<Stretch> pings = stretches(product, school.school_id, fan);
    for (std::size_t first = 0; first < pings.size();) {
      std::size_t end = first + 1;
      while (end < pings.size() && pings[end].ping == pings[end - 1].ping + 1) ++end;
      regions += region(product, school, fan, std::span(pings).subspan(first, end - first), ++number);
      first = end;
    }
  }
  if (number == 0) return {};
  return fmt::format("{}EVRG 7 {}{}{}{}", kByteOrderMark, kProgram, kEnd, number, kEnd) + regions;
}

std::string evl_text(const ObservationProduct& product) {
  std::map<std::int64_t, std::vector<double>> depths;
  for (const SchoolPingRow& row : product.school_pings) {
    const bool inside = row.ping_index >= 0 && row.ping_index < std::ssize(product.pings);
    if (inside && std::isfinite(row.bottom_depth_m)) depths[row.ping_index].push_back(row.bottom_depth_m);
  }
  if (depths.empty()) return {};
  std::string out = fmt::format("{}EVBD 3 {}{}{}{}", kByteOrderMark, kProgram, kEnd, depths.size(), kEnd);
  for (auto& [ping, values] : depths) {
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::ranges::nth_element(values, middle);
    out += fmt::format("{} {:.4f} {}{}", echoview_time(product.pings[static_cast<std::size_t>(ping)].time), *middle,
                       kUnverified, kEnd);
  }
  return out;
}

}  // namespace sonar
