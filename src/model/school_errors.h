// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "model/school_descriptors.h"

namespace sonar {

/// A column that tells the standard error of another.
struct ErrorColumn {
  std::string_view name;
  std::string_view unit;
  std::string_view figure;  ///< column of both tables that it is the error of
};
/// Standard errors of schools.csv by fading, threshold, calibration, sound speed and attitude (school/measure/school_errors.h).
/// In the order of the table.
inline constexpr auto kErrorColumns = std::to_array<ErrorColumn>({
    {"depth_se_m", "m", "depth_m"},
    {"volume_se_m3", "m3", "volume_m3"},
    {"length_se_m", "m", "length_m"},
    {"width_se_m", "m", "width_m"},
    {"height_se_m", "m", "height_m"},
    {"sv_mean_se_db", "dB", "sv_mean_db"},
    {"backscatter_se_m2", "m2", "backscatter_m2"},
    {"surface_se_m2", "m2", "surface_m2"},
    {"area_se_m2", "m2", "area_m2"},
    {"equivalent_radius_se_m", "m", "equivalent_radius_m"},
    {"box_length_se_m", "m", "box_length_m"},
    {"box_width_se_m", "m", "box_width_m"},
    {"box_thickness_se_m", "m", "box_thickness_m"},
    {"sphericity_se", "1", "sphericity"},
    {"roughness_se", "1", "roughness"},
    {"n_vacuoles_se", "1", "n_vacuoles"},
    {"vacuole_fraction_se", "1", "vacuole_fraction"},
    {"n_nuclei_se", "1", "n_nuclei"},
    {"sv_p5_se_db", "dB", "sv_p5_db"},
    {"sv_p50_se_db", "dB", "sv_p50_db"},
    {"sv_robust_mean_se_db", "dB", "sv_robust_mean_db"},
    {"sv_variation_se", "1", "sv_variation"},
    {"sv_skewness_se", "1", "sv_skewness"},
    {"sv_kurtosis_se", "1", "sv_kurtosis"},
    {"core_edge_se_db", "dB", "core_edge_db"},
    {"nasc_se_m2_nmi2", "m2 nautical_mile-2", "nasc_m2_nmi2"},
    {"surface_distance_se_m", "m", "surface_distance_m"},
    {"bottom_distance_se_m", "m", "bottom_distance_m"},
    {"horizontal_range_se_m", "m", "horizontal_range_m"},
    {"diner_nb_across_se", "1", "diner_nb_across"},
    {"diner_nb_height_se", "1", "diner_nb_height"},
    {"volume_corrected_se_m3", "m3", "volume_corrected_m3"},
    {"sv_corrected_se_db", "dB", "sv_corrected_db"},
});
inline constexpr std::size_t kErrorCount = kErrorColumns.size();

/// Place of a figure's error among them; kErrorCount = it has none.
[[nodiscard]] constexpr std::size_t error_at(std::string_view figure) {
  return static_cast<std::size_t>(std::find_if(kErrorColumns.begin(), kErrorColumns.end(),
                                               [&](const ErrorColumn& one) { return one.figure == figure; }) -
                                  kErrorColumns.begin());
}

/// One value for each of kErrorColumns.
using FigureValues = std::array<double, kErrorCount>;
[[nodiscard]] constexpr FigureValues unknown_figures() {
  FigureValues all{};
  all.fill(kUnknown);
  return all;
}

}  // namespace sonar
