// SPDX-License-Identifier: Apache-2.0
// The program is killed at work; the next start must miss nothing.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "window_at_work.h"

namespace sonar {
namespace {

constexpr const char* kJournal = "SONAR_KILLED_JOURNAL";

class Killed : public WindowAtWork {
 protected:
  void SetUp() override {
    if (const char* given = std::getenv(kJournal)) journal_ = given;
    open();
  }
};

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
