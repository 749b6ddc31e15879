// SPDX-License-Identifier: Apache-2.0
#include "io/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "model/later_columns.h"

namespace sonar {
namespace {

using testing::HasSubstr;

TEST(Csv, header_is_the_published_one) {
  EXPECT_EQ(csv_text(std::vector<SchoolRow>{}),
            "observation,school_id,continues,first_time_utc,last_time_utc,n_pings,n_pings_whole,latitude,longitude,"
            "depth_m,volume_m3,volume_corrected_m3,length_m,width_m,height_m,sv_mean_db,sv_corrected_db,backscatter_m2,"
            "speed_mps,speed_se_mps,course_deg,vertical_speed_mps,touches_edge_fraction,origin,status,operator,"
            "decided_utc,species,comment,name,backscatter_psi_error_db,backscatter_calibration_se_db,"
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
            "diner_nb_height_se,volume_corrected_se_m3,sv_corrected_se_db\n");
  EXPECT_EQ(csv_text(std::vector<SchoolPingRow>{}),
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
            "course_water_smoothed_se_deg,course_away_se_deg,speed_away_water_se_mps,time_to_cpa_se_s,cpa_se_m\n");
}

TEST(Csv, rows_read_back) {
  SchoolRow row;
  row.observation = "obs-0001";
  row.school_id = 3;
  row.first_time_utc = time_from_calendar(2026, 11, 21, 3.25);
  row.latitude = 60.123456789;
  row.depth_m = 0.1;
  row.comment = "line one\nline \"two\", end";
  const auto table = parse_csv(csv_text(std::vector{row}), "x.csv");
  ASSERT_TRUE(table);
  const auto back = csv_rows<SchoolRow>(*table);
  ASSERT_TRUE(back) << to_line(back.error());
  ASSERT_EQ(back->size(), 1U);
  EXPECT_EQ((*back)[0].comment, row.comment);
  EXPECT_EQ((*back)[0].first_time_utc, row.first_time_utc);
  EXPECT_EQ((*back)[0].decided_utc, 0);
  EXPECT_EQ((*back)[0].latitude, 60.12345679);
  EXPECT_EQ((*back)[0].depth_m, 0.1);
  EXPECT_TRUE(std::isnan((*back)[0].speed_mps));
}

TEST(Csv, a_table_from_before_a_column_came_is_whole) {
  SchoolRow row;
  row.observation = "obs-0001";
  row.school_id = 3;
  row.comment = "last";
  std::string text = csv_text(std::vector{row});
  // As it was written before schools had names: the last columns are not there.
  const std::size_t later = text.find(",name,backscatter_psi_error_db,");
  ASSERT_NE(later, std::string::npos);
  text.erase(later, text.find('\n', later) - later);
  text.replace(text.find("last,,,,,,,0,"), text.size() - text.find("last,,,,,,,0,") - 1, "last");
  const auto table = parse_csv(text, "old.csv");
  ASSERT_TRUE(table);
  const auto back = csv_rows<SchoolRow>(*table);
  ASSERT_TRUE(back) << to_line(back.error());
  EXPECT_EQ((*back)[0].comment, "last");
  EXPECT_EQ((*back)[0].name, "");
  EXPECT_EQ((*back)[0].ended_at_reach, "");
  EXPECT_TRUE(std::isnan((*back)[0].backscatter_psi_error_db));
  EXPECT_FALSE(is_later_column("comment")) << "all others are asked for";
}

TEST(Csv, quotes_line_ends_and_byte_order_mark) {
  const auto table = parse_csv(
      "\xEF\xBB\xBF"
      "a,b\r\n\"x \"\"y\"\"\",\r\n\r\n\"1\n2\",3",
      "t.csv");
  ASSERT_TRUE(table) << to_line(table.error());
  EXPECT_EQ(table->header, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table->records.size(), 2U);
  EXPECT_EQ(table->records[0].fields, (std::vector<std::string>{"x \"y\"", ""}));
  EXPECT_EQ(table->records[1].fields, (std::vector<std::string>{"1\n2", "3"}));
  EXPECT_EQ(table->records[1].line, 4);
  EXPECT_TRUE(std::isnan(*table->number(table->records[0], 1)));
}

TEST(Csv, a_formula_stands_behind_an_apostrophe_where_asked) {
  SchoolRow row;
  row.name = "=1+1";
  row.comment = "+47 555, call";
  row.species = "a = b";
  row.vertical_speed_mps = -0.5;  // a number is none
  const auto back_of = [&](CsvTexts texts) {
    const auto table = parse_csv(csv_text(std::vector<SchoolRow>{row}, texts), "t.csv");
    return csv_rows<SchoolRow>(*table)->front();
  };
  EXPECT_EQ(back_of(CsvTexts::as_they_are).name, "=1+1");
  const SchoolRow guarded = back_of(CsvTexts::no_formulas);
  EXPECT_EQ(guarded.name, "'=1+1");
  EXPECT_EQ(guarded.comment, "'+47 555, call");
  EXPECT_EQ(guarded.species, "a = b");
  EXPECT_EQ(guarded.vertical_speed_mps, -0.5);
}

TEST(Csv, what_is_not_finite_is_unknown) {
  for (const char* text : {"inf", "-inf", "nan", "infinity", "1e999"}) {
    const auto table = parse_csv(std::string("a\n") + text + "\n", "t.csv");
    ASSERT_TRUE(table);
    EXPECT_FALSE(table->number(table->records[0], 0)) << text;
  }
  SchoolRow row;
  row.sv_mean_db = -std::numeric_limits<double>::infinity();  // 10 log10 of nothing
  row.latitude = std::numeric_limits<double>::infinity();
  const auto table = parse_csv(csv_text(std::vector<SchoolRow>{row}), "t.csv");
  ASSERT_TRUE(table);
  const auto back = csv_rows<SchoolRow>(*table);
  ASSERT_TRUE(back) << to_line(back.error());
  EXPECT_TRUE(std::isnan((*back)[0].sv_mean_db));
  EXPECT_TRUE(std::isnan((*back)[0].latitude));
}

TEST(Csv, errors_name_file_and_line) {
  const auto text_of = [](std::string_view text) { return to_line(parse_csv(text, "t.csv").error()); };
  EXPECT_THAT(text_of(""), HasSubstr("t.csv: has no header"));
  EXPECT_THAT(text_of("a,b\n1,2\n3\n"), HasSubstr("t.csv: line 3: 1 fields; the header has 2"));
  EXPECT_THAT(text_of("a,b\n1,\"2\n"), HasSubstr("line 2: a quote is never closed"));
  EXPECT_THAT(text_of("a,b\n\"1\"x,2\n"), HasSubstr("line 2: text after a closing quote"));
  EXPECT_THAT(text_of("a,a\n"), HasSubstr("'a' stands twice"));
  const auto table = parse_csv("channel,gain_db\n0,1.5x\n", "t.csv");
  ASSERT_TRUE(table);
  EXPECT_THAT(to_line(table->number(table->records[0], 1).error()), HasSubstr("line 2: column 'gain_db' holds '1.5x'"));
  EXPECT_EQ(*table->whole(table->records[0], 0), 0);
  EXPECT_THAT(to_line(table->require_column("none").error()), HasSubstr("no column 'none'"));
  EXPECT_THAT(to_line(csv_rows<SchoolRow>(*table).error()), HasSubstr("no column 'observation'"));
}

}  // namespace
}  // namespace sonar
