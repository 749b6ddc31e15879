// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "model/school_descriptors.h"
#include "model/school_errors.h"

namespace sonar {

/// Columns of movement, of both tables.
inline constexpr std::array<std::string_view, 34> kMovementColumns{"speed_smoothed_mps",
                                                                   "speed_smoothed_se_mps",
                                                                   "course_smoothed_deg",
                                                                   "vertical_speed_smoothed_mps",
                                                                   "speed_water_smoothed_mps",
                                                                   "course_water_smoothed_deg",
                                                                   "relative_bearing_deg",
                                                                   "ship_speed_mps",
                                                                   "course_away_deg",
                                                                   "speed_away_mps",
                                                                   "speed_away_se_mps",
                                                                   "speed_away_water_mps",
                                                                   "time_to_cpa_s",
                                                                   "cpa_m",
                                                                   "wake_distance_m",
                                                                   "course_se_deg",
                                                                   "vertical_speed_se_mps",
                                                                   "tortuosity",
                                                                   "tortuosity_se",
                                                                   "speed_water_mps",
                                                                   "speed_water_se_mps",
                                                                   "course_water_deg",
                                                                   "course_water_se_deg",
                                                                   "current_east_mps",
                                                                   "current_north_mps",
                                                                   "current_se_mps",
                                                                   "course_smoothed_se_deg",
                                                                   "vertical_speed_smoothed_se_mps",
                                                                   "speed_water_smoothed_se_mps",
                                                                   "course_water_smoothed_se_deg",
                                                                   "course_away_se_deg",
                                                                   "speed_away_water_se_mps",
                                                                   "time_to_cpa_se_s",
                                                                   "cpa_se_m"};

/// Columns that came after the first published tables: a file without them is whole, and has none of it.
[[nodiscard]] constexpr bool is_later_column(std::string_view column) {
  constexpr std::string_view kLater[] = {"name",
                                         "backscatter_psi_error_db",
                                         "backscatter_calibration_se_db",
                                         "backscatter_total_m2",
                                         "backscatter_total_se_m2",
                                         "ended_at_reach",
                                         "survey_school",
                                         "depth_error_m",
                                         "extinction_loss_db",
                                         "extinction_share",
                                         "extinction_share_low",
                                         "extinction_share_high",
                                         "extinction_corrected",
                                         "box_bearing_deg",
                                         "box_tilt_deg",
                                         "mass_latitude",
                                         "mass_longitude",
                                         "mass_depth_m",
                                         "nasc_extinction_m2_nmi2",
                                         "nasc_extinction_low_m2_nmi2",
                                         "nasc_extinction_high_m2_nmi2"};
  return std::find(std::begin(kLater), std::end(kLater), column) != std::end(kLater) ||
         std::any_of(kDescriptorColumns.begin(), kDescriptorColumns.end(),
                     [&](const DescriptorColumn& one) { return one.name == column; }) ||
         std::find(kMovementColumns.begin(), kMovementColumns.end(), column) != kMovementColumns.end() ||
         std::any_of(kErrorColumns.begin(), kErrorColumns.end(),
                     [&](const ErrorColumn& one) { return one.name == column; });
}

}  // namespace sonar
