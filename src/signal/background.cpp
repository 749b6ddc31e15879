// SPDX-License-Identifier: Apache-2.0
#include "signal/background.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "base/units.h"
#include "signal/flag_kernels.h"
#include "signal/row_kernels.h"

namespace sonar {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using Row = std::span<const std::int16_t>;

/// The far part of a row, and its last half and quarter.
constexpr std::size_t kFarParts = 3;

/// in  samples with kNoData where they are flagged; it lies below all data, so ranks are shifted by its number
double low_quantile_db(Row used, const BackgroundParams& params) {
  const std::size_t data = count_data(used);
  if (data == 0 || data < static_cast<std::size_t>(params.minimum_samples)) return kUnknown;
  const auto rank = std::min(data - 1, static_cast<std::size_t>(params.quantile * static_cast<double>(data)));
  const std::int16_t value = select_rank(used, used.size() - data + rank);
  // The sample of this rank lies on average at this quantile of the distribution.
  const double p = static_cast<double>(rank + 1) / static_cast<double>(data + 1);
  return db_from_counts(value) - 10.0 * std::log10(-std::log1p(-p));
}

void far_levels_db(Row row, const BackgroundParams& params, std::span<double> level_db) {
  std::size_t recorded = row.size();
  while (recorded > 0 && row[recorded - 1] == kNoData) --recorded;
  double share = params.far_fraction;
  for (double& level : level_db) {
    const auto far = static_cast<std::size_t>(std::ceil(share * static_cast<double>(recorded)));
    level = low_quantile_db(row.first(recorded).last(std::min(far, recorded)), params);
    share /= 2.0;
  }
}

/// Mean power of each block of a row, of which half at least is sound.
void block_means_db(Row row, std::size_t block, std::span<double> level_db) {
  std::size_t index = 0;
  for (std::size_t first = 0; first < row.size(); first += block, ++index) {
    double sum = 0.0;
    std::size_t data = 0;
    for (const std::int16_t count : row.subspan(first, std::min(block, row.size() - first))) {
      if (count == kNoData) continue;
      sum += linear_from_count(count);
      ++data;
    }
    level_db[index] = 2 * data > block && sum > 0.0 ? db_from_linear(sum / static_cast<double>(data)) : kUnknown;
  }
}

double median_level_db(std::vector<double>& known) {
  if (known.empty()) return kUnknown;
  std::sort(known.begin(), known.end());
  const double high_db = known[known.size() / 2];
  if (known.size() % 2 == 1) return high_db;
  const double low_db = known[known.size() / 2 - 1];
  return db_from_linear(0.5 * (linear_from_db(low_db) + linear_from_db(high_db)));
}

double linear_mean_db(std::span<const double> known_db) {
  double sum = 0.0;
  for (const double db : known_db) sum += linear_from_db(db);
  return db_from_linear(sum / static_cast<double>(known_db.size()));
}

/// Whether most beams go down that far from the whole of their far part to its weakest end. One beam may have heard a
/// school or the surface before it was quiet; what all hear is water.
bool falls(std::span<const double> whole_db, std::span<const double> weakest_db, double fall_db) {
  std::size_t known = 0;
  std::size_t falling = 0;
  for (std::size_t row = 0; row < whole_db.size(); ++row) {
    if (std::isnan(whole_db[row])) continue;
    ++known;
    falling += weakest_db[row] < whole_db[row] - fall_db ? 1U : 0U;
  }
  return 2 * falling > known;
}

/// The count at or just above a level; outside the range of counts its end.
std::int16_t count_from_db(double db) {
  return static_cast<std::int16_t>(std::lround(std::clamp<double>(counts_from_db(db), kMinCount, kMaxCount)));
}

}  // namespace

std::vector<double> background_power_db(View3<const std::int16_t> power, View3<const SampleFlags> flags,
                                        const BackgroundParams& params) {
  SONAR_CHECK(power.shape() == flags.shape());
  const std::size_t rows = power.shape().rows();
  const auto samples = static_cast<std::size_t>(power.shape().samples);
  const bool by_blocks = params.method == BackgroundMethod::de_robertis;
  const auto block = static_cast<std::size_t>(params.block_samples);
  const std::size_t figures = by_blocks ? (samples + block - 1) / block : kFarParts;
  std::vector<double> level_db(rows * figures, kUnknown);
  std::vector<std::int16_t> sound(samples);
  for (std::size_t row = 0; row < rows; ++row) {
    const int index = static_cast<int>(row);
    copy_unflagged(power.row(index), flags.row(index), kNotFiltered, 0, sound);
    const std::span<double> out = std::span(level_db).subspan(row * figures, figures);
    if (!by_blocks) {
      far_levels_db(sound, params, out);
    } else if (count_data(sound) >= static_cast<std::size_t>(params.minimum_samples)) {
      block_means_db(sound, block, out);
    }
  }
  return level_db;
}

std::vector<double> combine_background(std::span<const std::vector<double>> pings, std::size_t rows,
                                       const BackgroundParams& params) {
  if (pings.empty() || rows == 0) return {};
  const std::size_t figures = pings.front().size() / rows;
  const bool by_blocks = params.method == BackgroundMethod::de_robertis;
  std::vector<double> weakest(rows, kUnknown);
  std::vector<double> whole(rows, kUnknown);
  std::vector<double> known;
  for (std::size_t i = 0; i < rows * figures; ++i) {
    known.clear();
    for (const auto& ping : pings) {
      SONAR_CHECK(ping.size() == rows * figures);
      if (!std::isnan(ping[i])) known.push_back(ping[i]);
    }
    if (known.empty()) continue;
    const double level_db = by_blocks ? std::min(linear_mean_db(known), params.maximum_db) : median_level_db(known);
    weakest[i / figures] = std::fmin(weakest[i / figures], level_db);
    if (i % figures == 0) whole[i / figures] = level_db;
  }
  return by_blocks || falls(whole, weakest, params.fall_db) ? weakest : whole;
}

void keep_quieter(std::span<const double> own_db, double quiet_db, std::span<double> level_db) {
  SONAR_CHECK(own_db.size() == level_db.size());
  for (std::size_t row = 0; row < own_db.size(); ++row) {
    if (own_db[row] < level_db[row] - quiet_db) level_db[row] = own_db[row];
  }
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
