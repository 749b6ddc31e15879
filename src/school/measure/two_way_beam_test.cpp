// SPDX-License-Identifier: Apache-2.0
#include "school/measure/two_way_beam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "base/units.h"
#include "model/beam_angles.h"
#include "school/measure/vertical_fit.h"
#include "school/test_water.h"

namespace sonar {
namespace {

/// 10 log10 of the product of a beam's -3 dB widths, rad^2.
double widths_db(double vertical_deg, double horizontal_deg) {
  return db_from_linear(rad_from_deg(vertical_deg) * rad_from_deg(horizontal_deg));
}

BeamGrid grid_of(const std::vector<double>& vertical_deg, const std::vector<double>& horizontal_deg) {
  BeamGrid grid;
  for (std::size_t fan = 0; fan < vertical_deg.size(); ++fan) {
    grid.elevation_deg.push_back(-45.0 + 2.0 * static_cast<double>(fan));
    grid.channel.push_back(static_cast<int>(fan));
  }
  grid.azimuth_deg = {270.0};
  grid.vertical_width_deg = vertical_deg;
  grid.horizontal_width_deg = horizontal_deg;
  return grid;
}

/// Over exp(-4 ln 2 u^2) squared, (sin x / x)^2 squared: integrals pi / (8 ln 2) w^2 and (2 pi / 3 / 2.7831)^2 w^2.
constexpr double kSquareGaussian_db = -2.468;
constexpr double kSquareLine_db = -2.460;

TEST(TwoWayArea, IsOneForBeamsThatSendAsTheyReceive) {
  const BeamGrid grid = grid_of({6.6, 7.2}, {3.4, 2.9});
  for (const double square_db : {kSquareGaussian_db, kSquareLine_db}) {
    const std::vector<double> psi_db{widths_db(6.6, 3.4) + square_db, widths_db(7.2, 2.9) + square_db};
    EXPECT_EQ(two_way_area(grid, psi_db, {}), 1.0);
  }
}

// A Gaussian that sends everywhere in one plane has the one-way integral there, sqrt(2) of the two-way one.
TEST(TwoWayArea, IsWhatTheWideTransmitBeamMakesOfThem) {
  const BeamGrid grid = grid_of({6.6, 7.2}, {3.4, 2.9});
  const double wide_db = kSquareGaussian_db + db_from_linear(std::numbers::sqrt2);
  const std::vector<double> psi_db{widths_db(6.6, 3.4) + wide_db, widths_db(7.2, 2.9) + wide_db};
  EXPECT_NEAR(two_way_area(grid, psi_db, {}), std::numbers::sqrt2, 0.002);
}

TEST(TwoWayArea, IsOneWhereTheBeamAngleIsNoEvidence) {
  const BeamGrid grid = grid_of({6.6, 7.2}, {3.4, 2.0});
  const double wide_db = -1.0;
  const std::vector<double> sound{widths_db(6.6, 3.4) + wide_db, widths_db(7.2, 2.0) + wide_db};
  ASSERT_GT(two_way_area(grid, sound, {}), 1.3);
  EXPECT_EQ(two_way_area(grid, {}, {}), 1.0);
  EXPECT_EQ(two_way_area(grid, std::vector{0.0, 0.0}, {}), 1.0) << "not filled in";
  EXPECT_EQ(two_way_area(grid, std::vector{sound[0], std::numeric_limits<double>::quiet_NaN()}, {}), 1.0);
  EXPECT_EQ(two_way_area(grid, std::vector{sound[0], sound[0]}, {}), 1.0) << "copied though the widths differ";
  EXPECT_EQ(two_way_area(grid, std::vector{sound[0] + 5.0, sound[1] + 5.0}, {}), 1.0) << "wider than any beam";
  EXPECT_EQ(two_way_area(grid, std::vector{sound[0] - 9.0, sound[1] - 9.0}, {}), 1.0) << "narrower than both ways";
  EXPECT_EQ(two_way_area(grid_of({6.6, 0.0}, {3.4, 2.0}), sound, {}), 1.0) << "a width is missing";
}

// Fans 0, 10 and 19, beam 12, of a recorded MS70: from what neither pattern has down to nearly the square of one.
TEST(TwoWayArea, IsOneWhereTheBeamAngleGoesItsOwnWay) {
  const BeamGrid grid = grid_of({6.994, 6.370, 7.235}, {2.709, 3.250, 3.963});
  EXPECT_EQ(two_way_area(grid, std::vector{-18.83, -22.73, -22.67}, {}), 1.0);
}

// A wide transmit beam's 1.5 dB, rippled by 2.4 dB from crest to trough along fans, beams, or from one to the next; and
// the same where a slope of 2 dB over the fans, or over the beams, lies below it.
TEST(TwoWayArea, IsThatOfTheMeanWhereATransmitFanRipples) {
  const BeamGrid grid = test::grid();
  for (const double period : {2.0, 2.7, 3.3, 5.0, 6.7}) {
    for (const double along_fans : {0.0, 0.4, 1.0}) {
      for (const auto& [by_fan_db, by_beam_db] : {std::pair(0.0, 0.0), std::pair(2.0, 0.0), std::pair(0.0, 2.0)}) {
        std::vector<double> psi_db = psi_from_widths_db(grid);
        for (int row = 0; row < 500; ++row) {
          const int fan = row / 25;
          const int beam = row % 25;
          const double phase = 2.0 * std::numbers::pi * (along_fans * fan + (1.0 - along_fans) * beam + 0.3) / period;
          psi_db[static_cast<std::size_t>(row)] +=
              1.5 + 1.2 * std::sin(phase) + by_fan_db * (fan - 9.5) / 19.0 + by_beam_db * (beam - 12.0) / 24.0;
        }
        const double area_db = db_from_linear(two_way_area(grid, psi_db, {}));
        EXPECT_NEAR(area_db, by_fan_db + by_beam_db > 0.0 ? 0.0 : 1.5, 0.2) << period << " " << along_fans;
      }
    }
  }
}

double integral_of(const BeamShape& shape) {
  constexpr double kReach = 200.0;
  constexpr int kSteps = 200'000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    sum += two_way_pattern({shape.gaussian_share, 0.1, shape.transmit_ratio}, (i + 0.5) / kSteps * kReach);
  }
  return 2.0 * sum * kReach / kSteps;
}

// However the area is shared, the parts make it up. What sends everywhere has a tail, 1 / (pi x) of it beyond x.
TEST(BeamShapes, HaveTheAreaThatTheyAreAskedFor) {
  for (const double area : {1.0, 1.3, 1.8}) {
    const std::vector<BeamShape> shapes = beam_shapes(MeasureParams{}, area);
    EXPECT_GE(shapes.size(), area > 1.0 ? 10U : 5U);
    for (const BeamShape& shape : shapes) {
      const double square = integral_of({shape.gaussian_share, 1.0, 1.0});
      EXPECT_NEAR(integral_of(shape) / square * std::sqrt(shape.level_variance), area, 0.005)
          << shape.gaussian_share << " " << shape.transmit_ratio;
    }
    EXPECT_TRUE(std::any_of(shapes.begin(), shapes.end(), [&](const BeamShape& shape) {
      return area == 1.0 || area > 1.4 || (shape.transmit_ratio > 1.0 && shape.upright_variance < 1.0);
    })) << "sent all along the fan, and narrower upright";
  }
}

/// A line of elements: integrals of its two-way beam, sent unshaded and sent everywhere, over those of the square of a
/// Gaussian of the received beam's -3 dB width.
struct ShadedLine {
  std::vector<double> weights;
  double received(double x) const { return power(weights, x); }
  double sent(double x) const { return power(std::vector<double>(weights.size(), 1.0), x); }

  double width() const {
    double half = 0.0;
    while (received(half) > 0.5) half += 1e-5;
    return 2.0 * half;
  }
  /// unshaded  0 = sent everywhere, 1 = by the same line without its shading
  double widening(bool unshaded) const {
    constexpr int kSteps = 40'000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double x = (i + 0.5) / kSteps - 0.5;
      sum += received(x) * (unshaded ? sent(x) : 1.0) / kSteps;
    }
    return sum / (width() * std::sqrt(std::numbers::pi / (8.0 * std::numbers::ln2)));
  }

 private:
  /// x  sine of the angle, in wavelengths per distance of elements
  static double power(const std::vector<double>& weights, double x) {
    std::complex<double> sum;
    double all = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      sum += weights[i] * std::polar(1.0, 2.0 * std::numbers::pi * x * static_cast<double>(i));
      all += weights[i];
    }
    return std::norm(sum / all);
  }
};

/// From 2 pedestal - 1 at the ends of the aperture to 1 in its middle.
ShadedLine raised_cosine(double pedestal) {
  constexpr int kElements = 24;
  ShadedLine line;
  for (int i = 0; i < kElements; ++i) {
    const double turn = 2.0 * std::numbers::pi * ((i + 0.5) / kElements - 0.5);
    line.weights.push_back(pedestal + (1.0 - pedestal) * std::cos(turn));
  }
  return line;
}

// An array of any shading that receives with it both ways, and sends without it upright and all along the fan: the area
// alone tells how narrow its upright beam is. Heights hardly do, so that what is not told here is in them.
TEST(BeamShapes, AreAsNarrowUprightAsAShadedArrayThatSendsAllAlongTheFan) {
  for (const double pedestal : {0.54, 0.6, 0.7, 0.8}) {  // from Hamming's towards none
    const ShadedLine line = raised_cosine(pedestal);
    const double upright = line.widening(true);
    const double area = upright * line.widening(false);
    int free = 0;
    for (const BeamShape& shape : beam_shapes(MeasureParams{}, area)) {
      if (shape.handicap > 0.0) continue;
      ++free;
      EXPECT_NEAR(std::sqrt(shape.upright_variance) / upright, 1.0, 0.03) << area << " " << shape.gaussian_share;
      EXPECT_NEAR(std::sqrt(shape.upright_variance * shape.level_variance), area, 1e-9);
    }
    EXPECT_GT(free, 0) << area;
  }
}

TEST(BeamShapes, SendAsTheyReceiveWhereTheBeamAngleIsNotToBeUsed) {
  MeasureParams params;
  params.use_beam_angle = false;
  for (const BeamShape& shape : beam_shapes(params, 1.8)) {
    EXPECT_EQ(shape.transmit_ratio, 1.0);
    EXPECT_EQ(shape.upright_variance, 1.0);
    EXPECT_EQ(shape.level_variance, 1.0);
  }
}

}  // namespace
}  // namespace sonar
