// SPDX-License-Identifier: Apache-2.0
#include "synth/simulate.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "io/csv.h"
#include "io/product_file.h"
#include "synth/truth.h"

namespace sonar::synth {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Relative name -> bytes.
std::map<std::string, std::string> tree(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[entry.path().lexically_relative(folder)] = bytes_of(entry.path());
  }
  return files;
}

class Simulate : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("simulate_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static SurveyParams small() {
    SurveyParams p = survey_params(Preset::standard);
    p.observations = 2;
    p.pings = 4;
    p.schools = 1;
    p.file_mb = 4.0;
    p.noise.dropouts = 0.5;
    return p;
  }
  std::filesystem::path folder_;
};

TEST_F(Simulate, EveryByteOfAFileIsADatagram) {
  Work work(2);
  SurveyParams params = small();
  const auto made = simulate_survey(folder_, params, ms70_beams(), false, "test", work);
  ASSERT_TRUE(made) << made.error().text;
  EXPECT_EQ(made->pings, 8);
  EXPECT_EQ(made->files.size(), 4U);  // two pings of 1.37 MB in 4 MB
  std::set<std::uint64_t> ping_times;
  for (const auto& file : made->files) {
    const std::string bytes = bytes_of(file);
    EXPECT_NE(file.filename().string().find("SYNTHETIC-D"), std::string::npos);
    EXPECT_NE(bytes.find("SYNTHETIC"), std::string::npos);
    std::size_t at = 0;
    std::map<std::string, int> types;
    std::uint64_t last_time = 0;
    while (at < bytes.size()) {
      std::int32_t length = 0;
      std::int32_t again = 0;
      std::uint64_t time = 0;
      ASSERT_LE(at + 16, bytes.size());
      std::memcpy(&length, bytes.data() + at, 4);
      ASSERT_GE(length, 12);
      ASSERT_LE(at + 8 + static_cast<std::size_t>(length), bytes.size());
      std::memcpy(&again, bytes.data() + at + 4 + length, 4);
      ASSERT_EQ(length, again);
      std::memcpy(&time, bytes.data() + at + 8, 8);
      EXPECT_GE(time, last_time);
      last_time = time;
      const std::string type = bytes.substr(at + 4, 4);
      ++types[type];
      if (type == "RAW0") {
        ping_times.insert(time);
        std::int32_t count = 0;
        std::memcpy(&count, bytes.data() + at + 16 + 68, 4);
        EXPECT_EQ(length, 12 + 72 + 2 * count);
      }
      at += 8 + static_cast<std::size_t>(length);
    }
    EXPECT_EQ(at, bytes.size());
    EXPECT_EQ(types["CON0"], 1);
    EXPECT_EQ(types["CON1"], 1);
    EXPECT_GT(types["NME0"], 5);
  }
  EXPECT_EQ(ping_times.size(), 8U);
}

TEST_F(Simulate, TheSameSeedGivesTheSameBytesForAnyNumberOfThreads) {
  Work one(1);
  Work two(2);
  ASSERT_TRUE(simulate_survey(folder_ / "a", small(), ms70_beams(), false, "test", one));
  ASSERT_TRUE(simulate_survey(folder_ / "b", small(), ms70_beams(), false, "test", two));
  const auto a = tree(folder_ / "a");
  EXPECT_TRUE(a == tree(folder_ / "b"));
  SurveyParams other = small();
  other.seed = 2;
  ASSERT_TRUE(simulate_survey(folder_ / "c", other, ms70_beams(), false, "test", two));
  EXPECT_FALSE(a == tree(folder_ / "c"));
}

TEST_F(Simulate, EveryFileSaysThatItIsSynthetic) {
  Work work(1);
  ASSERT_TRUE(simulate_survey(folder_, small(), ms70_beams(), false, "test", work));
  const auto files = tree(folder_);
  for (const char* name : {"schools.csv", "school_pings.csv", "bodies.csv", "obs-0001.nc", "depth.tif"}) {
    EXPECT_EQ(files.count(std::string("truth/") + name), 1U) << name;
  }
  for (const auto& [name, bytes] : files) EXPECT_NE(bytes.find("SYNTHETIC"), std::string::npos) << name;
}

TEST_F(Simulate, TablesWithoutASchoolSaySoToo) {
  Work work(1);
  SurveyParams params = small();
  params.observations = 1;
  params.pings = 1;
  params.schools = 0;
  ASSERT_TRUE(simulate_survey(folder_, params, ms70_beams(), false, "test", work));
  for (const auto& [name, bytes] : tree(folder_)) EXPECT_NE(bytes.find("SYNTHETIC"), std::string::npos) << name;
}

TEST_F(Simulate, ASurveyThatIsForcedReplacesTheOneBefore) {
  Work work(1);
  SurveyParams params = small();
  params.pings = 1;
  params.observations = 2;
  ASSERT_TRUE(simulate_survey(folder_ / "a", params, ms70_beams(), false, "test", work));
  std::ofstream(folder_ / "a" / "L0001-D20200101-T000000.raw") << "nobody's simulation";
  params.observations = 1;
  params.seed = 5;
  ASSERT_TRUE(simulate_survey(folder_ / "a", params, ms70_beams(), true, "test", work));
  ASSERT_TRUE(simulate_survey(folder_ / "b", params, ms70_beams(), false, "test", work));
  auto forced = tree(folder_ / "a");
  EXPECT_EQ(forced.erase("L0001-D20200101-T000000.raw"), 1U);
  EXPECT_TRUE(forced == tree(folder_ / "b"));
}

TEST_F(Simulate, RefusesAFolderWithRawFiles) {
  Work work(1);
  SurveyParams params = small();
  params.observations = 1;
  params.pings = 1;
  ASSERT_TRUE(simulate_survey(folder_, params, ms70_beams(), false, "test", work));
  const auto again = simulate_survey(folder_, params, ms70_beams(), false, "test", work);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::usage);
  EXPECT_TRUE(simulate_survey(folder_, params, ms70_beams(), true, "test", work));
  params.pings = 0;
  const auto no_pings = simulate_survey(folder_, params, ms70_beams(), true, "test", work);
  ASSERT_FALSE(no_pings);
  EXPECT_EQ(no_pings.error().code, ErrorCode::bad_parameter);
}

TEST_F(Simulate, RefusesTheFolderOfASurveysResults) {
  Work work(1);
  SurveyParams params = small();
  params.observations = 1;
  params.pings = 1;
  for (const bool force : {false, true}) {
    for (const char* folder : {"planned/plan.json", "run/products"}) {
      const std::filesystem::path results = folder_ / folder;
      std::filesystem::create_directories(results);
      const auto refused = simulate_survey(results.parent_path(), params, ms70_beams(), force, "test", work);
      ASSERT_FALSE(refused) << folder;
      EXPECT_EQ(refused.error().code, ErrorCode::usage);
      EXPECT_NE(refused.error().text.find("holds a survey's results"), std::string::npos) << refused.error().text;
      EXPECT_EQ(tree(results.parent_path()).size(), 0U);
    }
  }
}

TEST_F(Simulate, NamesTheRangeThatIsUpsideDown) {
  Work work(1);
  SurveyParams params = small();
  params.own_speed_max_mps = 0.1;
  params.own_speed_min_mps = 0.2;
  const auto refused = simulate_survey(folder_, params, ms70_beams(), false, "test", work);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().text, "own_speed_min_mps = 0.2 is more than own_speed_max_mps = 0.1");
}

TEST_F(Simulate, TheTruthsTablesAndMasksAgree) {
  Work work(2);
  SurveyParams params = survey_params(Preset::easy);
  params.pings = 12;
  params.schools = 3;
  // Beams of short range would do as well, but the masks need the grid.
  ASSERT_TRUE(simulate_survey(folder_, params, ms70_beams(), false, "test", work));
  const auto product = read_product(folder_ / "truth" / "obs-0001.nc");
  ASSERT_TRUE(product) << product.error().text;
  const auto rows = read_csv_rows<SchoolPingRow>(folder_ / "truth" / "school_pings.csv");
  ASSERT_TRUE(rows) << rows.error().text;
  const auto bodies = read_csv_rows<BodyTruth>(folder_ / "truth" / "bodies.csv");
  ASSERT_TRUE(bodies) << bodies.error().text;
  ASSERT_FALSE(rows->empty());
  ASSERT_EQ(product->masks.size(), rows->size());
  EXPECT_EQ(product->pings.size(), 12U);
  EXPECT_EQ(bodies->size() % 12, 0U);
  for (std::size_t i = 0; i < rows->size(); ++i) {
    EXPECT_EQ(product->masks[i].school_id, (*rows)[i].school_id);
    EXPECT_EQ(product->masks[i].ping_index, (*rows)[i].ping_index);
    EXPECT_EQ(static_cast<std::int64_t>(product->masks[i].mask.voxels()), (*rows)[i].n_voxels);
  }
}

TEST(SurveyScenes, SeparateSchoolsStayApart) {
  SurveyParams params = survey_params(Preset::standard);
  params.observations = 2;
  const auto scenes = survey_scenes(params, ms70_beams());
  ASSERT_TRUE(scenes);
  for (const Scene& scene : *scenes) {
    EXPECT_EQ(scene.bodies.size(), 5U);
    for (int ping = 0; ping < scene.pings; ++ping) {
      const double t = scene.seconds_of(ping);
      const Point<Enu> ship = ship_at(scene, t);
      for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const Point<Enu> a = scene.bodies[i].centre_at(t);
        EXPECT_LT(a.z, -7.0);
        for (std::size_t j = 0; j < i; ++j) {
          const Point<Enu> b = scene.bodies[j].centre_at(t);
          if (norm(a - ship) > 600.0) continue;
          EXPECT_GT(norm(a - b), std::max(scene.bodies[i].shape.length_m, scene.bodies[j].shape.length_m));
        }
      }
    }
  }
}

TEST(SurveyScenes, TheDemoPassesOneSchoolAtTwoRanges) {
  const auto scenes = survey_scenes(survey_params(Preset::demo), ms70_beams());
  ASSERT_TRUE(scenes);
  ASSERT_EQ(scenes->size(), 3U);
  EXPECT_EQ((*scenes)[0].bodies.size(), 12U);
  EXPECT_TRUE((*scenes)[1].bodies.empty());
  const auto closest = [](const Scene& scene) {
    double least = 1e9;
    for (double t = 0.0; t < scene.seconds_of(scene.pings); t += 0.5) {
      Point<Enu> p = scene.bodies[0].centre_at(t) - ship_at(scene, t);
      p.z += scene.ship.transducer_depth_m;
      least = std::min(least, norm(p));
    }
    return least;
  };
  EXPECT_NEAR(closest((*scenes)[0]), 100.0, 2.0);
  EXPECT_NEAR(closest((*scenes)[2]), 300.0, 2.0);
  EXPECT_EQ((*scenes)[0].corrupted_packets.size(), 1U);
  EXPECT_EQ((*scenes)[0].interference.size(), 1U);
}

}  // namespace
}  // namespace sonar::synth
