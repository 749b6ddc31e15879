// SPDX-License-Identifier: Apache-2.0
#include "session/recipes/parameters.h"

#include <gtest/gtest.h>

#include <array>

#include "session/listening.h"

namespace sonar {
namespace {

enum class Mode { slow, fast };
constexpr std::array<std::string_view, 2> kModes{"slow", "fast"};

struct Inner {
  double gate_m = 15.0;
};
template <class V>
void describe(V& v, Inner& p) {
  v.field("gate_m", p.gate_m, {.unit = "m", .min = 0, .max = 100, .text = "how near"});
}
struct Outer {
  Mode mode = Mode::slow;
  double tolerance_db = 10.0;
  bool live = true;
  Inner inner;
};
template <class V>
void describe(V& v, Outer& p) {
  v.choice("mode", p.mode, kModes, "how fast");
  v.field("tolerance_db", p.tolerance_db, {.unit = "dB", .min = 3, .max = 25, .text = "how deep"});
  v.field("live", p.live, {.text = "at once"});
  v.group("inner", p.inner, "the rest");
}

TEST(Parameters, EveryPropertyHasUnitRangeDefaultAndTooltip) {
  ChangeQueue queue;
  const Parameters<Outer> parameters(queue);
  const auto& list = parameters.properties();
  ASSERT_EQ(list.size(), 4U);
  EXPECT_EQ(list[0].choices, (std::vector<std::string>{"slow", "fast"}));
  EXPECT_EQ(list[1].label, "Tolerance");
  EXPECT_EQ(list[1].unit, "dB");
  EXPECT_EQ(list[1].min, 3.0);
  EXPECT_EQ(list[1].initial, PropertyValue(10.0));
  EXPECT_EQ(list[3].name, "inner.gate_m");
  for (const Property& property : list) EXPECT_FALSE(property.tooltip.empty());
}

TEST(Parameters, ListenersHearOnceATurn) {
  ChangeQueue queue;
  Parameters<Outer> parameters(queue);
  std::vector<double> heard;
  const Listening heard_of(parameters.changed(), [&](const Outer& now) { heard.push_back(now.tolerance_db); });
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(parameters.set("tolerance_db", 4.0 + i));
  ASSERT_TRUE(parameters.set("mode", Choice{1}));
  queue.drain();
  EXPECT_EQ(heard, std::vector<double>{13.0});
  EXPECT_EQ(parameters.values().mode, Mode::fast);
  ASSERT_TRUE(parameters.reset("tolerance_db"));
  EXPECT_EQ(*parameters.value("tolerance_db"), PropertyValue(10.0));
}

TEST(Parameters, WhatIsNoValueIsRefusedAndTheOldOneStands) {
  ChangeQueue queue;
  Parameters<Outer> parameters(queue);
  EXPECT_FALSE(parameters.set("tolerance_db", 26.0));
  EXPECT_FALSE(parameters.set("tolerance_db", true));
  EXPECT_FALSE(parameters.set("mode", Choice{2}));
  EXPECT_FALSE(parameters.set("colour", 1.0));
  EXPECT_FALSE(parameters.value("inner"));
  EXPECT_EQ(parameters.values().tolerance_db, 10.0);
  EXPECT_EQ(queue.drain(), 0U);
}

}  // namespace
}  // namespace sonar
