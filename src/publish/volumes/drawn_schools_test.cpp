// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/drawn_schools.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace sonar {
namespace {

DrawnPing ping_of(const char* status) {
  DrawnPing ping;
  ping.masks = {{1, std::make_shared<const PingMask>(PingMask{{{3, 10, 1}}, {255}}), status}};
  return ping;
}

TEST(CastingShadow, WhatAHumanRejectedTakesNoSound) {
  PictureOptions options;
  options.display.masks = true;
  options.display.rejected = true;
  for (const char* status : {"unreviewed", "accepted", "corrected"}) {
    const DrawnPing ping = ping_of(status);
    EXPECT_EQ(casting_shadow(ping, options), std::vector<const PingMask*>{ping.masks[0].mask.get()}) << status;
  }
  const DrawnPing rejected = ping_of("rejected");
  EXPECT_EQ(chosen_layers(rejected, options).size(), 1U) << "it is drawn";
  EXPECT_TRUE(casting_shadow(rejected, options).empty());
}

// A shadow without what casts it would be a riddle.
TEST(CastingShadow, IsOfSchoolsThatAreShown) {
  PictureOptions options;
  options.display.masks = true;
  options.schools = {2};
  EXPECT_TRUE(casting_shadow(ping_of("accepted"), options).empty()) << "another school";
  options.schools = {1};
  EXPECT_EQ(casting_shadow(ping_of("accepted"), options).size(), 1U);
  options.display.masks = false;
  EXPECT_TRUE(casting_shadow(ping_of("accepted"), options).empty());
}

}  // namespace
}  // namespace sonar
