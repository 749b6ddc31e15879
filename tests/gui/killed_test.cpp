// SPDX-License-Identifier: Apache-2.0
// The program is killed at work; the next start must miss nothing.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <string>

#include "window_at_work.h"

namespace sonar {
namespace {

constexpr const char* kJournal = "SONAR_KILLED_JOURNAL";
constexpr const char* kPipe = "SONAR_KILLED_PIPE";  ///< where the child tells of each act that it has seen done

constexpr int kMostActs = 200;

class Killed : public WindowAtWork {
 protected:
  void SetUp() override {
    if (const char* given = std::getenv(kJournal)) journal_ = given;
    open();
  }
  /// Tells the parent.
  static void tell() {
    const char* pipe = std::getenv(kPipe);
    const char one = '.';
    ASSERT_NE(pipe, nullptr);
    ASSERT_EQ(::write(std::atoi(pipe), &one, 1), 1);
  }
  /// Runs a disabled test of this program and kills it as soon as it has told of so many acts.
  void kill_after(const char* test, int acts) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const auto self = std::filesystem::read_symlink("/proc/self/exe");
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::close(ends[0]);
      ::setenv(kJournal, journal_.c_str(), 1);
      ::setenv("TMPDIR", survey_.parent_path().c_str(), 1);  // what the child leaves goes with the parent's
      ::setenv(kPipe, std::to_string(ends[1]).c_str(), 1);
      ::execl(self.c_str(), self.c_str(), (std::string("--gtest_filter=Killed.DISABLED_") + test).c_str(),
              "--gtest_also_run_disabled_tests", "--gtest_brief=1", nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    char one = 0;
    for (int told = 0; told < acts; ++told) ASSERT_EQ(::read(ends[0], &one, 1), 1) << "the child ended by itself";
    ::kill(child, SIGKILL);
    ::close(ends[0]);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended by itself: " << WEXITSTATUS(status);
    close();
    open();
  }
};

/// Marks ping after ping, each as soon as the one before is shown.
TEST_F(Killed, DISABLED_MarksWithoutEnd) {
  for (int i = 0; i < kMostActs; ++i) {
    const auto ping = static_cast<std::size_t>(i % TestSurvey::kPings);
    document().act(EventCommand{"other", document().shown()->context().times[ping], fmt::format("mark {}", i)});
    settle_jobs();
    tell();
  }
}

TEST_F(Killed, AmidItsActsKeepsAllThatWereShownAndNothingTorn) {
  std::size_t kept = 0;
  for (const int acts : {1, 4, 23}) {
    kill_after("MarksWithoutEnd", acts);
    ASSERT_FALSE(HasFatalFailure());
    const std::size_t now = document().state().events.size();
    EXPECT_GE(now, kept + static_cast<std::size_t>(acts));
    EXPECT_LT(now, kept + static_cast<std::size_t>(kMostActs));
    kept = now;
  }
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(document().state().events.size(), kept - 1) << "the journal is carried on";
}

/// A propagation in which nothing is shown to the end.
TEST_F(Killed, DISABLED_Propagates) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  tell();
  const Listening heard_of(document().changes(), [this](DocumentChange change) {
    if (change == DocumentChange::propagating && document().propagating().size() == 2) tell();
  });
  key(Qt::Key_P, Qt::ControlModifier);
}

TEST_F(Killed, AmidAPropagationKeepsWhatWasDoneBeforeIt) {
  kill_after("Propagates", 2);
  ASSERT_FALSE(HasFatalFailure());
  ASSERT_EQ(document().state().schools.size(), 1U);
  // The propagation is there to its end, or not at all.
  const auto lines = document().choices().lines->size();
  EXPECT_TRUE(lines == 2 ? masks().size() > 1 : masks().size() == 1)
      << lines << " lines, " << masks().size() << " masks";
  document().look_at(masks()[0].ping_index);
  settle();
  workspace().school.set(SchoolName{0, 1});
  key(Qt::Key_P, Qt::ControlModifier);
  EXPECT_GT(masks().size(), 1U);
}

/// A search of which nothing is shown to the end.
TEST_F(Killed, DISABLED_Detects) {
  const Listening heard_of(document().changes(), [this, told = false](DocumentChange change) mutable {
    const bool searching = change == DocumentChange::progress && document().progress().stage == "detecting";
    if (told || (!searching && change != DocumentChange::state)) return;
    told = true;
    tell();
  });
  QTest::keyClick(window_->windowHandle(), Qt::Key_D);
  while (true) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

TEST_F(Killed, AmidASearchFindsTheSameSchoolsWhenAskedAgain) {
  document().act(EventCommand{"trawl", document().shown()->context().times[2], "before"});
  settle();
  close();
  kill_after("Detects", 1);
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_EQ(document().state().events.size(), 1U) << "what was done before is there";
  // The search is in the journal and its schools are there, or neither is.
  const std::size_t lines = document().choices().lines->size();
  EXPECT_EQ(document().state().schools.size(), lines == 2 ? 2U : 0U) << lines << " lines";
  key(Qt::Key_D);
  EXPECT_EQ(document().state().schools.size(), 2U);
  EXPECT_EQ(document().choices().lines->size(), 2U) << "asked for once, however often it was begun";
}

/// Accepts and rejects one school again and again, each as soon as the one before is shown.
TEST_F(Killed, DISABLED_DecidesWithoutEnd) {
  if (document().state().schools.empty()) key(Qt::Key_D);
  for (int i = 0; i < kMostActs; ++i) {
    Decision decision;
    decision.school = key_of(document().state().schools.at(0)->masks, document().shown()->context());
    decision.status = i % 2 == 0 ? "accepted" : "rejected";
    document().act(DecideCommand{{decision}, {}});
    settle_jobs();
    tell();
  }
  while (true) ::pause();
}

TEST_F(Killed, AmidDecisionsKeepsAllThatWereShownAndTheLastOneHolds) {
  std::size_t kept = 1;  // the search
  for (const int acts : {1, 6}) {
    close();
    kill_after("DecidesWithoutEnd", acts);
    ASSERT_FALSE(HasFatalFailure());
    const auto& lines = *document().choices().lines;
    EXPECT_GE(lines.size(), kept + static_cast<std::size_t>(acts));
    kept = lines.size();
    ASSERT_EQ(document().state().schools.size(), 2U);
    const auto last = act_of(lines.back());
    ASSERT_TRUE(last);
    EXPECT_EQ(document().state().schools[0]->masks.decided.status,
              std::get<DecideCommand>(last->command).decisions.front().status);
  }
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(document().choices().lines->size(), kept + 1) << "the journal is carried on";
}

/// Runs in a process of its own: works until the first choice is shown, and dies without a farewell.
TEST_F(Killed, DISABLED_WorksAndDies) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  ASSERT_EQ(document().state().schools.size(), 1U);
  ::raise(SIGKILL);
}

TEST_F(Killed, LosesNothing) {
  const auto self = std::filesystem::read_symlink("/proc/self/exe");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::setenv(kJournal, journal_.c_str(), 1);
    ::execl(self.c_str(), self.c_str(), "--gtest_filter=Killed.DISABLED_WorksAndDies",
            "--gtest_also_run_disabled_tests", "--gtest_brief=1", nullptr);
    ::_exit(127);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended by itself: " << WEXITSTATUS(status);
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
  close();
  open();
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(document().choices().undo_text, "Undo grow school 1");
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(document().state().schools.empty());
}

}  // namespace
}  // namespace sonar
