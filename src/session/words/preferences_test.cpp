// SPDX-License-Identifier: Apache-2.0
#include "session/words/preferences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "pipeline/journal/journal_place.h"
#include "session/app_parts.h"
#include "session/looks/curves.h"
#include "session/test_survey.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

TEST(Preferences, APlaceThatWasLeftLatelyIsKept) {
  Preferences preferences;
  for (int i = 0; i < 150; ++i) {
    const std::filesystem::path survey = "/data/" + std::to_string(1000 - i);
    preferences.remember({survey});
    preferences.set_left_at({survey}, "obs-0001", i);
  }
  for (int i = 141; i < 150; ++i) EXPECT_TRUE(preferences.left_at_of({"/data/" + std::to_string(1000 - i)})) << i;
  EXPECT_EQ(preferences.left_at.size(), 100U);
}

TEST(Preferences, GoThroughAFileAndAWorkspaceUnchanged) {
  const fs::path path = TestSurvey::easy().fresh() / "below" / "preferences.json";
  Preferences out;
  out.path = path;
  out.dark = true;
  out.advance = false;
  out.operator_name = "Ane \u00D8.";
  out.window_layout = "AAEC";
  out.species = {"herring", "sprat"};
  out.display.scale.low_db = -70.0;
  out.display.removed = NoiseLook::transparent;
  out.select.tolerance_db = 12.5;
  out.volume.frames = 3;
  out.views.volume = false;
  out.display.take_out.interference = false;
  out.picture_file.paper.width_px = 777;
  out.reduce.margin_beams = 3;
  out.integrate.edsu_nmi = 0.1;
  out.fish.relation = "cod";
  out.fish.weight_a_g = 0.006;
  out.fish.lengths = LengthsFrom::table;
  out.view_curve = *curve_of(SvScale{}, {{-65.0, 0.0}, {-40.0, 0.5}});
  out.growth_curve = *growth_curve_of({{-70.0, 0.0}, {-35.0, 1.0}});
  out.window.theme = ThemeName::dark;
  out.window.text_size_percent = 120.0;
  out.window.memory_gb = 3.0;
  out.window.play_rate = 5.0;
  out.window.units = {LengthUnit::fathoms, SpeedUnit::knots};
  out.keys = {{"display.masks", {"Ctrl+G"}}, {"review.next", {}}};
  out.set_chart("/data/one", "/charts/gebco.nc");
  out.set_chart("/data/two", "/charts/emodnet.tif");
  out.set_left_at({"/data/one"}, "obs-0003", 17);
  out.set_chart("/data/two", {});
  out.remember({"/data/one"});
  out.remember({"/data/a.raw", "/data/b.raw"});
  out.remember({"/data/one"});
  ASSERT_TRUE(out.save());
  const auto in = Preferences::load(path);
  EXPECT_EQ(in.notice, "");
  EXPECT_TRUE(in.preferences.dark);
  EXPECT_EQ(in.preferences.window.theme, ThemeName::dark);
  EXPECT_EQ(in.preferences.window.text_size_percent, 120.0);
  EXPECT_EQ(in.preferences.window.memory_gb, 3.0);
  EXPECT_EQ(in.preferences.window.play_rate, 5.0);
  EXPECT_EQ(in.preferences.window.units, out.window.units);
  EXPECT_EQ(in.preferences.keys, out.keys);
  EXPECT_FALSE(in.preferences.advance);
  EXPECT_EQ(in.preferences.operator_name, out.operator_name);
  EXPECT_EQ(in.preferences.window_layout, "AAEC");
  EXPECT_EQ(in.preferences.species, out.species);
  const std::vector<std::vector<fs::path>> recent{{"/data/one"}, {"/data/a.raw", "/data/b.raw"}};
  EXPECT_EQ(in.preferences.recent, recent);

  ChangeQueue queue;
  Workspace workspace(queue, {});
  in.preferences.apply(workspace);
  EXPECT_TRUE(workspace.dark());
  EXPECT_EQ(in.preferences.chart_of("/data/one/."), "/charts/gebco.nc");
  EXPECT_EQ(in.preferences.left_at_of({"/data/one/."}), (std::pair<std::string, std::int64_t>{"obs-0003", 17}));
  EXPECT_EQ(in.preferences.left_at_of({"/data/two"}), std::nullopt);
  EXPECT_EQ(in.preferences.chart_of("/data/two"), "");
  EXPECT_FALSE(workspace.curve_follows_scale());
  EXPECT_EQ(workspace.view_curve(), *out.view_curve);
  EXPECT_EQ(workspace.growth_curve(), *out.growth_curve);
  Preferences taken;
  taken.take(workspace);
  EXPECT_EQ(taken.display.scale.low_db, -70.0);
  EXPECT_EQ(taken.display.removed, NoiseLook::transparent);
  EXPECT_EQ(taken.select.tolerance_db, 12.5);
  EXPECT_EQ(taken.volume.frames, 3);
  EXPECT_FALSE(taken.display.take_out.interference);
  EXPECT_EQ(taken.picture_file.paper.width_px, 777);
  EXPECT_EQ(taken.reduce.margin_beams, 3);
  EXPECT_EQ(taken.integrate.edsu_nmi, 0.1);
  EXPECT_EQ(taken.fish.relation, "cod");
  EXPECT_EQ(taken.fish.weight_a_g, 0.006);
  EXPECT_EQ(taken.fish.lengths, LengthsFrom::mean_and_sd) << "the table is not open any more";
  EXPECT_EQ(taken.view_curve, out.view_curve);
  EXPECT_EQ(taken.growth_curve, out.growth_curve);
  EXPECT_FALSE(taken.views.volume);
}

TEST(Preferences, TenSurveysAreRecent) {
  Preferences preferences;
  for (int i = 0; i < 12; ++i) preferences.remember({"/data/" + std::to_string(i)});
  ASSERT_EQ(preferences.recent.size(), 10U);
  EXPECT_EQ(preferences.recent.front().front(), "/data/11");
  EXPECT_EQ(preferences.recent.back().front(), "/data/2");
}

TEST(Preferences, WhatIsUnknownOrWrongIsPassedOver) {
  const fs::path path = TestSurvey::easy().fresh() / "preferences.json";
  write(path, R"({"dark": true, "from_the_future": [1], "advance": "no", "species": ["cod", 7, "a\tb"],
                  "select": {"tolerance_db": 99, "reach_pings": 12, "mode": "magic", "more": 1},
                  "recent": [["/a"], "x", [3]]})");
  const auto in = Preferences::load(path);
  EXPECT_EQ(in.notice, "");
  EXPECT_TRUE(in.preferences.dark);
  EXPECT_TRUE(in.preferences.advance);
  EXPECT_EQ(in.preferences.select.tolerance_db, SelectParams{}.tolerance_db);
  EXPECT_EQ(in.preferences.select.reach_pings, 12);
  EXPECT_EQ(in.preferences.select.mode, GrowMode::tracked);
  EXPECT_THAT(in.preferences.species, testing::ElementsAre("cod", "a b"));
  EXPECT_EQ(in.preferences.recent.size(), 1U);
}

TEST(Preferences, NamesOfTheVersionBeforeAreReadAndNoted) {
  const fs::path path = TestSurvey::easy().fresh() / "preferences.json";
  write(path, R"({"display": {"take_out": {"impulses": false}}})");
  const auto in = Preferences::load(path);
  EXPECT_FALSE(in.preferences.display.take_out.impulse_noise);
  EXPECT_THAT(in.notice, HasSubstr("display.take_out.impulses is called display.take_out.impulse_noise now"));
  ASSERT_TRUE(in.preferences.save());
  EXPECT_EQ(Preferences::load(path).notice, "");
}

TEST(Preferences, ADamagedFileIsTheDefaultsAndANotice) {
  const fs::path path = TestSurvey::easy().fresh() / "preferences.json";
  for (const char* text : {"{\"dark\": tr", "[]", ""}) {
    write(path, text);
    const auto in = Preferences::load(path);
    EXPECT_FALSE(in.preferences.dark);
    EXPECT_THAT(in.notice, HasSubstr("preferences.json"));
    EXPECT_THAT(in.notice, HasSubstr("defaults"));
  }
  EXPECT_EQ(Preferences::load(path.parent_path() / "none.json").notice, "");
}

TEST(Preferences, WhatHindersTheirKeepingIsToldOnce) {
  const fs::path folder = TestSurvey::easy().fresh();
  write(folder / "file", "");
  ChangeQueue queue;
  AppModel app(queue, {});
  app.preferences.path = folder / "file" / "preferences.json";
  keep_preferences(app);
  keep_preferences(app);
  ASSERT_EQ(app.workspace.document.notices().size(), 1U);
  EXPECT_THAT(app.workspace.document.notices().front(), HasSubstr("preferences cannot be kept"));
}

TEST(Preferences, EachSurveyHasItsOwnDepthChart) {
  const fs::path folder = TestSurvey::easy().fresh();
  ChangeQueue queue;
  AppModel app(queue, TestSurvey::options(folder));
  app.preferences.path = folder / "preferences.json";
  Document& document = app.workspace.document;
  document.open({TestSurvey::easy().folder()});
  document.settle();
  app.workspace.depth_raster.set(TestSurvey::easy().folder() / "truth" / "depth.tif");
  const fs::directory_iterator files(TestSurvey::easy().folder());
  const auto raw = std::find_if(fs::begin(files), fs::end(files),
                                [](const auto& entry) { return entry.path().extension() == ".raw"; });
  document.open({raw->path()});
  document.settle();
  EXPECT_EQ(app.workspace.depth_raster(), "");
  document.open({TestSurvey::easy().folder()});
  document.settle();
  EXPECT_EQ(app.workspace.depth_raster(), TestSurvey::easy().folder() / "truth" / "depth.tif");
  EXPECT_EQ(Preferences::load(app.preferences.path).preferences.charts.size(), 1U);
}

TEST(JournalFolders, LieBesideTheSurveyThenInTheUsersOwnAndNeverInIt) {
  const fs::path folder = TestSurvey::easy().fresh();
  fs::create_directories(folder / "cruise");
  write(folder / "cruise" / "x.raw", "");
  // NOLINTBEGIN(concurrency-mt-unsafe): no other thread is about
  ASSERT_EQ(::setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1), 0);
  const auto of_folder = journal_folders_for(folder / "cruise");
  ASSERT_EQ(of_folder.size(), 2U);
  EXPECT_EQ(of_folder[0], fs::canonical(folder) / "cruise-work");
  EXPECT_EQ(of_folder[1].parent_path(), folder / "state" / "sonar-explorer");
  EXPECT_EQ(journal_folders_for(folder / "cruise" / "x.raw"), of_folder);
  EXPECT_EQ(journal_folders_for((folder / "cruise").string() + "/"), of_folder);
  // Two surveys of one name do not share the user's folder.
  fs::create_directories(folder / "other" / "cruise");
  EXPECT_NE(journal_folders_for(folder / "other" / "cruise")[1], of_folder[1]);

  // The first cannot be made: a file of its name is in the way.
  write(folder / "cruise-work", "");
  const auto place = place_journal(of_folder, {});
  ::unsetenv("XDG_STATE_HOME");
  // NOLINTEND(concurrency-mt-unsafe)
  ASSERT_TRUE(place);
  EXPECT_EQ(place->path.parent_path(), of_folder[1]);
  ASSERT_EQ(place->notices.size(), 1U);
  EXPECT_THAT(place->notices.front(), HasSubstr("cannot be written to"));
}

TEST(FolderBeside, IsNamedAfterTheSurvey) {
  const fs::path folder = fs::canonical(TestSurvey::easy().fresh());
  fs::create_directories(folder / "cruise");
  write(folder / "cruise" / "x.raw", "");
  EXPECT_EQ(folder_beside(folder / "cruise", "-out"), folder / "cruise-out");
  EXPECT_EQ(folder_beside((folder / "cruise").string() + "/", "-out"), folder / "cruise-out");
  EXPECT_EQ(folder_beside(folder / "cruise" / "x.raw", "-out"), folder / "cruise-out");
  EXPECT_EQ(folder_beside("/", "-out"), "");
}

// Results are opened whose raw files are gone: two such surveys of one folder must not share a journal.
TEST(FolderBeside, IsTheSameWhenTheRawFilesAreGone) {
  const fs::path folder = fs::canonical(TestSurvey::easy().fresh());
  EXPECT_EQ(folder_beside(folder / "leg.1", "-work"), folder / "leg.1-work");
  EXPECT_EQ(folder_beside(folder / "leg.1" / "x.raw", "-work"), folder / "leg.1-work");
}

TEST(JournalFolders, AReadOnlyFolderLeadsToTheUsersOwn) {
  const fs::path folder = TestSurvey::easy().fresh();
  fs::create_directories(folder / "cruise");
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  if (std::ofstream(folder / "probe").good()) GTEST_SKIP() << "nothing is read-only for this user";
  const std::vector<fs::path> folders{folder / "cruise-work", TestSurvey::easy().fresh() / "own"};
  const auto place = place_journal(folders, {});
  fs::permissions(folder, fs::perms::owner_all);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->path.parent_path(), folders[1]);
  EXPECT_EQ(place->notices.size(), 1U);
}

}  // namespace
}  // namespace sonar
