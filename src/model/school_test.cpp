// SPDX-License-Identifier: Apache-2.0
#include "model/school.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

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
            "backscatter_total_m2,backscatter_total_se_m2,survey_school,depth_error_m");
  EXPECT_EQ(names.seen.size(), 42U);
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
            "backscatter_total_m2,backscatter_total_se_m2,ended_at_reach,survey_school,depth_error_m");
  EXPECT_EQ(names.seen.size(), 37U);
}

// 1 fore, 2 aft, 4 top fan, 8 bottom fan, 16 near, 32 far, 64 seabed, 128 surface, 256 flagged data.
TEST(EdgeFlags, PublishedBits) {
  EXPECT_EQ(kTouchesEdge,
            kEdgeFore | kEdgeAft | kEdgeTopFan | kEdgeBottomFan | kEdgeNear | kEdgeFar | kEdgeSeabed | kEdgeSurface);
  EXPECT_EQ(kTouchesEdge & kEdgeFlagged, 0);
  EXPECT_EQ(kCutsCentre, 1 | 2 | 16 | 32);
}

}  // namespace
}  // namespace sonar
