// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/integration_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "pipeline/integrate/integrate_params.h"

namespace sonar {
namespace {

constexpr double kNasc = 4.0 * std::numbers::pi * 1852.0 * 1852.0;  // 4.3101e7

EffortUnit unit(std::string transect, std::int64_t edsu, double sailed_m, EffortType type = EffortType::transect) {
  EffortUnit out;
  out.transect = std::move(transect);
  out.edsu = edsu;
  out.sailed_m = sailed_m;
  out.type = type;
  out.times = {1, 2};
  out.transducers.resize(2);
  return out;
}

CellSums cell(double water_m3, double heard_m3, double sv) {
  CellSums sums;
  sums.water_m3 = water_m3;
  sums.heard_m3 = heard_m3;
  sums.echo_m2 = sv * heard_m3;
  sums.beam_m3 = 0.5 * heard_m3;
  sums.noise_m2 = 1e-9 * heard_m3;
  sums.variance_m4 = std::pow(0.1 * sums.echo_m2, 2);
  sums.whole_m4 = sums.variance_m4;
  return sums;
}

TEST(IntegrationRows, of_one_cell_by_hand) {
  UnitSums sums;
  sums.pings = 2;
  sums.area_m2[1] = 1000.0;
  CellSums one = cell(8000.0, 4000.0, 1e-6);
  one.school_m3 = 400.0;
  one.school_m2 = 0.9 * one.echo_m2;
  sums.cells[{1, 3}] = one;
  const std::vector<EffortUnit> units{unit("A", 1, 1852.0)};
  const IntegrationTables tables = integration_tables(units, std::vector{sums}, {});
  ASSERT_EQ(tables.nasc.size(), 1U);
  const NascRow& row = tables.nasc[0];
  EXPECT_EQ(row.range_from_m, 50.0);
  EXPECT_EQ(row.range_to_m, 100.0);
  EXPECT_EQ(row.depth_from_m, 30.0);
  EXPECT_EQ(row.depth_to_m, 40.0);
  EXPECT_EQ(row.height_m, 8.0);
  EXPECT_EQ(row.valid_fraction, 0.5);
  EXPECT_NEAR(row.filled_fraction, 0.1, 1e-12);
  EXPECT_NEAR(row.sv_mean_db, -60.0, 1e-9);
  EXPECT_NEAR(row.sv_se_db, 0.4343, 1e-4);  // 10 % of it
  EXPECT_NEAR(row.snr_db, 30.0, 1e-9);
  EXPECT_NEAR(row.sv_school_db, -50.4576, 1e-4);  // nine times as strong as the whole
  EXPECT_NEAR(row.sv_rest_db, -69.5424, 1e-4);    // a tenth of the echo in nine tenths of the water
  EXPECT_NEAR(row.sv_layer_db, -60.0 + 3.0103, 1e-4);
  EXPECT_NEAR(row.nasc_m2_nmi2, kNasc * 8e-6, 1e-6);
  EXPECT_NEAR(row.nasc_school_m2_nmi2 + row.nasc_rest_m2_nmi2, row.nasc_m2_nmi2, 1e-9);
  EXPECT_NEAR(row.nasc_layer_m2_nmi2, 2.0 * row.nasc_m2_nmi2, 1e-9);
  EXPECT_NEAR(tables.effort.at(0).nasc_m2_nmi2, row.nasc_m2_nmi2, 1e-9);
}

// Two units, 1 and 3 nmi long, of one cell 10 m high whose echo was 1e-6 and 3e-6; of it a quarter, of the second nothing,
// was given back. By hand: NASC 4.3101e7 x 1e-5 = 431.0 of the first, 107.8 of it; transect (107.8 + 3 x 0) / 4.
TEST(IntegrationRows, what_was_given_back_for_extinction_is_told_on_every_level) {
  const auto sums_of = [](double sv, double share) {
    UnitSums sums;
    sums.pings = 1;
    sums.area_m2[0] = 100.0;
    CellSums one = cell(1000.0, 1000.0, sv);
    one.extinction_m2 = share * one.echo_m2;
    one.extinction_low_m2 = 0.8 * one.extinction_m2;
    one.extinction_high_m2 = 1.2 * one.extinction_m2;
    sums.cells[{0, 0}] = one;
    sums.extinction_corrected = true;
    return sums;
  };
  const std::vector<EffortUnit> units{unit("A", 1, 1852.0), unit("A", 2, 3.0 * 1852.0)};
  std::vector<UnitSums> sums{sums_of(1e-6, 0.25), sums_of(3e-6, 0.0)};
  const IntegrationTables tables = integration_tables(units, sums, {});
  const double given_back = 0.25 * kNasc * 1e-6 * 10.0;
  EXPECT_NEAR(tables.nasc.at(0).nasc_extinction_m2_nmi2, given_back, 1e-6);
  EXPECT_NEAR(tables.nasc.at(0).nasc_extinction_low_m2_nmi2, 0.8 * given_back, 1e-6);
  EXPECT_NEAR(tables.nasc.at(0).nasc_extinction_high_m2_nmi2, 1.2 * given_back, 1e-6);
  EXPECT_NEAR(tables.effort.at(0).nasc_extinction_m2_nmi2, given_back, 1e-6);
  EXPECT_EQ(tables.effort.at(1).nasc_extinction_m2_nmi2, 0.0);
  ASSERT_EQ(tables.strata.size(), 3U);
  for (const StratumRow& row : tables.strata) {
    EXPECT_NEAR(row.nasc_extinction_m2_nmi2, given_back / 4.0, 1e-6) << row.level;
    EXPECT_NEAR(row.nasc_extinction_high_m2_nmi2, 1.2 * given_back / 4.0, 1e-6) << row.level;
  }
  EXPECT_NE(extinction_text(tables).find("26.9 m2 nmi-2"), std::string::npos) << extinction_text(tables);

  for (UnitSums& one : sums) one.extinction_corrected = false;
  const IntegrationTables off = integration_tables(units, sums, {});
  EXPECT_TRUE(std::isnan(off.nasc.at(0).nasc_extinction_m2_nmi2));
  EXPECT_TRUE(std::isnan(off.effort.at(0).nasc_extinction_m2_nmi2));
  EXPECT_TRUE(std::isnan(off.strata.at(2).nasc_extinction_m2_nmi2));
  EXPECT_EQ(extinction_text(off), "");
}

TEST(IntegrationRows, a_channel_of_a_unit_is_its_mean_over_all_ranges_as_high_as_where_it_is_highest) {
  UnitSums sums;
  sums.pings = 1;
  sums.area_m2[0] = 100.0;
  sums.area_m2[1] = 300.0;
  sums.cells[{0, 0}] = cell(500.0, 500.0, 4e-6);    // 5 m of it
  sums.cells[{1, 0}] = cell(3000.0, 1500.0, 2e-6);  // 10 m, half of it heard
  const std::vector<EffortUnit> units{unit("A", 1, 100.0)};
  const IntegrationTables tables = integration_tables(units, std::vector{sums}, {});
  EXPECT_NEAR(tables.effort.at(0).nasc_m2_nmi2, kNasc * 2.5e-6 * 10.0, 1e-6);
}

TEST(IntegrationRows, a_layer_is_corrected_for_the_beam_that_misses_it_at_each_range) {
  // The layer's sv is 8e-6; half of the beam is in it near by, a quarter farther off.
  constexpr double kLayerSv = 8e-6;
  UnitSums sums;
  sums.pings = 1;
  sums.area_m2[0] = 100.0;
  sums.area_m2[1] = 300.0;
  sums.cells[{0, 0}] = cell(1000.0, 1000.0, 0.5 * kLayerSv);
  sums.cells[{1, 0}] = cell(3000.0, 3000.0, 0.25 * kLayerSv);
  sums.cells[{1, 0}].beam_m3 = 0.25 * 3000.0;
  CellLayout layer;
  layer.max_channels = 1;
  const std::vector<EffortUnit> units{unit("A", 1, 100.0), unit("B", 1, 300.0)};
  const std::vector both{sums, sums};
  const IntegrationTables tables = integration_tables(units, both, layer);
  const double nasc = kNasc * kLayerSv * 10.0;
  EXPECT_NEAR(tables.effort.at(0).nasc_layer_m2_nmi2, nasc, 1e-9 * nasc);
  EXPECT_LT(tables.effort[0].nasc_m2_nmi2, 0.5 * nasc);
  ASSERT_EQ(tables.strata.size(), 4U);
  for (const StratumRow& row : tables.strata) EXPECT_NEAR(row.nasc_layer_m2_nmi2, nasc, 1e-9 * nasc) << row.level;
  // Channels of one height each hear the others' fish: corrected ones have no sum.
  EXPECT_TRUE(std::isnan(integration_tables(units, both, {}).effort.at(0).nasc_layer_m2_nmi2));
}

TEST(IntegrationRows, water_in_which_nothing_was_heard_and_units_without_pings_have_their_rows) {
  UnitSums empty;
  UnitSums lost;
  lost.pings = 1;
  lost.area_m2[0] = 100.0;
  lost.cells[{0, 0}] = cell(500.0, 0.0, 0.0);
  const std::vector<EffortUnit> units{unit("A", 1, 100.0), unit("A", 2, 100.0), unit("", 0, 50.0, EffortType::off)};
  const IntegrationTables tables = integration_tables(units, std::vector{empty, lost, empty}, {});
  ASSERT_EQ(tables.effort.size(), 3U);
  EXPECT_TRUE(std::isnan(tables.effort[0].nasc_m2_nmi2));
  EXPECT_TRUE(std::isnan(tables.effort[0].n_schools));
  ASSERT_EQ(tables.nasc.size(), 1U);
  EXPECT_EQ(tables.nasc[0].valid_fraction, 0.0);
  EXPECT_TRUE(std::isnan(tables.nasc[0].nasc_m2_nmi2));
  EXPECT_TRUE(std::isnan(tables.strata.at(0).nasc_m2_nmi2));
  EXPECT_NEAR(tables.strata.at(0).distance_nmi, 200.0 / 1852.0, 1e-12);
}

TEST(IntegrationRows, where_nobody_looked_for_schools_their_columns_are_unknown) {
  UnitSums sums;
  sums.pings = 1;
  sums.schools_known = false;
  sums.area_m2[0] = 100.0;
  sums.cells[{0, 0}] = cell(500.0, 500.0, 4e-6);
  const std::vector<EffortUnit> units{unit("A", 1, 100.0)};
  const IntegrationTables tables = integration_tables(units, std::vector{sums}, {});
  EXPECT_TRUE(std::isfinite(tables.nasc.at(0).nasc_m2_nmi2));
  for (const double unknown :
       {tables.nasc[0].nasc_school_m2_nmi2, tables.nasc[0].nasc_rest_m2_nmi2, tables.nasc[0].filled_fraction,
        tables.effort.at(0).nasc_school_m2_nmi2, tables.effort[0].n_schools, tables.strata.at(0).nasc_school_m2_nmi2}) {
    EXPECT_TRUE(std::isnan(unknown));
  }
}

TEST(CellLayout, is_channels_of_one_height_or_one_layer) {
  IntegrateParams params;
  EXPECT_EQ(cell_layout(params)->depth_m(3), 30.0);
  params.layer_top_m = 35.0;
  params.layer_bottom_m = 47.0;
  EXPECT_EQ(cell_layout(params)->max_channels, 1);
  EXPECT_EQ(cell_layout(params)->depth_m(1), 47.0);
  params.layer_bottom_m = 30.0;
  EXPECT_EQ(cell_layout(params).error().code, ErrorCode::bad_parameter);
  params = {};
  params.depth_min_m = 15.0;
  EXPECT_EQ(cell_layout(params)->depth_m(0), 15.0);
  EXPECT_GT(cell_layout(params)->max_channels, 1000);
  params.depth_max_m = 88.0;  // channels of 10 m to 85 m
  EXPECT_EQ(cell_layout(params)->max_channels, 7);
  params.depth_max_m = 24.0;
  EXPECT_EQ(cell_layout(params).error().code, ErrorCode::bad_parameter);
  params = {};
  params.depth_channel_m = 12.3;
  params.depth_max_m = 36.9;
  EXPECT_EQ(cell_layout(params)->max_channels, 3);
  params = {};
  params.edsu_nmi = 0.0;
  EXPECT_FALSE(cell_layout(params));
}

}  // namespace
}  // namespace sonar
