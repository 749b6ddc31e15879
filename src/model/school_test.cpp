// SPDX-License-Identifier: Apache-2.0
#include "model/school.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

#include "model/product.h"

namespace sonar {
namespace {

struct Names {
  std::string line;
  std::set<std::string> seen;
  template <class Member>
  void operator()(std::string_view name, std::string_view, Member&&) {
    line += (line.empty() ? "" : ",") + std::string(name);
    seen.emplace(name);
  }
};

// The published order of columns (docs/interfaces.md), which other people's scripts read.
TEST(SchoolColumns, OfPings) {
  Names names;
  SchoolPingRow row;
  columns(names, row);
  EXPECT_EQ(names.line,
            "observation,school_id,ping_index,time_utc,latitude,longitude,depth_m,range_m,bearing_deg,n_voxels,n_beams,"
            "n_fans,volume_m3,length_m,width_m,height_m,axis_deg,depth_min_m,depth_max_m,sv_mean_db,sv_p95_db,"
            "sv_max_db,backscatter_m2,valid_fraction,volume_corrected_m3,length_corrected_m,width_corrected_m,"
            "height_corrected_m,sv_corrected_db,snr_db,threshold_db,edge_flags,edge_fraction,touches_edge,"
            "bottom_depth_m,provisional,backscatter_psi_error_db,backscatter_calibration_se_db,"
            "backscatter_total_m2,backscatter_total_se_m2,survey_school,"
            "surface_m2,area_m2,equivalent_radius_m,box_length_m,box_width_m,box_thickness_m,sphericity,"
            "roughness,n_vacuoles,vacuole_fraction,n_nuclei,sv_p5_db,sv_p50_db,sv_robust_mean_db,"
            "sv_variation,sv_skewness,sv_kurtosis,core_edge_db,nasc_m2_nmi2,surface_distance_m,"
            "bottom_distance_m,horizontal_range_m,incidence_deg,diner_nb_across,diner_nb_height,"
            "box_bearing_deg,box_tilt_deg,mass_latitude,mass_longitude,mass_depth_m,"
            "speed_smoothed_mps,speed_smoothed_se_mps,course_smoothed_deg,vertical_speed_smoothed_mps,"
            "speed_water_smoothed_mps,course_water_smoothed_deg,relative_bearing_deg,ship_speed_mps,"
            "course_away_deg,speed_away_mps,speed_away_se_mps,speed_away_water_mps,time_to_cpa_s,cpa_m,"
            "wake_distance_m,depth_error_m,"
            "extinction_loss_db,extinction_share,extinction_share_low,extinction_share_high,extinction_corrected,"
            "course_smoothed_se_deg,vertical_speed_smoothed_se_mps,speed_water_smoothed_se_mps,"
            "course_water_smoothed_se_deg,course_away_se_deg,speed_away_water_se_mps,time_to_cpa_se_s,cpa_se_m");
  EXPECT_EQ(names.seen.size(), 100U);
}

TEST(SchoolColumns, OfTracks) {
  Names names;
  SchoolRow row;
  columns(names, row);
  EXPECT_EQ(names.line,
            "observation,school_id,continues,first_time_utc,last_time_utc,n_pings,n_pings_whole,latitude,longitude,"
            "depth_m,volume_m3,volume_corrected_m3,length_m,width_m,height_m,sv_mean_db,sv_corrected_db,"
            "backscatter_m2,speed_mps,speed_se_mps,course_deg,vertical_speed_mps,touches_edge_fraction,origin,status,"
            "operator,decided_utc,species,comment,name,backscatter_psi_error_db,backscatter_calibration_se_db,"
            "backscatter_total_m2,backscatter_total_se_m2,ended_at_reach,survey_school,"
            "surface_m2,area_m2,equivalent_radius_m,box_length_m,box_width_m,box_thickness_m,sphericity,"
            "roughness,n_vacuoles,vacuole_fraction,n_nuclei,sv_p5_db,sv_p50_db,sv_robust_mean_db,"
            "sv_variation,sv_skewness,sv_kurtosis,core_edge_db,nasc_m2_nmi2,surface_distance_m,"
            "bottom_distance_m,horizontal_range_m,incidence_deg,diner_nb_across,diner_nb_height,"
            "course_se_deg,vertical_speed_se_mps,tortuosity,tortuosity_se,speed_water_mps,speed_water_se_mps,"
            "course_water_deg,course_water_se_deg,current_east_mps,current_north_mps,current_se_mps,depth_error_m,"
            "extinction_loss_db,extinction_share,extinction_share_low,extinction_share_high,extinction_corrected,"
            "depth_se_m,volume_se_m3,length_se_m,width_se_m,height_se_m,sv_mean_se_db,backscatter_se_m2,"
            "surface_se_m2,area_se_m2,equivalent_radius_se_m,box_length_se_m,box_width_se_m,box_thickness_se_m,"
            "sphericity_se,roughness_se,n_vacuoles_se,vacuole_fraction_se,n_nuclei_se,sv_p5_se_db,sv_p50_se_db,"
            "sv_robust_mean_se_db,sv_variation_se,sv_skewness_se,sv_kurtosis_se,core_edge_se_db,nasc_se_m2_nmi2,"
            "surface_distance_se_m,bottom_distance_se_m,horizontal_range_se_m,diner_nb_across_se,"
            "diner_nb_height_se,volume_corrected_se_m3,sv_corrected_se_db");
  EXPECT_EQ(names.seen.size(), 111U);
}

// 1 fore, 2 aft, 4 top fan, 8 bottom fan, 16 near, 32 far, 64 seabed, 128 surface, 256 flagged data.
TEST(EdgeFlags, PublishedBits) {
  EXPECT_EQ(kTouchesEdge,
            kEdgeFore | kEdgeAft | kEdgeTopFan | kEdgeBottomFan | kEdgeNear | kEdgeFar | kEdgeSeabed | kEdgeSurface);
  EXPECT_EQ(kTouchesEdge & kEdgeFlagged, 0);
  EXPECT_EQ(kCutsCentre, 1 | 2 | 16 | 32);
}

TEST(ObservationProduct, WithoutVoxelsIsAllTheRest) {
  ObservationProduct whole;
  int count = 0;
  for (std::string* text : {&whole.observation, &whole.program_version, &whole.title, &whole.source, &whole.history,
                            &whole.recipe_json, &whole.recipe_hash, &whole.stage_versions, &whole.input_hash}) {
    *text = std::to_string(++count);
  }
  whole.input_files.resize(1);
  whole.pings.resize(2);
  whole.background_db.resize(2);
  whole.grid.emplace();
  whole.schools.resize(3);
  whole.school_pings.resize(4);
  whole.masks.resize(4);
  whole.rejected.resize(5);
  whole.diagnostics.resize(6);
  whole.next_school_id = 7;
  whole.cut_after = 8;
  const ObservationProduct rows = without_voxels(whole);
  EXPECT_TRUE(rows.masks.empty());
  EXPECT_TRUE(rows.background_db.empty());
  EXPECT_EQ(rows.observation + rows.program_version + rows.title + rows.source + rows.history + rows.recipe_json +
                rows.recipe_hash + rows.stage_versions + rows.input_hash,
            "123456789");
  EXPECT_EQ(rows.input_files.size(), 1U);
  EXPECT_EQ(rows.pings.size(), 2U);
  EXPECT_TRUE(rows.grid);
  EXPECT_EQ(rows.schools.size(), 3U);
  EXPECT_EQ(rows.school_pings.size(), 4U);
  EXPECT_EQ(rows.rejected.size(), 5U);
  EXPECT_EQ(rows.diagnostics.size(), 6U);
  EXPECT_EQ(rows.next_school_id, 7);
  EXPECT_EQ(rows.cut_after, 8);
}

}  // namespace
}  // namespace sonar
