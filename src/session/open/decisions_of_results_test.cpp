// SPDX-License-Identifier: Apache-2.0
// Results of a run that was given decisions are opened with these.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "session/test_results.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

class DecisionsOfResults : public TestResults {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(TestResults::SetUp());
    plan_.session = session_.string();
    write_plan();
    product_ = product_of(0);
    ASSERT_FALSE(product_.masks.empty());
  }
  /// The first voxel of the first school, farther out by so many samples.
  [[nodiscard]] SchoolKey voxel(int samples = 0) const {
    const SchoolMask& mask = product_.masks.front();
    const sonar::Run& run = mask.mask.runs.front();
    const int channel = product_.grid->grid.channel[static_cast<std::size_t>(run.row)];
    return {product_.pings[static_cast<std::size_t>(mask.ping_index)].time, channel, run.first_sample + samples};
  }
  void say(const std::string& who, Command command) {
    const JournalAct act{++lines_, lines_ * kSecondNs, who, voxel().ping_time, std::move(command)};
    ASSERT_TRUE(append_journal(session_.string(), {}, line_of(act)));
  }
  [[nodiscard]] static DecideCommand species(const SchoolKey& school, const std::string& name) {
    Decision decision;
    decision.school = school;
    decision.species = name;
    return {{decision}, {}};
  }
  [[nodiscard]] std::ptrdiff_t lost() {
    return std::ranges::count(document().state(0).notes, DiagnosticCode::decision_lost, &Diagnostic::code);
  }

  fs::path session_ = TestSurvey::easy().fresh() / "chosen.jsonl";
  ObservationProduct product_;
  std::int64_t lines_ = 0;
};

TEST_F(DecisionsOfResults, AreTakenOverWithTheirPersonAndToldOnce) {
  say("ann", species(voxel(), "herring"));
  say("ann", species(voxel(500), "nobody is there"));
  open({out_});
  ASSERT_FALSE(document().state(0).schools.empty());
  EXPECT_EQ(document().state(0).schools.front()->masks.decided.species, "herring");
  EXPECT_EQ(document().state(0).schools.front()->masks.decided.operator_name, "ann");
  EXPECT_EQ(lost(), 1) << "what finds no school is listed";
  EXPECT_THAT(document().notices(), Contains(AllOf(HasSubstr("2 decisions"), HasSubstr("ann"))));
  open({out_});
  EXPECT_EQ(document().state(0).schools.front()->masks.decided.species, "herring");
  EXPECT_EQ(lost(), 1) << "they are there once";
  EXPECT_THAT(document().notices(), Each(Not(HasSubstr("taken over"))));
}

TEST_F(DecisionsOfResults, ThatAreOnesOwnAreOneStepToUndo) {
  say("tester", DetectCommand{2});
  say("tester", species(voxel(), "herring"));
  open({out_});
  ASSERT_EQ(document().state(0).schools.size(), 2U);
  EXPECT_EQ(document().state(0).schools.front()->masks.decided.species, "herring");
  // Above them lies that the schools of the other observation were looked for.
  for (int i = 0; i < 2; ++i) document().undo();
  document().settle();
  EXPECT_TRUE(document().state(0).schools.empty()) << "as the journal was before";
  for (int i = 0; i < 2; ++i) document().redo();
  document().settle();
  EXPECT_EQ(document().state(0).schools.front()->masks.decided.species, "herring");
}

TEST_F(DecisionsOfResults, WhoseJournalIsGoneAreMissedInOneLine) {
  open({out_});
  EXPECT_EQ(document().state(0).schools.size(), 2U);
  EXPECT_THAT(document().notices(), Contains(AllOf(HasSubstr("not taken over"), HasSubstr(session_.string()))));
}

}  // namespace
}  // namespace sonar
