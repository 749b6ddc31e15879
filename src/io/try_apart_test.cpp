// SPDX-License-Identifier: Apache-2.0
#include "io/try_apart.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <string>

namespace sonar {
namespace {

TEST(TryApart, tells_who_survives) {
  int here = 0;
  EXPECT_TRUE(try_apart([&] { here = 1; }, "x"));
  EXPECT_EQ(here, 0) << "it ran in another process";
  const auto crashed = try_apart([] { ::raise(SIGSEGV); }, "x");
  ASSERT_FALSE(crashed);
  EXPECT_EQ(crashed.error().code, ErrorCode::format);
  // An alarm ends what never ends.
  EXPECT_FALSE(try_apart(
      [] {
        for (;;) ::pause();
      },
      "x", 1));
}

// What a child waits for in vain may be free when the next is made.
TEST(TryApart, a_child_that_hangs_is_made_again) {
  const std::string marker = ::testing::TempDir() + "try_apart_" + std::to_string(::getpid());
  EXPECT_TRUE(try_apart(
      [&] {
        const int fresh = ::open(marker.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0600);
        if (fresh < 0) return;
        for (;;) ::pause();
      },
      "x", 12));
  EXPECT_EQ(::unlink(marker.c_str()), 0);
}

}  // namespace
}  // namespace sonar
