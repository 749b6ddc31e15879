// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <string_view>

namespace sonar {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Form, echo, place and resolution of a school, in one ping or as a median over several. NaN = unknown.
struct SchoolDescriptors {
  double surface_m2 = kUnknown;
  double area_m2 = kUnknown;
  double equivalent_radius_m = kUnknown;
  double box_length_m = kUnknown;
  double box_width_m = kUnknown;
  double box_thickness_m = kUnknown;
  double sphericity = kUnknown;
  double roughness = kUnknown;
  double n_vacuoles = kUnknown;  ///< a count; a number that may be unknown, as in products of older versions
  double vacuole_fraction = kUnknown;
  double n_nuclei = kUnknown;  ///< the same
  double sv_p5_db = kUnknown;
  double sv_p50_db = kUnknown;
  double sv_robust_mean_db = kUnknown;
  double sv_variation = kUnknown;
  double sv_skewness = kUnknown;
  double sv_kurtosis = kUnknown;
  double core_edge_db = kUnknown;
  double nasc_m2_nmi2 = kUnknown;
  double surface_distance_m = kUnknown;
  double bottom_distance_m = kUnknown;
  double horizontal_range_m = kUnknown;
  double incidence_deg = kUnknown;
  double diner_nb_across = kUnknown;
  double diner_nb_height = kUnknown;
};

/// A column of SchoolDescriptors.
struct DescriptorColumn {
  std::string_view name;
  std::string_view unit;
  double SchoolDescriptors::*value;
};
/// In the order of the tables.
inline constexpr auto kDescriptorColumns = std::to_array<DescriptorColumn>({
    {"surface_m2", "m2", &SchoolDescriptors::surface_m2},
    {"area_m2", "m2", &SchoolDescriptors::area_m2},
    {"equivalent_radius_m", "m", &SchoolDescriptors::equivalent_radius_m},
    {"box_length_m", "m", &SchoolDescriptors::box_length_m},
    {"box_width_m", "m", &SchoolDescriptors::box_width_m},
    {"box_thickness_m", "m", &SchoolDescriptors::box_thickness_m},
    {"sphericity", "1", &SchoolDescriptors::sphericity},
    {"roughness", "1", &SchoolDescriptors::roughness},
    {"n_vacuoles", "1", &SchoolDescriptors::n_vacuoles},
    {"vacuole_fraction", "1", &SchoolDescriptors::vacuole_fraction},
    {"n_nuclei", "1", &SchoolDescriptors::n_nuclei},
    {"sv_p5_db", "dB re 1 m-1", &SchoolDescriptors::sv_p5_db},
    {"sv_p50_db", "dB re 1 m-1", &SchoolDescriptors::sv_p50_db},
    {"sv_robust_mean_db", "dB re 1 m-1", &SchoolDescriptors::sv_robust_mean_db},
    {"sv_variation", "1", &SchoolDescriptors::sv_variation},
    {"sv_skewness", "1", &SchoolDescriptors::sv_skewness},
    {"sv_kurtosis", "1", &SchoolDescriptors::sv_kurtosis},
    {"core_edge_db", "dB", &SchoolDescriptors::core_edge_db},
    {"nasc_m2_nmi2", "m2 nautical_mile-2", &SchoolDescriptors::nasc_m2_nmi2},
    {"surface_distance_m", "m", &SchoolDescriptors::surface_distance_m},
    {"bottom_distance_m", "m", &SchoolDescriptors::bottom_distance_m},
    {"horizontal_range_m", "m", &SchoolDescriptors::horizontal_range_m},
    {"incidence_deg", "degrees", &SchoolDescriptors::incidence_deg},
    {"diner_nb_across", "1", &SchoolDescriptors::diner_nb_across},
    {"diner_nb_height", "1", &SchoolDescriptors::diner_nb_height},
});

}  // namespace sonar
