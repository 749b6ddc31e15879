// SPDX-License-Identifier: Apache-2.0
#include "io/try_apart.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

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

}  // namespace
}  // namespace sonar
