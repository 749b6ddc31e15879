// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/recipe.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "io/csv_table.h"
#include "io/simrad/test_bytes.h"
#include "pipeline/survey/calibration_json.h"

namespace sonar {
namespace {

using testing::HasSubstr;

TEST(Recipe, TextReadsBackEqual) {
  for (const char* preset : {"default", "paper"}) {
    const auto recipe = recipe_preset(preset);
    ASSERT_TRUE(recipe);
    const std::string text = recipe_text(*recipe);
    const auto again = recipe_from_text(text);
    ASSERT_TRUE(again) << again.error().text;
    EXPECT_EQ(recipe_text(*again), text);
    EXPECT_EQ(recipe_hash(*again), recipe_hash(*recipe));
  }
  EXPECT_NE(recipe_hash(*recipe_preset("default")), recipe_hash(*recipe_preset("paper")));
}

TEST(Recipe, PresetsAreWithinTheirOwnRanges) {
  for (const char* preset : {"default", "paper"}) EXPECT_TRUE(validate(*recipe_preset(preset)));
  EXPECT_FALSE(recipe_preset("papers"));
}

TEST(Recipe, PaperKeepsToThePaper) {
  const Recipe paper = *recipe_preset("paper");
  EXPECT_EQ(paper.flags.near_field.range_m, 15.0);
  EXPECT_EQ(paper.flags.surface.mode, SurfaceMode::fan);
  EXPECT_EQ(paper.median.kernel_samples, 23);
  EXPECT_EQ(paper.propagate_paper.enlarge_fans, 2);
  EXPECT_EQ(paper.propagate_paper.enlarge_beams, 4);
  EXPECT_EQ(paper.propagate_paper.enlarge_samples, 40);
  EXPECT_FALSE(paper.automatic);
}

TEST(Recipe, PartOfARecipeKeepsTheOtherDefaults) {
  const auto recipe = recipe_from_text(R"({"recipe_version":1,"detect":{"min_range_m":8}})");
  ASSERT_TRUE(recipe) << recipe.error().text;
  EXPECT_EQ(recipe->detect.size.min_range_m, 8.0);
  EXPECT_EQ(recipe->detect.tolerance_db, Recipe{}.detect.tolerance_db);
}

TEST(Recipe, ParametersThatEarlierVersionsHadAreListedAndHaveNoEffect) {
  const auto recipe = recipe_from_text(
      R"({"recipe_version":1,"detect":{"floor_db":-55,"tolerance_db":9},"seabed":{"flank_rise_db":3},"track":{}})");
  ASSERT_TRUE(recipe) << recipe.error().text;
  EXPECT_EQ(recipe->notes, (std::vector<std::string>{"seabed.flank_rise_db has no effect any more",
                                                     "detect.floor_db has no effect any more"}));
  EXPECT_EQ(recipe->detect.tolerance_db, 9.0);
  EXPECT_EQ(recipe_text(*recipe).find("floor_db"), std::string::npos);
}

TEST(Recipe, NamesOfTheVersionBeforeAreReadAndNoted) {
  const auto recipe = recipe_from_text(
      R"({"recipe_version":1,"flags":{"wall":{"enabled":false},"lost":{"minimum_samples":99}},
          "measure":{"floor_extent_m":2,"min_extent_m":3}})");
  ASSERT_TRUE(recipe) << recipe.error().text;
  EXPECT_FALSE(recipe->flags.interference.enabled);
  EXPECT_EQ(recipe->flags.dropouts.minimum_samples, 99);
  EXPECT_EQ(recipe->measure.min_extent_m, 3.0) << "where both stand, today's name counts";
  EXPECT_THAT(recipe->notes,
              testing::UnorderedElementsAre("flags.wall is called flags.interference now",
                                            "flags.lost is called flags.dropouts now",
                                            "measure.floor_extent_m is called measure.min_extent_m now"));
  EXPECT_EQ(recipe_text(*recipe).find("\"wall\""), std::string::npos);
}

struct Refusal {
  const char* text;
  ErrorCode code;
  const char* names;
};

TEST(Recipe, RefusesByName) {
  for (const Refusal& refusal : {
           Refusal{"{", ErrorCode::format, "JSON"},
           Refusal{"[]", ErrorCode::format, "object"},
           Refusal{R"({"detect":{}})", ErrorCode::format, "recipe_version"},
           Refusal{R"({"recipe_version":99})", ErrorCode::newer_version, "99"},
           Refusal{R"({"recipe_version":1,"detect":{"flor_db":-55}})", ErrorCode::format, "detect.flor_db"},
           Refusal{R"({"recipe_version":1,"detect":{"min_range_m":"low"}})", ErrorCode::format, "detect.min_range_m"},
           Refusal{R"({"recipe_version":1,"median":{"kernel_fans":65}})", ErrorCode::bad_parameter,
                   "median.kernel_fans"},
           Refusal{R"({"recipe_version":1,"detect":{"left_out":"ship, shp"}})", ErrorCode::bad_parameter,
                   "detect.left_out: no judge shp"},
           Refusal{R"({"recipe_version":1,"track":{"confirm_pings":6}})", ErrorCode::bad_parameter,
                   "track.confirm_window = 5"},
           Refusal{R"({"recipe_version":1,"survey":{"sound_speed_mps":148}})", ErrorCode::bad_parameter,
                   "sound_speed_mps: 148 m/s is outside 1000 .. 2000"},
           Refusal{R"({"recipe_version":1,"sound_speed_profile":[[0,148]]})", ErrorCode::bad_parameter,
                   "sound_speed_profile: 148 m/s at 0 m"},
           Refusal{R"({"recipe_version":1,"grow":{"mode":"fast"}})", ErrorCode::format, "tracked, paper"},
           Refusal{R"({"recipe_version":1,"growth_curve":{"tf_version":1,"points":[]}})", ErrorCode::bad_parameter,
                   "growth_curve"},
       }) {
    const auto recipe = recipe_from_text(refusal.text);
    ASSERT_FALSE(recipe) << refusal.text;
    EXPECT_EQ(recipe.error().code, refusal.code) << refusal.text;
    EXPECT_THAT(recipe.error().text, HasSubstr(refusal.names));
  }
}

TEST(Recipe, CalibrationStandsInsideByContent) {
  Recipe recipe;
  recipe.calibration.beams = {{3, 20.5, -1.25, 0.5}, {4, kUnknown, 0.0, 0.0}};
  const auto again = recipe_from_text(recipe_text(recipe));
  ASSERT_TRUE(again) << again.error().text;
  ASSERT_EQ(again->calibration.beams.size(), 2U);
  EXPECT_EQ(again->calibration.beams[0], recipe.calibration.beams[0]);
  EXPECT_TRUE(std::isnan(again->calibration.beams[1].gain_db));
  EXPECT_NE(recipe_hash(recipe), recipe_hash(Recipe{}));
}

Result<void> taken(const std::string& csv) {
  Recipe recipe;
  const auto table = parse_csv(csv, "gains.csv");
  if (!table) return pass_on(table);
  return take_calibration_table(recipe, *table);
}

// A column that nobody reads is a calibration that nobody applies.
TEST(Recipe, CalibrationsWithOtherColumnsAreRefused) {
  EXPECT_TRUE(taken("channel,gain_db\n0,25.5\n"));
  EXPECT_TRUE(taken("channel,gain_db,sa_correction_db,extra_factor_db\n0,25.5,,0\n"));
  const auto misspelt = taken("channel,gain_dB,sa_correction_db,extra_factor_db\n0,20,0,0\n");
  ASSERT_FALSE(misspelt);
  EXPECT_EQ(to_line(misspelt.error())
                .find("gains.csv: line 1: column 'gain_dB' is none of channel, gain_db, sa_correction_db, "
                      "extra_factor_db, psi_db, "),
            0U);
  EXPECT_FALSE(taken("channel\n0\n"));
}

// All columns that section 8 of the interfaces names, each with its error, there and back.
TEST(Recipe, CalibrationsTellBeamAnglesWidthsAndErrors) {
  const std::string csv =
      "channel,gain_db,gain_db_se,sa_correction_db,sa_correction_db_se,extra_factor_db,extra_factor_db_se,psi_db,psi_"
      "db_se,"
      "width_along_deg,width_along_deg_se,width_athwart_deg,width_athwart_deg_se\n"
      "3,25.5,0.1,-0.4,0.05,0.2,0.3,-22.5,0.4,6.9,0.06,3.1,0.07\n";
  Recipe recipe;
  ASSERT_TRUE(take_calibration_table(recipe, *parse_csv(csv, "gains.csv")));
  EXPECT_EQ(recipe.calibration.psi, PsiSource::table) << "whoever gives angles wants them used";
  const BeamCalibration expected{3, 25.5, -0.4, 0.2, -22.5, 6.9, 3.1, 0.1, 0.05, 0.3, 0.4, 0.06, 0.07};
  const auto again = recipe_from_text(recipe_text(recipe));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->calibration.beams, std::vector{expected});
  Recipe gains_alone;
  ASSERT_TRUE(take_calibration_table(gains_alone, *parse_csv("channel,gain_db\n0,25.5\n", "gains.csv")));
  EXPECT_EQ(gains_alone.calibration.psi, PsiSource::stated);
  EXPECT_FALSE(taken("channel,width_along_deg\n0,0\n"));
  EXPECT_FALSE(taken("channel,gain_db_se\n0,-0.1\n"));
}

// A number or a table's file, the later in place of the earlier; none that no water has.
TEST(Recipe, SoundSpeedsAreTakenAndStandInside) {
  const test::TemporaryFolder folder;
  const std::string cast = (folder.path() / "cast.csv").string();
  std::ofstream(cast) << "depth_m,sound_speed_mps\n0,1500\n100,1480\n";
  Recipe recipe;
  ASSERT_TRUE(take_sound_speed(recipe, "1478.5"));
  EXPECT_EQ(recipe_from_text(recipe_text(recipe)).value().survey.sound_speed_mps, 1478.5);
  ASSERT_TRUE(take_sound_speed(recipe, cast));
  const SurveyParams read = recipe_from_text(recipe_text(recipe)).value().survey;
  EXPECT_EQ(read.sound_speed_mps, 0.0);
  EXPECT_EQ(read.sound_speed_profile, (SoundProfile{{0.0, 1500.0}, {100.0, 1480.0}}));
  for (const char* wrong : {"148", "999.9", "2000.1", "-1500", "0", "nan"}) {
    const auto refused = take_sound_speed(recipe, wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.error().text, fmt::format("sound speed: expected 1000 to 2000 m/s, got {}", wrong));
  }
  EXPECT_EQ(recipe.survey, read) << "what is refused changes nothing";
  EXPECT_EQ(take_sound_speed(recipe, "gone.csv").error().code, ErrorCode::not_found);
}

TEST(Recipe, BeamCalibrationsAreNumbersUnderKnownNames) {
  using nlohmann::json;
  EXPECT_TRUE(beams_from_json(json::parse(R"([{"channel": 0, "gain_db": 30, "sa_correction_db": null}])")));
  for (const char* wrong : {R"([{"channel": 0, "gian_db": 30}])", R"([{"channel": 0.7, "gain_db": 30}])",
                            R"([{"channel": 0, "gain_db": "30"}])", R"([{"gain_db": 30}])", R"([7])"}) {
    EXPECT_FALSE(beams_from_json(json::parse(wrong))) << wrong;
  }
}

}  // namespace
}  // namespace sonar
