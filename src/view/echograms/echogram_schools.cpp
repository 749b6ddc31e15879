// SPDX-License-Identifier: Apache-2.0
#include "view/echograms/echogram_schools.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/units.h"

namespace sonar {
namespace {

/// The bins of a range that hold a sample of a mask; runs of rows that are not shown are passed over.
std::vector<bool> bins_of(const PingMask& mask, std::span<const EchogramRow> rows, const EchogramRange& range) {
  std::vector<bool> bins(static_cast<std::size_t>(range.bins), false);
  for (const Run& run : mask.runs) {
    // Rows of an echogram rise as those of a mask do.
    const auto row = std::lower_bound(rows.begin(), rows.end(), run.row,
                                      [](const EchogramRow& a, std::int32_t wanted) { return a.row < wanted; });
    if (row == rows.end() || row->row != run.row) continue;
    for (int sample = run.first_sample; sample < run.end(); ++sample) {
      const int bin = bin_of(range, row->height_m(sample));
      if (bin >= 0) bins[static_cast<std::size_t>(bin)] = true;
    }
  }
  return bins;
}

void add_stretches(const std::vector<bool>& bins, const EchogramRange& range, std::size_t ping,
                   std::vector<EchogramStretch>& out) {
  for (std::size_t b = 0; b < bins.size(); ++b) {
    if (!bins[b]) continue;
    const std::size_t first = b;
    while (b < bins.size() && bins[b]) ++b;
    out.push_back({ping, range.first_m + static_cast<double>(first) * range.bin_m,
                   range.first_m + static_cast<double>(b) * range.bin_m});
  }
}

using Interval = std::pair<double, double>;

/// What of some intervals no other covers.
std::vector<Interval> without(std::span<const Interval> some, std::span<const Interval> others) {
  std::vector<Interval> out;
  for (const auto& [from, to] : some) {
    double at = from;
    for (const auto& [start, end] : others) {
      if (end <= at || start >= to) continue;
      if (start > at) out.emplace_back(at, start);
      at = std::max(at, end);
    }
    if (at < to) out.emplace_back(at, to);
  }
  return out;
}

using Corner = std::pair<double, double>;
using Edges = std::multimap<Corner, Corner>;

bool in_line(const Corner& a, const Corner& b, const Corner& c) {
  return (a.first == b.first && b.first == c.first) || (a.second == b.second && b.second == c.second);
}

/// A ring from the first edge on; its edges are taken out.
PathItem::Part ring_from(Edges& edges) {
  std::vector<Corner> ring;
  const Corner start = edges.begin()->first;
  Corner at = start;
  do {
    while (ring.size() > 1 && in_line(ring[ring.size() - 2], ring.back(), at)) ring.pop_back();
    ring.push_back(at);
    const auto next = edges.find(at);
    if (next == edges.end()) break;  // no ring: cannot be, every corner has as many edges out as in
    at = next->second;
    edges.erase(next);
  } while (at != start);
  while (ring.size() > 2 && in_line(ring[ring.size() - 2], ring.back(), start)) ring.pop_back();
  PathItem::Part part;
  part.closed = true;
  for (const auto& [x, y] : ring) part.points.push_back({x, y});
  return part;
}

}  // namespace

std::vector<EchogramSchool> echogram_schools(const ObservationProduct& product, const RowsOfPing& rows,
                                             const EchogramRange& range, std::int64_t first, std::int64_t pings) {
  std::vector<EchogramSchool> out;
  std::map<std::int64_t, std::vector<EchogramRow>> known;
  for (const SchoolRow& school : product.schools) {
    EchogramSchool one{school.school_id, school.status, {}};
    for (const SchoolMask& mask : product.masks) {
      if (mask.school_id != school.school_id || mask.ping_index < first || mask.ping_index >= first + pings) continue;
      auto of_ping = known.find(mask.ping_index);
      if (of_ping == known.end()) of_ping = known.emplace(mask.ping_index, rows(mask.ping_index)).first;
      add_stretches(bins_of(mask.mask, of_ping->second, range), range,
                    static_cast<std::size_t>(mask.ping_index - first), one.stretches);
    }
    if (!one.stretches.empty()) out.push_back(std::move(one));
  }
  return out;
}

std::vector<EchogramStretch> echogram_shadow(std::span<const std::vector<double>> shadow,
                                             std::span<const EchogramRow> rows, const EchogramRange& range, int samples,
                                             double least_db, std::size_t ping) {
  const auto beam_of = [&](const EchogramRow& row) -> const std::vector<double>& {
    return shadow[static_cast<std::size_t>(row.row)];
  };
  if (std::ranges::all_of(rows, [&](const EchogramRow& row) { return beam_of(row).empty(); })) return {};
  struct Left {
    double sum = 0.0;
    int samples = 0;
  };
  std::vector<Left> left(static_cast<std::size_t>(range.bins));
  for (const EchogramRow& row : rows) {
    const std::vector<double>& beam = beam_of(row);
    for (int s = 0; s < samples; ++s) {
      const int bin = bin_of(range, row.height_m(s));
      if (bin < 0) continue;
      Left& of = left[static_cast<std::size_t>(bin)];
      of.sum += beam.empty() ? 1.0 : 1.0 / beam[static_cast<std::size_t>(s)];
      ++of.samples;
    }
  }
  const double most = linear_from_db(-least_db);
  std::vector<bool> bins;
  for (const Left& of : left) bins.push_back(of.samples > 0 && of.sum <= most * of.samples);
  std::vector<EchogramStretch> out;
  add_stretches(bins, range, ping, out);
  return out;
}

std::vector<RefusedEcho> echogram_refused(std::span<const RefusedEcho> echoes, const BeamGrid& grid,
                                          const RowsOfPing& rows, std::int64_t first, std::int64_t pings) {
  std::vector<RefusedEcho> out;
  const std::vector<int> row_of_channel = grid.row_of_channel();
  for (const RefusedEcho& echo : echoes) {
    if (echo.ping_index < first || echo.ping_index >= first + pings) continue;
    const auto channel = static_cast<std::size_t>(echo.channel);
    if (echo.channel < 0 || channel >= row_of_channel.size()) continue;
    for (const EchogramRow& row : rows(echo.ping_index)) {
      if (row.row != row_of_channel[channel]) continue;
      RefusedEcho& here = out.emplace_back(echo);
      here.ping_index -= first;
      here.range_m = row.height_m(static_cast<double>(echo.sample));
    }
  }
  return out;
}

std::vector<PathItem::Part> outline_of_columns(std::span<const OutlinedColumn> columns) {
  Edges edges;
  const std::vector<Interval> none;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const OutlinedColumn& c = columns[i];
    const bool joined_left = i > 0 && columns[i - 1].to == c.from;
    const bool joined_right = i + 1 < columns.size() && columns[i + 1].from == c.to;
    for (const auto& [top, bottom] : c.stretches) {
      edges.emplace(Corner{c.from, top}, Corner{c.to, top});
      edges.emplace(Corner{c.to, bottom}, Corner{c.from, bottom});
    }
    for (const auto& [top, bottom] : without(c.stretches, joined_left ? columns[i - 1].stretches : none)) {
      edges.emplace(Corner{c.from, bottom}, Corner{c.from, top});
    }
    for (const auto& [top, bottom] : without(c.stretches, joined_right ? columns[i + 1].stretches : none)) {
      edges.emplace(Corner{c.to, top}, Corner{c.to, bottom});
    }
  }
  std::vector<PathItem::Part> rings;
  while (!edges.empty()) rings.push_back(ring_from(edges));
  return rings;
}

}  // namespace sonar
