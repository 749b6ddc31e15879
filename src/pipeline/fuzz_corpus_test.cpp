// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "base/test_corpus.h"
#include "pipeline/fuzz_bodies.h"

namespace sonar {
namespace {

TEST(FuzzCorpus, Recipe) {
  test::replay("recipe", [](const std::string& text) { fuzz::recipe(text); });
}

TEST(FuzzCorpus, Journal) {
  test::replay("journal", [](const std::string& text) { fuzz::journal(text); });
}

TEST(FuzzCorpus, Plan) {
  test::replay("plan", [](const std::string& text) { fuzz::plan(text); });
}

TEST(FuzzCorpus, TransferFunction) {
  test::replay("transfer_function", [](const std::string& text) { fuzz::transfer_function(text); });
}

TEST(FuzzCorpus, CalibrationCsv) {
  test::replay("calibration_csv", [](const std::string& text) { fuzz::calibration_csv(text); });
}

TEST(FuzzCorpus, SurveyTables) {
  test::replay("survey_tables", [](const std::string& text) { fuzz::survey_tables(text); });
}

TEST(FuzzCorpus, WorkFolder) {
  const test::CorpusFolder folder("work_folder");
  test::replay("work_folder", [&](const std::string& text) { fuzz::work_folder(text, folder.path()); });
}

TEST(FuzzCorpus, MeasuredPings) {
  test::replay("measured_pings", [](const std::string& bytes) { fuzz::measured_pings(bytes); });
}

TEST(FuzzCorpus, SoundProfile) {
  test::replay("sound_profile", [](const std::string& text) { fuzz::sound_profile(text); });
}

}  // namespace
}  // namespace sonar
