// SPDX-License-Identifier: Apache-2.0
#include "view/maps/depth_layer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "base/units.h"
#include "view/axes.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr int kMostBands = 9;
constexpr int kContourStep = 3;  ///< pixels between the contours' lattice points
/// Of the background in a band's colour: what lies over the sea must be clear, on a dark picture the more.
constexpr double kMuted = 0.42;
constexpr double kMutedDark = 0.62;

Rgba8 mixed(Rgba8 a, Rgba8 b, double t) {
  const auto m = [t](std::uint8_t x, std::uint8_t y) {
    return static_cast<std::uint8_t>(std::lround((1.0 - t) * x + t * y));
  };
  return {m(a.r, b.r), m(a.g, b.g), m(a.b, b.b), 255};
}

/// Whether a place lies between known nodes.
bool enclosed(const DepthGrid& grid, const Geographic& place) {
  if (grid.rows < 2 || grid.columns < 2) return false;
  const double y = (place.latitude_deg - grid.south_deg) / grid.step_latitude_deg;
  const double x = wrap_360(place.longitude_deg - grid.west_deg) / grid.step_longitude_deg;
  if (!(y >= 0.0 && y <= grid.rows - 1 && x >= 0.0 && x <= grid.columns - 1)) return false;
  const int row = std::min(static_cast<int>(y), grid.rows - 2);
  const int column = std::min(static_cast<int>(x), grid.columns - 2);
  return !std::isnan(grid.at(row, column) + grid.at(row, column + 1) + grid.at(row + 1, column) +
                     grid.at(row + 1, column + 1));
}

std::shared_ptr<const Image> painted(const ScalarField& field, const DepthBands& bands, const Theme& theme) {
  auto image = std::make_shared<Image>(field.size, Rgba8{0, 0, 0, 0});
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const auto depth = static_cast<double>(field.values[i]);
    if (std::isnan(depth)) continue;
    image->pixels[i] = depth <= 0.0 ? theme.land : bands.colour(depth);
  }
  return image;
}

/// Where labels already stand.
using Taken = std::vector<PixelPoint>;

/// At the most level and straight place of a long line.
void add_label(FrameDescription& frame, const std::vector<PixelPoint>& line, const std::string& text,
               const MapFrame& map, const Theme& theme, Taken& taken) {
  const double em = small_text_px(theme, 0.85);
  const double width = text_width_px(text.c_str(), em) + 0.6 * em;
  const auto stride = static_cast<std::size_t>(std::max(2.0, std::ceil(width / kContourStep)));
  if (line.size() < 3 * stride) return;
  double best = 0.35;  // level and straight enough, or no label
  PixelPoint place;
  double turned = 0.0;
  for (std::size_t i = 0; i + stride < line.size(); i += std::max<std::size_t>(1, stride / 4)) {
    const PixelPoint& a = line[i];
    const PixelPoint& b = line[i + stride];
    const PixelPoint& middle = line[i + stride / 2];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length < 0.6 * width) continue;
    const double bow = std::abs((b.x - a.x) * (middle.y - a.y) - (b.y - a.y) * (middle.x - a.x)) / (length * length);
    const double steep = std::abs(b.y - a.y) / length;
    const double cost = bow + 0.3 * steep;
    const bool inside = middle.x > map.place.x + width && middle.x < map.place.x + map.place.width - width &&
                        middle.y > map.place.y + em && middle.y < map.place.y + map.place.height - em;
    const bool free = std::none_of(taken.begin(), taken.end(), [&](const PixelPoint& t) {
      return std::hypot(t.x - middle.x, t.y - middle.y) < 6.0 * theme.text_px;
    });
    if (!inside || !free || cost >= best) continue;
    best = cost;
    place = middle;
    turned = std::atan2(b.y - a.y, b.x - a.x) * (180.0 / std::numbers::pi);
  }
  if (best >= 0.35) return;
  if (turned > 90.0) turned -= 180.0;
  if (turned < -90.0) turned += 180.0;
  TextItem label = text_item(place, text, em, theme.text, TextAnchor::centre);
  label.turned_deg = turned;
  label.halo = theme.halo;
  frame.items.emplace_back(std::move(label));
  taken.push_back(place);
}

}  // namespace

Rgba8 DepthBands::colour(double depth_m) const {
  if (levels_m.size() < 2) return map.at(0.5);
  const auto above = std::upper_bound(levels_m.begin(), levels_m.end(), depth_m) - levels_m.begin();
  const auto bands = static_cast<std::ptrdiff_t>(levels_m.size()) - 1;
  const auto band = std::clamp<std::ptrdiff_t>(above - 1, 0, bands - 1);
  return map.knots[static_cast<std::size_t>(band)];
}

ScalarField depth_field(const MapFrame& map, const DepthGrid& grid) {
  ScalarField field;
  field.size = {std::max(1, static_cast<int>(std::ceil(map.place.width))),
                std::max(1, static_cast<int>(std::ceil(map.place.height)))};
  const PixelPlaces places(map, field.size, 1.0);
  field.values.reserve(field.size.count());
  for (int y = 0; y < field.size.height; ++y) {
    for (int x = 0; x < field.size.width; ++x)
      field.values.push_back(static_cast<float>(grid.depth_at(places.at(x, y))));
  }
  return field;
}

ScalarField contour_field(const MapFrame& map, const DepthGrid& grid, int step) {
  const PixelSize size{std::max(1, static_cast<int>(std::ceil(map.place.width))),
                       std::max(1, static_cast<int>(std::ceil(map.place.height)))};
  const PixelPlaces places(map, size, 1.0);
  ScalarField out;
  out.size = {(size.width + step - 1) / step, (size.height + step - 1) / step};
  out.values.reserve(out.size.count());
  for (int y = 0; y < out.size.height; ++y) {
    for (int x = 0; x < out.size.width; ++x) {
      const Geographic place = places.at(x * step, y * step);
      out.values.push_back(enclosed(grid, place) ? static_cast<float>(grid.depth_at(place))
                                                 : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return out;
}

DepthBands depth_bands(const ScalarField& field, const Theme& theme) {
  DepthBands bands;
  double low = 0.0;
  double high = -1.0;
  for (const float v : field.values) {
    const auto depth = static_cast<double>(v);
    bands.unknown = bands.unknown || std::isnan(depth);
    bands.land = bands.land || depth <= 0.0;
    if (!(depth > 0.0)) continue;
    low = high < 0.0 ? depth : std::min(low, depth);
    high = std::max(high, depth);
  }
  if (high < 0.0) return bands;
  // A level sea still has one band.
  const double middle = (low + high) / 2.0;
  const double half = std::max({(high - low) / 2.0, 0.01 * middle, 0.5});
  const Unit unit = theme.units.length();
  const double from = unit.of(middle - half);
  const double to = unit.of(middle + half);
  const Ticks ticks = nice_ticks(std::max(0.0, from), to, kMostBands);
  for (double v = std::floor(from / ticks.step) * ticks.step; v < to + ticks.step; v += ticks.step) {
    const double level = std::max(0.0, std::round(v / ticks.step) * ticks.step);
    bands.levels_m.push_back(level * unit.si);
    if (level >= to) break;
  }
  bands.map.stepped = true;
  const double muted = lightness(theme.background) < 50.0 ? kMutedDark : kMuted;
  const std::size_t n = bands.levels_m.size() - 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = n > 1 ? 0.04 + 0.72 * static_cast<double>(i) / static_cast<double>(n - 1) : 0.3;
    bands.map.knots.push_back(mixed(colour_map(ColourMapName::deep).at(t), theme.background, muted));
  }
  return bands;
}

DepthBands add_depth_layer(FrameDescription& frame, const MapFrame& map, const DepthGrid& grid, const Theme& theme,
                           std::vector<PixelPoint> taken) {
  const ScalarField field = depth_field(map, grid);
  DepthBands bands = depth_bands(field, theme);
  if (bands.levels_m.empty() && !bands.land) return bands;
  frame.items.emplace_back(ClipItem{map.place});
  const PixelRect place{map.place.x, map.place.y, static_cast<double>(field.size.width),
                        static_cast<double>(field.size.height)};
  frame.items.emplace_back(ImageItem{place, painted(field, bands, theme), false});
  const ScalarField coarse = contour_field(map, grid, kContourStep);
  std::vector<double> levels = bands.levels_m;
  if (bands.land) levels.insert(levels.begin(), 0.0);
  for (const double level : levels) {
    PathItem path;
    for (ContourLine& line : contour_lines(coarse, level)) {
      for (PixelPoint& p : line.points) {
        p = {map.place.x + 0.5 + p.x * kContourStep, map.place.y + 0.5 + p.y * kContourStep};
      }
      path.parts.push_back({std::move(line.points), line.closed});
    }
    if (path.parts.empty()) continue;
    path.stroke = {with_alpha(theme.text, level == 0.0 ? 190 : 90), (level == 0.0 ? 1.5 : 1.0) * theme.line_px, {}};
    std::vector<PathItem::Part> parts = path.parts;
    frame.items.emplace_back(std::move(path));
    if (level == 0.0) continue;
    for (const PathItem::Part& part : parts) {
      add_label(frame, part.points, fmt::format("{:g}", rounded(level, theme.units.length())), map, theme, taken);
    }
  }
  frame.items.emplace_back(ClipItem{});
  return bands;
}

}  // namespace sonar
