// SPDX-License-Identifier: Apache-2.0
#include "model/transfer_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

// The default growth curve: 0 at -70 dB to 1 at -30 dB, so 0.025 a dB.
TEST(TransferFunction, DefaultGrowthCurve) {
  const TransferFunction curve;
  EXPECT_EQ(curve.opacity(-90), 0.0);
  EXPECT_EQ(curve.opacity(-70), 0.0);
  EXPECT_NEAR(curve.opacity(-60), 0.25, 1e-15);
  EXPECT_NEAR(curve.opacity(-50), 0.5, 1e-15);
  EXPECT_NEAR(curve.opacity(-31), 0.975, 1e-15);
  EXPECT_EQ(curve.opacity(-30), 1.0);
  EXPECT_EQ(curve.opacity(0), 1.0);
  EXPECT_EQ(curve.opacity_length_m(), 10.0);
}

TEST(TransferFunction, LinearBetweenPointsConstantOutside) {
  const auto made = TransferFunction::make(
      {{-70, 0.1, {0, 0, 0}}, {-60, 0.9, {1, 0.5, 0}}, {-50, 0.2, {0, 1, 1}}, {-40, 0.2, {1, 1, 1}}}, 5.0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->opacity(-100), 0.1);
  EXPECT_NEAR(made->opacity(-65), 0.5, 1e-15);
  EXPECT_NEAR(made->opacity(-60), 0.9, 1e-15);
  EXPECT_NEAR(made->opacity(-52.5), 0.375, 1e-15);
  EXPECT_EQ(made->opacity(10), 0.2);
  const std::array<double, 3> colour = made->colour(-55);
  EXPECT_NEAR(colour[0], 0.5, 1e-15);
  EXPECT_NEAR(colour[1], 0.75, 1e-15);
  EXPECT_NEAR(colour[2], 0.5, 1e-15);
}

TEST(TransferFunction, OnePointIsAConstant) {
  const auto flat = TransferFunction::make({{-50, 0.3}}, 1.0);
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->opacity(-80), 0.3);
  EXPECT_EQ(flat->opacity(-20), 0.3);
}

TEST(TransferFunction, TablesAgreeWithTheCurve) {
  const TransferFunction curve;
  const std::vector<float> table = curve.table_i16();
  ASSERT_EQ(table.size(), 65536U);
  EXPECT_EQ(table[0], 0.0F);  // "no data"
  for (const int count : {-32767, -6000, -5953, -4000, -2552, -2000, 0, 32767}) {
    EXPECT_EQ(table[static_cast<std::size_t>(count + 32768)], static_cast<float>(curve.opacity(db_from_counts(count))));
  }
  const auto steps = curve.table(5, -70, -30);
  ASSERT_EQ(steps.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(steps[i][3], 0.25F * static_cast<float>(i), 1e-7F);
}

TEST(TransferFunction, NotANumberIsTransparentAtMost) {
  EXPECT_EQ(TransferFunction().opacity(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

TEST(TransferFunction, RefusesWhatIsNoCurve) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](std::vector<TransferPoint> points, double length_m = 10.0) {
    const auto made = TransferFunction::make(std::move(points), length_m);
    return !made && made.error().code == ErrorCode::bad_parameter && !made.error().text.empty();
  };
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({{-50, 0.1}, {-50, 0.2}}));
  EXPECT_TRUE(refused({{-50, 0.1}, {-60, 0.2}}));
  EXPECT_TRUE(refused({{-50, 1.1}}));
  EXPECT_TRUE(refused({{-50, -0.1}}));
  EXPECT_TRUE(refused({{-50, nan}}));
  EXPECT_TRUE(refused({{nan, 0.5}}));
  EXPECT_TRUE(refused({{-50, 0.5}}, 0.0));
  EXPECT_TRUE(refused({{-50, 0.5}}, nan));
}

}  // namespace
}  // namespace sonar
