// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/json_file.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/recipe/recipe.h"
#include "pipeline/recipe/transfer_function_json.h"
#include "pipeline/tasks/plan.h"

namespace sonar {
namespace {

std::string nested(int depth) {
  const auto deep = static_cast<std::size_t>(depth);
  return std::string(deep, '[') + std::string(deep, ']');
}

TEST(JsonFile, deep_nesting_is_refused_before_anything_recurses) {
  EXPECT_TRUE(parse_json(nested(100)));
  const auto deep = parse_json(nested(101));
  ASSERT_FALSE(deep);
  EXPECT_EQ(deep.error().code, ErrorCode::format);
  EXPECT_EQ(deep.error().where.offset, 100);  // the hundred-and-first bracket
  EXPECT_FALSE(parse_json(nested(1'000'000)));
  EXPECT_FALSE(plan_from_text("{\"plan_version\":1,\"survey\":[],\"recipe\":" + nested(1'000'000) + "}"));
}

TEST(JsonFile, brackets_inside_texts_do_not_nest) {
  const std::string brackets(200, '[');
  EXPECT_TRUE(parse_json("[\"" + brackets + "\\\"" + brackets + "\"]"));
}

TEST(JsonFile, a_number_that_no_double_holds_is_an_error_like_any_other) {
  const auto json = parse_json("{\"recipe_version\":1e400}");
  ASSERT_FALSE(json);
  EXPECT_EQ(json.error().code, ErrorCode::format);
}

TEST(JsonFile, whole_numbers_do_not_wrap_round) {
  const auto of = [](const char* text) { return whole_number(*parse_json(text)); };
  EXPECT_EQ(of("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(of("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(of("9223372036854775808"), std::nullopt);  // 2^63
  EXPECT_EQ(of("18446744073709551615"), std::nullopt);
  EXPECT_EQ(of("1.0"), std::nullopt);
  EXPECT_EQ(of("\"1\""), std::nullopt);
  EXPECT_EQ(whole_number(*parse_json("7"), 0, 6), std::nullopt);
  EXPECT_EQ(whole_number(*parse_json("-1"), 0), std::nullopt);
  // 2^32 + 15 is 15 in 32 bits.
  EXPECT_FALSE(recipe_from_text("{\"recipe_version\":1,\"median\":{\"kernel_samples\":4294967311}}"));
  EXPECT_TRUE(recipe_from_text("{\"recipe_version\":1,\"median\":{\"kernel_samples\":15}}"));
}

TEST(JsonFile, a_plan_names_pings_that_can_be) {
  const auto plan = [](const std::string& pings) {
    return plan_from_text("{\"plan_version\":1,\"survey\":[],\"recipe\":{\"recipe_version\":1},\"pings\":" + pings +
                          ",\"tasks\":[]}");
  };
  EXPECT_TRUE(plan("[3,3]"));
  EXPECT_FALSE(plan("[5,3]"));
  EXPECT_FALSE(plan("[-1,3]"));
  EXPECT_FALSE(plan("[0,18446744073709551615]"));
}

TEST(JsonFile, a_curve_whose_slope_would_overflow_is_refused) {
  const auto curve = [](const char* points) {
    return transfer_function_from_json(*parse_json(std::string("{\"tf_version\":1,\"points\":") + points + "}"));
  };
  EXPECT_TRUE(curve("[{\"sv_db\":-1000,\"opacity\":0},{\"sv_db\":1000,\"opacity\":1}]"));
  EXPECT_FALSE(curve("[{\"sv_db\":-1.7e308,\"opacity\":0},{\"sv_db\":1.7e308,\"opacity\":1}]"));
  EXPECT_TRUE(curve("[{\"sv_db\":-70,\"opacity\":0,\"rgb\":[255,0,0]}]"));
  EXPECT_FALSE(curve("[{\"sv_db\":-70,\"opacity\":0,\"rgb\":[300,0,0]}]"));
  EXPECT_FALSE(curve("[{\"sv_db\":-70,\"opacity\":0,\"rgb\":[0,-1,0]}]"));
}

}  // namespace
}  // namespace sonar
