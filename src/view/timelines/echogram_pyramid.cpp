// SPDX-License-Identifier: Apache-2.0
#include "view/timelines/echogram_pyramid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.h"

namespace sonar {

std::int16_t EchogramCell::mean_count() const {
  if (empty()) return kNoData;
  const double sv = static_cast<double>(sv_volume) / static_cast<double>(volume_m3);
  if (!(sv > 0.0)) return kMinCount;
  const double count = std::round(counts_from_db(db_from_linear(sv)));
  return static_cast<std::int16_t>(std::clamp(count, static_cast<double>(kMinCount), static_cast<double>(kMaxCount)));
}

void EchogramCell::add(const EchogramCell& other) {
  if (other.empty()) return;
  sv_volume += other.sv_volume;
  volume_m3 += other.volume_m3;
  low = std::min(low, other.low);
  high = std::max(high, other.high);
}

EchogramRange echogram_range(const RangeAxis& axis, int most) {
  EchogramRange r;
  const double last_m = std::max(axis.spacing_m, axis.range_m(axis.count - 0.5));
  const int samples = std::max(1, static_cast<int>(std::ceil(last_m / axis.spacing_m)));
  r.bins = std::clamp(samples, 1, std::max(1, most));
  r.bin_m = std::max(axis.spacing_m, last_m / r.bins);
  return r;
}

EchogramColumn::EchogramColumn(const EchogramRange& range, int samples)
    : range_(range),
      bin_of_(static_cast<std::size_t>(std::max(0, samples)), -1),
      sums_(static_cast<std::size_t>(range.bins), 0.0),
      volumes_(static_cast<std::size_t>(range.bins), 0.0),
      cells_(static_cast<std::size_t>(range.bins)) {}

int bin_of(const EchogramRange& range, double height_m) {
  // What lies on an edge falls below it, however its sum was rounded: else rows would be doubled and others left empty.
  constexpr double kOnEdge = 1e-6;
  const double bin = std::floor((height_m - range.first_m) / range.bin_m + kOnEdge);
  return bin >= 0.0 && bin < range.bins ? static_cast<int>(bin) : -1;
}

void EchogramColumn::lay(double first_m, double step_m) {
  if (first_m == first_m_ && step_m == step_m_) return;
  first_m_ = first_m;
  step_m_ = step_m;
  for (std::size_t i = 0; i < bin_of_.size(); ++i) {
    const double height_m = first_m + static_cast<double>(i) * step_m;
    bin_of_[i] = bin_of(range_, height_m);
  }
}

void EchogramColumn::lay(std::span<const double> heights_m) {
  SONAR_CHECK(heights_m.size() == bin_of_.size());
  first_m_ = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < bin_of_.size(); ++i) bin_of_[i] = bin_of(range_, heights_m[i]);
}

void EchogramColumn::add(const Beam& beam, SampleFlags hidden) {
  const std::size_t samples = std::min({bin_of_.size(), beam.counts.size(), beam.flags.size(), beam.volumes_m3.size()});
  for (std::size_t i = 0; i < samples; ++i) {
    if (bin_of_[i] < 0 || beam.counts[i] == kNoData || any(beam.flags[i] & hidden)) continue;
    const double v = beam.volumes_m3[i];
    if (!(v > 0.0)) continue;
    const auto b = static_cast<std::size_t>(bin_of_[i]);
    sums_[b] += linear_from_count(beam.counts[i]) * v;
    volumes_[b] += v;
    cells_[b].low = std::min(cells_[b].low, beam.counts[i]);
    cells_[b].high = std::max(cells_[b].high, beam.counts[i]);
  }
}

std::vector<EchogramCell> EchogramColumn::cells() const {
  std::vector<EchogramCell> out = cells_;
  for (std::size_t b = 0; b < out.size(); ++b) {
    out[b].sv_volume = static_cast<float>(sums_[b]);
    out[b].volume_m3 = static_cast<float>(volumes_[b]);
  }
  return out;
}

std::vector<EchogramCell> echogram_column(const Sector& sector, const Volume& volume, SampleFlags hidden,
                                          const EchogramRange& range) {
  const Shape3& shape = volume.counts.shape();
  SONAR_CHECK(shape == volume.flags.shape() && shape.fans == sector.fans() && shape.beams == sector.beams());
  const int samples = std::min(shape.samples, sector.range().count);
  EchogramColumn column(range, samples);
  column.lay(sector.range().first_m, sector.range().spacing_m);
  std::vector<double> volumes(static_cast<std::size_t>(std::max(0, samples)));
  for (int fan = 0; fan < shape.fans; ++fan) {
    for (int beam = 0; beam < shape.beams; ++beam) {
      for (int s = 0; s < samples; ++s) volumes[static_cast<std::size_t>(s)] = sector.volume_m3(fan, beam, s);
      column.add({volume.counts.row(fan, beam), volume.flags.row(fan, beam), volumes}, hidden);
    }
  }
  return column.cells();
}

namespace {

/// Of the level above one.
int bins_above(int bins) {
  const int half = (bins + 1) / 2;
  return half >= EchogramPyramid::kLeastBins ? half : bins;
}

}  // namespace

EchogramPyramid EchogramPyramid::coarser(int level) const {
  const int first = std::clamp(level, 0, levels() - 1);
  EchogramPyramid out(range_.coarser(bins(first)), pings_per_column_ << first);
  out.times_ = times_;
  out.distances_ = distances_;
  out.levels_.assign(levels_.begin() + first, levels_.end());
  return out;
}

std::optional<EchogramPyramid> EchogramPyramid::of_parts(const EchogramRange& range, int pings_per_column,
                                                         std::vector<TimeNs> times, std::vector<double> distances_nmi,
                                                         std::vector<EchogramLevel> levels) {
  constexpr int kMostPings = 1 << 30;
  if (range.bins < 1 || pings_per_column < 1 || pings_per_column > kMostPings || times.size() > kMostPings ||
      levels.empty() || times.size() != distances_nmi.size() || !std::is_sorted(times.begin(), times.end())) {
    return std::nullopt;
  }
  const auto per_column = static_cast<std::size_t>(pings_per_column);
  std::size_t columns = times.size() / per_column + (times.size() % per_column != 0 ? 1 : 0);
  int bins = range.bins;
  for (const EchogramLevel& level : levels) {
    const bool last = &level == &levels.back();
    if (level.columns != columns || level.bins != bins || last != (columns <= 1)) return std::nullopt;
    const auto cells = static_cast<std::size_t>(bins);
    if (level.cells.size() % cells != 0 || level.cells.size() / cells != columns) return std::nullopt;
    columns = (columns + 1) / 2;
    bins = bins_above(bins);
  }
  EchogramPyramid out(range, pings_per_column);
  out.times_ = std::move(times);
  out.distances_ = std::move(distances_nmi);
  out.levels_ = std::move(levels);
  return out;
}

EchogramPyramid::EchogramPyramid(const EchogramRange& range, int pings_per_column)
    : range_(range), pings_per_column_(std::max(1, pings_per_column)) {
  levels_.push_back({range_.bins, 0, {}});
}

const EchogramCell& EchogramPyramid::cell(int level, std::size_t column, int bin) const {
  const EchogramLevel& l = levels_[static_cast<std::size_t>(level)];
  return l.cells[column * static_cast<std::size_t>(l.bins) + static_cast<std::size_t>(bin)];
}

void EchogramPyramid::renew(std::size_t level, std::size_t column) {
  const EchogramLevel& below = levels_[level - 1];
  EchogramLevel& l = levels_[level];
  const int factor = l.bins < below.bins ? 2 : 1;
  if (column >= l.columns) {
    l.columns = column + 1;
    l.cells.resize(l.columns * static_cast<std::size_t>(l.bins));
  }
  for (int bin = 0; bin < l.bins; ++bin) {
    EchogramCell cell;
    for (std::size_t c = 2 * column; c < std::min(below.columns, 2 * column + 2); ++c) {
      for (int b = factor * bin; b < std::min(below.bins, factor * (bin + 1)); ++b) {
        cell.add(below.cells[c * static_cast<std::size_t>(below.bins) + static_cast<std::size_t>(b)]);
      }
    }
    l.cells[column * static_cast<std::size_t>(l.bins) + static_cast<std::size_t>(bin)] = cell;
  }
}

void EchogramPyramid::add_ping(TimeNs time, std::span<const EchogramCell> column, double distance_nmi) {
  SONAR_CHECK(column.empty() || column.size() == static_cast<std::size_t>(range_.bins));
  SONAR_CHECK(times_.empty() || time >= times_.back());
  times_.push_back(time);
  distances_.push_back(distance_nmi);
  const std::size_t at = (times_.size() - 1) / static_cast<std::size_t>(pings_per_column_);
  {
    EchogramLevel& base = levels_.front();
    if (at >= base.columns) {
      base.columns = at + 1;
      base.cells.resize(base.columns * static_cast<std::size_t>(base.bins));
    }
    for (std::size_t b = 0; b < column.size(); ++b) {
      base.cells[at * static_cast<std::size_t>(base.bins) + b].add(column[b]);
    }
  }
  // A level more where the last one has several columns; then every level's last column is made again.
  while (levels_.back().columns > 1) {
    const std::size_t below = levels_.size() - 1;
    const std::size_t columns = (levels_[below].columns + 1) / 2;
    levels_.push_back({bins_above(levels_[below].bins), 0, {}});
    for (std::size_t c = 0; c < columns; ++c) renew(below + 1, c);
  }
  std::size_t last = at;
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    last /= 2;
    renew(level, last);
  }
}

}  // namespace sonar
