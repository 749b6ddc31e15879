// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/setup/setup_page.h"
#include "session/setup/sphere_page.h"
#include "session/test_app.h"

namespace sonar {
namespace {

class SetupPages : public testing::Test, protected TestApp {
 protected:
  void SetUp() override { begin(); }
  void settle(SpherePage& page) {
    do {
      document().settle();
      page.wait();
    } while (queue_.drain() > 0);
  }
};

TEST_F(SetupPages, APresetFillsTheFieldsAndOtherFieldsAreOnesOwn) {
  SpherePage page(*app_);
  ASSERT_TRUE(page.asked().set("sphere", Choice{static_cast<std::size_t>(SpherePreset::cu60)}));
  settle(page);
  EXPECT_EQ(page.asked().values().material, SphereSolid::copper);
  EXPECT_NEAR(page.asked().values().diameter_mm, 60.0, 1e-9);
  EXPECT_THAT(page.material_text(), testing::HasSubstr("Foote"));
  ASSERT_TRUE(page.asked().set("diameter_mm", 42.0));
  settle(page);
  EXPECT_EQ(page.asked().values().sphere, SpherePreset::own);
}

TEST_F(SetupPages, WhereThereIsNoSphereALineSaysSoAndNothingCanBeUsed) {
  SpherePage page(*app_);
  EXPECT_EQ(page.sphere_run(), document().paths());
  ASSERT_TRUE(page.asked().set("range_from_m", 900.0));  // beyond the samples
  page.start();
  EXPECT_TRUE(page.running());
  settle(page);
  EXPECT_FALSE(page.running());
  EXPECT_THAT(page.told(), testing::HasSubstr("sphere"));
  EXPECT_FALSE(page.made());
  EXPECT_FALSE(page.usable());
  page.start();  // and closed while it runs: nothing comes back to it
}

TEST_F(SetupPages, RangesThatDoNotRiseAreToldBeforeThePingsAreRead) {
  SpherePage page(*app_);
  ASSERT_TRUE(page.asked().set("range_to_m", 5.0));
  page.start();
  settle(page);
  EXPECT_THAT(page.told(), testing::HasSubstr("range 10,5: expected the nearer"));
}

TEST_F(SetupPages, TheCheckOpensAllObservationsAndSaysWhatItLacks) {
  SetupPage page(*app_);
  page.resize({900, 600}, 1.0);
  page.set_seen(true);
  do {
    document().settle();
    page.wait();
  } while (queue_.drain() > 0);
  EXPECT_TRUE(document().all_measured());
  EXPECT_THAT(page.problem(), testing::HasSubstr("expected 3 or more")) << "no school was looked for";
  EXPECT_FALSE(page.proposes());
}

TEST_F(SetupPages, AChangedRecipeIsTakenBackAndBroughtAgain) {
  const double was = document().recipe().navigation.mounting_azimuth_deg;
  EXPECT_FALSE(document().recipe_before());
  Recipe recipe = document().recipe();
  recipe.navigation.mounting_azimuth_deg = was - 3.0;
  document().use_recipe(recipe);
  document().settle();
  EXPECT_EQ(document().recipe().navigation.mounting_azimuth_deg, was - 3.0);
  press("file.recipe_before");
  document().settle();
  EXPECT_EQ(document().recipe().navigation.mounting_azimuth_deg, was);
  press("file.recipe_before");
  document().settle();
  EXPECT_EQ(document().recipe().navigation.mounting_azimuth_deg, was - 3.0);
  recipe.navigation.mounting_azimuth_deg = was - 7.0;
  document().use_recipe(recipe);
  EXPECT_FALSE(app_->actions.find("file.recipe_before")->enabled()) << "of which of both is not known yet";
  document().open(std::vector(document().paths()));
  document().settle();
  EXPECT_EQ(document().recipe().navigation.mounting_azimuth_deg, was - 3.0) << "no recipe is another opening's";
  EXPECT_FALSE(document().recipe_before());
}

}  // namespace
}  // namespace sonar
