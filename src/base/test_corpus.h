// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/test_paths.h"

namespace sonar::test {

/// Runs every file of a fuzz target's kept corpus; expects at least one.
/// body  takes a file's bytes, a std::string
template <class Body>
void replay(const char* target, const Body& body) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_tree() / "tests/data/fuzz" / target)) {
    std::ifstream in(entry.path(), std::ios::binary);
    body(std::string(std::istreambuf_iterator<char>(in), {}));
    ++count;
  }
  EXPECT_GT(count, 0);
}

/// A folder for what the bodies write; it goes with the object.
class CorpusFolder {
 public:
  explicit CorpusFolder(const std::string& name) : path_(scratch_path("-" + name)) {
    std::filesystem::create_directories(path_);
  }
  ~CorpusFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  CorpusFolder(const CorpusFolder&) = delete;
  CorpusFolder& operator=(const CorpusFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace sonar::test
