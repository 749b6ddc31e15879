// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibrate/setup_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "geo/geodesic.h"
#include "io/product_example.h"
#include "io/product_file.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

/// Ten pings on a course, and schools that rest 200 m to port; bearings from the ship are too large.
ObservationProduct on_course(const std::string& name, double course_deg, double bearing_error_deg) {
  const double metres = example::kPingSeconds * example::kShip_mps;
  ObservationProduct p = example::empty(name, 10);
  for (std::size_t i = 0; i < p.pings.size(); ++i) {
    p.pings[i].transducer = destination({60.0, 5.0}, static_cast<double>(i) * metres, course_deg);
  }
  for (int id = 1; id <= 3; ++id) example::add_school(p, id, 0, 9, example::block(id - 1, 1, 2, 20, 10));
  const Geographic rests = destination({60.0, 5.0}, 200.0, course_deg - 90.0);
  for (SchoolPingRow& row : p.school_pings) {
    const Geographic ship = p.pings[static_cast<std::size_t>(row.ping_index)].transducer;
    const GeodesicStep way = geodesic(ship, rests);
    const Geographic seen = destination(ship, way.distance_m, way.bearing_deg + bearing_error_deg);
    row.latitude = seen.latitude_deg;
    row.longitude = seen.longitude_deg;
  }
  return p;
}

TEST(SetupReport, ProposesFromProductsAlone) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_product(on_course("obs-0001", 0.0, 2.0), folder.path() / "obs-0001.nc"));
  Work work(1);
  const auto one = setup_report(folder.path(), work);
  ASSERT_TRUE(one) << one.error().text;
  EXPECT_TRUE(std::isnan(one->proposed_mounting_azimuth_deg));
  EXPECT_THAT(setup_text(*one), testing::HasSubstr("nothing is proposed"));
  EXPECT_TRUE(nlohmann::json::parse(setup_json_text(*one))["drift"].is_null());

  ObservationProduct second = on_course("obs-0002", 90.0, 2.0);
  for (SchoolPingRow& row : second.school_pings) {
    if (row.school_id == 3) row.latitude += 1e-4 * static_cast<double>(row.ping_index);
  }
  second.schools[2].status = "rejected";
  ASSERT_TRUE(write_product(second, folder.path() / "obs-0002.nc"));
  const auto both = setup_report(folder.path(), work);
  ASSERT_TRUE(both) << both.error().text;
  EXPECT_EQ(both->check.schools, 5U);
  EXPECT_EQ(both->check.legs.size(), 2U);
  EXPECT_NEAR(both->proposed_mounting_azimuth_deg, 268.0, 0.02);
  EXPECT_EQ(both->sound_speed_mps, 1490.0);  // of the example
  EXPECT_NEAR(both->proposed_sound_speed_mps, 1490.0, 1.0);
  EXPECT_NEAR(nlohmann::json::parse(setup_json_text(*both))["bearing_error_deg"].get<double>(), 2.0, 0.02);

  second.recipe_hash = "other";
  ASSERT_TRUE(write_product(second, folder.path() / "obs-0002.nc"));
  EXPECT_EQ(setup_report(folder.path(), work).error().code, ErrorCode::mismatch);
}

}  // namespace
}  // namespace sonar
