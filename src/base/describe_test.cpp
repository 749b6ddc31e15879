// SPDX-License-Identifier: Apache-2.0
#include "base/describe.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace sonar {
namespace {

enum class Colour { red, green };
constexpr std::string_view kColourNames[] = {"red", "green"};

struct Inner {
  double width_m = 2.0;
};
struct Outer {
  bool on = true;
  int count = 3;
  double range_m = 15.0;
  std::string text = {};
  Colour colour = Colour::red;
  Inner inner = {};
};

template <class Visitor>
void describe(Visitor& v, Inner& p) {
  v.field("width_m", p.width_m, {.unit = "m", .min = 0, .max = 10, .text = "how wide"});
}
template <class Visitor>
void describe(Visitor& v, Outer& p) {
  v.field("on", p.on, {.text = "whether"});
  v.field("count", p.count, {.unit = "1", .min = 1, .max = 5, .text = "how many"});
  v.field("range_m", p.range_m, {.unit = "m", .min = 0, .max = 500, .text = "how far"});
  v.field("text", p.text, {.text = "what"});
  v.choice("colour", p.colour, kColourNames, "which");
  v.group("inner", p.inner, "more");
}

std::string problem(const Outer& p) {
  const Result<void> checked = validate(p);
  return checked ? "" : checked.error().text;
}

TEST(Describe, DefaultsAreValid) { EXPECT_TRUE(validate(Outer{})); }

TEST(Describe, BoundsAreInside) {
  EXPECT_EQ(problem({.count = 1, .range_m = 500.0}), "");
  EXPECT_EQ(problem({.count = 5, .range_m = 0.0}), "");
}

TEST(Describe, TheProblemNamesTheField) {
  EXPECT_NE(problem({.count = 0}).find("count = 0"), std::string::npos);
  EXPECT_NE(problem({.count = 6}).find("count = 6"), std::string::npos);
  EXPECT_NE(problem({.range_m = 501.0}).find("range_m"), std::string::npos);
  EXPECT_NE(problem({.inner = {.width_m = -1.0}}).find("inner.width_m = -1"), std::string::npos);
  EXPECT_NE(problem({.colour = static_cast<Colour>(2)}).find("colour"), std::string::npos);
  EXPECT_EQ(validate(Outer{.count = 0}).error().code, ErrorCode::bad_parameter);
}

TEST(Describe, NotANumberIsOutsideEveryRange) {
  EXPECT_NE(problem({.range_m = std::numeric_limits<double>::quiet_NaN()}), "");
  EXPECT_NE(problem({.range_m = std::numeric_limits<double>::infinity()}), "");
}

TEST(Describe, TheFirstProblemIsNamed) {
  EXPECT_NE(problem({.count = 0, .range_m = -1.0}).find("count"), std::string::npos);
}

}  // namespace
}  // namespace sonar
