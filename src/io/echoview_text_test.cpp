// SPDX-License-Identifier: Apache-2.0
#include "io/echoview_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sonar {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two fans of three beams, samples 1 m apart from 0 m on, pings a second apart.
ObservationProduct two_schools() {
  ObservationProduct product;
  product.observation = "obs-0001";
  GridRecord grid;
  grid.grid.elevation_deg = {-10.0, -5.0};
  grid.grid.azimuth_deg = {240.0, 243.0, 246.0};
  grid.range = {0.0, 1.0, 100};
  product.grid = grid;
  product.pings.resize(4);
  for (std::size_t i = 0; i < 4; ++i) product.pings[i].time = static_cast<TimeNs>(i) * kSecondNs;
  product.schools.resize(2);
  product.schools[0].school_id = 3;
  product.schools[0].species = "st\xF8rje\r\nEVRG";
  product.schools[1].school_id = 5;
  // School 3 in fan 0 of ping 1 and in fan 1 of ping 2; school 5 in fan 0 of pings 1 and 3, and not in 2.
  product.masks = {{3, 1, {{{0, 10, 5}, {2, 12, 8}}, {}}},
                   {3, 2, {{{4, 10, 5}}, {}}},
                   {5, 1, {{{1, 50, 1}}, {}}},
                   {5, 3, {{{1, 60, 2}}, {}}}};
  return product;
}

// Samples 10 to 19 of ping 1 reach from 9.5 to 19.5 m, from half a second before it to half a second after.
TEST(EchoviewText, ARegionReachesFromTheNearestSampleToTheFarthest) {
  const std::string text = evr_text(two_schools(), 0);
  EXPECT_THAT(text, HasSubstr("\r\n3\r\n")) << "one of school 3, and two of school 5, which a ping is without";
  EXPECT_THAT(text, HasSubstr("13 6 1 0 2 -1 1 19700101 0000005000 9.5000 19700101 0000015000 19.5000\r\n"));
  EXPECT_THAT(text, HasSubstr("19700101 0000010000 9.5000 19700101 0000015000 9.5000 19700101 0000015000 19.5000 "));
  EXPECT_THAT(text, HasSubstr("\r\nobs-0001/3\r\n"));
  EXPECT_THAT(evr_text(two_schools(), 1), Not(HasSubstr("obs-0001/5")));
}

TEST(EchoviewText, ANameIsOneLineOfUtf8) {
  EXPECT_THAT(evr_text(two_schools(), 1), HasSubstr("\r\nst\uFFFDrje\uFFFD EVRG\r\n"));
}

TEST(EchoviewText, RejectedSchoolsAreLeftOut) {
  ObservationProduct product = two_schools();
  for (SchoolRow& school : product.schools) school.status = "rejected";
  EXPECT_EQ(evr_text(product, 0), "");
}

}  // namespace
}  // namespace sonar
