// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/test_paths.h"
#include "io/atomic_file.h"
#include "pipeline/fuzz_bodies.h"

namespace sonar {
namespace {

template <class Body>
void replay(const char* target, const Body& body) {
  namespace fs = std::filesystem;
  const fs::path folder = test::source_tree() / "tests/data/fuzz" / target;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    body(read_file(entry.path()).value());
    ++count;
  }
  EXPECT_GT(count, 0);
}

TEST(FuzzCorpus, Recipe) {
  replay("recipe", [](const std::string& text) { fuzz::recipe(text); });
}

TEST(FuzzCorpus, Journal) {
  replay("journal", [](const std::string& text) { fuzz::journal(text); });
}

TEST(FuzzCorpus, Plan) {
  replay("plan", [](const std::string& text) { fuzz::plan(text); });
}

TEST(FuzzCorpus, TransferFunction) {
  replay("transfer_function", [](const std::string& text) { fuzz::transfer_function(text); });
}

TEST(FuzzCorpus, CalibrationCsv) {
  replay("calibration_csv", [](const std::string& text) { fuzz::calibration_csv(text); });
}

TEST(FuzzCorpus, SoundProfile) {
  replay("sound_profile", [](const std::string& text) { fuzz::sound_profile(text); });
}

}  // namespace
}  // namespace sonar
