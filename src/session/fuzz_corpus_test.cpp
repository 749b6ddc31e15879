// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/test_paths.h"
#include "session/fuzz_bodies.h"

namespace sonar {
namespace {

TEST(FuzzCorpus, Preferences) {
  namespace fs = std::filesystem;
  const fs::path folder = test::scratch_path("-preferences");
  fs::create_directories(folder);
  int count = 0;
  for (const auto& entry : fs::directory_iterator(test::source_tree() / "tests/data/fuzz/preferences")) {
    std::ifstream in(entry.path(), std::ios::binary);
    fuzz::preferences(std::string(std::istreambuf_iterator<char>(in), {}), folder);
    ++count;
  }
  EXPECT_GT(count, 0);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sonar
