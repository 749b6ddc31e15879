// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/mask.h"
#include "model/navigation.h"
#include "model/outline.h"
#include "view/maps/map_frame.h"
#include "view/theme.h"
#include "view/volume/mask_plan.h"

namespace sonar {

/// One school's mask in a ping, as the mosaic takes it.
struct MosaicMask {
  int school = 0;  ///< number of its colour; kept modulo 252
  const PingMask* mask = nullptr;
};

/// Maximum projection from above of the masks of all pings of an observation, on a raster that lies in a map. A ping is
/// put, changed or taken away by itself: what depends on it is a box of cells in a tree of maxima over pings, sixteen to
/// a node, so that nothing else is touched however many pings there are.
/// threads  one object belongs to one thread
class MaskMosaic {
 public:
  /// A cell's largest confidence (upper byte) and the school that has it; 0 = nothing.
  using Cell = std::uint16_t;
  [[nodiscard]] static std::uint8_t confidence(Cell c) { return static_cast<std::uint8_t>(c >> 8U); }
  [[nodiscard]] static int school(Cell c) { return c & 0xFFU; }

  /// Schools are kept modulo this: a whole number of rounds of school_colour().
  static constexpr int kSchools = 240;
  static_assert(kSchools % kSchoolColours == 0);

  /// map      where the raster lies; it covers `map.place`
  /// pings    of the observation
  /// cell_px  size of a cell
  /// placed   how the pings lie
  MaskMosaic(const MapFrame& map, std::size_t pings, double cell_px = 1.0,
             PlacementOf placed = &PingNavigation::placement);

  /// Replaces what a ping shows; no masks = nothing. A ping without position or heading shows nothing.
  void set(std::size_t ping, const Sector& sector, const PingNavigation& navigation, std::span<const MosaicMask> masks);

  [[nodiscard]] double cell_px() const { return cell_px_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const std::vector<Cell>& cells() const { return top_; }
  [[nodiscard]] Cell at(int x, int y) const {
    return top_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }
  /// Cells read or written by all calls of set() so far: what an update costs, countable.
  [[nodiscard]] std::uint64_t cells_touched() const { return touched_; }

 private:
  struct Patch {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    std::vector<Cell> cells;
  };
  struct Box {
    int x = 0;
    int y = 0;
    int end_x = 0;
    int end_y = 0;
    [[nodiscard]] bool empty() const { return end_x <= x || end_y <= y; }
  };
  static constexpr std::size_t kFan = 16;

  [[nodiscard]] Patch patch(const Sector& sector, const PingNavigation& navigation,
                            std::span<const MosaicMask> masks) const;
  static void include(Box& box, const Patch& patch);
  void grow(Patch& patch, const Box& box);
  /// row  of a raster, from box.x on
  void maxima(Cell* row, int y, const Box& box, std::span<const Patch> children);
  void refresh(Patch& node, std::span<const Patch> children, const Box& box);
  void refresh_top(const Box& box);

  MapFrame map_;
  double cell_px_;
  PlacementOf placed_;
  int width_ = 0;
  int height_ = 0;
  std::vector<std::vector<Patch>> levels_;  ///< [0] pings, then sixteen of the level below to a node
  std::vector<Cell> top_;
  std::uint64_t touched_ = 0;
};

}  // namespace sonar
