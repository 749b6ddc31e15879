// SPDX-License-Identifier: Apache-2.0
#include "publish/maps/map_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "io/product_example.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {
namespace {

bool says(const FrameDescription& frame, const std::string& words) {
  return std::any_of(frame.items.begin(), frame.items.end(), [&](const auto& item) {
    const auto* text = std::get_if<TextItem>(&item);
    return text != nullptr && text->text.find(words) != std::string::npos;
  });
}

/// A school that the clock cut, one beside it, and one that a human rejected.
std::unique_ptr<PictureSource> cut_survey() {
  const TimeNs step = static_cast<TimeNs>(example::kPingSeconds * 1e9);
  const TimeNs first = example::kStart + 10 * step;
  const PingMask mask = example::block(1, 1, 2, 20, 10);
  std::vector<ObservationProduct> products{
      example::empty("obs-0001", 10),
      example::empty("obs-0002", 10, destination({60.0, 5.0}, 10 * example::kPingSeconds * example::kShip_mps, 0.0),
                     first)};
  products[1].cut_after = first - step;
  example::add_school(products[0], 1, 5, 9, mask);
  example::add_school(products[0], 2, 0, 2, mask);
  example::add_school(products[0], 3, 0, 2, example::block(0, 1, 2, 20, 10));
  products[0].schools[2].status = "rejected";
  example::add_school(products[1], 1, 0, 4, mask);
  for (ObservationProduct& product : products) {
    for (SchoolRow& school : product.schools) {
      school.speed_mps = example::kShip_mps;
      school.course_deg = 0.0;
      school.length_m = 20.0;
    }
  }
  return PictureSource::of(nullptr, std::move(products), {});
}

TEST(MapPictures, CountASchoolOverACutOnceAndARejectedOneNever) {
  const auto source = cut_survey();
  Work work(1);
  PictureOptions options;
  const auto survey = survey_map_frame(source->observations(), options, work);
  ASSERT_TRUE(survey) << to_line(survey.error());
  EXPECT_TRUE(says(*survey, "2 observations, 2 schools"));
  const auto observation = observation_map_frame(source->observations()[0], options);
  ASSERT_TRUE(observation) << to_line(observation.error());
  EXPECT_TRUE(says(*observation, "10 pings, 2 schools"));
  // One of the two is drawn: one is left out, whichever of its parts was named.
  options.schools = {2};
  EXPECT_TRUE(says(*survey_map_frame(source->observations(), options, work), "1 of 2 schools"));
}

/// One school of four rows, of which each continues the one before it, and two that continue a fifth; all over a cut.
std::unique_ptr<PictureSource> chained_survey() {
  const PingMask mask = example::block(1, 1, 2, 20, 10);
  std::vector<ObservationProduct> products{
      example::empty("obs-0001", 10), example::empty("obs-0002", 10, {60.1, 5.0}, example::kStart + 100'000'000'000)};
  for (int id = 1; id <= 4; ++id) example::add_school(products[0], id, 2 * id - 2, 2 * id - 1, mask);
  for (std::size_t i = 1; i < 4; ++i) products[0].schools[i].continues = "obs-0001/" + std::to_string(i);
  example::add_school(products[1], 5, 0, 3, mask);
  products[1].schools[0].continues = "obs-0001/3";
  return PictureSource::of(nullptr, std::move(products), {});
}

// Whichever rows of a school are drawn, and however they hang together, it is one school and none is left out.
TEST(MapPictures, RowsOfOneSchoolAreOneWhereWhatTheyContinueIsNotDrawn) {
  const auto source = chained_survey();
  Work work(1);
  for (const std::vector<std::int64_t>& drawn :
       std::vector<std::vector<std::int64_t>>{{1, 3}, {2, 4}, {1, 4}, {2, 3}}) {
    PictureOptions options;
    options.schools = drawn;
    const auto observation = observation_map_frame(source->observations()[0], options);
    ASSERT_TRUE(observation) << to_line(observation.error());
    EXPECT_TRUE(says(*observation, "10 pings, 1 school")) << drawn[0] << " " << drawn[1];
    EXPECT_FALSE(says(*observation, "10 pings, 1 schools"));
    EXPECT_FALSE(says(*observation, " of 1 school"));
  }
  // Over the cut as well.
  PictureOptions options;
  options.schools = {1, 5};
  EXPECT_TRUE(says(*survey_map_frame(source->observations(), options, work), "2 observations, 1 school"));
}

/// What the map of one school shows of it.
std::vector<Image> images_under(const Recipe& recipe, double roll_deg) {
  std::vector<ObservationProduct> products{example::empty("obs-0001", 4)};
  example::add_school(products[0], 1, 1, 1, example::block(0, 1, 2, 40, 10));
  products[0].recipe_json = recipe_text(recipe);
  for (PingNavigation& ping : products[0].pings) ping.roll_deg = roll_deg;
  const auto source = PictureSource::of(nullptr, std::move(products), recipe);
  const auto map = observation_map_frame(source->observations()[0], PictureOptions{});
  EXPECT_TRUE(map);
  std::vector<Image> images;
  for (const auto& item : map->items) {
    if (const auto* image = std::get_if<ImageItem>(&item)) images.push_back(*image->image);
  }
  return images;
}

// How far masks move is view's to say (TurnedMasks); whether they do is the product's own recipe's.
TEST(MapPictures, AnObservationsMapFollowsTheRecipeOfItsProduct) {
  Recipe recipe;
  const auto plain = images_under(recipe, 0.0);
  ASSERT_FALSE(plain.empty());
  EXPECT_EQ(images_under(recipe, 20.0), plain) << "stabilised";
  recipe.survey.sound_speed_profile = {{0.0, 1504.0}, {100.0, 1304.0}};
  EXPECT_EQ(images_under(recipe, 0.0), plain) << "a profile that bends nothing";
  recipe.survey.bend_rays = true;
  EXPECT_NE(images_under(recipe, 0.0), plain);
  recipe = {};
  recipe.navigation.beams_stabilised = false;
  EXPECT_EQ(images_under(recipe, 0.0), plain) << "fixed to a ship that lies still";
  EXPECT_NE(images_under(recipe, 20.0), plain);
}

}  // namespace
}  // namespace sonar
