// SPDX-License-Identifier: Apache-2.0
#include "view/maps/graticule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ranges>

#include "base/units.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr std::array<double, 24> kSteps_s{
    3600 * 30.0, 3600 * 20.0, 3600 * 10.0, 3600 * 5.0, 3600 * 2.0, 3600.0, 1800.0, 1200.0, 600.0, 300.0, 120.0, 60.0,
    30.0,        20.0,        10.0,        5.0,        2.0,        1.0,    0.5,    0.2,    0.1,   0.05,  0.02,  0.01};
constexpr double kMetresPerDegree = 111'195.0;
constexpr int kLineSteps = 96;

/// The largest step whose lines are not farther apart than `most_deg`.
double round_step_deg(double most_deg) {
  for (const double s : kSteps_s) {
    if (s / 3600.0 <= most_deg) return s / 3600.0;
  }
  return kSteps_s.back() / 3600.0;
}

std::string angle_text(double degrees, double step_deg, const char* letters) {
  const bool negative = degrees < 0.0;
  // In hundredths of a second, so that 59.9999 seconds never show.
  const auto hundredths = static_cast<long long>(std::llround(std::abs(degrees) * 360'000.0));
  const long long deg = hundredths / 360'000;
  const long long minute = hundredths / 6'000 % 60;
  const double second = static_cast<double>(hundredths % 6'000) / 100.0;
  std::string text = fmt::format("{}°", deg);
  if (step_deg < 1.0 - 1e-9) text += fmt::format("{:02d}′", minute);
  if (step_deg < 1.0 / 60.0 - 1e-9) {
    text += step_deg < 1.0 / 3600.0 - 1e-9 ? fmt::format("{:05.2f}″", second) : fmt::format("{:02.0f}″", second);
  }
  const bool plain = hundredths == 0;
  if (!plain) text += fmt::format(" {}", letters[negative ? 1 : 0]);
  return text;
}

/// Where multiples of a step are crossed along an edge of the map.
template <class Value, class Found>
void crossings(int steps, double step_deg, const Value& value, const Found& found) {
  double before = value(0);
  for (int i = 1; i <= steps; ++i) {
    const double now = value(i);
    if (std::isfinite(before) && std::isfinite(now)) {
      const double low = std::min(before, now) / step_deg;
      const double high = std::max(before, now) / step_deg;
      for (double k = std::ceil(low); k <= high && high - low < 20.0; k += 1.0) {
        const double t = now == before ? 0.0 : (k * step_deg - before) / (now - before);
        if (t > 0.0 || i == 1) found(i - 1 + t, k * step_deg);
      }
    }
    before = now;
  }
}

struct Span {
  GeoExtent extent;
  double latitude_step = 1.0;
  double longitude_step = 1.0;
};

Span span_of(const MapFrame& map, double spacing_px) {
  Span s;
  s.extent = shown_extent(map);
  const double most = spacing_px * map.metres_per_px / kMetresPerDegree;
  s.latitude_step = round_step_deg(most * 1.35);
  const double narrow = std::max(0.02, std::cos(rad_from_deg(s.extent.middle().latitude_deg)));
  s.longitude_step = round_step_deg(most * 1.35 / narrow);
  return s;
}

void add_line(Graticule& g, const MapFrame& map, const Geographic& from, const Geographic& to) {
  std::vector<PixelPoint> line;
  for (int i = 0; i <= kLineSteps; ++i) {
    const double t = i / static_cast<double>(kLineSteps);
    const auto p = map.at(Geographic{from.latitude_deg + (to.latitude_deg - from.latitude_deg) * t,
                                     wrap_180(from.longitude_deg + (to.longitude_deg - from.longitude_deg) * t)});
    if (p) line.push_back(*p);
  }
  if (line.size() > 1) g.lines.push_back(std::move(line));
}

void add_lines(Graticule& g, const MapFrame& map, const Span& s) {
  const GeoExtent& e = s.extent;
  for (double k = std::ceil(e.south_deg / s.latitude_step); k * s.latitude_step <= e.north_deg; k += 1.0) {
    const double lat = k * s.latitude_step;
    if (std::abs(lat) < 90.0) add_line(g, map, {lat, e.west_deg}, {lat, e.east_deg});
  }
  const double south = std::max(-89.0, e.south_deg);
  const double north = std::min(89.0, e.north_deg);
  for (double k = std::ceil(e.west_deg / s.longitude_step); k * s.longitude_step <= e.east_deg; k += 1.0) {
    const double lon = k * s.longitude_step;
    add_line(g, map, {south, lon}, {north, lon});
  }
}

}  // namespace

std::string latitude_text(double degrees, double step_deg) { return angle_text(degrees, step_deg, "NS"); }
std::string longitude_text(double degrees, double step_deg) {
  const double wrapped = wrap_180(degrees);
  // 180 degrees is neither east nor west.
  return std::abs(wrapped + 180.0) < 1e-9 ? std::string("180°") : angle_text(wrapped, step_deg, "EW");
}

Graticule graticule(const MapFrame& map, double spacing_px) {
  Graticule g;
  const Span s = span_of(map, spacing_px);
  add_lines(g, map, s);
  const PixelRect& r = map.place;
  const int down = static_cast<int>(std::ceil(r.height / 4.0));
  const auto left = [&](double i) { return PixelPoint{r.x, r.y + r.height * i / down}; };
  crossings(
      down, s.latitude_step,
      [&](int i) {
        const auto p = map.geographic(left(i));
        return p ? p->latitude_deg : std::nan("");
      },
      [&](double i, double deg) {
        g.latitudes.push_back({left(i), latitude_text(deg, s.latitude_step), deg});
      });
  const int across = static_cast<int>(std::ceil(r.width / 4.0));
  const auto lower = [&](double i) { return PixelPoint{r.x + r.width * i / across, r.y + r.height}; };
  const double middle = s.extent.middle().longitude_deg;
  crossings(
      across, s.longitude_step,
      [&](int i) {
        const auto p = map.geographic(lower(i));
        return p ? middle + wrap_180(p->longitude_deg - middle) : std::nan("");
      },
      [&](double i, double deg) {
        g.longitudes.push_back({lower(i), longitude_text(deg, s.longitude_step), wrap_180(deg)});
      });
  return g;
}

void add_graticule(FrameDescription& frame, const MapFrame& map, const Theme& theme) {
  const Graticule g = graticule(map, 11.0 * theme.text_px);
  frame.items.emplace_back(ClipItem{map.place});
  PathItem lines;
  for (const auto& line : g.lines) lines.parts.push_back({line, false});
  lines.stroke = {theme.grid, theme.line_px, {}};
  frame.items.emplace_back(std::move(lines));
  frame.items.emplace_back(ClipItem{});
  frame.items.emplace_back(rectangle_item(map.place, {0, 0, 0, 0}, theme.axis, theme.line_px));
  const double em = theme.text_px;
  double free_y = 1e9;
  for (const Graticule::Label& label : std::views::reverse(g.latitudes)) {
    const PixelPoint& at = label.at;
    if (at.y > free_y || at.y < map.place.y || at.y > map.place.y + map.place.height) continue;
    free_y = at.y - 1.6 * em;
    frame.items.emplace_back(line_item({at.x - 0.35 * em, at.y}, at, theme.axis, theme.line_px));
    frame.items.emplace_back(text_item({at.x - 0.6 * em, at.y}, label.text, em, theme.text, TextAnchor::right));
  }
  double free_x = -1e9;
  for (const Graticule::Label& label : g.longitudes) {
    const double half = text_width_px(label.text.c_str(), em) / 2.0;
    frame.items.emplace_back(line_item(label.at, {label.at.x, label.at.y + 0.35 * em}, theme.axis, theme.line_px));
    if (label.at.x - half < std::max(0.0, free_x) || label.at.x + half > frame.size.width) continue;
    free_x = label.at.x + half + 0.8 * em;
    frame.items.emplace_back(
        text_item({label.at.x, label.at.y + 1.1 * em}, label.text, em, theme.text, TextAnchor::centre));
  }
}

}  // namespace sonar
