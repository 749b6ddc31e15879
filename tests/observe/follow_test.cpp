// SPDX-License-Identifier: Apache-2.0
// A survey that is being recorded: what follows it ends with the products of a run over the finished files.
#include "pipeline/live/follow.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "io/product_file.h"
#include "io/simrad/test_bytes.h"
#include "pipeline/tasks/run.h"
#include "synth/beam_table.h"
#include "synth/presets.h"
#include "synth/simulate.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Two observations in several files, simulated once.
class FollowSurvey : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    synth::SurveyParams params = synth::survey_params(synth::Preset::easy);
    params.observations = 2;
    params.pings = 20;
    params.schools = 2;
    params.file_mb = 9.0;
    Work work(2);
    ASSERT_TRUE(synth::simulate_survey(recorded(), params, synth::ms70_beams(), false, "test", work));
    std::vector<fs::path> raw;
    for (const auto& entry : fs::directory_iterator(recorded())) {
      if (entry.path().extension() == ".raw") raw.push_back(entry.path());
    }
    std::sort(raw.begin(), raw.end());
    files_ = new std::vector<std::pair<std::string, std::string>>;
    for (const fs::path& path : raw) files_->emplace_back(path.filename().string(), bytes_of(path));
    ASSERT_GT(files_->size(), 2U);
  }
  static void TearDownTestSuite() {
    delete files_;
    folder_.reset();
  }
  void SetUp() override {
    fs::remove_all(live());
    fs::remove_all(out());
    fs::create_directories(live());
  }

  static fs::path recorded() { return folder_->path() / "recorded"; }
  static fs::path live() { return folder_->path() / "live"; }
  static fs::path out() { return folder_->path() / "out"; }

  static void append(const std::string& name, std::string_view bytes) {
    std::ofstream(live() / name, std::ios::binary | std::ios::app)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  /// What run() writes of the finished files, by observation.
  static std::map<std::string, std::string> expected(const Recipe& recipe) {
    Work work(2);
    const auto survey = open_survey(std::vector<fs::path>{recorded()}, recipe.survey, recipe.navigation, {}, work);
    std::map<std::string, std::string> products;
    for (const ObservationFiles& observation : survey->observations) {
      const auto product = observe(*survey, observation, recipe, {{}, {}, "test"}, work);
      const fs::path file = folder_->path() / "expected.nc";
      EXPECT_TRUE(product && write_product(*product, file));
      products[observation.name] = bytes_of(file);
      fs::remove(file);
    }
    return products;
  }
  static std::map<std::string, std::string> written() {
    std::map<std::string, std::string> products;
    for (const auto& entry : fs::directory_iterator(out() / "products")) {
      products[entry.path().stem().string()] = bytes_of(entry.path());
    }
    return products;
  }

  static void expect_equal(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [name, bytes] : a) {
      ASSERT_TRUE(b.contains(name)) << name;
      EXPECT_TRUE(bytes == b.at(name)) << name;
    }
  }

  static inline std::unique_ptr<test::TemporaryFolder> folder_;
  static inline std::vector<std::pair<std::string, std::string>>* files_ = nullptr;
};

/// Writes the files piece by piece and looks after each; the clock goes on by a second a look.
class Recorder {
 public:
  Recorder(Follow& follow, Work& work) : follow_(follow), work_(work) {}

  Follow::Look look() {
    now_ += seconds(1);
    auto look = follow_.look(now_, work_);
    EXPECT_TRUE(look) << (look ? "" : look.error().text);
    if (!look) return {};
    for (const RunFailure& failure : look->failures) ADD_FAILURE() << failure.error.text;
    finished.insert(finished.end(), look->finished.begin(), look->finished.end());
    for (const LiveSchool& school : look->schools) fresh += school.is_new ? 1 : 0;
    return std::move(*look);
  }

  std::vector<std::string> finished;
  int fresh = 0;

 private:
  Follow& follow_;
  Work& work_;
  LiveClock::time_point now_ = LiveClock::time_point{} + seconds(1000);
};

TEST_F(FollowSurvey, EndsWithTheProductsOfARunHoweverTheBytesCame) {
  // The second recipe cuts within files; the pieces end anywhere.
  Recipe whole;
  Recipe cut;
  cut.survey.observation_max_s = 25.0;
  for (const Recipe& recipe : {whole, cut}) {
    SetUp();
    Work work(2);
    Follow follow({{live()}, out(), {}, "test", {}}, recipe);
    Recorder recorder(follow, work);
    std::uint32_t random = 7;
    for (const auto& [name, bytes] : *files_) {
      for (std::size_t at = 0; at < bytes.size();) {
        random = random * 1664525U + 1013904223U;
        const std::size_t piece = std::min<std::size_t>(bytes.size() - at, 1U + random % 5'000'000U);
        append(name, std::string_view(bytes).substr(at, piece));
        at += piece;
        recorder.look();
      }
    }
    EXPECT_GT(recorder.fresh, 0);
    follow.end();
    recorder.look();
    const auto products = expected(recipe);
    // Of 20 pings, 5 s apart, six are within 25 s: four observations of each.
    EXPECT_EQ(products.size(), recipe.survey.observation_max_s < 100.0 ? 8U : 2U);
    expect_equal(written(), products);
    EXPECT_EQ(recorder.finished.size(), products.size());
    // What is over is let go: one that is finished and what goes on.
    EXPECT_LE(follow.survey()->observations.size(), 2U);
  }
}

TEST_F(FollowSurvey, TellsOfSchoolsAlsoWhereAllIsOverAtOnce) {
  Work work(2);
  Follow follow({{live()}, out(), {}, "test", {}}, {});
  Recorder recorder(follow, work);
  for (const auto& [name, bytes] : *files_) append(name, bytes);
  follow.end();
  recorder.look();
  EXPECT_THAT(recorder.finished, ElementsAre("obs-0001", "obs-0002"));
  EXPECT_EQ(recorder.fresh, 4);  // two in each
  expect_equal(written(), expected({}));
}

TEST_F(FollowSurvey, ALookThatWasStoppedIsTakenUpByTheNext) {
  Work work(2);
  Follow follow({{live()}, out(), {}, "test", {}}, {});
  Recorder recorder(follow, work);
  const auto& [name, bytes] = files_->front();
  append(name, std::string_view(bytes).substr(0, bytes.size() / 2));
  recorder.look();
  append(name, std::string_view(bytes).substr(bytes.size() / 2));
  Work stopped(2);
  stopped.set_progress([&](std::string_view, std::int64_t, std::int64_t) { stopped.cancel(); });
  EXPECT_EQ(follow.look(LiveClock::time_point{} + seconds(1001), stopped).error().code, ErrorCode::cancelled);
  const Follow::Look look = recorder.look();
  EXPECT_EQ(look.news.pings, 0U);  // they were read by the look before
  ASSERT_TRUE(follow.write(work));
  const auto product = read_product(product_path(out(), "obs-0001"));
  ASSERT_TRUE(product);
  EXPECT_EQ(product->pings.size(), follow.survey()->observations.front().pings.size());
}

TEST_F(FollowSurvey, WhatGoesOnIsProvisionalAndNoRightProduct) {
  Work work(2);
  Follow follow({{live()}, out(), {}, "test", {}}, {});
  Recorder recorder(follow, work);
  const auto& [name, bytes] = files_->front();
  append(name, std::string_view(bytes).substr(0, bytes.size() - 100'000));
  EXPECT_THAT(recorder.look().finished, IsEmpty());
  ASSERT_TRUE(follow.write(work));
  EXPECT_FALSE(follow.unwritten());
  const auto product = read_product(product_path(out(), "obs-0001"));
  ASSERT_TRUE(product);
  EXPECT_EQ(product->input_hash, "");
  ASSERT_FALSE(product->school_pings.empty());
  for (const SchoolPingRow& row : product->school_pings) EXPECT_EQ(row.provisional, 1);
  const auto merged = merge_folder(out(), {}, work);
  ASSERT_TRUE(merged);
  EXPECT_EQ(merged->survey.schools.size(), product->schools.size());
}

TEST_F(FollowSurvey, WaitsForADiskThatIsGoneAndGoesOn) {
  Work work(2);
  Follow follow({{live()}, out(), {}, "test", {}}, {});
  Recorder recorder(follow, work);
  const fs::path away = folder_->path() / "away";
  for (const auto& [name, bytes] : *files_) {
    const std::size_t half = bytes.size() / 2;
    append(name, std::string_view(bytes).substr(0, half));
    recorder.look();
    fs::rename(live(), away);
    for (int i = 0; i < 200; ++i) {  // longer than a gap: nothing is taken for its end
      const Follow::Look look = recorder.look();
      EXPECT_TRUE(look.news.cannot);
      EXPECT_EQ(look.news.pings, 0U);
    }
    fs::rename(away, live());
    append(name, std::string_view(bytes).substr(half));
    recorder.look();
  }
  follow.end();
  recorder.look();
  expect_equal(written(), expected({}));
}

TEST_F(FollowSurvey, AFileThatGoesOnAfterALongRestIsTakenInAgain) {
  Work work(2);
  Follow follow({{live()}, out(), {}, "test", {}}, {});
  Recorder recorder(follow, work);
  const auto& [first, bytes] = files_->front();
  append(first, std::string_view(bytes).substr(0, bytes.size() / 2));
  for (int i = 0; i < 130; ++i) recorder.look();
  EXPECT_THAT(recorder.finished, ElementsAre("obs-0001"));
  append(first, std::string_view(bytes).substr(bytes.size() / 2));
  for (std::size_t f = 1; f < files_->size(); ++f) append((*files_)[f].first, (*files_)[f].second);
  recorder.look();
  follow.end();
  recorder.look();
  expect_equal(written(), expected({}));
}

}  // namespace
}  // namespace sonar
