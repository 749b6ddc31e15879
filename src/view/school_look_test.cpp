// SPDX-License-Identifier: Apache-2.0
#include "view/school_look.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "view/maps/map_example.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{1000, 760};

/// Schools 1 and 2 are one: 3 m2 in each of four pings; 3 is rejected, and 4 one of its own.
ObservationProduct parted() {
  const Geographic start{60.0, 5.0};
  ObservationProduct p = map_example::product("obs-0001", 60, start);
  const auto add = [&](std::int64_t id, int first, double m2) {
    map_example::add_school(p, id, destination(p.pings[static_cast<std::size_t>(first)].transducer, 60.0, 270.0), first,
                            first + 1, map_example::block(2, 1, 2, 25, 5));
    p.schools.back().backscatter_total_m2 = m2;
    for (SchoolPingRow& row : p.school_pings) {
      if (row.school_id == id) row.backscatter_total_m2 = m2;
    }
  };
  add(1, 20, 3.0);
  add(2, 22, 3.0);
  add(3, 30, 50.0);
  add(4, 40, 1.0);
  p.schools[1].continues = "obs-0001/1";
  p.schools[2].status = "rejected";
  return p;
}

TEST(SchoolLook, TheFirstRowOfASchoolHasAllOfItsCircle) {
  const std::vector<ObservationProduct> all{parted()};
  SurveyMapStyle style;
  style.rejected = true;
  const Theme theme = light_theme(kSize);
  const SchoolLook look(all, style, theme);
  const auto& rows = all[0].schools;
  EXPECT_EQ(look.schools(), 2U);
  EXPECT_DOUBLE_EQ(look.backscatter_m2(rows[0]), 3.0);
  EXPECT_EQ(look.backscatter_m2(rows[1]), 0.0);
  EXPECT_EQ(look.school_of(rows[1]), look.school_of(rows[0]));
  EXPECT_EQ(look.school_of(rows[2]), nullptr);
  EXPECT_DOUBLE_EQ(look.backscatter_m2(rows[3]), 1.0);
  // Areas are as 1 to 3: the largest that counts sets the scale, not one that a human rejected.
  EXPECT_NEAR(look.radius_px(3.0) / look.radius_px(1.0), std::sqrt(3.0), 1e-12);
  EXPECT_EQ(look.radius_px(50.0), look.radius_px(3.0));
}

TEST(SchoolLook, TheMapsCaptionCountsAsItDoes) {
  const std::vector<ObservationProduct> all{parted()};
  for (const bool rejected : {false, true}) {
    SurveyMapStyle style;
    style.rejected = rejected;
    const auto frame = survey_map(all, {}, nullptr, style, kSize, light_theme(kSize));
    ASSERT_TRUE(frame) << to_line(frame.error());
    EXPECT_TRUE(map_example::says(*frame, "1 observation, 2 schools"));
  }
}

}  // namespace
}  // namespace sonar
