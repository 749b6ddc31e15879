// SPDX-License-Identifier: Apache-2.0
#include "synth/beam_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "model/beam_grid.h"

namespace sonar::synth {
namespace {

TEST(BeamTable, IsTheRecordedOne) {
  const auto beams = ms70_beams();
  ASSERT_EQ(beams.size(), 500U);
  // Widths of the recorded table, three decimals: fan 0 beams 0 and 12, fan 10 beam 24, fan 19 beam 12.
  EXPECT_NEAR(beams[0].vertical_width_deg, 6.994, 6e-4);
  EXPECT_NEAR(beams[0].horizontal_width_deg, 3.128, 6e-4);
  EXPECT_NEAR(beams[12].horizontal_width_deg, 2.709, 6e-4);
  EXPECT_NEAR(beams[10 * 25 + 24].horizontal_width_deg, 3.753, 6e-4);
  EXPECT_NEAR(beams[19 * 25 + 12].vertical_width_deg, 7.235, 6e-4);
  EXPECT_DOUBLE_EQ(beams[19 * 25].frequency_hz, 75925.0);
  EXPECT_DOUBLE_EQ(beams[12].gain_db, 15.69);
  EXPECT_DOUBLE_EQ(beams[24].gain_db, 14.28);
  EXPECT_NEAR(beams[6].gain_db, (14.50 + 15.69) / 2, 1e-12);
  EXPECT_EQ(beams[15 * 25].count, 1324);
  EXPECT_EQ(beams[16 * 25].count, 1320);
  EXPECT_DOUBLE_EQ(beams[24].azimuth_deg, 30.0);
  const auto grid = derive_beam_grid(sounder_config(beams, "SYNTHETIC"), 270.0);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->fans(), 20);
  EXPECT_EQ(grid->beams(), 25);
}

class BeamTableFile : public testing::Test {
 protected:
  Result<std::vector<Beam>> read(const std::string& text) {
    const auto path = std::filesystem::path(testing::TempDir()) / "beam_table.csv";
    std::ofstream(path) << text;
    auto beams = read_beam_table(path);
    std::filesystem::remove(path);
    return beams;
  }
  static constexpr const char* kHeader =
      "channel,elevation_deg,azimuth_deg,frequency_hz,vertical_width_deg,horizontal_width_deg,gain_db,psi_db,"
      "sa_correction_db,power_w,absorption_db_per_m,count\n";
};

TEST_F(BeamTableFile, ReadsAUsersOwn) {
  const auto beams = read(std::string(kHeader) + "1,-10,5,80000,6,3,20,-21,-1,40,0.03,900\r\n" +
                          "0,-20,5,90000,6,3,21,-22,-1.5,35,0.031,1000\n");
  ASSERT_TRUE(beams) << beams.error().text;
  ASSERT_EQ(beams->size(), 2U);
  EXPECT_EQ((*beams)[0].elevation_deg, -20.0);
  EXPECT_EQ((*beams)[1].count, 900);
}

TEST_F(BeamTableFile, RefusesWhatMakesNoSense) {
  const std::string header = kHeader;
  EXPECT_FALSE(read(""));
  EXPECT_FALSE(read(header));
  EXPECT_THAT(read("channel,count\n0,3\n").error().text,
              testing::HasSubstr("line 1: expected the columns channel,count,elevation_deg"));
  EXPECT_FALSE(read(header + "1,-10,5,80000,6,3,20,-21,-1,40,0.03,900\n"));    // no channel 0
  EXPECT_FALSE(read(header + "0,-10,5,80000,6,3,20,-21,-1,40,0.03\n"));        // a field is missing
  EXPECT_FALSE(read(header + "0,-10,5,nan,6,3,20,-21,-1,40,0.03,900\n"));      // no frequency
  EXPECT_FALSE(read(header + "0,-10,5,80000,6,3,20,-21,-1,40,0.03,1e12\n"));   // too many samples
  EXPECT_FALSE(read(header + "0.5,-10,5,80000,6,3,20,-21,-1,40,0.03,900\n"));  // no channel
  EXPECT_FALSE(read(header + "0,-10,5,80000,6,3,20,-21,-1,40,0.03,900.5\n"));  // no number of samples
  EXPECT_FALSE(read_beam_table("does/not/exist.csv"));
}

}  // namespace
}  // namespace sonar::synth
