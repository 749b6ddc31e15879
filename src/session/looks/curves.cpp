// SPDX-License-Identifier: Apache-2.0
#include "session/looks/curves.h"

#include <algorithm>
#include <cmath>

namespace sonar {
namespace {

constexpr double kMostOpacity = 0.9;  // of the scale's own curve
constexpr double kStep_db = 1e-6;     // how steep a step is drawn

double opacity_at(const std::vector<OpacityPoint>& points, double sv_db) {
  if (sv_db <= points.front().sv_db) return points.front().opacity;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const OpacityPoint& a = points[i - 1];
    const OpacityPoint& b = points[i];
    if (sv_db <= b.sv_db) return a.opacity + (b.opacity - a.opacity) * (sv_db - a.sv_db) / (b.sv_db - a.sv_db);
  }
  return points.back().opacity;
}

/// Whether a point lies on the straight line between its neighbours.
bool on_line(const OpacityPoint& a, const OpacityPoint& b, const OpacityPoint& c) {
  const double expected = a.opacity + (c.opacity - a.opacity) * (b.sv_db - a.sv_db) / (c.sv_db - a.sv_db);
  return std::abs(expected - b.opacity) < 1e-9;
}

}  // namespace

Result<TransferFunction> curve_of(const SvScale& scale, const std::vector<OpacityPoint>& points,
                                  double opacity_length_m) {
  if (points.empty()) return fail(ErrorCode::bad_parameter, "a curve needs a point");
  auto colours = transfer_function(scale, kMostOpacity, opacity_length_m);
  if (!colours) return colours;
  std::vector<double> places;
  for (const TransferPoint& point : colours->points()) places.push_back(point.sv_db);
  for (const OpacityPoint& point : points) places.push_back(point.sv_db);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<TransferPoint> joined;
  for (const double sv_db : places) joined.push_back({sv_db, opacity_at(points, sv_db), colours->colour(sv_db)});
  return TransferFunction::make(std::move(joined), opacity_length_m);
}

Result<TransferFunction> growth_curve_of(const std::vector<OpacityPoint>& points) {
  std::vector<TransferPoint> made;
  for (const OpacityPoint& point : points) made.push_back({point.sv_db, point.opacity, {1.0, 1.0, 1.0}});
  return TransferFunction::make(std::move(made), TransferFunction{}.opacity_length_m());
}

std::vector<OpacityPoint> corners_of(const TransferFunction& curve) {
  std::vector<OpacityPoint> corners;
  const auto& points = curve.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const OpacityPoint here{points[i].sv_db, points[i].opacity};
    const bool inner = !corners.empty() && i + 1 < points.size();
    if (inner && on_line(corners.back(), here, {points[i + 1].sv_db, points[i + 1].opacity})) continue;
    corners.push_back(here);
  }
  return corners;
}

std::vector<CurvePreset> curve_presets() {
  return {{"ramp", "Ramp: from nothing at the lower limit to 90 % at the upper"},
          {"threshold", "Threshold: all that lies above the middle, equally"},
          {"band", "Band: the middle third alone"},
          {"faint", "Faint: a mist of everything, for plankton and layers"}};
}

std::vector<OpacityPoint> preset_points(std::string_view name, const SvScale& scale) {
  const double low = scale.low_db;
  const double high = scale.high_db();
  const double middle = (low + high) / 2.0;
  const double third = (high - low) / 3.0;
  if (name == "threshold") return {{middle, 0.0}, {middle + kStep_db, kMostOpacity}};
  if (name == "band") {
    return {{low + third, 0.0},
            {low + 1.25 * third, kMostOpacity},
            {high - 1.25 * third, kMostOpacity},
            {high - third, 0.0}};
  }
  if (name == "faint") return {{low, 0.0}, {low + third, 0.08}, {high, 0.2}};
  return {{low, 0.0}, {high, kMostOpacity}};
}

}  // namespace sonar
