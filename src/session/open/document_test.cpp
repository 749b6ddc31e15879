// SPDX-License-Identifier: Apache-2.0
#include "session/open/document.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <set>
#include <vector>

#include "base/test_full_disk.h"
#include "pipeline/stages/observe.h"
#include "session/listening.h"
#include "session/test_survey.h"

namespace sonar {
namespace {

class DocumentAtWork : public testing::Test {
 protected:
  void SetUp() override { reopen(); }

  void reopen() {
    document_.reset();
    document_ = std::make_unique<Document>(queue_, TestSurvey::options(journal_));
    listening_.emplace(document_->changes(), [this](DocumentChange change) { heard_.insert(change); });
    document_->open({TestSurvey::easy().folder()});
    document_->settle();
  }

  /// The brightest voxel of what the recipe finds in the observation on show, with its ping.
  struct Bright {
    std::int64_t ping = 0;
    SeedKey seed;
  };
  Bright bright() {
    Work work;
    const auto found = observe(*document_->survey(), document_->shown()->files(), Recipe{}, {{}, {}, "test"}, work);
    const SchoolMask& mask = found->masks[found->masks.size() / 4];
    const auto at = std::max_element(mask.mask.confidence.begin(), mask.mask.confidence.end());
    auto left = at - mask.mask.confidence.begin();
    for (const sonar::Run& run : mask.mask.runs) {
      if (left < run.count) {
        return {mask.ping_index,
                {document_->shown()->grid().channel[static_cast<std::size_t>(run.row)],
                 run.first_sample + static_cast<int>(left)}};
      }
      left -= run.count;
    }
    return {};
  }

  void grow(const Bright& at) {
    GrowCommand command;
    command.seeds = {at.seed};
    document_->act(at.ping, command);
  }

  std::filesystem::path journal_ = TestSurvey::easy().fresh();
  ChangeQueue queue_;
  std::set<DocumentChange> heard_;
  std::optional<Listening> listening_;
  std::unique_ptr<Document> document_;
};

TEST_F(DocumentAtWork, OpensLooksAtTheFirstPingAndFillsTheNeighbours) {
  ASSERT_NE(document_->survey(), nullptr);
  EXPECT_EQ(document_->survey()->observations.size(), 2U);
  ASSERT_TRUE(document_->shown());
  ASSERT_TRUE(document_->staged());
  EXPECT_EQ(document_->staged()->ping_index, 0);
  EXPECT_TRUE(document_->shown()->cache().held(2));
  EXPECT_FALSE(document_->shown()->cache().held(5));
  EXPECT_TRUE(heard_.contains(DocumentChange::ping));
}

TEST_F(DocumentAtWork, APingLookedAtIsTheEnginesBitForBit) {
  document_->look_at(5);
  document_->settle();
  Engine whole(*document_->survey(), document_->survey()->observations.front(), document_->recipe());
  Work work;
  ASSERT_TRUE(whole.estimate_background(0, TestSurvey::kPings - 1, work));
  const auto staged = whole.staged(5);
  ASSERT_TRUE(staged);
  EXPECT_EQ(staged->filtered->counts, document_->staged()->filtered->counts);
  EXPECT_EQ(staged->filtered->flags, document_->staged()->filtered->flags);
}

TEST_F(DocumentAtWork, AnActStandsInTheJournalAndIsMeasured) {
  grow(bright());
  document_->settle();
  ASSERT_EQ(document_->state().schools.size(), 1U);
  EXPECT_EQ(document_->choices().undo_text, "Undo grow school 1");
  const auto journal = read_journal(document_->journal_path().string());
  ASSERT_TRUE(journal);
  ASSERT_EQ(journal->lines.size(), 1U);
  EXPECT_EQ(journal->lines[0].command, "grow");
  ASSERT_TRUE(document_->product(0));
  ASSERT_EQ(document_->product(0)->schools.size(), 1U);
  EXPECT_EQ(document_->product(0)->schools[0].school_id, 1);
  EXPECT_GT(document_->product(0)->schools[0].volume_m3, 0.0);
}

TEST_F(DocumentAtWork, UndoAndRedoGoBackAndForthAndAreLinesThemselves) {
  grow(bright());
  document_->settle();
  const auto grown = masks_of(document_->state());
  document_->undo();
  document_->settle();
  EXPECT_TRUE(document_->state().schools.empty());
  EXPECT_EQ(document_->choices().redo_text, "Redo grow school 1");
  document_->redo();
  document_->settle();
  ASSERT_EQ(document_->state().schools.size(), 1U);
  EXPECT_EQ(document_->state().schools[0]->masks.pings[0].mask, grown[0].pings[0].mask);
  EXPECT_EQ(read_journal(document_->journal_path().string())->lines.size(), 3U);
  document_->redo();
  document_->settle();
  EXPECT_THAT(document_->notices().back(), testing::HasSubstr("nothing to redo"));
}

TEST_F(DocumentAtWork, WhatWasChosenIsThereAfterTheProgramEndedAnyhow) {
  grow(bright());
  document_->settle();
  const auto before = masks_of(document_->state());
  reopen();
  ASSERT_EQ(document_->state().schools.size(), 1U);
  EXPECT_EQ(document_->state().schools[0]->masks.pings[0].mask, before[0].pings[0].mask);
  EXPECT_EQ(document_->choices().undo_text, "Undo grow school 1");
}

TEST_F(DocumentAtWork, APropagationTellsEveryPingAndItsRerunGivesTheSameMasks) {
  const Bright at = bright();
  PropagateCommand command;
  command.seeds = {at.seed};
  command.reach = 3;
  std::set<std::int64_t> seen;
  const Listening heard_of(document_->changes(), [&](DocumentChange change) {
    if (change != DocumentChange::propagating) return;
    for (const auto& [ping, mask] : document_->propagating()) seen.insert(ping);
  });
  std::int64_t most = 0;
  const Listening progress_of(document_->changes(), [&](DocumentChange change) {
    if (change != DocumentChange::progress || document_->activity().stage != "propagating") return;
    EXPECT_LE(document_->activity().done, document_->activity().total);
    most = std::max(most, document_->activity().done);
  });
  document_->act(at.ping, command);
  document_->settle();
  ASSERT_EQ(document_->state().schools.size(), 1U);
  EXPECT_GT(seen.size(), 1U);
  EXPECT_EQ(most, static_cast<std::int64_t>(seen.size()));
  EXPECT_EQ(document_->activity().stage, "");
  Work work;
  Recipe recipe = document_->recipe();
  const auto lines = effective_lines(read_journal(document_->journal_path().string())->lines);
  const auto rerun = observe(*document_->survey(), document_->shown()->files(), recipe, {{}, lines, "test"}, work);
  ASSERT_TRUE(rerun);
  ASSERT_EQ(rerun->masks.size(), document_->state().schools[0]->masks.pings.size());
  for (std::size_t i = 0; i < rerun->masks.size(); ++i) {
    EXPECT_EQ(rerun->masks[i].mask, document_->state().schools[0]->masks.pings[i].mask);
  }
  ASSERT_EQ(rerun->schools.size(), document_->product(0)->schools.size());
  EXPECT_EQ(rerun->schools[0].backscatter_m2, document_->product(0)->schools[0].backscatter_m2);
}

TEST_F(DocumentAtWork, DetectionIsAChoiceAndComesBack) {
  document_->detect({0});
  document_->settle();
  ASSERT_EQ(document_->state(0).schools.size(), 2U);
  EXPECT_TRUE(document_->detected(0));
  EXPECT_FALSE(document_->detected(1));
  const std::size_t lines = document_->choices().lines->size();
  reopen();
  EXPECT_EQ(document_->state(0).schools.size(), 2U);
  EXPECT_EQ(document_->choices().lines->size(), lines) << "asking again is no new choice";
  Work work;
  const auto effective = effective_lines(*document_->choices().lines);
  const auto first = observe(*document_->survey(), document_->survey()->observations[0], document_->recipe(),
                             {{}, effective, "test"}, work);
  const auto second = observe(*document_->survey(), document_->survey()->observations[1], document_->recipe(),
                              {{}, effective, "test"}, work);
  EXPECT_EQ(first->schools.size(), 2U);
  EXPECT_EQ(second->schools.size(), 0U);
}

TEST_F(DocumentAtWork, DetectionIsUndoneAndRedoneAsTheJournalAloneWouldHaveIt) {
  document_->detect({0});
  document_->settle();
  ASSERT_EQ(document_->state(0).schools.size(), 2U);
  document_->undo();
  document_->settle();
  EXPECT_TRUE(document_->state(0).schools.empty());
  Work work;
  const auto rerun = [&] {
    const auto lines = effective_lines(*document_->choices().lines);
    return observe(*document_->survey(), document_->survey()->observations[0], document_->recipe(), {{}, lines, "test"},
                   work);
  };
  EXPECT_TRUE(rerun()->schools.empty());
  document_->redo();
  document_->settle();
  EXPECT_EQ(document_->state(0).schools.size(), 2U);
  EXPECT_EQ(rerun()->schools.size(), 2U);
}

TEST_F(DocumentAtWork, WhatCannotBeDoneIsToldAndChangesNothing) {
  GrowCommand nowhere;
  nowhere.seeds = {{100000, 1}};
  document_->act(0, nowhere);
  document_->settle();
  EXPECT_TRUE(document_->state().schools.empty());
  EXPECT_THAT(document_->notices().back(), testing::HasSubstr("there is no channel"));
  EXPECT_FALSE(std::filesystem::exists(document_->journal_path()));
}

TEST_F(DocumentAtWork, WhatAJournalCouldNotGiveBackIsRefused) {
  document_->act(EventCommand{"picnic", document_->shown()->context().times[2], "ashore"});
  document_->settle();
  EXPECT_TRUE(document_->state().events.empty());
  EXPECT_THAT(document_->notices().back(), testing::HasSubstr("kind: expected one of trawl"));
  EXPECT_FALSE(std::filesystem::exists(document_->journal_path()));
}

TEST_F(DocumentAtWork, AnUndoThatNobodySeesIsTold) {
  const auto at = bright();
  grow(at);
  document_->settle();
  ASSERT_EQ(document_->state().schools.size(), 1U);
  ASSERT_TRUE(document_->show(1));
  document_->settle();
  document_->undo();
  document_->settle();
  EXPECT_THAT(document_->notices().back(), testing::HasSubstr("taken back in obs-0001: grow school 1"));
}

// States of all observations may be built anew by an undo; only what changed is worth a word.
TEST_F(DocumentAtWork, AnUndoIsToldOfNoObservationThatItLeavesAsItWas) {
  grow(bright());
  document_->settle();
  const std::size_t told = document_->notices().size();
  document_->undo();
  document_->settle();
  document_->redo();
  document_->settle();
  for (std::size_t i = told; i < document_->notices().size(); ++i) {
    EXPECT_THAT(document_->notices()[i], testing::Not(testing::HasSubstr(" in obs-")));
  }
}

TEST_F(DocumentAtWork, LookingLeavesNothingBehindAndTheFirstChoiceMakesTheFolder) {
  journal_ /= "not/yet/there";
  reopen();
  EXPECT_FALSE(std::filesystem::exists(journal_));
  grow(bright());
  document_->settle();
  EXPECT_TRUE(std::filesystem::exists(journal_ / "session.jsonl"));
}

// What the files' ends tell comes before anything else, and part of the survey can be asked for instead of all.
TEST_F(DocumentAtWork, BothEndsOfTheFilesAreThereFirst) {
  document_ = std::make_unique<Document>(queue_, TestSurvey::options(journal_));
  std::vector<std::string> seen;
  const Listening heard_of(document_->changes(), [&](DocumentChange change) {
    if (change != DocumentChange::survey && change != DocumentChange::glance) return;
    const auto& glance = document_->glance();
    seen.push_back(fmt::format("{}/{}", glance ? glance->observations.size() : 0,
                               document_->survey() != nullptr ? document_->survey()->observations.size() : 0));
    if (glance && glance->observations.size() == 2) document_->open_glanced(1);
  });
  document_->open({TestSurvey::easy().folder()});
  document_->settle();
  EXPECT_EQ(seen.front(), "2/0") << "of the whole folder, and no survey yet";
  EXPECT_EQ(seen.back(), "0/1");
  EXPECT_EQ(document_->survey()->files.size(), 1U);
}

TEST_F(DocumentAtWork, AFolderThatIsNotThereIsOneLine) {
  document_->open({"no-such-folder"});
  document_->settle();
  EXPECT_THAT(document_->notices().back(), testing::HasSubstr("no-such-folder"));
  EXPECT_NE(document_->survey(), nullptr) << "what was open stays";
}

TEST_F(DocumentAtWork, AFolderWithoutPingsSaysSo) {
  document_->open({TestSurvey::easy().fresh()});
  document_->settle();
  EXPECT_THAT(document_->notices().back(), testing::HasSubstr("no"));
  EXPECT_FALSE(document_->shown());
}

TEST_F(DocumentAtWork, TheFirstPictureDoesNotWaitForTheJournal) {
  grow(bright());
  document_->act(EventCommand{"trawl", document_->shown()->context().times[2], "haul 1"});
  document_->detect({0});
  document_->settle();
  const auto schools = document_->state().schools.size();
  document_.reset();
  document_ = std::make_unique<Document>(queue_, TestSurvey::options(journal_));
  std::vector<DocumentChange> order;
  const Listening heard_of(document_->changes(), [&](DocumentChange change) { order.push_back(change); });
  document_->open({TestSurvey::easy().folder()});
  document_->settle();
  const auto first = [&](DocumentChange change) {
    return std::find(order.begin(), order.end(), change) - order.begin();
  };
  EXPECT_LT(first(DocumentChange::ping), first(DocumentChange::state));
  EXPECT_EQ(document_->state().schools.size(), schools);
  EXPECT_EQ(document_->state().events.size(), 1U);
}

TEST_F(DocumentAtWork, AnActBeforeTheFirstPictureComesAfterTheJournal) {
  document_->act(EventCommand{"trawl", document_->shown()->context().times[2], "haul 1"});
  document_->settle();
  document_.reset();
  document_ = std::make_unique<Document>(queue_, TestSurvey::options(journal_));
  bool acted = false;
  const Listening heard_of(document_->changes(), [&](DocumentChange change) {
    if (change != DocumentChange::observation || acted) return;
    acted = true;
    EXPECT_FALSE(document_->staged());
    document_->act(EventCommand{"station", document_->shown()->context().times[4], ""});
  });
  document_->open({TestSurvey::easy().folder()});
  document_->settle();
  ASSERT_EQ(document_->state().events.size(), 2U);
  EXPECT_EQ(document_->choices().lines->back().n, 2);
}

TEST_F(DocumentAtWork, MemoryThatRunsOutBehindTheWindowIsOneLine) {
  document_->run([](Work&, const CancelToken&) { throw std::bad_alloc(); });
  document_->settle();
  EXPECT_THAT(document_->notices().back(), testing::HasSubstr("not enough memory"));
  EXPECT_EQ(document_->progress().stage, "");
  grow(bright());
  document_->settle();
  EXPECT_EQ(document_->state().schools.size(), 1U);
}

TEST_F(DocumentAtWork, AFullDiskRefusesTheActAndTheWindowGoesOn) {
  const TimeNs time = document_->shown()->context().times[2];
  document_->act(EventCommand{"trawl", time, "haul 1"});
  document_->settle();
  const std::string journal = document_->journal_path().string();
  const auto size = std::filesystem::file_size(journal);
  {
    const FullDisk disk(size + 20);
    document_->act(EventCommand{"station", time, ""});
    document_->undo();
    document_->settle();
    EXPECT_THAT(document_->choices().failure, testing::HasSubstr("could not be written: File too large"));
    EXPECT_EQ(document_->choices().failure.find('\n'), std::string::npos);
  }
  EXPECT_EQ(document_->state().events.size(), 1U) << "what is not in the journal is not shown";
  EXPECT_EQ(std::filesystem::file_size(journal), size);
  document_->act(EventCommand{"station", time, ""});
  document_->settle();
  EXPECT_EQ(document_->state().events.size(), 2U);
  reopen();
  EXPECT_EQ(document_->state().events.size(), 2U);
  EXPECT_TRUE(document_->notices().empty());
}

}  // namespace
}  // namespace sonar
