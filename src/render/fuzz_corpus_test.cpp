// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/test_paths.h"
#include "render/fuzz_bodies.h"

namespace sonar {
namespace {

TEST(FuzzCorpus, Png) {
  namespace fs = std::filesystem;
  const fs::path folder = test::scratch_path("-png");
  fs::create_directories(folder);
  int count = 0;
  for (const auto& entry : fs::directory_iterator(test::source_tree() / "tests/data/fuzz/png")) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    fuzz::png(std::as_bytes(std::span(bytes)), folder);
    ++count;
  }
  EXPECT_GT(count, 0);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sonar
