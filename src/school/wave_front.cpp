// SPDX-License-Identifier: Apache-2.0
#include "school/wave_front.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace sonar {
namespace {

/// What the middle `most` of the values span, and their median.
struct Spread {
  double width = 0.0;
  double median = 0.0;
};

Spread spread_of(std::vector<double> values, double most) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const auto i = static_cast<std::size_t>(share * static_cast<double>(values.size()));
    return values[std::min(i, values.size() - 1)];
  };
  return {at(0.5 + 0.5 * most) - at(0.5 - 0.5 * most), at(0.5)};
}

/// The larger of a box's angles over fans and over beams, beams' own widths included; steps add up round the ship.
double angle_across(const IndexBox& box, const Sector& sector) {
  const auto across = [](int first, int last, const auto& angle_rad) {
    double sum = 0.0;
    for (int i = first; i < last; ++i) {
      sum += std::abs(std::remainder(angle_rad(i + 1) - angle_rad(i), 2.0 * std::numbers::pi));
    }
    return last > first ? sum * (last - first + 1) / (last - first) : 0.0;
  };
  return std::max(across(box.first_fan, box.last_fan, [&](int i) { return sector.elevation_rad(i); }),
                  across(box.first_beam, box.last_beam, [&](int i) { return sector.azimuth_rad(i); }));
}

}  // namespace

bool is_wave_front(const PingMask& mask, const IndexBox& box, const Sector& sector, const DetectParams& params) {
  if (params.front_share <= 0.0) return false;
  std::vector<double> first;
  std::vector<double> end;
  int row = -1;
  for (const Run& run : mask.runs) {
    if (run.row != row) {
      first.push_back(run.first_sample);
      end.push_back(run.end());
    } else {
      end.back() = run.end();
    }
    row = run.row;
  }
  std::vector<double> middle;
  for (std::size_t i = 0; i < first.size(); ++i) middle.push_back(0.5 * (first[i] + end[i]));
  if (static_cast<int>(middle.size()) < params.front_rows) return false;
  const Spread middles = spread_of(std::move(middle), params.front_most);
  const double across_m = angle_across(box, sector) * sector.range().range_m(middles.median);
  const double most_samples = params.front_share * across_m / sector.range().spacing_m;
  if (std::max(box.fans(), box.beams()) >= params.front_beams && middles.width <= most_samples) return true;
  return spread_of(std::move(first), params.front_most).width <= most_samples &&
         spread_of(std::move(end), params.front_most).width <= most_samples;
}

}  // namespace sonar
