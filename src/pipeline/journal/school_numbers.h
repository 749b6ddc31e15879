// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/time.h"
#include "model/beam_grid.h"
#include "model/product.h"
#include "pipeline/stages/measure_schools.h"

namespace sonar {

/// What earlier products of the same pings know of schools: their numbers, which, once published, stay with them, and where
/// they lay.
struct EarlierSchools {
  struct Layer {
    std::vector<TimeNs> ping_times;   ///< [ping_index of the product], datagram times
    std::vector<int> channel_of_row;  ///< of the product's grid
    std::vector<SchoolMask> masks;    ///< rows of the product's grid
    std::int64_t first_number = 0;    ///< a product before it may have given those below to other schools
  };
  std::vector<Layer> layers;
  std::int64_t next_school_id = 1;  ///< above every number that was ever given

  /// Adds a product.
  /// time_offset_s  what the product's recipe added to the datagrams' times
  void add(ObservationProduct product, double time_offset_s);
};

/// The numbers that an observation's schools had at the look before, while it goes on.
[[nodiscard]] EarlierSchools numbers_of(const ObservationProduct& before);

/// The mask's runs on another grid's rows; beams that it has not are left out. Confidences are all 1.
[[nodiscard]] PingMask on_rows(const PingMask& mask, const std::vector<int>& channel_of_row,
                               const std::vector<int>& row_of_channel);

/// Gives schools the numbers that they had: those that share most voxels first (same ping time, channel and sample),
/// each number and each school once; the others go on from next_school_id in their order.
/// schools  numbered, in order; grid, ping_times: of their observation
/// out      the next free number
[[nodiscard]] std::int64_t keep_numbers(std::vector<SchoolMasks>& schools, const BeamGrid& grid,
                                        std::span<const TimeNs> ping_times, const EarlierSchools& earlier);

}  // namespace sonar
