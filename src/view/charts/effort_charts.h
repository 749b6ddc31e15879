// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/integration.h"
#include "view/axes.h"
#include "view/frame_description.h"
#include "view/sv_scale.h"
#include "view/theme.h"

namespace sonar {

/// A unit of sailed distance (EDSU) in a chart of echo integration.
struct EffortPlace {
  std::size_t row = 0;    ///< of effort.csv
  double from_nmi = 0.0;  ///< sailed on all transects before it
  double to_nmi = 0.0;
};
/// Units of transects one behind the other, in the order of their rows; what is off effort has none.
[[nodiscard]] std::vector<EffortPlace> effort_places(std::span<const EffortRow> effort);

/// A chart over sailed distance, and what lies where in it.
struct EffortChart {
  FrameDescription frame;
  PlotFrame plot;
  std::vector<EffortPlace> places;
  struct Cell {
    PixelRect place;
    std::size_t place_of = 0;  ///< in `places`
    double sv_db = kUnknown;
    double depth_from_m = kUnknown;
    double depth_to_m = kUnknown;
  };
  std::vector<Cell> cells;  ///< of a section
  /// A unit, and how far along it, 0 to 1.
  struct At {
    std::size_t row = 0;  ///< of effort.csv
    double share = 0.0;
  };
  [[nodiscard]] std::optional<At> at(PixelPoint pixel) const;
  [[nodiscard]] const Cell* cell(PixelPoint pixel) const;
};

/// NASC of each unit over sailed distance: a step, with a band of 95 % (1.96 standard errors, by fading) where they are told,
/// and the part that is of schools.
/// errors  bad_parameter: too small a picture; not_found: no unit with a NASC
[[nodiscard]] Result<EffortChart> nasc_chart(std::span<const EffortRow> effort, PixelSize size, const Theme& theme);

/// Sv by unit and depth channel: of one range bin, or the mean of all of them, linear and weighted by sampled volume.
/// range_from_m  where the bin begins; empty = all bins
/// errors        bad_parameter: too small a picture; not_found: no cell with an Sv
[[nodiscard]] Result<EffortChart> sv_section(std::span<const EffortRow> effort, std::span<const NascRow> nasc,
                                             std::optional<double> range_from_m, const SvColours& colours,
                                             PixelSize size, const Theme& theme);

}  // namespace sonar
