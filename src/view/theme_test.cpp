// SPDX-License-Identifier: Apache-2.0
#include "view/theme.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "view/colour_map.h"
#include "view/contrast_example.h"

namespace sonar {
namespace {

using Three = std::array<double, 3>;
using Matrix = std::array<Three, 3>;

/// Eyes, as Machado, Oliveira and Fernandes 2009 have them in linear light: usual, without red, green and blue cones.
constexpr std::array<Matrix, 4> kEyes{
    {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
     {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
     {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}};

Three times(const Matrix& m, const Three& v) {
  Three out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

/// Oklab (Ottosson 2020), times 100.
Three seen(Rgba8 colour, const Matrix& eye) {
  const auto linear = [](int v) {
    const double c = v / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  Three light = times(eye, {linear(colour.r), linear(colour.g), linear(colour.b)});
  for (double& v : light) v = std::clamp(v, 0.0, 1.0);
  Three cones = times({{{0.4122214708, 0.5363325363, 0.0514459929},
                        {0.2119034982, 0.6806995451, 0.1073969566},
                        {0.0883024619, 0.2817188376, 0.6299787005}}},
                      light);
  for (double& v : cones) v = std::cbrt(v);
  Three lab = times({{{0.2104542553, 0.7936177850, -0.0040720468},
                      {1.9779984951, -2.4285922050, 0.4505937099},
                      {0.0259040371, 0.7827717662, -0.8086757660}}},
                    cones);
  for (double& v : lab) v *= 100.0;
  return lab;
}

double apart(Rgba8 a, Rgba8 b, const Matrix& eye) {
  const Three x = seen(a, eye);
  const Three y = seen(b, eye);
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

// 2 is about the least that eyes tell apart side by side; Okabe and Ito's own seven come as near as 7.6.
TEST(SchoolColours, AreToldApartByAllEyes) {
  for (int i = 0; i < kSchoolColours; ++i) {
    for (int j = 0; j < i; ++j) {
      const int steps = std::min(i - j, kSchoolColours - (i - j));
      for (const Matrix& eye : kEyes) {
        EXPECT_GT(apart(school_colour(i), school_colour(j), eye), steps <= 2 || steps == 12 ? 10.5 : 9.0)
            << i << ' ' << j;
      }
    }
  }
}

TEST(SchoolColours, AreNoneOfSvInAnyPalette) {
  constexpr int kSteps = 510;
  for (const std::string_view name : colour_map_names()) {
    const ColourMap& map = colour_map(*colour_map_named(name));
    for (int i = 0; i < kSchoolColours; ++i) {
      double nearest = 100.0;
      for (int step = 0; step <= kSteps; ++step) {
        nearest = std::min(nearest, apart(school_colour(i), map.at(static_cast<double>(step) / kSteps), kEyes[0]));
      }
      EXPECT_GT(nearest, 6.5) << i << ' ' << name;
    }
  }
}

TEST(SchoolColours, StandOutFromBothBackgrounds) {
  for (const Theme& theme : {light_theme({640, 480}), dark_theme({640, 480})}) {
    for (int i = 0; i < kSchoolColours; ++i) {
      EXPECT_GT(apart(school_colour(i), theme.water, kEyes[0]), 14.0) << i;
      EXPECT_GT(apart(school_colour(i), theme.plot, kEyes[0]), 10.0) << i;
    }
  }
}

TEST(SchoolColours, AreNotThatOfRejectedSchools) {
  for (const Theme& theme : {light_theme({640, 480}), dark_theme({640, 480})}) {
    for (int i = 0; i < kSchoolColours; ++i) EXPECT_GT(apart(school_colour(i), theme.muted, kEyes[0]), 6.0) << i;
  }
}

TEST(SchoolColours, ComeRoundAfterTwentyFour) {
  EXPECT_EQ(school_colour(25), school_colour(1));
  EXPECT_EQ(school_colour(-1), school_colour(23));
  EXPECT_NE(school_colour(13), school_colour(1));
  EXPECT_NE(school_colour(8), school_colour(1));
}

// Of some schools' colours the rim is all that a chart's marks have.
TEST(Theme, RimsOfMarksStandOutFromThePlot) {
  for (const Theme& theme : {light_theme({800, 600}), dark_theme({800, 600})}) {
    EXPECT_GE(contrast_example::contrast(theme.axis, theme.plot), 3.0);
  }
}

}  // namespace
}  // namespace sonar
