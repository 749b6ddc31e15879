// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "session/lists/calibration_table.h"
#include "session/test_app.h"

namespace sonar {
namespace {

using testing::HasSubstr;

/// A factor that lies over every channel, and what it does to Sv: exactly so many dB, to a step of 0.012 dB.
constexpr double kFactor_db = 1.5;

class ChosenCalibration : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    paint(2, 6, 5, 5, 200, 4, 20);
    document().settle();
    table_ = TestSurvey::easy().fresh() / "sphere.csv";
    std::ofstream out(table_);
    out << "channel,extra_factor_db\n";
    const auto channels = document().shown()->grid().channel.size();
    for (std::size_t channel = 0; channel < channels; ++channel) out << channel << "," << kFactor_db << "\n";
    app_->dialogs.file_to_open = [this](const auto&, const auto&) { return table_.string(); };
  }
  void ask(const std::string& id) {
    press(id);
    document().settle();
  }
  [[nodiscard]] const SchoolRow& measured() { return document().product(0)->schools.at(0); }

  std::filesystem::path table_;
};

TEST_F(ChosenCalibration, SvAndMeasuresFollowMasksAndDecisionsStay) {
  select(1);
  press("review.accept");
  document().settle();
  const auto masks = masks_of(document().state()).at(0).pings;
  const SchoolRow before = measured();
  const std::int16_t count = document().staged()->sv.counts(7, 7, 205);
  workspace().slices.set({3, 4});
  ask("file.calibration");
  EXPECT_EQ(last_line().command, "calibrate");
  EXPECT_THAT(document().notices().back(), HasSubstr("masks and decisions stay"));
  EXPECT_NEAR(measured().sv_mean_db, before.sv_mean_db + kFactor_db, 0.02);
  EXPECT_EQ(measured().status, "accepted");
  EXPECT_EQ(measured().volume_m3, before.volume_m3);
  const std::int16_t louder = document().staged()->sv.counts(7, 7, 205);
  EXPECT_NEAR(db_from_counts(static_cast<std::int16_t>(louder - count)), kFactor_db, 0.013);
  const auto after = masks_of(document().state()).at(0).pings;
  ASSERT_EQ(after.size(), masks.size());
  for (std::size_t i = 0; i < masks.size(); ++i) EXPECT_EQ(after[i].mask, masks[i].mask);
  EXPECT_EQ(workspace().slices(), (SlicePlaces{3, 4})) << "the place that is looked at stays";
  EXPECT_TRUE(document().shown()->recalibrated());
  // The product says what it was measured with.
  EXPECT_EQ(document().product(0)->recipe_hash, recipe_hash(document().measuring_recipe()));

  // It is there in the next run, and undo takes it back.
  begin();
  EXPECT_NEAR(measured().sv_mean_db, before.sv_mean_db + kFactor_db, 0.02);
  EXPECT_EQ(document().choices().undo_text, "Undo calibration sphere.csv");
  ask("edit.undo");
  EXPECT_EQ(measured().sv_mean_db, before.sv_mean_db);
  EXPECT_FALSE(document().shown()->recalibrated());
  ask("edit.redo");
  EXPECT_NEAR(measured().sv_mean_db, before.sv_mean_db + kFactor_db, 0.02);
  ask("file.own_calibration");
  EXPECT_EQ(measured().sv_mean_db, before.sv_mean_db);
}

TEST_F(ChosenCalibration, TheTableTellsWhatIsInForceAndWhereItComesFrom) {
  const auto& files = document().shown()->files();
  const auto own = calibration_in_force(files, document().measuring_recipe().calibration, "recipe");
  ASSERT_EQ(own.size(), files.grid->channel.size());
  const BeamConfig& first = files.config.beams[static_cast<std::size_t>(own[0].channel)];
  EXPECT_EQ(own[0].psi_db, first.equivalent_beam_angle_db);
  EXPECT_EQ(own[0].absorption_db_per_m, files.transmit[static_cast<std::size_t>(own[0].channel)].absorption_db_per_m);
  for (const std::string& from : {own[0].gain_from, own[0].psi_from, own[0].absorption_from})
    EXPECT_EQ(from, "raw file");

  CalibrationParams changed = document().measuring_recipe().calibration;
  BeamCalibration line;
  line.channel = own[1].channel;
  line.gain_db = 17.25;
  line.psi_db = -31.5;
  changed.beams = {line};
  changed.psi = PsiSource::table;
  changed.absorption = AbsorptionSource::ainslie_mccolm;
  const auto now = calibration_in_force(files, changed, "recipe");
  EXPECT_EQ(now[1].gain_db, 17.25);
  EXPECT_EQ(now[1].gain_from, "recipe");
  EXPECT_EQ(now[1].sa_correction_from, "raw file") << "the line does not say it";
  EXPECT_EQ(now[1].psi_db, -31.5);
  EXPECT_EQ(now[1].psi_from, "recipe");
  EXPECT_EQ(now[0].psi_from, "raw file");
  EXPECT_EQ(now[0].gain_db, own[0].gain_db);
  EXPECT_EQ(now[0].absorption_from, "Ainslie & McColm");

  CalibrationTable table(workspace());
  ask("file.calibration");
  EXPECT_EQ(table.rows(), own.size());
  EXPECT_EQ(document().shown()->recalibrated(), true);
  const auto factor = std::ranges::find(table.columns(), "Extra factor", &ListColumn::title) - table.columns().begin();
  EXPECT_EQ(table.cell(0, static_cast<std::size_t>(factor)).text, fmt::format("{:.2f}", kFactor_db)) << "it follows";
}

// Choices stand on the recipe, whatever was chosen meanwhile: the same click gives the same mask.
TEST_F(ChosenCalibration, AClickSelectsWhatItSelectedBefore) {
  const auto grown = [&] {
    GrowCommand command;
    command.seeds = {{channel(6, 6), 205}};
    document().act(8, command);
    document().settle();
    auto mask = document().state().schools.back()->masks.pings.at(0).mask;
    ask("edit.undo");
    return mask;
  };
  const PingMask before = grown();
  ask("file.calibration");
  EXPECT_EQ(grown(), before);
}

TEST_F(ChosenCalibration, WhatIsNoCalibrationIsRefusedInOneLine) {
  std::ofstream(table_) << "channel,gain_db\n1,loud\n";
  const auto lines = document().choices().lines->size();
  ask("file.calibration");
  EXPECT_THAT(document().notices().back(), HasSubstr("sphere.csv: line 2"));
  table_ = table_.parent_path() / "none.json";
  ask("file.calibration");
  EXPECT_THAT(document().notices().back(), HasSubstr("none.json"));
  EXPECT_EQ(document().choices().lines->size(), lines);
}

}  // namespace
}  // namespace sonar
