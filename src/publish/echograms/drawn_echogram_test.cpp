// SPDX-License-Identifier: Apache-2.0
#include "publish/echograms/drawn_echogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "base/units.h"
#include "io/product_example.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {
namespace {

constexpr double kRoll_deg = -20.0;  ///< port down

/// What an echogram of a beam shows of its only school, along depth: samples 40 to 49 of 2 m, 79 to 97 m away, in a beam 25
/// degrees down; of a product alone that was made under a recipe.
EchogramStretch school_under(const Recipe& recipe) {
  std::vector<ObservationProduct> products{example::empty("obs-0001", 4)};
  example::add_school(products[0], 1, 1, 1, example::block(0, 1, 2, 40, 10));
  products[0].recipe_json = recipe_text(recipe);
  for (PingNavigation& ping : products[0].pings) {
    ping.transducer_depth_m = 7.0;
    ping.roll_deg = kRoll_deg;
    ping.pitch_deg = 0.0;
  }
  const auto source = PictureSource::of(nullptr, std::move(products), recipe);
  PictureOptions options;
  options.fan = 0;
  options.beam = 1;
  options.kind.echogram.depth = true;
  Work work(1);
  const auto drawn = drawn_echogram(source->observations()[0], options, work);
  if (!drawn || drawn->schools.size() != 1 || drawn->schools[0].stretches.size() != 1) {
    ADD_FAILURE() << "one school in one piece is to be there";
    return {};
  }
  return drawn->schools[0].stretches[0];
}

// By hand, from the angles and, where the speed falls by 2 m/s each metre from 1490 m/s at 7 m, from the circle that a ray
// is then: artanh of the dip's sine grows by 2 each second, and the speed goes with the dip's cosine. A bin is 1.3 m at most:
// 2 m times the sine of the dip.
TEST(DrawnEchogram, OfAProductAloneLiesAtTheDepthsThatItsRecipeSays) {
  const double dip = rad_from_deg(25.0);
  const double roll = rad_from_deg(kRoll_deg);
  const double turned = std::sin(dip) * std::cos(roll) - std::cos(dip) * std::sin(rad_from_deg(87.5)) * std::sin(roll);
  const auto straight_m = [](double sine, double range_m) { return 7.0 + range_m * sine; };
  const auto bent_m = [](double sine, double range_m) {
    const double before = std::atanh(sine);
    return 7.0 + 745.0 * (1.0 - std::cosh(before) / std::cosh(before + 2.0 * range_m / 1490.0));
  };
  const auto expect = [](const EchogramStretch& shown, double from_m, double to_m) {
    EXPECT_NEAR(shown.from_m, from_m, 1.35);
    EXPECT_NEAR(shown.to_m, to_m, 1.35);
  };
  Recipe recipe;
  expect(school_under(recipe), straight_m(std::sin(dip), 79.0), straight_m(std::sin(dip), 97.0));
  recipe.navigation.beams_stabilised = false;
  expect(school_under(recipe), straight_m(turned, 79.0), straight_m(turned, 97.0));
  recipe.survey.sound_speed_profile = {{0.0, 1504.0}, {200.0, 1104.0}};
  expect(school_under(recipe), straight_m(turned, 79.0), straight_m(turned, 97.0));
  recipe.navigation.beams_stabilised = true;
  recipe.survey.bend_rays = true;
  expect(school_under(recipe), bent_m(std::sin(dip), 79.0), bent_m(std::sin(dip), 97.0));
}

}  // namespace
}  // namespace sonar
