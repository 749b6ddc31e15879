// SPDX-License-Identifier: Apache-2.0
#include "session/listening.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

#include "base/describe.h"

namespace sonar {
namespace {

struct Depth {
  double gate_m = 15.0;
};
template <class V>
void describe(V& v, Depth& p) {
  v.field("gate_m", p.gate_m, {.unit = "m", .min = 0, .max = 100, .text = "how near"});
}

TEST(Listening, StopsWhenItGoesAndLeavesNothingBehind) {
  Listeners<int> listeners;
  const auto held = std::make_shared<int>(0);
  std::vector<int> heard;
  std::optional<Listening> listening(std::in_place);
  listening->to(listeners, [&heard, held](int what) { heard.push_back(what); });
  listeners.tell(1);
  listening.reset();
  listeners.tell(2);
  EXPECT_EQ(heard, std::vector<int>{1});
  EXPECT_EQ(held.use_count(), 1);
}

TEST(Listening, OfParametersStopsWhenItGoesAndLeavesNothingBehind) {
  ChangeQueue queue;
  Parameters<Depth> parameters(queue);
  const auto held = std::make_shared<int>(0);
  std::vector<double> heard;
  int changes = 0;
  std::optional<Listening> listening(std::in_place);
  listening->to(parameters, [&heard, held](const Depth& now) { heard.push_back(now.gate_m); });
  listening->to(parameters, [&changes] { ++changes; });
  parameters.assign({20.0});
  queue.drain();
  listening.reset();
  parameters.assign({30.0});
  queue.drain();
  EXPECT_EQ(heard, std::vector<double>{20.0});
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(held.use_count(), 1);
}

TEST(Listening, MayOutliveWhatItListensTo) {
  Listening listening;
  Listeners<> later;
  {
    Listeners<> listeners;
    listening.to(listeners, [] {});
  }
  bool heard = false;
  listening.to(later, [&] { heard = true; });
  later.tell();
  EXPECT_TRUE(heard);
}

// A widget that goes because of a change must not be told of it.
TEST(Listening, ThatAnotherEndsIsNotToldAnyMore) {
  Listeners<> listeners;
  bool told = false;
  std::optional<Listening> second;
  Listening first(listeners, [&] { second.reset(); });
  second.emplace(listeners, [&] { told = true; });
  listeners.tell();
  EXPECT_FALSE(told);
}

TEST(Listening, OneThatEndsItselfIsCarriedOutToItsEnd) {
  Listeners<> listeners;
  const auto held = std::make_shared<int>(0);
  int rounds = 0;
  std::optional<Listening> listening(std::in_place);
  listening->to(listeners, [&, held] {
    listening.reset();
    rounds += 1 + *held;
  });
  listeners.tell();
  listeners.tell();
  EXPECT_EQ(rounds, 1);
}

}  // namespace
}  // namespace sonar
