// SPDX-License-Identifier: Apache-2.0
// Results of a run that was given decisions, or that kept masks, are shown without detecting again.
#include "pipeline/tasks/other_finds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/journal/journals.h"
#include "pipeline/stages/detected_cache.h"
#include "pipeline/tasks/kept_find.h"
#include "pipeline/tasks/run.h"
#include "session/test_app.h"
#include "session/test_run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class DecidedFinds : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    const fs::path found = TestSurvey::easy().fresh();
    const auto plan = run_easy(found);
    ASSERT_TRUE(plan) << to_line(plan.error());
    for (const PlanTask& task : plan->tasks) {
      const auto product = kept_detected(product_path(found, task.observation), task.key);
      ASSERT_TRUE(product);
      found_.push_back(*product);
    }
    ASSERT_EQ(found_.size(), 2U);
  }
  /// A voxel of an observation's first school, in the ping where it is first.
  [[nodiscard]] SchoolKey voxel(std::size_t observation) const {
    const ObservationProduct& product = found_[observation];
    const SchoolMask& mask = product.masks.front();
    const sonar::Run& run = mask.mask.runs.front();
    const int channel = product.grid->grid.channel[static_cast<std::size_t>(run.row)];
    return {product.pings[static_cast<std::size_t>(mask.ping_index)].time, channel, run.first_sample};
  }
  /// A line of the journal that the run is given.
  std::int64_t say(std::size_t observation, Command command) {
    const JournalAct act{++lines_, lines_ * kSecondNs, "ann", voxel(observation).ping_time, std::move(command)};
    EXPECT_TRUE(append_journal(session_.string(), {}, line_of(act)));
    return act.n;
  }
  std::int64_t decide(std::size_t observation, Decision decision) {
    decision.school = voxel(observation);
    return say(observation, DecideCommand{{decision}, {}});
  }
  std::int64_t say_species(std::size_t observation) {
    Decision decision;
    decision.species = "herring";
    return decide(observation, decision);
  }
  std::int64_t reject(std::size_t observation) {
    Decision decision;
    decision.status = "rejected";
    return decide(observation, decision);
  }
  std::int64_t paint_in(std::size_t observation) {
    BrushCommand command;
    command.runs.push_back({voxel(observation).channel, voxel(observation).sample - 4, 6});
    return say(observation, command);
  }
  void take_back(std::int64_t line) {
    JournalLine undo;
    undo.n = ++lines_;
    undo.decided = lines_ * kSecondNs;
    undo.operator_name = "ann";
    undo.command = "undo";
    undo.ping_time = voxel(0).ping_time;
    undo.args = JsonValue(nlohmann::json{{"target", line}});
    ASSERT_TRUE(append_journal(session_.string(), {}, undo));
  }
  /// Of version "test", as `sonarx run --session` makes them.
  void run(std::optional<PingSelection> pings = {}, bool remeasure = false) {
    const std::vector<fs::path> paths{raw_};
    const fs::path session = fs::exists(session_) ? session_ : fs::path();
    std::vector<JournalLine> said;
    if (!session.empty()) {
      const auto journal = read_session(session);
      ASSERT_TRUE(journal);
      said = effective_lines(journal->lines);
    }
    const ReadJournal lines(said);
    Work work;
    const auto survey = open_survey(paths, recipe_.survey, recipe_.navigation, {}, work);
    ASSERT_TRUE(survey);
    const Plan plan = make_plan(*survey, paths, session, recipe_, {{}, lines, "test"});
    RunOptions options;
    options.out = out_;
    options.program_version = "test";
    options.pings = pings;
    options.remeasure = remeasure;
    ASSERT_TRUE(run_plan(plan, *survey, lines, options, work));
    std::ofstream(out_ / "plan.json") << plan_text(plan);
    keys_ = {plan.tasks[0].key, plan.tasks[1].key};
    for (std::size_t i = 0; i < 2 && !pings && !remeasure; ++i) {
      auto product = kept_detected(product_path(out_, plan.tasks[i].observation), plan.tasks[i].key);
      ASSERT_TRUE(product);
      made_.push_back(std::move(*product));
    }
  }
  void open(const fs::path& path, const std::string& version) {
    DocumentOptions options = TestSurvey::options(journal_);
    options.program_version = version;
    options.cache = cache_;
    app_ = std::make_unique<AppModel>(queue_, options);
    document().open({path});
    document().settle();
  }
  /// As it lies in OUT after it kept masks.
  [[nodiscard]] ObservationProduct kept(std::size_t observation) const {
    const ObservationProduct& before = made_[observation];
    auto product = kept_detected(product_path(out_, before.observation), remeasured_key(keys_[observation], before));
    EXPECT_TRUE(product);
    return product ? *product : ObservationProduct{};
  }
  static std::uint64_t voxels_of(const ObservationProduct& product) {
    std::uint64_t sum = 0;
    for (const SchoolMask& mask : product.masks) sum += mask.mask.voxels();
    return sum;
  }
  /// By pings, without those that have none.
  static std::vector<double> backscatter_m2(const ObservationProduct& product) {
    std::vector<double> of_pings;
    for (const SchoolPingRow& row : product.school_pings) {
      if (std::isfinite(row.backscatter_m2)) of_pings.push_back(row.backscatter_m2);
    }
    return of_pings;
  }
  [[nodiscard]] std::uint64_t found_voxels(std::size_t observation) const { return voxels_of(found_[observation]); }
  [[nodiscard]] std::uint64_t made_voxels(std::size_t observation) const { return voxels_of(made_[observation]); }
  [[nodiscard]] std::uint64_t voxels(std::size_t observation) {
    std::uint64_t sum = 0;
    for (const auto& school : document().state(observation).schools) {
      for (const auto& in_ping : school->masks.pings) sum += in_ping.mask.voxels();
    }
    return sum;
  }
  [[nodiscard]] std::string species(std::size_t observation) {
    const auto& schools = document().state(observation).schools;
    return schools.empty() ? "no school" : schools.front()->masks.decided.species;
  }

  const fs::path& raw_ = TestSurvey::easy().folder();
  fs::path out_ = TestSurvey::easy().fresh();
  fs::path session_ = TestSurvey::easy().fresh() / "chosen.jsonl";
  IndexCache cache_;
  Recipe recipe_;
  std::vector<ObservationProduct> found_;  ///< without decisions
  std::vector<ObservationProduct> made_;   ///< with them
  std::vector<std::string> keys_;          ///< of the last run's tasks
  std::int64_t lines_ = 0;
};

TEST_F(DecidedFinds, AreShownWithTheirDecisionsAndFiguresWhereTheseChangedNoMask) {
  cache_.folder = TestSurvey::easy().fresh();
  say_species(0);
  paint_in(1);
  run();
  ASSERT_EQ(made_[0].schools.front().species, "herring");
  open(out_, "another");
  ASSERT_TRUE(document().as_made(0));
  EXPECT_TRUE(document().detected(0));
  EXPECT_EQ(document().state(0).schools.size(), found_[0].schools.size());
  EXPECT_EQ(species(0), "herring");
  EXPECT_EQ(document().state(0).schools.front()->masks.decided.operator_name, "ann");
  ASSERT_TRUE(document().product(0));
  EXPECT_EQ(document().product(0)->program_version, "test");
  EXPECT_EQ(document().product(0)->input_hash, "") << "it is no find of this version";
  EXPECT_EQ(document().product(0)->school_pings.size(), made_[0].school_pings.size());
  EXPECT_EQ(document().product(0)->schools.front().backscatter_m2, made_[0].schools.front().backscatter_m2);
  EXPECT_THAT(document().notices(), Contains(AllOf(HasSubstr("the schools of 2 observations are shown as version test"),
                                                   HasSubstr("Ctrl+D"))));
  EXPECT_TRUE(document().as_made(1)) << "the run kept what it had found";
  EXPECT_EQ(voxels(1), made_voxels(1)) << "what was painted is painted once";
  EXPECT_GT(voxels(1), found_voxels(1));
  open(raw_, "another");
  EXPECT_EQ(document().as_made(0), nullptr);
  ASSERT_TRUE(document().product(0));
  EXPECT_EQ(document().product(0)->program_version, "another") << "it was kept under no key of this version";
  EXPECT_EQ(species(0), "herring") << "the decision holds on what is found now";
}

TEST_F(DecidedFinds, OfThisVersionTooAreNotDetectedAgain) {
  say_species(0);
  run();
  open(out_, "test");
  EXPECT_TRUE(document().detected(0));
  EXPECT_EQ(document().as_made(0), nullptr) << "the run kept its find, under the key of a run without decisions";
  EXPECT_TRUE(document().detected(1)) << "nothing was said of it: it is such a find";
  EXPECT_EQ(species(0), "herring");
}

// As a version before left them that kept no finds.
TEST_F(DecidedFinds, OfThisVersionAreNotDetectedAgainWhereNoFindWasKept) {
  say_species(0);
  run();
  fs::remove_all(out_ / "found");
  open(out_, "test");
  EXPECT_TRUE(document().as_made(0));
  EXPECT_TRUE(document().detected(1));
  EXPECT_EQ(species(0), "herring");
  EXPECT_THAT(document().notices(), Contains(HasSubstr("as the run left them")));
}

// As a run without decisions left it, under its key.
TEST_F(DecidedFinds, OfThisVersionAreFoundUnderAllDecisionsThatChangedMasks) {
  paint_in(0);
  say(1, BadPingsCommand{voxel(1).ping_time, voxel(1).ping_time});
  run();
  ASSERT_NE(made_voxels(0), found_voxels(0));
  ASSERT_NE(made_voxels(1), found_voxels(1));
  open(out_, "test");
  for (const std::size_t observation : {0U, 1U}) {
    EXPECT_TRUE(document().detected(observation));
    ASSERT_TRUE(document().product(observation));
    EXPECT_EQ(voxels_of(*document().product(observation)), made_voxels(observation));
    EXPECT_EQ(backscatter_m2(*document().product(observation)), backscatter_m2(made_[observation]));
  }
}

// A window's recipe looks for schools where it is asked to.
TEST_F(DecidedFinds, OfARunUnderAWindowsRecipeAreFoundToo) {
  recipe_.automatic = false;
  say(0, DetectCommand{0});
  say(1, DetectCommand{0});
  paint_in(0);
  run();
  EXPECT_FALSE(fs::exists(found_path(out_, made_[1].observation))) << "nothing but that was said of it";
  open(out_, "test");
  EXPECT_TRUE(document().detected(0));
  EXPECT_EQ(voxels(0), made_voxels(0));
  const auto find = kept_detected(found_path(out_, made_[0].observation), found_[0].input_hash);
  ASSERT_TRUE(find) << "as of a run without decisions";
  EXPECT_EQ(voxels_of(*find), found_voxels(0));
}

TEST_F(DecidedFinds, WhatIsNoLongerDecidedLeavesNoFind) {
  const std::int64_t painted = paint_in(0);
  run();
  const fs::path found = found_path(out_, made_[0].observation);
  EXPECT_TRUE(fs::exists(found));
  EXPECT_FALSE(fs::exists(found_path(out_, made_[1].observation))) << "nothing was said of it";
  take_back(painted);
  run();
  EXPECT_FALSE(fs::exists(found));
  EXPECT_FALSE(fs::exists(found.parent_path()));
}

TEST_F(DecidedFinds, WhatWasLookedForInSomePingsIsNotAllThatIsThere) {
  say_species(0);
  run(PingSelection{0, 1});
  open(out_, "another");
  EXPECT_EQ(document().as_made(0), nullptr);
  EXPECT_EQ(document().as_made(1), nullptr);
}

// Every figure of them is another than the run before had, and than detection would give.
TEST_F(DecidedFinds, MasksThatWereKeptAreShownAsTheyWereMeasuredAnew) {
  run();
  recipe_.calibration.psi = PsiSource::from_widths;
  run({}, true);
  open(out_, "test");
  for (const std::size_t observation : {0U, 1U}) {
    ASSERT_TRUE(document().as_made(observation));
    EXPECT_EQ(voxels(observation), made_voxels(observation));
    const ObservationProduct anew = kept(observation);
    EXPECT_NE(backscatter_m2(anew), backscatter_m2(made_[observation]));
    ASSERT_TRUE(document().product(observation));
    EXPECT_EQ(backscatter_m2(*document().product(observation)), backscatter_m2(anew));
  }
  EXPECT_THAT(document().notices(), Contains(HasSubstr("as the run left them")));
}

TEST_F(DecidedFinds, MasksThatWereKeptAndShapedByHandAreCarriedOutOnTheFindOfThatRun) {
  paint_in(0);
  run();
  recipe_.calibration.psi = PsiSource::from_widths;
  run({}, true);
  open(out_, "test");
  ASSERT_TRUE(document().as_made(0));
  EXPECT_EQ(voxels(0), made_voxels(0));
  ASSERT_TRUE(document().product(0));
  EXPECT_EQ(voxels_of(*document().product(0)), voxels_of(kept(0)));
  const std::vector<double> shown = backscatter_m2(*document().product(0));
  const std::vector<double> anew = backscatter_m2(kept(0));
  ASSERT_EQ(shown.size(), anew.size());
  for (std::size_t i = 0; i < shown.size(); ++i) EXPECT_NEAR(shown[i], anew[i], 1e-9 * anew[i]);
  EXPECT_TRUE(document().as_made(1)) << "of this one nothing was decided";
}

// Which decisions they hold, such a run does not tell: it was given none.
TEST_F(DecidedFinds, MasksThatWereKeptWithDecisionsAreNoFind) {
  paint_in(0);
  reject(0);
  run();
  fs::remove(session_);
  run({}, true);
  open(out_, "test");
  EXPECT_EQ(document().as_made(0), nullptr);
  EXPECT_TRUE(document().as_made(1)) << "of this one nothing was decided";
  fs::remove_all(out_ / "found");
  open(out_, "test");
  EXPECT_EQ(document().as_made(0), nullptr) << "its schools show it";
}

TEST_F(DecidedFinds, MasksThatWereMeasuredInSomePingsAreNotShown) {
  run();
  run(PingSelection{0, 1}, true);
  open(out_, "test");
  EXPECT_EQ(document().as_made(0), nullptr);
}

TEST_F(DecidedFinds, ARejectedSchoolStaysRejected) {
  reject(0);
  run();
  ASSERT_EQ(made_[0].schools.front().status, "rejected");
  open(out_, "another");
  EXPECT_TRUE(document().as_made(0));
  ASSERT_FALSE(document().state(0).schools.empty());
  EXPECT_EQ(document().state(0).schools.front()->masks.decided.status, "rejected");
}

// With the extinction correction a rejected school casts no shadow: taken in again, it would change the figures of others.
TEST_F(DecidedFinds, FiguresThatHangOnARejectedSchoolAreMeasuredAnew) {
  recipe_.measure.extinction.correct = true;
  reject(0);
  run();
  open(out_, "another");
  EXPECT_EQ(document().as_made(0), nullptr);
  EXPECT_TRUE(document().as_made(1)) << "in this one no school is rejected";
}

// The journal may have had the line when the run was given it.
TEST_F(DecidedFinds, ALineThatWasTakenBackMayHaveChangedMasks) {
  take_back(paint_in(0));
  run();
  open(out_, "another");
  EXPECT_EQ(document().as_made(0), nullptr);
  EXPECT_TRUE(document().as_made(1));
}

// Another journal lies where the run's lay: what the product says of its schools counts.
TEST_F(DecidedFinds, SchoolsThatWereShapedByHandAreNotShownAsFound) {
  paint_in(0);
  run();
  fs::remove(session_);
  say_species(0);
  fs::remove(found_path(out_, made_[0].observation));
  open(out_, "another");
  EXPECT_EQ(document().as_made(0), nullptr);
  EXPECT_TRUE(document().as_made(1));
  fs::remove(session_);
  open(out_, "another");
  EXPECT_EQ(document().as_made(1), nullptr) << "nobody knows what was decided";
}

// No school, of a run that looked for none, is no find.
TEST_F(DecidedFinds, WhereNobodyLookedForSchoolsNothingIsShown) {
  Recipe recipe;
  recipe.automatic = false;
  ASSERT_TRUE(run_easy(out_, recipe));
  open(out_, "another");
  EXPECT_EQ(document().as_made(0), nullptr);
  EXPECT_FALSE(document().detected(0));
}

}  // namespace
}  // namespace sonar
