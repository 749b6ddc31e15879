// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "session/batch/batch.h"
#include "session/test_survey.h"

namespace sonar {

/// Bytes of each file below a folder, by its place in there.
[[nodiscard]] inline std::map<std::string, std::string> bytes_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    bytes[entry.path().lexically_relative(folder).string()] = {std::istreambuf_iterator<char>(in), {}};
  }
  return bytes;
}

/// A copy of the small simulated survey, so that each of several has a place of its own.
[[nodiscard]] inline std::filesystem::path copied_survey(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& entry : std::filesystem::directory_iterator(TestSurvey::easy().folder())) {
    if (entry.is_regular_file()) std::filesystem::copy_file(entry.path(), folder / entry.path().filename());
  }
  return folder;
}

/// A batch without a window, on copies of the small simulated survey, for tests.
class TestBatch {
 protected:
  [[nodiscard]] std::filesystem::path survey(const std::string& name) const { return copied_survey(root_ / name); }
  [[nodiscard]] std::filesystem::path empty_folder(const std::string& name) const {
    std::filesystem::create_directories(root_ / name);
    return root_ / name;
  }
  void run() {
    const auto started = batch_.start();
    ASSERT_TRUE(started) << to_line(started.error());
    batch_.settle();
    EXPECT_FALSE(batch_.running());
  }
  [[nodiscard]] std::filesystem::path out(std::size_t at) const { return batch_.surveys().at(at).out; }
  [[nodiscard]] BatchState state(std::size_t at) const { return batch_.surveys().at(at).state; }

  std::filesystem::path root_ = TestSurvey::easy().fresh();
  ChangeQueue queue_;
  Document document_{queue_, TestSurvey::options(root_ / "journal")};
  Batch batch_{queue_, document_};
};

}  // namespace sonar
