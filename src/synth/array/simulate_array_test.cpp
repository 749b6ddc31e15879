// SPDX-License-Identifier: Apache-2.0
#include "synth/array/simulate_array.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "base/units.h"
#include "io/csv.h"
#include "io/product_file.h"
#include "synth/array/array_truth.h"

namespace sonar::synth::array {
namespace {

/// Relative name -> bytes.
std::map<std::string, std::string> tree(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    files[entry.path().lexically_relative(folder)] = out.str();
  }
  return files;
}

class ArraySimulate : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("array_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static ArrayParams small() {
    ArrayParams p;
    p.observations = 1;
    p.pings = 3;
    p.schools = 2;
    p.fish.most_echoes = 2000;
    return p;
  }
  std::filesystem::path folder_;
};

TEST_F(ArraySimulate, WorkOfAnyNumberOfThreadsGivesTheSameBytes) {
  const ArrayParams params = small();
  Work one(1);
  Work three(3);
  ASSERT_TRUE(simulate_array_survey(folder_ / "1", params, false, "test", one));
  ASSERT_TRUE(simulate_array_survey(folder_ / "3", params, false, "test", three));
  EXPECT_EQ(tree(folder_ / "1"), tree(folder_ / "3"));
}

TEST_F(ArraySimulate, TheTruthOfFishAndBodiesAgreesAndPsiIsToldTwice) {
  Work work(2);
  ArrayParams params = small();
  params.elements.psi_law = PsiLaw::cos4;
  params.elements.psi_excess_db = 6.0;
  ASSERT_TRUE(simulate_array_survey(folder_, params, false, "test", work));
  const auto fish = read_csv_rows<FishTruth>(folder_ / "truth" / "fish.csv");
  const auto bodies = read_csv_rows<BodyTruth>(folder_ / "truth" / "bodies.csv");
  const auto beams = read_csv_rows<BeamTruth>(folder_ / "truth" / "beams.csv");
  ASSERT_TRUE(fish && bodies && beams);
  ASSERT_EQ(fish->size(), bodies->size());
  ASSERT_FALSE(fish->empty());
  for (std::size_t i = 0; i < fish->size(); ++i) {
    EXPECT_EQ((*fish)[i].sigma_bs_m2, (*bodies)[i].backscatter_m2);
    EXPECT_NEAR(db_from_linear((*fish)[i].sigma_bs_m2 / static_cast<double>((*fish)[i].fish)), (*fish)[i].ts_mean_db,
                1e-3);
  }
  ASSERT_EQ(beams->size(), 500U);
  EXPECT_NEAR(beams->front().psi_stated_db - beams->front().psi_true_db, 6.0, 1e-9);  // at -45 degrees
  EXPECT_NEAR(beams->back().psi_stated_db - beams->back().psi_true_db, 0.0, 1e-9);    // at 0
}

TEST_F(ArraySimulate, AnotherSeedIsAnotherSurvey) {
  Work work(2);
  ArrayParams params = small();
  params.pings = 1;
  std::set<std::string> waters;
  std::set<std::string> schools;
  for (const int seed : {1, 2, 3}) {
    params.seed = seed;
    const auto out = folder_ / std::to_string(seed);
    ASSERT_TRUE(simulate_array_survey(out, params, false, "test", work));
    const auto files = tree(out / "truth");
    waters.insert(files.at("water.csv"));
    schools.insert(files.at("fish.csv"));
  }
  EXPECT_EQ(waters.size(), 3U);
  EXPECT_EQ(schools.size(), 3U);
}

TEST_F(ArraySimulate, RangesThatAreUpsideDownAreRefusedByName) {
  Work work(1);
  ArrayParams params = small();
  params.fish.per_m3_min = 9.0;
  const auto made = simulate_array_survey(folder_, params, false, "test", work);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::bad_parameter);
  EXPECT_NE(made.error().text.find("fish.per_m3_min"), std::string::npos);
}

}  // namespace
}  // namespace sonar::synth::array
