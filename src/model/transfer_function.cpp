// SPDX-License-Identifier: Apache-2.0
#include "model/transfer_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/units.h"

namespace sonar {
namespace {

/// Further apart, and the slope between two points would overflow.
constexpr double kMostDecibels = 1000.0;

struct Bracket {
  const TransferPoint* below;
  const TransferPoint* above;
  double weight;  ///< of `above`
};

Bracket bracket(const std::vector<TransferPoint>& points, double sv_db) {
  if (!(sv_db > points.front().sv_db)) return {&points.front(), &points.front(), 0.0};
  if (sv_db >= points.back().sv_db) return {&points.back(), &points.back(), 0.0};
  const auto above = std::upper_bound(points.begin(), points.end(), sv_db,
                                      [](double value, const TransferPoint& p) { return value < p.sv_db; });
  const auto below = above - 1;
  return {&*below, &*above, (sv_db - below->sv_db) / (above->sv_db - below->sv_db)};
}

}  // namespace

TransferFunction::TransferFunction() : points_{{-70.0, 0.0, {0.0, 0.0, 1.0}}, {-30.0, 1.0, {1.0, 0.0, 0.0}}} {}

Result<TransferFunction> TransferFunction::make(std::vector<TransferPoint> points, double opacity_length_m) {
  if (points.empty()) return fail(ErrorCode::bad_parameter, "a transfer function needs at least one point");
  if (!(opacity_length_m > 0.0) || !std::isfinite(opacity_length_m)) {
    return fail(ErrorCode::bad_parameter, fmt::format("opacity_length_m = {} is not above 0", opacity_length_m));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TransferPoint& p = points[i];
    if (!(std::abs(p.sv_db) <= kMostDecibels)) {
      return fail(ErrorCode::bad_parameter,
                  fmt::format("point {}: sv_db {} is outside -{} .. {}", i, p.sv_db, kMostDecibels, kMostDecibels));
    }
    if (!(p.opacity >= 0.0 && p.opacity <= 1.0)) {
      return fail(ErrorCode::bad_parameter,
                  fmt::format("point {}: opacity {} at {} dB is outside 0 .. 1", i, p.opacity, p.sv_db));
    }
    if (i > 0 && !(points[i - 1].sv_db < p.sv_db)) {
      return fail(ErrorCode::bad_parameter, fmt::format("point {}: sv_db {} does not rise", i, p.sv_db));
    }
  }
  TransferFunction made;
  made.points_ = std::move(points);
  made.opacity_length_m_ = opacity_length_m;
  return made;
}

double TransferFunction::opacity(double sv_db) const {
  const Bracket b = bracket(points_, sv_db);
  return b.below->opacity + b.weight * (b.above->opacity - b.below->opacity);
}

std::optional<double> TransferFunction::mean_db_per_opacity() const {
  const double rise = points_.back().opacity - points_.front().opacity;
  if (!(rise > 0.0)) return std::nullopt;
  return (points_.back().sv_db - points_.front().sv_db) / rise;
}

std::array<double, 3> TransferFunction::colour(double sv_db) const {
  const Bracket b = bracket(points_, sv_db);
  std::array<double, 3> rgb{};
  for (std::size_t i = 0; i < rgb.size(); ++i)
    rgb[i] = b.below->rgb[i] + b.weight * (b.above->rgb[i] - b.below->rgb[i]);
  return rgb;
}

std::vector<float> TransferFunction::table_i16() const {
  std::vector<float> table(65536);
  for (int count = -32767; count <= 32767; ++count) {
    table[static_cast<std::size_t>(count + 32768)] = static_cast<float>(opacity(db_from_counts(count)));
  }
  return table;
}

std::vector<std::array<float, 4>> TransferFunction::table(int size, double first_db, double last_db) const {
  std::vector<std::array<float, 4>> table(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) {
    const double sv_db = size > 1 ? first_db + (last_db - first_db) * i / (size - 1) : first_db;
    const std::array<double, 3> rgb = colour(sv_db);
    table[static_cast<std::size_t>(i)] = {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
                                          static_cast<float>(rgb[2]), static_cast<float>(opacity(sv_db))};
  }
  return table;
}

}  // namespace sonar
