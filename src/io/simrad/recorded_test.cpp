// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "io/ping_source.h"
#include "io/raw_index.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// First counts of the first channel in the first ping, and the last two in the last ping of the file where given
/// (data/README.md).
TEST(RecordedFiles, FirstSamples) {
  const fs::path folder = test::data_folder() / "raw";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "no recorded data beside the source";
  const auto first_counts = [&](const char* file) {
    const auto source = open_file(folder / file);
    const auto index = index_raw(**source);
    const auto ping = read_ping(**source, index->pings.at(0));
    const auto counts = ping->channels.at(0).power_count;
    return std::vector<int>{counts[0], counts[1], counts[2]};
  };
  EXPECT_EQ(first_counts("Summer2017-D20170615-T214712.raw"), (std::vector<int>{1341, 2240, 2233}));
  EXPECT_EQ(first_counts("RedSlip-D20160915-T120914.raw"), (std::vector<int>{-63, 1580, 1780}));
  EXPECT_EQ(first_counts("D20070724-T042400.raw"), (std::vector<int>{1320, 2252, 2259}));
}

TEST(RecordedFiles, FirstPingLiesWhereTheSoundersOwnIndexSays) {
  const fs::path folder = test::data_folder() / "raw";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "no recorded data beside the source";
  const auto source = open_file(folder / "D20070724-T042400.raw");
  const auto index = index_raw(**source);
  ASSERT_TRUE(index);
  EXPECT_EQ(index->pings.front().offset, 1868U);
  EXPECT_EQ(index->pings.back().offset, 1'481'668U);
}

}  // namespace
}  // namespace sonar
