// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_voxels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/units.h"
#include "view/slices/slice_geometry.h"

namespace sonar {
namespace {

/// From borders of cells: far above what rounding does to an angle, far below what a pixel spans.
constexpr double kMargin_rad = 1e-9;
constexpr double kTurn = 2.0 * std::numbers::pi;
/// A cross product tells one side of a border from the other within half a turn of it.
constexpr double kWedge_rad = 3.0;

/// A place whose cell in one angle is known from the pixel before: tells whether the next one surely has the same.
/// Cells along a circle, seen from its middle.
class Wedges {
 public:
  /// edges_rad  [cell + 1], rising
  /// zero_rad   the angle that lies along the first coordinate
  Wedges(const std::vector<double>& edges_rad, double zero_rad) : edges_(edges_rad) {
    for (const double edge : edges_) directions_.push_back({std::cos(edge - zero_rad), std::sin(edge - zero_rad)});
    const double span = edges_.back() - edges_.front();
    const double most = std::max({std::abs(edges_.front()), std::abs(edges_.back()), std::abs(zero_rad)});
    // Angles of many turns are too coarse for the margin, and cells that overlap are the exact rule's business.
    sound_ = span <= kTurn + 1e-12 && most < 1e3;
    outside_ = span < kWedge_rad ? Outside::reflex : kTurn - span < kWedge_rad ? Outside::wedge : Outside::unknown;
  }

  /// cell    -1 = beside all cells
  /// radius  at least that of (x, y)
  [[nodiscard]] bool surely_in(int cell, double x, double y, double radius) const {
    if (!sound_) return false;
    const double margin = kMargin_rad * radius;
    if (cell >= 0) {
      const auto i = static_cast<std::size_t>(cell);
      return edges_[i + 1] - edges_[i] < kWedge_rad && beyond(directions_[i], x, y) > margin &&
             beyond(directions_[i + 1], x, y) < -margin;
    }
    const bool before = beyond(directions_.front(), x, y) < -margin;
    const bool after = beyond(directions_.back(), x, y) > margin;
    return outside_ == Outside::reflex ? before || after : outside_ == Outside::wedge && before && after;
  }

 private:
  enum class Outside : std::uint8_t { unknown, reflex, wedge };
  struct Direction {
    double x;
    double y;
  };
  /// radius * sin(angle beyond a border)
  static double beyond(const Direction& d, double x, double y) { return d.x * y - d.y * x; }

  std::vector<double> edges_;
  std::vector<Direction> directions_;
  bool sound_ = false;
  Outside outside_ = Outside::unknown;
};

/// Cells in elevation, by the sine.
class Cones {
 public:
  explicit Cones(const std::vector<double>& edges_rad) {
    constexpr double kUp = std::numbers::pi / 2.0;
    for (const double e : edges_rad) sines_.push_back(e <= -kUp ? -2.0 : e >= kUp ? 2.0 : std::sin(e));
  }
  /// The angle is further from a border than the sine.
  [[nodiscard]] bool surely_in(int cell, double sine) const {
    if (cell < 0) return sine < sines_.front() - kMargin_rad || sine > sines_.back() + kMargin_rad;
    const auto i = static_cast<std::size_t>(cell);
    return sine > sines_[i] + kMargin_rad && sine < sines_[i + 1] - kMargin_rad;
  }

 private:
  std::vector<double> sines_;
};

class VoxelFinder {
 public:
  VoxelFinder(const Sector& sector, const SliceView& view, const SliceExtent& extent, PixelSize size)
      : sector_(&sector), geometry_(sector, view), up_rad_(view.up_rad), size_(size), voxels_(size.count(), -1) {
    for (int x = 0; x < size.width; ++x) x_.push_back(extent.x0 + (x + 0.5) * (extent.x1 - extent.x0) / size.width);
    for (int y = 0; y < size.height; ++y) y_.push_back(extent.y0 + (y + 0.5) * (extent.y1 - extent.y0) / size.height);
  }

  void top(int fan) {
    const double c = std::cos(sector_->elevation_rad(fan));
    if (c < 1e-9) return;
    const Wedges wedges(geometry_.azimuth_edges(), up_rad_);
    std::size_t i = 0;
    for (const double y : y_) {
      int beam = -1;
      for (const double x : x_) {
        const double horizontal = std::sqrt(x * x + y * y);
        const int sample = sample_at(horizontal / c);
        if (sample >= 0 && horizontal > 0.0) {
          if (!wedges.surely_in(beam, -y, x, horizontal)) beam = geometry_.beam_at(up_rad_ + std::atan2(x, -y));
          voxels_[i] = number(fan, beam, sample);
        }
        ++i;
      }
    }
  }

  void side(int beam) {
    const Wedges wedges = elevation_wedges();
    std::size_t i = 0;
    for (const double y : y_) {
      int fan = -1;
      for (const double x : x_) {
        const double range = std::sqrt(x * x + y * y);
        const int sample = sample_at(range);
        if (sample >= 0 && range > 0.0) {
          if (!wedges.surely_in(fan, x, -y, range)) fan = geometry_.fan_at(std::atan2(-y, x));
          voxels_[i] = number(fan, beam, sample);
        }
        ++i;
      }
    }
  }

  /// Azimuths are the columns', elevations the rows'.
  void shell(int sample) {
    std::vector<int> beams;
    for (const double x : x_) beams.push_back(geometry_.beam_on_axis(rad_from_deg(x)));
    std::size_t i = 0;
    for (const double y : y_) {
      const int fan = geometry_.fan_at(rad_from_deg(-y));
      for (const int beam : beams) voxels_[i++] = number(fan, beam, sample);
    }
  }

  void plane(const PlaneSlice& plane) {
    const Wedges wedges(geometry_.azimuth_edges(), 0.0);
    const Cones cones(geometry_.elevation_edges());
    std::vector<Point<Sonar>> columns;
    for (const double x : x_) columns.push_back(plane.origin + plane.right * x);
    std::size_t i = 0;
    for (const double y : y_) {
      const Point<Sonar> down = plane.down * y;
      int fan = -1;
      int beam = -1;
      for (const Point<Sonar>& column : columns) {
        const Point<Sonar> p = column + down;
        const double range = norm(p);
        const int sample = sample_at(range);
        if (sample >= 0 && range > 0.0) {
          const double sine = -p.z / range;
          if (!cones.surely_in(fan, sine)) fan = geometry_.fan_at(std::asin(std::clamp(sine, -1.0, 1.0)));
          if (fan >= 0 && !wedges.surely_in(beam, p.x, p.y, range)) beam = geometry_.beam_at(std::atan2(p.y, p.x));
          voxels_[i] = number(fan, beam, sample);
        }
        ++i;
      }
    }
  }

  std::vector<std::int32_t> take() { return std::move(voxels_); }

 private:
  /// Side slices do not unwrap: elevations reach from -180 to 180 degrees.
  [[nodiscard]] Wedges elevation_wedges() const {
    const std::vector<double>& edges = geometry_.elevation_edges();
    const bool within = edges.front() > -std::numbers::pi + 0.1 && edges.back() < std::numbers::pi - 0.1;
    return {edges, within ? 0.0 : 1e4};  // too many turns: nothing is sure
  }
  [[nodiscard]] int sample_at(double range_m) const {
    const double sample = sector_->range().sample_at(range_m) + 0.5;
    return sample >= 0.0 && sample < sector_->range().count ? static_cast<int>(sample) : -1;
  }
  [[nodiscard]] std::int32_t number(int fan, int beam, int sample) const {
    return fan < 0 || beam < 0 ? -1 : (fan * sector_->beams() + beam) * sector_->range().count + sample;
  }

  const Sector* sector_;
  SliceGeometry geometry_;
  double up_rad_;
  PixelSize size_;
  std::vector<double> x_;  ///< slice coordinates of the columns' and rows' middles
  std::vector<double> y_;
  std::vector<std::int32_t> voxels_;
};

}  // namespace

std::vector<std::int32_t> slice_voxels(const Sector& sector, const SliceView& view, const SliceExtent& extent,
                                       PixelSize size) {
  VoxelFinder finder(sector, view, extent, size);
  if (const auto* top = std::get_if<TopSlice>(&view.slice)) {
    finder.top(top->fan);
  } else if (const auto* side = std::get_if<SideSlice>(&view.slice)) {
    finder.side(side->beam);
  } else if (const auto* range = std::get_if<RangeSlice>(&view.slice)) {
    finder.shell(range->sample);
  } else {
    finder.plane(turned_plane(view));
  }
  return finder.take();
}

}  // namespace sonar
