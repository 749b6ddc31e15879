// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "geo/geodesic.h"
#include "view/label_room.h"
#include "view/school_labels.h"
#include "view/volume/context_layout.h"
#include "view/volume/context_scene.h"

namespace sonar {
namespace {

/// A place to be labelled: it lies on a line through itself and `along`, and its label stands on the side of `out`.
struct Labelled {
  Point<Sonar> at;
  Point<Sonar> along;
  Point<Sonar> out;
};

/// Unit vector in the picture, square to the line, on the side of `out`; where the line is seen end on, towards `out`.
PixelPoint away(PixelPoint at, PixelPoint along, PixelPoint out) {
  const PixelPoint line{along.x - at.x, along.y - at.y};
  const PixelPoint side{out.x - at.x, out.y - at.y};
  const double length = std::hypot(line.x, line.y);
  if (length > 1e-6) {
    const PixelPoint normal{-line.y / length, line.x / length};
    return normal.x * side.x + normal.y * side.y < 0.0 ? PixelPoint{-normal.x, -normal.y} : normal;
  }
  const double reach = std::hypot(side.x, side.y);
  return reach > 1e-6 ? PixelPoint{side.x / reach, side.y / reach} : PixelPoint{0.0, -1.0};
}

constexpr double kSmall_em = 40.0;  ///< width of a picture that has room for every second label

/// Puts labels into a frame, each beside its place.
class ContextLabels {
 public:
  ContextLabels(FrameDescription& frame, const CameraBasis& camera, const Theme& theme, const OpaqueView& opaque)
      : frame_(&frame),
        camera_(&camera),
        theme_(&theme),
        opaque_(&opaque),
        room_({0.0, 0.0, static_cast<double>(frame.size.width), static_cast<double>(frame.size.height)}) {}

  void keep_off(const PixelRect& place) { room_.take(place); }
  void keep_off(const std::vector<SceneLine>& lines) {
    for (const SceneLine& line : lines) {
      const auto a = camera_->project(line.from);
      const auto b = camera_->project(line.to);
      if (a && b) room_.add_line(a->pixel, b->pixel);
    }
  }

  /// Whether the picture is so small that labels would cover what they name.
  [[nodiscard]] bool small() const { return frame_->size.width < kSmall_em * theme_->text_px; }
  /// A school's name beside the school; that of the selected one, whose box is not kept off yet, is always there.
  void name(const SchoolPlace& school, const PixelRect& box) {
    const auto middle = camera_->project(school.middle);
    if (middle ? hidden(school.middle, middle->pixel) : !school.selected) return;
    TextItem label{{},  school.name,     theme_->text_px, theme_->text, TextAnchor::centre,
                   0.0, school.selected, theme_->halo};
    if (school.selected) {
      const std::string number = school.name.substr(0, school.name.find(':'));
      return add_selected_name(*frame_, room_, std::move(label), number, box, *theme_);
    }
    const auto places = places_beside(box, label);
    if (auto placed = room_.place(std::move(label), places)) frame_->items.emplace_back(std::move(*placed));
  }

  /// Whether there was room.
  bool add(const Labelled& place, std::string text) {
    const auto at = camera_->project(place.at);
    const auto along = camera_->project(place.along);
    const auto out = camera_->project(place.out);
    if (!at || !along || !out) return false;
    if (!seen(at->pixel) || hidden(place.at, at->pixel)) return false;
    const double em = theme_->text_px;
    TextItem label{at->pixel, std::move(text), em, theme_->text, TextAnchor::centre, 0.0, false, theme_->halo};
    const PixelRect box = LabelRoom::box_of(label);
    const PixelPoint d = away(at->pixel, along->pixel, out->pixel);
    const double half = std::abs(d.x) * box.width / 2 + std::abs(d.y) * box.height / 2;
    std::array<PixelPoint, 4> places;
    // Near, a little farther, and the same on the other side.
    constexpr std::array<double, 4> kGaps{0.35, 1.4, -0.35, -1.4};
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double reach = kGaps[i] * em + std::copysign(half, kGaps[i]);
      places[i] = {at->pixel.x + d.x * reach, at->pixel.y + d.y * reach};
    }
    auto placed = room_.place(std::move(label), places, !small());
    if (!placed) return false;
    frame_->items.emplace_back(std::move(*placed));
    return true;
  }

 private:
  [[nodiscard]] bool seen(PixelPoint p) const {
    return p.x >= 0 && p.y >= 0 && p.x <= frame_->size.width && p.y <= frame_->size.height;
  }

  /// Behind something opaque; what stands on it is not.
  [[nodiscard]] bool hidden(const Point<Sonar>& p, PixelPoint pixel) const {
    const auto [size, metres] = *opaque_;
    if (metres.empty()) return false;
    const auto of = [](double at, int shown, int known) {
      return static_cast<std::size_t>(std::clamp(static_cast<int>(at * known / shown), 0, known - 1));
    };
    const std::size_t row = of(pixel.y, frame_->size.height, size.height);
    const std::size_t column = of(pixel.x, frame_->size.width, size.width);
    const auto ends = static_cast<double>(metres[row * static_cast<std::size_t>(size.width) + column]);
    return 1.02 * ends < norm(p - camera_->eye);
  }

  FrameDescription* frame_;
  const CameraBasis* camera_;
  const Theme* theme_;
  const OpaqueView* opaque_;
  LabelRoom room_;
};

/// Numbers and names beside the schools. No label lies on a school, whatever comes later.
void label_schools(ContextLabels& labels, const std::vector<SchoolPlace>& schools, const CameraBasis& camera) {
  std::vector<std::pair<const SchoolPlace*, PixelRect>> seen;
  for (const SchoolPlace& school : schools) {
    const auto box = school_box(school, camera);
    if (!box) continue;
    if (!school.selected) labels.keep_off(*box);
    seen.emplace_back(&school, *box);
  }
  // The selected one has the first choice.
  std::stable_partition(seen.begin(), seen.end(), [](const auto& one) { return one.first->selected; });
  for (const auto& [school, box] : seen) {
    if (!school->name.empty()) labels.name(*school, box);
    if (school->selected) labels.keep_off(box);
  }
}

/// Of the rings and the depth axis: both are lengths. In a small picture one of each says what its figures are.
std::string distance_text(const char* word, double metres, bool with_word, const Unit& unit) {
  return with_word ? fmt::format("{} {}", word, round_text(metres, unit)) : round_text(metres, unit);
}

void label_rings(ContextLabels& labels, const SurfaceGrid& grid, double z, const Unit& unit) {
  const double edge = grid.first_azimuth_rad;
  // Every second one in a small picture, the farthest among them.
  const std::size_t step = labels.small() ? 2 : 1;
  bool named = false;
  for (std::size_t i = (grid.radii_m.size() - 1) % step; i < grid.radii_m.size(); i += step) {
    const double radius = grid.radii_m[i];
    const Labelled place{on_surface(radius, edge, z), on_surface(0.9 * radius, edge, z),
                         on_surface(radius, edge - 0.05, z)};
    if (labels.add(place, distance_text("range", radius, !named, unit))) named = labels.small();
  }
}

void label_depths(ContextLabels& labels, const DepthAxis& axis, double far_m, double z, const Unit& unit) {
  bool named = false;
  for (const double depth : axis.depths_m) {
    const Point<Sonar> tick = Point<Sonar>{axis.top.x, axis.top.y, depth + z} + axis.outwards * (0.015 * far_m);
    const Labelled place{tick, tick + Point<Sonar>{0.0, 0.0, 0.02 * far_m}, tick + axis.outwards * (0.05 * far_m)};
    if (labels.add(place, distance_text("depth", depth, !named, unit))) named = labels.small();
  }
}

void label_bearings(ContextLabels& labels, const SurfaceGrid& grid, const ContextParams& params, double z) {
  const double edge = grid.edge_m;
  const std::size_t step = labels.small() ? 2 : 1;
  for (std::size_t i = 0; i < grid.azimuths_rad.size(); i += step) {
    const double azimuth = grid.azimuths_rad[i];
    labels.add({on_surface(edge, azimuth, z), on_surface(edge, azimuth + 0.02, z), on_surface(1.05 * edge, azimuth, z)},
               bearing_text(azimuth, params));
  }
}

/// At the slices' far edges, where these are far from each other: the slice from above at the end of its arc, the slice
/// from the side low down.
void label_slices(ContextLabels& labels, const Sector& sector, const ContextParams& params) {
  constexpr double kAlong = 0.9;
  const double far_m = far_range_m(sector);
  const auto between = [](double first, double last, double share) { return first + share * (last - first); };
  const auto label = [&](double elevation, double azimuth, double up_rad, double on_rad, const char* words) {
    const Point<Sonar> at = Sector::direction(elevation, azimuth) * far_m;
    labels.add({at, Sector::direction(elevation + up_rad, azimuth + on_rad) * far_m, at * 1.05}, words);
  };
  if (params.top_fan) {
    const double azimuth = between(sector.azimuth_rad(0), sector.azimuth_rad(sector.beams() - 1), kAlong);
    label(sector.elevation_rad(*params.top_fan), azimuth, 0.0, 0.02, "slice from above");
  }
  if (params.side_beam) {
    const double elevation = between(sector.elevation_rad(sector.fans() - 1), sector.elevation_rad(0), kAlong);
    label(elevation, sector.azimuth_rad(*params.side_beam), 0.02, 0.0, "slice from the side");
  }
}

/// Their depths, beside where they begin.
void label_currents(ContextLabels& labels, const std::vector<CurrentArrow>& arrows, double far_m, const Unit& unit) {
  for (const CurrentArrow& arrow : arrows) {
    const Point<Sonar> back = (arrow.from - arrow.to) * (0.05 * far_m / norm(arrow.to - arrow.from));
    labels.add({arrow.from, arrow.from + Point<Sonar>{0.0, 0.0, 0.02 * far_m}, arrow.from + back},
               round_text(arrow.depth_m, unit));
  }
}

}  // namespace

std::optional<PixelRect> school_box(const SchoolPlace& school, const CameraBasis& camera) {
  double left = camera.size.width;
  double right = 0.0;
  double top = camera.size.height;
  double bottom = 0.0;
  for (const Point<Sonar>& place : school.edge) {
    const auto seen = camera.project(place);
    if (!seen) continue;
    left = std::min(left, seen->pixel.x);
    right = std::max(right, seen->pixel.x);
    top = std::min(top, seen->pixel.y);
    bottom = std::max(bottom, seen->pixel.y);
  }
  left = std::max(left, 0.0);
  top = std::max(top, 0.0);
  right = std::min<double>(right, camera.size.width);
  bottom = std::min<double>(bottom, camera.size.height);
  if (!(left < right) || !(top < bottom)) return std::nullopt;
  return PixelRect{left, top, right - left, bottom - top};
}

ConvexOutline school_outline(const SchoolPlace& school, const CameraBasis& camera) {
  std::vector<PlanePoint> seen;
  for (const Point<Sonar>& place : school.edge) {
    if (const auto at = camera.project(place)) seen.push_back({at->pixel.x, at->pixel.y});
  }
  ConvexOutline out;
  for (const PlanePoint& p : convex_hull(std::move(seen))) out.push_back({p.x, p.y});
  return out;
}

void add_context_labels(FrameDescription& frame, const Sector& sector, const ContextParams& params,
                        const CameraBasis& camera, const Theme& theme, const OpaqueView& opaque,
                        std::span<const PixelRect> taken) {
  ContextParams lines = params;
  lines.ship = lines.sea_surface = false;
  lines.fitted_seabed.reset();
  lines.shadow_from.reset();  // so many that no label would have room
  ContextLabels labels(frame, camera, theme, opaque);
  for (const PixelRect& place : taken) labels.keep_off(place);
  const ContextScene drawn = context_scene(sector, lines, theme);
  labels.keep_off(drawn.lines);
  labels.keep_off(drawn.under);
  label_schools(labels, params.schools, camera);
  const double z = -params.transducer_depth_m;
  const Unit unit = params.units.length();
  const SurfaceGrid grid = surface_grid(sector, params);
  if (params.range_rings) label_rings(labels, grid, z, unit);
  if (params.depth_axis) label_depths(labels, depth_axis(sector, params), far_range_m(sector), z, unit);
  if (params.range_rings) label_bearings(labels, grid, params, z);
  label_slices(labels, sector, params);
  label_currents(labels, current_arrows(sector, params.currents, params.heading_deg, params.transducer_depth_m),
                 far_range_m(sector), unit);
}

}  // namespace sonar
