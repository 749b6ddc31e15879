// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "base/describe.h"
#include "base/result.h"
#include "geo/frames.h"

namespace sonar {

struct SeabedRasterParams {
  double cell_m = 10.0;
  bool geographic = false;
};

template <class Visitor>
void describe(Visitor& v, SeabedRasterParams& p) {
  v.field("cell_m", p.cell_m,
          {.unit = "m",
           .min = 0.5,
           .max = 10000,
           .text = "Side of a cell of the seabed's raster; raise it where few beams hit each cell."});
  v.field("geographic", p.geographic, {.text = "Lay the raster along latitudes and longitudes instead of UTM."});
}

/// One beam's depth of the seabed.
struct SeabedDepth {
  Geographic place;
  double depth_m = 0.0;  ///< positive down, below the mean water line
  double se_m = 0.0;     ///< standard error
  int fan = 0;
};

/// Depths gathered in square cells: their mean weighted by 1 / se^2. Beams of one fan err alike (in the shape of their
/// pattern, in their direction), so that a cell's standard error falls with the root of the number of its fans, not of
/// its beams.
/// threads  one at a time
class SeabedRaster {
 public:
  /// near  whose UTM zone is taken; cells are aligned to whole multiples of their size
  SeabedRaster(const SeabedRasterParams& params, const Geographic& near);
  ~SeabedRaster();
  SeabedRaster(const SeabedRaster&) = delete;
  SeabedRaster& operator=(const SeabedRaster&) = delete;

  /// Leaves out what has no place or no error.
  void add(const SeabedDepth& depth);
  [[nodiscard]] bool empty() const { return cells_.empty(); }
  /// Bands depth (m, positive down), standard_error (m), count (beams); cells without a beam hold NoData.
  /// errors  io, no_space; unsupported: more than 200 million cells
  [[nodiscard]] Result<void> write(const std::filesystem::path& target, const std::string& description) const;

 private:
  struct Cell {
    double weight = 0.0;
    double weighted_m = 0.0;
    std::int64_t beams = 0;
    std::uint64_t fans = 0;  ///< a bit each, by the number modulo 64
  };
  struct Projection;
  double step_x_;
  double step_y_;
  int epsg_ = 4326;
  Geographic near_;
  std::unique_ptr<Projection> projection_;                       ///< null where the raster is geographic
  std::map<std::pair<std::int64_t, std::int64_t>, Cell> cells_;  ///< (row from the south, column)
};

}  // namespace sonar
