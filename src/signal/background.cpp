// SPDX-License-Identifier: Apache-2.0
#include "signal/background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "base/check.h"
#include "base/middle.h"
#include "base/units.h"
#include "signal/column_quantiles.h"
#include "signal/flag_kernels.h"
#include "signal/noise_beside_water.h"
#include "signal/row_kernels.h"

namespace sonar {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using Row = std::span<const std::int16_t>;

struct Block {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The blocks of a row that levels are told of.
std::vector<Block> blocks_of(std::size_t samples, const BackgroundParams& params) {
  std::vector<Block> blocks;
  if (params.method == BackgroundMethod::de_robertis) {
    const auto length = static_cast<std::size_t>(params.block_samples);
    for (std::size_t first = 0; first < samples; first += length) {
      blocks.push_back({first, std::min(length, samples - first)});
    }
    return blocks;
  }
  const auto far = static_cast<std::size_t>(std::ceil(params.far_fraction * static_cast<double>(samples)));
  const auto edge = [&](std::size_t k) { return samples - far + k * far / kFarBlocks; };
  for (std::size_t k = 0; k < kFarBlocks; ++k) blocks.push_back({edge(k), edge(k + 1) - edge(k)});
  return blocks;
}

/// Share of the samples of an exponential below the one of a rank, half of the times more and half less: levels of single
/// pings enter a median.
double share_at_rank(std::size_t rank, std::size_t data) {
  return (static_cast<double>(rank) + 0.7) / (static_cast<double>(data) + 0.4);  // Benard's
}

/// in  samples with kNoData where they are flagged; it lies below all data, so ranks are shifted by its number
std::int16_t low_quantile_level(Row block, std::size_t data, double quantile) {
  const auto rank = std::min(data - 1, static_cast<std::size_t>(quantile * static_cast<double>(data)));
  const std::int16_t most = *std::ranges::max_element(block);
  const std::int16_t value = select_rank(block, block.size() - data + rank, kNoData + 1, most);
  return count_from_linear(linear_from_count(value) / -std::log1p(-share_at_rank(rank, data)));
}

std::int16_t mean_level(Row block, std::size_t data) {
  double sum = 0.0;
  for (const std::int16_t count : block) sum += linear_from_count(count);
  return sum > 0.0 ? count_from_linear(sum / static_cast<double>(data)) : kNoData;
}

/// Means of the data in each column of a matrix, which has as many as the shape has values.
Array3<std::int16_t> mean_over_rows(Row matrix, const Shape3& shape) {
  Array3<std::int16_t> out(shape, kNoData);
  const std::size_t columns = out.all().size();
  std::vector<std::int16_t> known;
  for (std::size_t i = 0; i < columns; ++i) {
    known.clear();
    for (std::size_t at = i; at < matrix.size(); at += columns) {
      if (matrix[at] != kNoData) known.push_back(matrix[at]);
    }
    if (!known.empty()) out.all()[i] = mean_level(known, known.size());
  }
  return out;
}

/// The same for medians; of an even number the mean, linear, of the two in the middle.
Array3<std::int16_t> median_over_rows(Row matrix, const Shape3& shape) {
  constexpr std::array kMiddles = {0.5, 0.4999};  // of an odd number below 5000 the same rank
  Array3<std::int16_t> out(shape);
  const std::size_t columns = out.all().size();
  std::vector<std::int16_t> known(columns);
  std::vector<std::int16_t> middles(2 * columns);
  column_quantiles(matrix, kMiddles, known, middles);
  for (std::size_t i = 0; i < columns; ++i) {
    const std::int16_t high = middles[i];
    const std::int16_t low = middles[columns + i];
    out.all()[i] = low == high ? high : count_from_linear(0.5 * (linear_from_count(high) + linear_from_count(low)));
  }
  return out;
}

/// Sv of each block that half of a fan's beams lie below, and their gain there; 0 where none is known.
struct FanLevels {
  std::array<double, kFarBlocks> sv{};
  std::array<double, kFarBlocks> gain{};
};

FanLevels fan_levels(View3<const std::int16_t> levels, View3<const double> gain, int fan) {
  FanLevels out;
  std::vector<double> sv;
  std::vector<double> gains;
  for (int k = 0; k < levels.shape().samples; ++k) {
    sv.clear();
    gains.clear();
    for (int beam = 0; beam < levels.shape().beams; ++beam) {
      if (levels(fan, beam, k) == kNoData || !(gain(fan, beam, k) > 0.0)) continue;
      sv.push_back(linear_from_count(levels(fan, beam, k)) * gain(fan, beam, k));
      gains.push_back(gain(fan, beam, k));
    }
    if (sv.empty()) continue;
    out.sv[static_cast<std::size_t>(k)] = middle_of(sv);
    out.gain[static_cast<std::size_t>(k)] = middle_of(gains);
  }
  return out;
}

double fan_water_sv(const FanLevels& fan) {
  std::vector<double> sv;
  std::vector<double> gain;
  for (std::size_t k = 0; k < kFarBlocks; ++k) {
    if (!(fan.sv[k] > 0.0)) continue;
    sv.push_back(fan.sv[k]);
    gain.push_back(fan.gain[k]);
  }
  return uniform_water_sv(sv, gain);
}

/// Noise power of one row, linear; 0 where no level is known.
double row_noise(Row levels, std::span<const double> gain, const FanLevels& fan, double water_sv, double spread) {
  std::vector<double> power;
  std::vector<double> water;
  std::vector<double> usual;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (levels[k] == kNoData) continue;
    const bool calibrated = gain[k] > 0.0;
    power.push_back(linear_from_count(levels[k]));
    water.push_back(calibrated ? water_sv / gain[k] : 0.0);
    usual.push_back(calibrated ? fan.sv[k] / gain[k] : power.back());
  }
  return power.empty() ? 0.0 : noise_beside_water(power, water, usual, spread);
}

std::int16_t distance(std::int16_t a, std::int16_t b) {
  return static_cast<std::int16_t>(std::min<int>(std::abs(a - b), kMaxCount));
}

std::int16_t weakest_level(Row levels) {
  std::int16_t weakest = kNoData;
  for (const std::int16_t level : levels) {
    if (level != kNoData && (weakest == kNoData || level < weakest)) weakest = level;
  }
  return weakest;
}

/// The count at or just above a level; outside the range of counts its end.
std::int16_t count_from_db(double db) {
  return static_cast<std::int16_t>(std::lround(std::clamp<double>(counts_from_db(db), kMinCount, kMaxCount)));
}

}  // namespace

Array3<std::int16_t> background_levels(View3<const std::int16_t> power, View3<const SampleFlags> flags,
                                       const BackgroundParams& params) {
  SONAR_CHECK(power.shape() == flags.shape());
  const auto [fans, beams, samples] = power.shape();
  const std::vector<Block> blocks = blocks_of(static_cast<std::size_t>(samples), params);
  Array3<std::int16_t> levels({fans, beams, static_cast<int>(blocks.size())}, kNoData);
  std::vector<std::int16_t> sound(static_cast<std::size_t>(samples));
  for (int row = 0; row < fans * beams; ++row) {
    copy_unflagged(power.row(row), flags.row(row), kNotFiltered, 0, sound);
    const std::size_t before = blocks.empty() ? 0 : blocks.front().first;
    if (count_data(std::span(sound).subspan(before)) < static_cast<std::size_t>(params.minimum_samples)) continue;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const Row block = std::span(sound).subspan(blocks[k].first, blocks[k].count);
      const std::size_t data = count_data(block);
      if (data == 0 || 2 * data < block.size()) continue;
      levels.view().row(row)[k] = params.method == BackgroundMethod::de_robertis
                                      ? mean_level(block, data)
                                      : low_quantile_level(block, data, params.quantile);
    }
  }
  return levels;
}

Array3<std::int16_t> levels_over_pings(std::span<const Array3<std::int16_t>* const> pings,
                                       const BackgroundParams& params) {
  SONAR_CHECK(!pings.empty());
  const Shape3 shape = pings.front()->shape();
  std::vector<std::int16_t> matrix;
  for (const auto* ping : pings) {
    SONAR_CHECK(ping->shape() == shape);
    matrix.insert(matrix.end(), ping->all().begin(), ping->all().end());
  }
  return params.method == BackgroundMethod::de_robertis ? mean_over_rows(matrix, shape)
                                                        : median_over_rows(matrix, shape);
}

void keep_quieter(View3<const std::int16_t> own, double quiet_db, View3<std::int16_t> levels) {
  SONAR_CHECK(own.shape() == levels.shape());
  for (int row = 0; row < static_cast<int>(own.shape().rows()); ++row) {
    const std::int16_t own_weakest = weakest_level(own.row(row));
    const std::int16_t weakest = weakest_level(levels.row(row));
    if (own_weakest == kNoData || weakest == kNoData) continue;
    if (own_weakest < weakest - counts_from_db(quiet_db)) std::ranges::copy(own.row(row), levels.row(row).begin());
  }
}

Array3<double> block_gain(View3<const std::int16_t> table, const BackgroundParams& params) {
  const auto [fans, beams, samples] = table.shape();
  const std::vector<Block> blocks = blocks_of(static_cast<std::size_t>(samples), params);
  Array3<double> gain({fans, beams, static_cast<int>(blocks.size())});
  for (int row = 0; row < fans * beams; ++row) {
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const Row block = table.row(row).subspan(blocks[k].first, blocks[k].count);
      double sum = 0.0;
      for (const std::int16_t count : block) sum += linear_from_count(count);
      if (count_data(block) == block.size() && !block.empty()) {
        gain.view().row(row)[k] = sum / static_cast<double>(block.size());
      }
    }
  }
  return gain;
}

double level_spread(std::span<const Array3<std::int16_t>* const> pings, View3<const std::int16_t> levels, int samples,
                    const BackgroundParams& params) {
  SONAR_CHECK(!pings.empty());
  const auto count = static_cast<double>(pings.size());
  if (pings.size() < 3) {
    const double p = params.quantile;
    const double data = std::max(1.0, params.far_fraction * samples / kFarBlocks);
    return std::sqrt(p / (1.0 - p) / data) / -std::log1p(-p) / std::sqrt(count);
  }
  std::vector<std::int16_t> apart;
  apart.reserve(pings.size() * levels.all().size());
  std::size_t known = 0;
  for (const auto* ping : pings) {
    SONAR_CHECK(ping->shape() == levels.shape());
    for (std::size_t i = 0; i < levels.all().size(); ++i) {
      const bool told = ping->all()[i] != kNoData;
      known += told ? 1U : 0U;
      // what is not told lies behind all ranks that are
      apart.push_back(told ? distance(ping->all()[i], levels.all()[i]) : kMaxCount);
    }
  }
  if (known == 0) return 0.0;
  const double single =
      kStandardOverMiddleDeviation * (linear_from_db(db_from_counts(select_rank(apart, known / 2, 0))) - 1.0);
  return single * std::sqrt(std::numbers::pi / 2.0 / count);  // of a median
}

std::vector<double> noise_power_db(View3<const std::int16_t> levels, double spread, View3<const double> gain,
                                   const BackgroundParams& params) {
  std::vector<double> level_db;
  if (params.method == BackgroundMethod::de_robertis) {
    for (int row = 0; row < static_cast<int>(levels.shape().rows()); ++row) {
      const std::int16_t weakest = weakest_level(levels.row(row));
      level_db.push_back(weakest == kNoData ? kUnknown : std::min(db_from_counts(weakest), params.maximum_db));
    }
    return level_db;
  }
  SONAR_CHECK(gain.shape() == levels.shape() && levels.shape().samples == kFarBlocks);
  for (int fan = 0; fan < levels.shape().fans; ++fan) {
    const FanLevels of_fan = fan_levels(levels, gain, fan);
    const double water_sv = fan_water_sv(of_fan);
    for (int beam = 0; beam < levels.shape().beams; ++beam) {
      const double noise = row_noise(levels.row(fan, beam), gain.row(fan, beam), of_fan, water_sv, spread);
      level_db.push_back(noise > 0.0 ? db_from_linear(noise) : kUnknown);
    }
  }
  return level_db;
}

std::vector<double> noise_sv_db(double level_db, std::span<const std::int16_t> table) {
  std::vector<double> sv_db(table.size(), kUnknown);
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i] != kNoData) sv_db[i] = level_db + db_from_counts(table[i]);
  }
  return sv_db;
}

std::vector<std::int16_t> noise_sv_counts(double level_db, double margin_db, std::span<const std::int16_t> table) {
  std::vector<std::int16_t> limit(table.size(), kNoData);
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i] == kNoData) continue;
    limit[i] = std::isnan(level_db) ? kMinCount : count_from_db(level_db + margin_db + db_from_counts(table[i]));
  }
  return limit;
}

void flag_low_snr(View3<const std::int16_t> power, std::span<const double> level_db, double margin_db,
                  View3<SampleFlags> flags) {
  SONAR_CHECK(power.shape() == flags.shape() && level_db.size() == power.shape().rows());
  for (std::size_t row = 0; row < level_db.size(); ++row) {
    if (std::isnan(level_db[row])) continue;
    const int index = static_cast<int>(row);
    flag_below(power.row(index), count_from_db(level_db[row] + margin_db), SampleFlags::low_snr, flags.row(index));
  }
}

void flag_low_snr(std::span<const std::int16_t> sv, std::span<const std::int16_t> limit, std::span<SampleFlags> flags) {
  flag_below(sv, limit, SampleFlags::low_snr, flags);
}

}  // namespace sonar
