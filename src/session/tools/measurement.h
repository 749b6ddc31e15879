// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geo/frames.h"
#include "model/school.h"
#include "pipeline/stages/voxel_statistics.h"
#include "view/slices/slice.h"
#include "view/units.h"

namespace sonar {

/// An end of a measured line, as far as it is known.
struct MeasuredEnd {
  std::optional<Point<Sonar>> place;  ///< in the sector, beams not yet levelled; empty on a map
  std::optional<Voxel> voxel;
  std::optional<Geographic> where;  ///< empty without position or heading
  double depth_m = kUnknown;        ///< below the water line
  double sv_db = kUnknown;          ///< as shown
  friend bool operator==(const MeasuredEnd&, const MeasuredEnd&) = default;
};

/// From the first end of a line to the second.
struct LineFigures {
  double horizontal_m = kUnknown;
  double slant_m = kUnknown;      ///< in three dimensions; unknown on a map
  double bearing_deg = kUnknown;  ///< clockwise from true north, [0, 360); unknown of a line that is upright
  bool from_bow = false;          ///< the heading is not known: the bearing is from the bow, [-180, 180)
  double deeper_m = kUnknown;     ///< how much deeper the second end lies
  friend bool operator==(const LineFigures&, const LineFigures&) = default;
};

/// What lies within a box or a lasso.
struct AreaFigures {
  VoxelStatistics statistics;  ///< of the voxels that could belong to a school, as its own figures would be
  std::int64_t never = 0;      ///< the others: near the transducer, at the surface, at or behind the seabed
  int fans = 0;                ///< how many it goes through; 0 = the slice alone
  /// What schools took out of the beams is given back, and of sigma_bs so much was, dB; empty = figures are as heard.
  std::optional<double> extinction_db = {};
  friend bool operator==(const AreaFigures&, const AreaFigures&) = default;
};

/// What was measured with the measure tool, and its figures. It belongs to a ping of an observation, or to the chart.
struct Measurement {
  enum class Shape : std::uint8_t { line, box, lasso };
  enum class On : std::uint8_t { slice, volume, map };

  Shape shape = Shape::line;
  On on = On::slice;
  bool drawing = false;                    ///< its end is still in the hand
  std::shared_ptr<const int> observation;  ///< identity; null on a map
  std::string name;                        ///< of the observation; empty on a map
  std::int64_t ping = -1;                  ///< -1 on a map
  std::optional<Slice> slice;              ///< that it was drawn in
  std::vector<PixelPoint> outline;         ///< in the slice's coordinates, ship-up: both ends, or the closed line
  std::optional<std::array<MeasuredEnd, 2>> ends;  ///< of a line
  LineFigures line;
  AreaFigures area;

  friend bool operator==(const Measurement&, const Measurement&) = default;
};

/// Figures of a line; on a map by the geodesic.
/// placement      of the ping, where the ends have places
/// heading_known  else the bearing is from the bow
[[nodiscard]] LineFigures line_figures(const MeasuredEnd& from, const MeasuredEnd& to, const Placement& placement,
                                       bool heading_known);

/// A few lines to stand beside it.
[[nodiscard]] std::string brief_text(const Measurement& measured, const Units& units = {});
/// All of it in one line, for the status line.
[[nodiscard]] std::string whole_text(const Measurement& measured, const Units& units = {});
/// Two lines for a spreadsheet, columns set off by tabs: names with units, and figures. What is not known is empty.
[[nodiscard]] std::string table_text(const Measurement& measured, const Units& units = {});

}  // namespace sonar
