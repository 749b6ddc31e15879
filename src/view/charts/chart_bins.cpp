// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart_bins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace sonar {
namespace {

/// factor * 10^power, kept apart so that multiples of 0.1 are the nearest doubles of their decimals.
struct RoundNumber {
  double factor = 1.0;
  int power = 0;
  [[nodiscard]] double times(std::int64_t n) const {
    const double whole = static_cast<double>(n) * factor;
    return power >= 0 ? whole * std::pow(10.0, power) : whole / std::pow(10.0, -power);
  }
};

constexpr std::array<double, 3> kFactors{1.0, 2.0, 5.0};
constexpr double kDay_s = 86'400.0;
constexpr std::array<double, 19> kTimeSteps_s{1,   2,     5,     10,    15,     30,     60,     120,    300,       600,
                                              900, 1'800, 3'600, 7'200, 10'800, 21'600, 43'200, kDay_s, 2 * kDay_s};

/// Round numbers in order, as far as they may be the width of a bin.
std::vector<RoundNumber> round_numbers(const ChartColumn& column, int lowest_power, int highest_power) {
  std::vector<RoundNumber> out;
  if (column.time) {
    for (const double step : kTimeSteps_s) out.push_back({step, 0});
    for (int power = 0; power < 5; ++power) {
      for (const double factor : kFactors) out.push_back({5.0 * factor * kDay_s, power});
    }
    return out;
  }
  for (int power = column.whole ? 0 : lowest_power; power <= std::max(0, highest_power); ++power) {
    for (const double factor : kFactors) out.push_back({factor, power});
  }
  return out;
}

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// 0 where rounding alone tells the values apart.
double span_of(const std::vector<double>& sorted) {
  const double span = sorted.back() - sorted.front();
  return span > 1e-9 * std::max(std::abs(sorted.front()), std::abs(sorted.back())) ? span : 0.0;
}

/// How wide bins would be, were there no round numbers.
double width_asked(const std::vector<double>& sorted, int about) {
  const double span = span_of(sorted);
  if (!(span > 0.0)) return 0.1 * std::abs(sorted.front());
  if (about > 0) return span / about;
  const auto n = static_cast<double>(sorted.size());
  const double spread = quantile(sorted, 0.75) - quantile(sorted, 0.25);
  if (spread > 0.0) return 2.0 * spread / std::cbrt(n);
  return span / (std::ceil(std::log2(n)) + 1.0);
}

RoundNumber width_of(const std::vector<double>& sorted, const ChartColumn& column, int about) {
  const double asked = width_asked(sorted, about);
  const double span = span_of(sorted);
  if (!(asked > 0.0) || (span == 0.0 && column.time)) return {1.0, 0};
  const auto power_of = [](double number) { return static_cast<int>(std::floor(std::log10(number))); };
  const auto choices = round_numbers(column, power_of(asked) - 1, power_of(std::max(asked, span)) + 1);
  const auto away = [&](const RoundNumber& one) { return std::abs(std::log(one.times(1) / asked)); };
  auto best = std::min_element(choices.begin(), choices.end(),
                               [&](const RoundNumber& a, const RoundNumber& b) { return away(a) < away(b); });
  while (span / best->times(1) > kMostBins - 2 && std::next(best) != choices.end()) ++best;
  return *best;
}

}  // namespace

ChartBins chart_bins(std::span<const double> values, const ChartColumn& column, int about) {
  if (column.unit_size != 1.0) {  // round numbers of the unit that is read
    std::vector<double> read(values.begin(), values.end());
    for (double& value : read) value /= column.unit_size;
    ChartColumn plain = column;
    plain.unit_size = 1.0;
    ChartBins bins = chart_bins(read, plain, about);
    for (double& edge : bins.edges) edge *= column.unit_size;
    return bins;
  }
  ChartBins bins;
  bins.bin_of_row.assign(values.size(), ChartBins::kNone);
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double v) { return std::isfinite(v); });
  if (sorted.empty()) return bins;
  std::sort(sorted.begin(), sorted.end());
  const RoundNumber width = width_of(sorted, column, about);
  auto first = static_cast<std::int64_t>(std::floor(sorted.front() / width.times(1)));
  while (width.times(first) > sorted.front()) --first;
  while (width.times(first + 1) <= sorted.front()) ++first;
  bins.edges.push_back(width.times(first));
  while (bins.edges.back() <= sorted.back()) bins.edges.push_back(width.times(++first));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const auto above = std::upper_bound(bins.edges.begin(), bins.edges.end(), values[i]);
    bins.bin_of_row[i] = static_cast<std::size_t>(above - bins.edges.begin()) - 1;
  }
  return bins;
}

}  // namespace sonar
