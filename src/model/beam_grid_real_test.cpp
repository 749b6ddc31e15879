// SPDX-License-Identifier: Apache-2.0
// The beam table of a real MS70, in TSD ("time step data"): "%TSD", float number of variables, int steps, int 1, the
// variables' lengths, four-letter names, four-letter types, then the values of one step. Little-endian.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "base/test_paths.h"
#include "model/beam_grid.h"

namespace sonar {
namespace {

std::filesystem::path beam_table() { return test::recorded_data() / "beams/S2009116_D20091113_E0001_MS70.beams"; }

template <class T>
T value_at(const std::string& bytes, std::size_t offset) {
  T value{};
  if (offset + sizeof(T) <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

/// Float variables of the table by name.
std::map<std::string, std::vector<double>> read_tsd(const std::string& bytes) {
  const std::map<std::string, std::size_t> sizes{{"char", 1}, {"byte", 1}, {"shrt", 2},
                                                 {"long", 4}, {"floa", 4}, {"doub", 8}};
  std::map<std::string, std::vector<double>> table;
  const auto count = static_cast<std::size_t>(value_at<float>(bytes, 4));
  std::size_t offset = 16 + 12 * count;
  for (std::size_t i = 0; i < count; ++i) {
    const auto length = static_cast<std::size_t>(value_at<std::int32_t>(bytes, 16 + 4 * i));
    const std::string name = bytes.substr(16 + 4 * count + 4 * i, 4);
    const std::string type = bytes.substr(16 + 8 * count + 4 * i, 4);
    if (type == "floa") {
      for (std::size_t k = 0; k < length; ++k) table[name].push_back(value_at<float>(bytes, offset + 4 * k));
    }
    offset += length * sizes.at(type);
  }
  return table;
}

TEST(BeamGridRealData, DirectionsWithinAHundredthOfADegree) {
  std::ifstream file(beam_table(), std::ios::binary);
  if (!file) GTEST_SKIP() << "no real data at " << beam_table();
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  ASSERT_EQ(bytes.substr(0, 4), "%TSD");
  auto table = read_tsd(bytes);
  ASSERT_EQ(table["dirx"].size(), 500U);
  ASSERT_EQ(table["diry"].size(), 500U);

  SounderConfig config;
  config.kind = SounderKind::ms70;
  config.sounder_name = "MBS";
  for (std::size_t i = 0; i < 500; ++i) {
    BeamConfig beam;
    beam.direction_deg = {table["dirx"][i], table["diry"][i], 0.0};
    beam.frequency_hz = table["freq"].at(i);
    config.beams.push_back(beam);
  }
  const Result<BeamGrid> grid = derive_beam_grid(config, 270.0);
  ASSERT_TRUE(grid) << grid.error().text;
  ASSERT_EQ(grid->fans(), 20);
  ASSERT_EQ(grid->beams(), 25);
  double worst_deg = 0.0;
  for (std::size_t channel = 0; channel < 500; ++channel) {
    const std::size_t fan = channel / 25;
    const std::size_t beam = channel % 25;
    EXPECT_EQ(grid->channel[channel], static_cast<int>(channel));
    worst_deg = std::max(worst_deg, std::abs(grid->elevation_deg[fan] - table["dirx"][channel]));
    worst_deg = std::max(worst_deg, std::abs(grid->azimuth_deg[beam] - 270.0 - table["diry"][channel]));
    // The table also holds the directions as another program worked them out: azimuth counter-clockwise from
    // starboard, polar angle from the zenith.
    const double azimuth_deg = 90.0 - table["dira"].at(channel) * 180.0 / 3.14159265358979;
    const double elevation_deg = 90.0 - table["dire"].at(channel) * 180.0 / 3.14159265358979;
    worst_deg = std::max(worst_deg, std::abs(wrap_180(grid->azimuth_deg[beam] - azimuth_deg)));
    worst_deg = std::max(worst_deg, std::abs(grid->elevation_deg[fan] - elevation_deg));
  }
  EXPECT_LT(worst_deg, 0.01);
  RecordProperty("worst_deg", std::to_string(worst_deg));
}

}  // namespace
}  // namespace sonar
