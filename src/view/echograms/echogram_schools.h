// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/beam_grid.h"
#include "model/product.h"
#include "model/refused_echo.h"
#include "view/echograms/echogram_rows.h"
#include "view/frame_description.h"

namespace sonar {

/// Some cells of one ping that follow each other, as heights: from the upper edge of the first to the lower one of the last.
struct EchogramStretch {
  std::size_t ping = 0;  ///< of the echogram
  double from_m = 0.0;
  double to_m = 0.0;
  friend bool operator==(const EchogramStretch&, const EchogramStretch&) = default;
};

/// A school as an echogram has it: all cells that hold a sample of its masks in the beams that are shown.
struct EchogramSchool {
  std::int64_t school_id = 0;
  std::string status;
  std::vector<EchogramStretch> stretches;  ///< by ping, then height; none meets another of its ping
};

/// The rows that an echogram shows of a ping.
using RowsOfPing = std::function<std::vector<EchogramRow>(std::int64_t ping_index)>;

/// Those of a product's schools that an echogram cuts, in the order of its rows of schools.
/// first, pings  of the observation that the echogram shows
[[nodiscard]] std::vector<EchogramSchool> echogram_schools(const ObservationProduct& product, const RowsOfPing& rows,
                                                           const EchogramRange& range, std::int64_t first,
                                                           std::int64_t pings);

/// Where an echogram of a ping lies in the shadow of schools: cells whose beams, heard alike, would lose least_db or more of
/// their mean both ways. Of one beam that is from a sample to the record's end.
/// shadow  [row][sample] what was taken, as a factor >= 1 of sv; empty = nothing of that beam
/// rows    that the echogram shows of the ping
/// ping    of the echogram
[[nodiscard]] std::vector<EchogramStretch> echogram_shadow(std::span<const std::vector<double>> shadow,
                                                           std::span<const EchogramRow> rows,
                                                           const EchogramRange& range, int samples, double least_db,
                                                           std::size_t ping);

/// Refused echoes of the pings and beams that an echogram shows, each at its height there and at its ping of the echogram.
/// echoes  of the observation
[[nodiscard]] std::vector<RefusedEcho> echogram_refused(std::span<const RefusedEcho> echoes, const BeamGrid& grid,
                                                        const RowsOfPing& rows, std::int64_t first, std::int64_t pings);

/// What a school takes of one column: x from..to, and its stretches there, rising and apart.
struct OutlinedColumn {
  double from = 0.0;
  double to = 0.0;
  std::vector<std::pair<double, double>> stretches;
};
/// The edge of columns of cells as closed rings, even-odd; columns touch where one ends at the very place where the next
/// begins. Corners alone are points.
[[nodiscard]] std::vector<PathItem::Part> outline_of_columns(std::span<const OutlinedColumn> columns);

}  // namespace sonar
