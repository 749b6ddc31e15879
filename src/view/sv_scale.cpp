// SPDX-License-Identifier: Apache-2.0
#include "view/sv_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"

namespace sonar {
namespace {

constexpr std::size_t kCounts = 65536;
constexpr int kSmoothBar = 192;

/// Colour at an Sv, the limits alone at work. Steps begin exactly at low + k * (span / n).
Rgba8 colour_at(const SvScale& scale, const ColourMap& map, double sv_db) {
  if (sv_db < scale.low_db) return {0, 0, 0, 0};
  if (!map.stepped) return map.at((sv_db - scale.low_db) / scale.span_db);
  const auto n = static_cast<double>(map.knots.size());
  const double step = std::clamp(std::floor((sv_db - scale.low_db) / (scale.span_db / n)), 0.0, n - 1.0);
  return map.knots[static_cast<std::size_t>(step)];
}

std::uint8_t channel(double fraction) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(fraction, 0.0, 1.0)));
}

Rgba8 colour_at(const TransferFunction& transfer, double sv_db) {
  const std::array<double, 3> rgb = transfer.colour(sv_db);
  return {channel(rgb[0]), channel(rgb[1]), channel(rgb[2]), channel(transfer.opacity(sv_db))};
}

template <class ColourAt>
std::vector<Rgba8> count_table(const ColourAt& colour, double threshold_db, Rgba8 no_data) {
  std::vector<Rgba8> table(kCounts);
  for (std::size_t i = 0; i < kCounts; ++i) {
    const double sv_db = db_from_counts(static_cast<double>(i) - 32768.0);
    table[i] = sv_db < threshold_db ? Rgba8{0, 0, 0, 0} : colour(sv_db);
  }
  table[static_cast<std::size_t>(kNoData + 32768)] = no_data;
  return table;
}

TransferPoint point_at(const SvScale& scale, const ColourMap& map, double sv_db, double start_db, double most) {
  const double inside = std::max(sv_db, scale.low_db);  // below the limit the first colour goes on, unseen
  const Rgba8 c = colour_at(scale, map, inside);
  const double opacity = most * std::clamp((sv_db - start_db) / (scale.high_db() - start_db), 0.0, 1.0);
  return {sv_db, opacity, {c.r / 255.0, c.g / 255.0, c.b / 255.0}};
}

}  // namespace

SvColours sv_colours(const SvScale& scale) {
  const ColourMap& map = colour_map(scale.map);
  SvColours out;
  out.by_count =
      count_table([&](double sv_db) { return colour_at(scale, map, sv_db); }, scale.threshold_db, scale.no_data);
  out.low_db = scale.low_db;
  out.high_db = scale.high_db();
  out.threshold_db = scale.threshold_db;
  const int colours = map.stepped ? static_cast<int>(map.knots.size()) : kSmoothBar;
  if (map.stepped) out.step_db = scale.span_db / colours;
  for (int i = 0; i < colours; ++i) out.bar.push_back(map.at((i + 0.5) / colours));
  return out;
}

SvColours sv_colours(const TransferFunction& transfer, double threshold_db, Rgba8 no_data) {
  SvColours out;
  out.by_count = count_table([&](double sv_db) { return colour_at(transfer, sv_db); }, threshold_db, no_data);
  const SvScale limits = sv_scale(transfer, ColourMapName::grey);
  out.low_db = limits.low_db;
  out.high_db = limits.high_db();
  out.threshold_db = threshold_db;
  for (int i = 0; i < kSmoothBar; ++i) {
    out.bar.push_back(colour_at(transfer, out.low_db + limits.span_db * (i + 0.5) / kSmoothBar));
  }
  return out;
}

Result<TransferFunction> transfer_function(const SvScale& scale, double most_opacity, double opacity_length_m) {
  const double start_db = std::max(scale.low_db, scale.threshold_db);
  if (!(start_db < scale.high_db())) {
    return fail(ErrorCode::bad_parameter, fmt::format("threshold_db = {} is not below the upper display limit, {} dB",
                                                      scale.threshold_db, scale.high_db()));
  }
  const ColourMap& map = colour_map(scale.map);
  const std::size_t parts = map.stepped ? map.knots.size() : map.knots.size() - 1;
  std::vector<double> places;
  for (std::size_t i = 0; i <= parts; ++i) {
    const double edge = scale.low_db + static_cast<double>(i) * (scale.span_db / static_cast<double>(parts));
    if (map.stepped && i > 0) places.push_back(edge - 1e-6);
    if (!map.stepped || i < parts) places.push_back(edge);
  }
  places.push_back(start_db);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<TransferPoint> points;
  points.reserve(places.size());
  for (const double sv_db : places) points.push_back(point_at(scale, map, sv_db, start_db, most_opacity));
  return TransferFunction::make(std::move(points), opacity_length_m);
}

SvScale sv_scale(const TransferFunction& transfer, ColourMapName map) {
  SvScale out;
  out.map = map;
  out.low_db = transfer.points().front().sv_db;
  out.span_db = std::max(1.0, transfer.points().back().sv_db - out.low_db);
  return out;
}

}  // namespace sonar
