// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "pipeline/commands/command.h"

namespace sonar {
namespace {

struct Hostile {
  const char* command;
  const char* args;
  const char* says;
};

TEST(Commands, HostileLinesAreRefusedByTheNameOfTheMember) {
  const std::vector<Hostile> lines{
      {"paint", "{}", "does not know"},
      {"grow", R"({})", "to: expected"},
      {"grow", R"({"to":"new","seeds":[]})", "seeds: expected"},
      {"grow", R"({"to":"new","seeds":[{"channel":-1,"sample":3}]})", "seeds[0]"},
      {"grow", R"({"to":"new","seeds":[{"channel":1e99,"sample":3}]})", "seeds[0]"},
      {"grow", R"({"to":"add","seeds":[{"channel":1,"sample":3}]})", "school: expected"},
      {"grow", R"({"to":"new","seeds":[{"channel":1,"sample":3}],"grow":{"tolerance_db":1e9}})", "tolerance_db"},
      {"brush", R"({"runs":"all"})", "runs: expected"},
      {"brush", R"({"runs":[[1,2]]})", "runs[0]"},
      {"brush", R"({"runs":[[1,2147483647,2147483647]]})", "runs[0]"},
      {"erase", R"({"runs":[[1,2,0]]})", "runs[0]"},
      {"smooth", R"({"school":7})", "school: expected"},
      {"fill_holes", R"({"school":{"channel":1,"sample":2,"ping_time":"now"}})", "school.ping_time"},
      {"merge", R"({"schools":[{"channel":1,"sample":2}]})", "schools: expected"},
      {"merge", R"({"schools":[{"channel":1,"sample":2},{}]})", "schools[1]"},
      {"split", R"({"school":{"channel":1,"sample":2},"seed":[]})", "seed: expected"},
      {"delete", R"({})", "school: expected"},
      {"decide", R"({"school":{"channel":1,"sample":2},"status":"maybe"})", "status: expected"},
      {"decide", R"({"school":{"channel":1,"sample":2}})", "status, species, comment or name"},
      {"species", R"({"school":{"channel":1,"sample":2},"species":"her\u0000ring"})", "control characters"},
      {"bulk_decide", R"({"rule":"x","decisions":[3]})", "decisions[0]"},
      {"event", R"({"kind":"party","time":1,"text":""})", "kind: expected"},
      {"event", R"({"kind":"bookmark","time":1,"text":"","view":[1]})", "view: expected"},
      {"bad_interval", R"({"first":5,"last":4})", "last: lies before"},
      {"good_interval", R"({"first":5})", "last: expected"},
      {"calibrate", R"({"beam_calibration":[{}],"file":""})", "expected a channel"},
      {"calibrate", R"({"calibration":{"water":{"ph":70}},"file":""})", "ph"},
      {"remove_event", R"({"kind":"party","time":1,"text":""})", "kind: expected"},
      {"propagate", R"({"seeds":[{"channel":1,"sample":2}],"reach_forward":"far"})", "reach_forward"}};
  for (const Hostile& hostile : lines) {
    const auto read = command_from_json(hostile.command, nlohmann::json::parse(hostile.args), 0);
    ASSERT_FALSE(read) << hostile.command << hostile.args;
    EXPECT_THAT(read.error().text, testing::HasSubstr(hostile.says));
  }
}

}  // namespace
}  // namespace sonar
