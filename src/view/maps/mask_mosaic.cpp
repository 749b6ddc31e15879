// SPDX-License-Identifier: Apache-2.0
#include "view/maps/mask_mosaic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "base/units.h"

namespace sonar {
namespace {

/// Blocks of known length, so that compilers make vectors of them.
void take_larger(MaskMosaic::Cell* to, const MaskMosaic::Cell* from, int count) {
  constexpr int kBlock = 32;
  // NOLINTBEGIN(cppcoreguidelines-pro-type-member-init): written before they are read
  std::array<MaskMosaic::Cell, kBlock> a;
  std::array<MaskMosaic::Cell, kBlock> b;
  // NOLINTEND(cppcoreguidelines-pro-type-member-init)
  int i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    std::memcpy(a.data(), to + i, sizeof a);
    std::memcpy(b.data(), from + i, sizeof b);
    for (std::size_t k = 0; k < kBlock; ++k) a[k] = a[k] < b[k] ? b[k] : a[k];
    std::memcpy(to + i, a.data(), sizeof a);
  }
  for (; i < count; ++i) to[i] = std::max(to[i], from[i]);
}

/// Whether levelled() leaves every place where it is.
bool straight_and_level(const Placement& placement) {
  return placement.roll_rad == 0.0 && placement.pitch_rad == 0.0 && !placement.rays;
}

}  // namespace

MaskMosaic::MaskMosaic(const MapFrame& map, std::size_t pings, double cell_px, PlacementOf placed)
    : map_(map),
      cell_px_(cell_px),
      placed_(std::move(placed)),
      width_(std::max(1, static_cast<int>(std::ceil(map.place.width / cell_px)))),
      height_(std::max(1, static_cast<int>(std::ceil(map.place.height / cell_px)))),
      top_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0) {
  levels_.emplace_back(pings);
  while (levels_.back().size() > kFan) levels_.emplace_back((levels_.back().size() + kFan - 1) / kFan);
}

MaskMosaic::Patch MaskMosaic::patch(const Sector& sector, const PingNavigation& navigation,
                                    std::span<const MosaicMask> masks) const {
  Patch out;
  if (!navigation.has_position() || !std::isfinite(navigation.heading_deg)) return out;
  const auto here = map_.projection.forward(navigation.transducer);
  if (!here) return out;
  // A step on the map in metres to the bow and to starboard.
  const double bow = rad_from_deg(navigation.heading_deg) + map_.projection.north_rad(navigation.transducer);
  const double metres = cell_px_ * map_.true_metres_per_px(navigation.transducer);
  const double sine = std::sin(bow);
  const double cosine = std::cos(bow);
  PlanRaster raster;
  raster.width = width_;
  raster.height = height_;
  raster.x_step_u = metres * sine;
  raster.x_step_v = metres * cosine;
  raster.y_step_u = -metres * cosine;
  raster.y_step_v = metres * sine;
  const PixelPoint ship = map_.at(*here);
  const double x = (map_.place.x + 0.5 * cell_px_ - ship.x) / cell_px_;
  const double y = (map_.place.y + 0.5 * cell_px_ - ship.y) / cell_px_;
  raster.origin_u = x * raster.x_step_u + y * raster.y_step_u;
  raster.origin_v = x * raster.x_step_v + y * raster.y_step_v;
  const Placement placement = placed_(navigation);
  std::vector<MaskPatch> parts;
  Box box;
  for (const MosaicMask& m : masks) {
    if (m.mask == nullptr || m.mask->empty()) continue;
    const double bin_m = std::max(0.5 * metres, sector.range().spacing_m);
    parts.push_back(straight_and_level(placement) ? patch_of(plan_from_above(sector, *m.mask, bin_m), raster)
                                                  : patch_from_above(sector, *m.mask, placement, raster));
    const MaskPatch& p = parts.back();
    if (p.empty()) continue;
    include(box, Patch{p.first_x, p.first_y, p.width, p.height, {}});
  }
  if (box.empty()) return out;
  out = {box.x, box.y, box.end_x - box.x, box.end_y - box.y, {}};
  out.cells.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height), 0);
  std::size_t part = 0;
  for (const MosaicMask& m : masks) {
    if (m.mask == nullptr || m.mask->empty()) continue;
    const MaskPatch& p = parts[part++];
    const auto school = static_cast<Cell>(std::max(0, m.school) % kSchools);
    for (int j = 0; j < p.height; ++j) {
      for (int i = 0; i < p.width; ++i) {
        const std::uint8_t q =
            p.confidence[static_cast<std::size_t>(j) * static_cast<std::size_t>(p.width) + static_cast<std::size_t>(i)];
        if (q == 0) continue;
        Cell& cell = out.cells[static_cast<std::size_t>(p.first_y + j - out.y) * static_cast<std::size_t>(out.width) +
                               static_cast<std::size_t>(p.first_x + i - out.x)];
        cell = std::max(cell, static_cast<Cell>(static_cast<unsigned>(q) << 8U | school));
      }
    }
  }
  return out;
}

void MaskMosaic::include(Box& box, const Patch& p) {
  if (p.width <= 0 || p.height <= 0) return;
  if (box.empty()) {
    box = {p.x, p.y, p.x + p.width, p.y + p.height};
    return;
  }
  box = {std::min(box.x, p.x), std::min(box.y, p.y), std::max(box.end_x, p.x + p.width),
         std::max(box.end_y, p.y + p.height)};
}

void MaskMosaic::grow(Patch& patch, const Box& box) {
  Box all = box;
  include(all, patch);
  if (all.x == patch.x && all.y == patch.y && all.end_x == patch.x + patch.width &&
      all.end_y == patch.y + patch.height) {
    return;
  }
  Patch larger{all.x, all.y, all.end_x - all.x, all.end_y - all.y, {}};
  larger.cells.assign(static_cast<std::size_t>(larger.width) * static_cast<std::size_t>(larger.height), 0);
  for (int j = 0; j < patch.height; ++j) {
    const auto from = patch.cells.begin() + static_cast<std::ptrdiff_t>(j) * patch.width;
    std::copy(from, from + patch.width,
              larger.cells.begin() + static_cast<std::ptrdiff_t>(patch.y + j - larger.y) * larger.width +
                  (patch.x - larger.x));
  }
  touched_ += patch.cells.size();
  patch = std::move(larger);
}

void MaskMosaic::maxima(Cell* row, int y, const Box& box, std::span<const Patch> children) {
  std::fill(row, row + (box.end_x - box.x), Cell{0});
  for (const Patch& child : children) {
    if (y < child.y || y >= child.y + child.height) continue;
    const int first = std::max(box.x, child.x);
    const int count = std::min(box.end_x, child.x + child.width) - first;
    if (count <= 0) continue;
    const Cell* from = child.cells.data() + static_cast<std::ptrdiff_t>(y - child.y) * child.width + (first - child.x);
    Cell* to = row + (first - box.x);
    take_larger(to, from, count);
    touched_ += static_cast<std::uint64_t>(count);
  }
}

void MaskMosaic::refresh(Patch& node, std::span<const Patch> children, const Box& box) {
  grow(node, box);
  for (int y = box.y; y < box.end_y; ++y) {
    maxima(node.cells.data() + static_cast<std::ptrdiff_t>(y - node.y) * node.width + (box.x - node.x), y, box,
           children);
  }
}

void MaskMosaic::refresh_top(const Box& box) {
  for (int y = box.y; y < box.end_y; ++y) {
    maxima(top_.data() + static_cast<std::ptrdiff_t>(y) * width_ + box.x, y, box, levels_.back());
  }
}

void MaskMosaic::set(std::size_t ping, const Sector& sector, const PingNavigation& navigation,
                     std::span<const MosaicMask> masks) {
  SONAR_CHECK(ping < levels_.front().size());
  Patch& leaf = levels_.front()[ping];
  Box changed;
  include(changed, leaf);
  leaf = patch(sector, navigation, masks);
  include(changed, leaf);
  touched_ += leaf.cells.size();
  if (changed.empty()) return;
  std::size_t index = ping;
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    index /= kFan;
    const std::vector<Patch>& below = levels_[level - 1];
    const std::size_t first = index * kFan;
    refresh(levels_[level][index], std::span(below).subspan(first, std::min(kFan, below.size() - first)), changed);
  }
  refresh_top(changed);
}

}  // namespace sonar
