// SPDX-License-Identifier: Apache-2.0
#include "session/pictures/exports.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <utility>

#include "base/test_full_disk.h"
#include "pipeline/journal/journal.h"
#include "pipeline/tasks/run.h"
#include "pipeline/tasks/survey_numbers.h"
#include "publish/movies/movie_file.h"
#include "publish/picture_source.h"
#include "session/open/survey_schools.h"
#include "session/test_app.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Observation, then for each school its masks in its pings; whatever the schools are called.
using Masks = std::vector<std::pair<std::string, std::vector<std::pair<std::int64_t, PingMask>>>>;

Masks masks_in(const fs::path& folder) {
  Work work(1);
  const std::vector<fs::path> paths{folder};
  const auto source = PictureSource::open(paths, std::nullopt, work);
  Masks all;
  if (!source) return all;
  for (const ObservationProduct& product : (*source)->products()) {
    for (const SchoolRow& school : product.schools) {
      all.emplace_back(product.observation, std::vector<std::pair<std::int64_t, PingMask>>{});
      for (const SchoolMask& mask : product.masks) {
        if (mask.school_id == school.school_id) all.back().second.emplace_back(mask.ping_index, mask.mask);
      }
    }
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.first, a.second.front().first, a.second.front().second.runs) <
           std::tuple(b.first, b.second.front().first, b.second.front().second.runs);
  });
  return all;
}

Masks masks_of(const Document& document) {
  Masks all;
  for (std::size_t i = 0; i < document.survey()->observations.size(); ++i) {
    for (const auto& school : document.state(i).schools) {
      all.emplace_back(document.survey()->observations[i].name, std::vector<std::pair<std::int64_t, PingMask>>{});
      for (const auto& there : school->masks.pings) all.back().second.emplace_back(there.ping_index, there.mask);
    }
  }
  return all;
}

class Exports : public testing::Test, protected TestApp {
 protected:
  void SetUp() override { begin(); }
  [[nodiscard]] const std::string& told() { return document().notices().back(); }
  fs::path out_ = TestSurvey::easy().fresh();
};

/// `run --session` on a journal.
void run_session(const fs::path& journal_file, const fs::path& out) {
  const auto journal = read_journal(journal_file.string());
  ASSERT_TRUE(journal);
  const auto recipe = recipe_from_text(journal->recipe);
  ASSERT_TRUE(recipe);
  const std::vector<fs::path> paths{TestSurvey::easy().folder()};
  Work work(2);
  const auto survey = open_survey(paths, recipe->survey, recipe->navigation, {}, work);
  ASSERT_TRUE(survey);
  const std::vector<JournalLine> lines = effective_lines(journal->lines);
  const Plan plan = make_plan(*survey, paths, journal_file.string(), *recipe, {{}, lines, "test"});
  RunOptions options;
  options.out = out;
  options.program_version = "test";
  const auto report = run_plan(plan, *survey, lines, options, work);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->done.size(), 2U);
}

TEST_F(Exports, ResultsHaveTheMasksThatARunOfTheJournalGivesBitForBit) {
  press("schools.detect_all");
  document().settle();
  ASSERT_FALSE(document().state().schools.empty());
  select(1);
  document().look_at(survey_schools(document()).front().middle_ping());
  press("school.smooth_all");
  press("school.propagate");
  document().settle();
  paint(2, 3, 5, 5, 200);
  ASSERT_TRUE(document().show(1));
  document().settle();
  paint(1, 1, 5, 5, 200);
  document().settle();
  const std::size_t first = document().state(0).schools.size();
  const std::size_t second = document().state(1).schools.size();
  export_results(workspace(), out_ / "window");
  document().settle();
  EXPECT_THAT(told(), HasSubstr("written: 2 observations"));
  run_session(document().journal_path(), out_ / "run");
  const Masks window = masks_in(out_ / "window");
  EXPECT_EQ(window.size(), first + second);
  EXPECT_TRUE(window == masks_in(out_ / "run"));
  for (const char* file : {"schools.csv", "school_pings.csv", "survey.gpkg", "survey.json"}) {
    EXPECT_TRUE(fs::exists(out_ / "window" / file)) << file;
  }
}

// The schools that the journal asks for are looked for again at each opening; whoever cancels that must not export less.
TEST_F(Exports, WithTheSearchAtOpeningCancelledTheSchoolsAreStillThere) {
  press("schools.detect_all");
  document().settle();
  paint(2, 3, 5, 5, 200);
  document().settle();
  const std::size_t all = document().state(0).schools.size() + document().state(1).schools.size();
  app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
  document().open({TestSurvey::easy().folder()});
  while (!document().staged()) queue_.drain();  // the search begins with the first picture
  document().cancel();
  document().settle();
  ASSERT_TRUE(document().lacks_detected(0));
  EXPECT_EQ(document().state(0).schools.size(), 1U);
  EXPECT_THAT(told(), HasSubstr("stopped: the schools that were found before in 2 observations are not shown"));
  export_results(workspace(), out_ / "window");
  document().settle();
  EXPECT_THAT(told(), HasSubstr("written: 2 observations"));
  run_session(document().journal_path(), out_ / "run");
  const Masks window = masks_in(out_ / "window");
  EXPECT_EQ(window.size(), all);
  EXPECT_TRUE(window == masks_in(out_ / "run"));
  press("schools.detect_all");
  document().settle();
  EXPECT_FALSE(document().lacks_detected(0));
  EXPECT_EQ(document().state(0).schools.size() + document().state(1).schools.size(), all);
}

// What was found is kept: the next opening does not look for it again.
TEST_F(Exports, WhatWasFoundIsThereAtTheNextOpeningWithoutASearch) {
  DocumentOptions options = TestSurvey::options(journal_);
  options.cache.folder = out_ / "cache";
  const auto open = [&] {
    app_ = std::make_unique<AppModel>(queue_, options);
    document().open({TestSurvey::easy().folder()});
    document().settle();
  };
  open();
  press("schools.detect_all");
  document().settle();
  const Masks found = masks_of(document());
  ASSERT_FALSE(found.empty());
  std::size_t kept = 0;
  for (const auto& entry : fs::recursive_directory_iterator(journal_)) {
    if (entry.path().string().ends_with(".detected.nc")) ++kept;
  }
  EXPECT_EQ(kept, 2U);
  open();
  EXPECT_TRUE(document().detected(0) && document().detected(1));
  EXPECT_TRUE(masks_of(document()) == found);
  // A damaged one is looked for again.
  for (const auto& entry : fs::recursive_directory_iterator(journal_)) {
    if (entry.path().string().ends_with(".detected.nc")) std::ofstream(entry.path()) << "nonsense";
  }
  open();
  EXPECT_TRUE(masks_of(document()) == found);
}

TEST_F(Exports, UnderAChosenCalibrationARunOfTheJournalGivesTheSame) {
  press("schools.detect_all");
  document().settle();
  CalibrateCommand calibrate;
  calibrate.calibration = document().recipe().calibration;
  for (int channel = 0; channel < static_cast<int>(document().shown()->grid().channel.size()); ++channel) {
    calibrate.calibration.beams.push_back({channel, kUnknown, kUnknown, 1.5});
  }
  document().act(calibrate);
  document().settle();
  export_results(workspace(), out_ / "window");
  document().settle();
  EXPECT_THAT(told(), HasSubstr("written: 2 observations"));
  run_session(document().journal_path(), out_ / "run");
  EXPECT_TRUE(masks_in(out_ / "window") == masks_in(out_ / "run"));
  const auto levels = [&](const char* folder) {
    Work work(1);
    const std::vector<fs::path> paths{out_ / folder};
    const auto source = PictureSource::open(paths, std::nullopt, work);
    std::vector<double> db;
    for (const ObservationProduct& product : (*source)->products()) {
      EXPECT_EQ(product.recipe_hash, recipe_hash(document().measuring_recipe()));
      for (const SchoolRow& school : product.schools) db.push_back(school.sv_mean_db);
    }
    std::sort(db.begin(), db.end());
    return db;
  };
  EXPECT_FALSE(levels("run").empty());
  EXPECT_EQ(levels("window"), levels("run"));
}

TEST_F(Exports, NumbersAreThoseOnTheScreen) {
  paint(4, 5, 5, 5, 200);
  paint(2, 3, 12, 12, 300);
  document().settle();
  export_as(workspace(), "csv", out_);
  document().settle();
  EXPECT_THAT(told(), HasSubstr("written: 3 files in " + out_.string()));
  const std::string table = text_of(out_ / "school_pings.csv");
  EXPECT_THAT(table, HasSubstr("obs-0001,1,4,"));
  EXPECT_THAT(table, HasSubstr("obs-0001,2,2,"));
  // What was needed on the way is gone.
  for (const auto& entry : fs::directory_iterator(out_)) EXPECT_EQ(entry.path().extension(), ".csv");
}

TEST_F(Exports, EveryFormatIsInTheMenuAndIsWritten) {
  paint(4, 5, 5, 5, 200);
  document().settle();
  for (const char* format : {"netcdf-mask", "gpkg", "geojson", "raw-reduced"}) {
    const fs::path folder = out_ / format;
    app_->dialogs.folder_to_save = [&](const auto&, const auto&) { return folder.string(); };
    press(std::string("export.") + format);
    document().settle();
    EXPECT_THAT(told(), HasSubstr("written: ")) << format;
    EXPECT_FALSE(fs::is_empty(folder)) << format;
  }
}

TEST_F(Exports, NothingIsWrittenWhereRawFilesLie) {
  const fs::path raw = TestSurvey::easy().folder();
  const auto before = std::distance(fs::directory_iterator(raw), {});
  const auto refused = [&] {
    document().settle();
    EXPECT_THAT(told(), HasSubstr("raw"));
    EXPECT_EQ(std::distance(fs::directory_iterator(raw), {}), before);
  };
  export_results(workspace(), raw);
  refused();
  export_as(workspace(), "csv", raw / "inner");
  refused();
  save_picture(workspace(), PictureKind::slice_top, raw / "a.png");
  refused();
  save_movie(workspace(), PictureKind::slice_top, raw / "movie");
  refused();
}

TEST_F(Exports, AFullDiskIsOneLine) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  fs::create_symlink("/dev/full", out_ / "file");
  export_as(workspace(), "csv", out_ / "file" / "below");
  document().settle();
  EXPECT_THAT(told(), HasSubstr("below"));
  EXPECT_EQ(told().find('\n'), std::string::npos);
}

// A disk that gets full half way: one line, what was there stays, and the next attempt finds nothing in its way.
TEST_F(Exports, ADiskThatGetsFullHalfWayLeavesNothingTorn) {
  paint(4, 5, 5, 5, 200);
  document().settle();
  const auto full = [&](const char* what, const std::function<void()>& write) {
    const FullDisk disk(3000);
    write();
    document().settle();
    EXPECT_THAT(told(), HasSubstr("File too large")) << what;
    EXPECT_EQ(told().find('\n'), std::string::npos) << what;
  };
  full("products", [&] { export_results(workspace(), out_ / "results"); });
  full("tables", [&] { export_as(workspace(), "csv", out_ / "csv"); });
  full("picture", [&] { save_picture(workspace(), PictureKind::slice_top, out_ / "slice.png"); });
  fs::create_directories(out_ / "movie");
  PictureFileParams params = workspace().picture_file.values();
  params.kind.movie.each_picture = true;  // ffmpeg has a disk of its own
  workspace().picture_file.assign(params);
  full("movie", [&] { save_movie(workspace(), PictureKind::slice_top, out_ / "movie"); });
  for (const auto& entry : fs::recursive_directory_iterator(out_)) {
    EXPECT_FALSE(entry.is_regular_file()) << entry.path();
  }
  export_results(workspace(), out_ / "results");
  document().settle();
  EXPECT_THAT(told(), HasSubstr("written: 2 observations"));
}

TEST_F(Exports, APlannedRunsFolderIsLeftAlone) {
  std::ofstream(out_ / "plan.json") << "{}";
  export_results(workspace(), out_);
  document().settle();
  EXPECT_THAT(told(), HasSubstr("choose another folder"));
}

TEST_F(Exports, PicturesAreDrawnAsTheWindowShowsThem) {
  paint(4, 5, 5, 5, 200);
  document().settle();
  for (const char* name : {"map.svg", "slice.pdf", "slice.png"}) {
    const PictureKind kind = name == std::string("map.svg") ? PictureKind::observation_map : PictureKind::slice_top;
    save_picture(workspace(), kind, out_ / name);
    document().settle();
    EXPECT_EQ(told(), "written: " + (out_ / name).string());
    EXPECT_GT(fs::file_size(out_ / name), 1000U);
  }
  EXPECT_THAT(text_of(out_ / "map.svg"), HasSubstr("<svg"));
  EXPECT_THAT(text_of(out_ / "slice.pdf"), testing::StartsWith("%PDF"));
  save_picture(workspace(), PictureKind::slice_top, out_ / "a.bmp");
  document().settle();
  EXPECT_THAT(told(), HasSubstr(".png, .svg or .pdf"));
}

TEST_F(Exports, AMovieHasOnePictureAPingOfTheSelectedSchool) {
  paint(4, 6, 5, 5, 200);
  document().settle();
  select(1);
  PictureFileParams params = workspace().picture_file.values();
  params.kind.movie.each_picture = true;
  workspace().picture_file.assign(params);
  save_movie(workspace(), PictureKind::slice_top, out_);
  document().settle();
  EXPECT_THAT(told(), HasSubstr("written: 3 pictures in"));
  for (const char* name : {"movie-0000.png", "movie-0001.png", "movie-0002.png"}) {
    EXPECT_TRUE(fs::exists(out_ / name)) << name;
  }
  EXPECT_FALSE(fs::exists(out_ / "movie-0003.png"));
  if (mp4_can_be_made()) {
    EXPECT_THAT(text_of(out_ / "movie.mp4"), HasSubstr("ftyp"));
  } else {
    EXPECT_THAT(text_of(out_ / "movie.png"), HasSubstr("acTL"));
  }
}

TEST_F(Exports, AReportIsOnePage) {
  paint(4, 6, 5, 5, 200);
  document().settle();
  save_picture(workspace(), PictureKind::report, out_ / "report.pdf");
  document().settle();
  EXPECT_EQ(told(), "written: " + (out_ / "report.pdf").string());
  EXPECT_THAT(text_of(out_ / "report.pdf"), testing::StartsWith("%PDF"));
}

TEST_F(Exports, WithoutASurveyThereIsNothingToWrite) {
  ChangeQueue queue;
  AppModel app(queue, {});
  export_results(app.workspace, out_);
  EXPECT_THAT(app.workspace.document.notices().back(), HasSubstr("no survey is open"));
}

// The window numbers schools in the survey as results would have them now; once they are written, as they have them.
TEST_F(Exports, NumbersInTheSurveyAreThoseOfTheResultsAndStay) {
  const auto numbers = [this] {
    std::map<SchoolName, std::int64_t, decltype([](const SchoolName& a, const SchoolName& b) {
               return std::pair(a.observation, a.number) < std::pair(b.observation, b.number);
             })>
        out;
    for (const SurveySchool& school : survey_schools(document())) out[school.name] = school.survey_number;
    return out;
  };
  ASSERT_TRUE(document().show(1));
  document().settle();
  paint(2, 4, 5, 5, 200);
  document().settle();
  EXPECT_EQ(numbers().at({1, 1}), 1);
  ASSERT_TRUE(document().show(0));
  document().settle();
  paint(2, 4, 5, 5, 200);
  document().settle();
  EXPECT_EQ(numbers().at({0, 1}), 1) << "in the order of observations, as a run would";
  EXPECT_EQ(numbers().at({1, 1}), 2);
  export_results(workspace(), out_);
  document().settle();
  ASSERT_THAT(told(), HasSubstr("written"));
  EXPECT_THAT(text_of(out_ / "survey.json"), HasSubstr("survey_schools"));
  paint(6, 8, 10, 10, 400);
  document().settle();
  EXPECT_EQ(numbers().at({0, 1}), 1);
  EXPECT_EQ(numbers().at({1, 1}), 2) << "what was written stays";
  EXPECT_EQ(numbers().at({0, 2}), 3);
  export_results(workspace(), out_);
  document().settle();
  const auto kept = kept_numbers(out_);
  EXPECT_EQ(kept.size(), 3U);
  EXPECT_TRUE(std::any_of(kept.begin(), kept.end(),
                          [](const SurveyNumber& one) { return one.number == 3 && one.school_id == 2; }));
}

}  // namespace
}  // namespace sonar
