// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/raw_format.h"

#include <gtest/gtest.h>

#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using test::Bytes;
using test::kStart;

std::int64_t channels_of(const Bytes& bytes) {
  const auto channels = simrad::ek80_channels(MemorySource("memory", bytes.data));
  EXPECT_TRUE(channels);
  return channels.value_or(-1);
}

TEST(Ek80Channels, AreCountedByTheirNames) {
  Bytes file = test::datagram("XML0", kStart, Bytes().text("<Configuration/>", 16));
  EXPECT_EQ(channels_of(file), 0);
  for (const char* name : {"WBT 1 ES38", "WBT 2 ES120", "WBT 1 ES38"}) {
    file.add(test::datagram("RAW3", kStart, Bytes().text(name, 128).zeros(12)));
  }
  EXPECT_EQ(channels_of(file), 2);
  // too short to hold a name
  file.add(test::datagram("RAW3", kStart, Bytes().zeros(20)));
  EXPECT_EQ(channels_of(file), 2);
}

}  // namespace
}  // namespace sonar
