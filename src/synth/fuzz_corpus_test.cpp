// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "base/test_paths.h"
#include "io/atomic_file.h"
#include "synth/fuzz_bodies.h"

namespace sonar {
namespace {

TEST(FuzzCorpus, BeamTable) {
  namespace fs = std::filesystem;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(test::source_tree() / "tests/data/fuzz/beam_table")) {
    fuzz::beam_table(read_file(entry.path()).value());
    ++count;
  }
  EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace sonar
