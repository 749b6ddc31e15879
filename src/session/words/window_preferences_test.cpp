// SPDX-License-Identifier: Apache-2.0
#include "session/words/window_preferences.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "session/listening.h"
#include "session/pictures/exports.h"
#include "session/playing/playback.h"
#include "session/test_app.h"

namespace sonar {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

class WindowPreferences : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
    app_->dialogs.system_is_dark = [this] { return system_dark_; };
    queue_.drain();
  }
  void set(const std::string& name, const PropertyValue& to) {
    ASSERT_TRUE(workspace().window.set(name, to));
    queue_.drain();
    queue_.drain();
  }
  WindowParams now() {
    queue_.drain();
    return workspace().window.values();
  }
  Actions& actions() { return app_->actions; }

  bool system_dark_ = false;
};

TEST_F(WindowPreferences, TheThemeAndItsKeyAreOne) {
  set("theme", Choice{static_cast<std::size_t>(ThemeName::dark)});
  EXPECT_TRUE(workspace().dark());
  press("view.dark");
  EXPECT_EQ(now().theme, ThemeName::light);
  system_dark_ = true;
  set("theme", Choice{static_cast<std::size_t>(ThemeName::system)});
  EXPECT_TRUE(workspace().dark());
  EXPECT_EQ(now().theme, ThemeName::system) << "as the desktop is, it stays";
}

TEST_F(WindowPreferences, PlaybackFollowsAndItsKeysAreKept) {
  set("play_rate", 5.0);
  set("play_loop", true);
  EXPECT_EQ(app_->playback->rate(), 5.0);
  EXPECT_TRUE(app_->playback->loops());
  app_->playback->faster();
  EXPECT_EQ(now().play_rate, 10.0);
  app_->playback->set_rate(Playback::kFastest);
  EXPECT_EQ(now().play_rate, 10.0) << "no number";
  set("text_size_percent", 120.0);
  EXPECT_EQ(app_->playback->rate(), Playback::kFastest) << "another setting does not touch it";
}

TEST_F(WindowPreferences, KeysThatAreQuickerThanTheWindowsTurnsAllCount) {
  for (int i = 0; i < 4; ++i) app_->playback->faster();  // 5, 10, 20, as fast as possible
  press("view.dark");
  press("view.dark");
  press("view.dark");
  queue_.drain();
  queue_.drain();
  EXPECT_EQ(app_->playback->rate(), Playback::kFastest);
  EXPECT_TRUE(workspace().dark());
  EXPECT_EQ(now().theme, ThemeName::dark);
}

TEST_F(WindowPreferences, MemoryHoldsForWhatIsOpenedNext) {
  set("memory_gb", 2.0);
  EXPECT_EQ(document().options().memory_bytes, 2'000'000'000U);
  set("memory_gb", 0.0);
  EXPECT_EQ(document().options().memory_bytes, usual_memory());
}

TEST_F(WindowPreferences, CancelBringsBackAllAndOkKeepsIt) {
  const auto hands = [&](bool ok) {
    return [this, ok] {
      set("theme", Choice{static_cast<std::size_t>(ThemeName::dark)});
      EXPECT_TRUE(workspace().display.set("scale.low_db", -80.0));
      EXPECT_TRUE(actions().set_keys("display.masks", {"Ctrl+G"}));
      return ok;
    };
  };
  app_->preferences.path = journal_ / "preferences.json";
  app_->dialogs.preferences = hands(false);
  press("edit.preferences");
  queue_.drain();
  queue_.drain();
  EXPECT_FALSE(workspace().dark());
  EXPECT_EQ(workspace().display.values().scale.low_db, -60.0);
  EXPECT_THAT(actions().find("display.masks")->keys, ElementsAre("M"));
  EXPECT_FALSE(std::filesystem::exists(app_->preferences.path));
  app_->dialogs.preferences = hands(true);
  press("edit.preferences");
  const auto kept = Preferences::load(app_->preferences.path).preferences;
  EXPECT_TRUE(kept.dark);
  EXPECT_EQ(kept.window.theme, ThemeName::dark);
  EXPECT_EQ(kept.display.scale.low_db, -80.0);
  EXPECT_THAT(kept.keys, ElementsAre(Pair("display.masks", ElementsAre("Ctrl+G"))));
}

TEST_F(WindowPreferences, EverySettingHasItsSentence) {
  for (const PanelSection& page : preference_pages(*app_)) {
    EXPECT_EQ(page.notes.size(), page.names.size()) << page.title;
    for (const auto& note : page.notes) EXPECT_GT(note.text().size(), 10U) << note.name;
  }
}

TEST_F(WindowPreferences, AKeyThatIsTakenStaysWhereItIs) {
  EXPECT_EQ(actions().with_key("N")->id, "review.next");
  EXPECT_FALSE(actions().set_keys("display.masks", {"N"}));
  EXPECT_THAT(actions().find("display.masks")->keys, IsEmpty());
  EXPECT_THAT(actions().find("review.next")->keys, ElementsAre("N"));
  EXPECT_THAT(actions().clashes(), IsEmpty());
}

TEST_F(WindowPreferences, TwoActionsMayExchangeTheirKeys) {
  actions().take_keys({{"display.masks", {"N"}}, {"review.next", {"M"}}, {"no.such", {"Q"}}});
  EXPECT_THAT(actions().find("display.masks")->keys, ElementsAre("N"));
  EXPECT_THAT(actions().find("review.next")->keys, ElementsAre("M"));
  const auto changed = actions().changed_keys();
  EXPECT_EQ(changed.size(), 2U);
  actions().take_keys({});
  EXPECT_THAT(actions().find("display.masks")->keys, ElementsAre("M"));
  EXPECT_THAT(actions().changed_keys(), IsEmpty());
  actions().take_keys(changed);
  EXPECT_EQ(actions().changed_keys(), changed);
}

TEST_F(WindowPreferences, TextsNameTheKeysThatAreInForce) {
  const std::string text = "[schools.detect_all] detects, [no.such] and [] do nothing, [review.next] goes on [";
  EXPECT_EQ(actions().with_keys(text), "Ctrl+D detects, [no.such] and [] do nothing, N goes on [");
  actions().take_keys({{"schools.detect_all", {}}, {"review.next", {"F10"}}});
  EXPECT_EQ(actions().with_keys(text),
            "Detect schools in the whole survey detects, [no.such] and [] do nothing, F10 goes on [");
  app_->workspace.document.tell("press [review.next]");
  EXPECT_EQ(app_->workspace.document.notices().back(), "press F10");
}

// A version that gives a key to something new takes it from nobody.
TEST_F(WindowPreferences, AKeyThatAUserChoseIsNotAnActionsThatCameWithIt) {
  actions().take_keys({{"review.next", {"F8"}}});
  EXPECT_EQ(actions().with_key("F8")->id, "review.next");
  EXPECT_TRUE(actions().find("display.filtered")->keys.empty());
  actions().take_keys({});
  EXPECT_EQ(actions().with_key("F8")->id, "display.filtered");
}

// 1 ft = 0.3048 m; what was asked for is read everywhere at once.
TEST_F(WindowPreferences, UnitsReachReadOutsAndListsAndCancelBringsBackMetres) {
  document().open({TestSurvey::easy().folder()});
  document().settle();
  paint(2, 4, 5, 5, 200);
  document().settle();
  const Rows& schools = *app_->rows("schools");
  const auto column = [&](const std::string& title) {
    const auto& all = schools.columns();
    const auto found = std::ranges::find(all, title, &ListColumn::title);
    return static_cast<std::size_t>(found - all.begin());
  };
  const std::size_t depth = column("Depth");
  const std::size_t speed = column("Speed");
  ASSERT_LT(std::max(depth, speed), schools.columns().size());
  EXPECT_EQ(schools.columns()[depth].unit, "m");
  EXPECT_EQ(schools.columns()[speed].unit, "kn");
  const double depth_m = std::get<double>(schools.cell(0, depth).key);
  const ReadOut metres = read_out(workspace(), {6, 6, 200});
  int told = 0;
  const Listening heard(app_->rows("schools")->changed(), [&told] { ++told; });

  const auto feet = [&](bool ok) {
    return [&, ok] {
      set("length_unit", Choice{static_cast<std::size_t>(LengthUnit::feet)});
      set("speed_unit", Choice{static_cast<std::size_t>(SpeedUnit::metres_per_second)});
      EXPECT_GE(told, 1) << "at once";
      EXPECT_EQ(schools.columns()[depth].unit, "ft");
      EXPECT_EQ(schools.columns()[speed].unit, "m/s");
      const Cell cell = schools.cell(0, depth);
      EXPECT_NEAR(std::get<double>(cell.key), depth_m / 0.3048, 1e-9);
      EXPECT_EQ(cell.text, fmt::format("{:.1f}", depth_m / 0.3048));
      EXPECT_TRUE(row_matches(schools, 0, fmt::format("depth>{:.1f}", depth_m / 0.3048 - 1.0))) << "a limit is read so";
      EXPECT_THAT(tab_separated(schools, {0}), testing::HasSubstr("Depth [ft]"));
      const ReadOut read = read_out(workspace(), {6, 6, 200});
      EXPECT_THAT(read.depth, testing::EndsWith(" ft"));
      EXPECT_THAT(read.range, testing::EndsWith(" ft"));
      EXPECT_THAT(read.ship, testing::EndsWith(" m/s"));
      EXPECT_THAT(read.log, testing::EndsWith(" nmi"));
      EXPECT_NEAR(std::stod(read.depth.substr(6)) * 0.3048, std::stod(metres.depth.substr(6)), 0.07);
      const auto options = picture_options(workspace(), PictureKind::slice_top);
      EXPECT_TRUE(options && options->units == workspace().units()) << "as pictures in files";
      return ok;
    };
  };
  app_->preferences.path = journal_ / "preferences.json";
  app_->dialogs.preferences = feet(false);
  press("edit.preferences");
  queue_.drain();
  queue_.drain();
  EXPECT_EQ(workspace().units(), Units{});
  EXPECT_EQ(schools.columns()[depth].unit, "m");
  EXPECT_EQ(read_out(workspace(), {6, 6, 200}).line(), metres.line());
  app_->dialogs.preferences = feet(true);
  press("edit.preferences");
  const auto kept = Preferences::load(app_->preferences.path).preferences;
  EXPECT_EQ(kept.window.units, (Units{LengthUnit::feet, SpeedUnit::metres_per_second}));
}

}  // namespace
}  // namespace sonar
