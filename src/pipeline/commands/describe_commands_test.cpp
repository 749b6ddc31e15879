// SPDX-License-Identifier: Apache-2.0
// Laws that hold for every command there is, because each is described once.
#include "pipeline/commands/describe_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/commands/test_commands.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)
using nlohmann::json;

std::vector<std::pair<int, Command>> examples() {
  auto all = every_command();
  CalibrateCommand calibrate;
  calibrate.calibration.water.salinity_psu = 7.0;
  calibrate.calibration.beams = {{3, 27.5, 0.25, 0.5}};
  calibrate.file = "sphere.csv";
  all.emplace_back(3, RemoveEventCommand{{"trawl", ping_time(2), "haul 12"}});
  all.emplace_back(3, GoodPingsCommand{ping_time(4), ping_time(5)});
  all.emplace_back(3, calibrate);
  all.emplace_back(3, DetectCommand{2});
  all.emplace_back(3, SplitCommand{key_a(), seed_a()});
  return all;
}

/// All names that a command may have.
class Names : public PassesOver {
 public:
  template <class E>
  void command(std::span<const std::string_view> all, const E&, About) {
    names.assign(all.begin(), all.end());
  }
  std::vector<std::string> names;
};

/// Calls a function with a default-made command of every kind.
template <class F, std::size_t... I>
void each_kind(F f, std::index_sequence<I...>) {
  (f(I, std::variant_alternative_t<I, Command>{}), ...);
}
template <class F>
void each_kind(F f) {
  each_kind(f, std::make_index_sequence<std::variant_size_v<Command>>{});
}

TEST(DescribeCommands, EveryKindHasAnExampleASentenceAndNamesOfItsOwn) {
  std::set<std::size_t> shown;
  for (const auto& [ping, command] : examples()) shown.insert(command.index());
  std::set<std::string> taken;
  each_kind([&](std::size_t kind, const auto& made) {
    EXPECT_TRUE(shown.contains(kind)) << command_name(made);
    EXPECT_FALSE(sentence_of(made).words.empty()) << command_name(made);
    EXPECT_TRUE(to_json(made).is_object());
    Names of;
    describe(of, made);
    EXPECT_THAT(of.names, testing::Contains(command_name(made)));
    for (const std::string& name : of.names) EXPECT_TRUE(taken.insert(name).second) << name << " is two commands";
  });
  // As docs/interfaces.md lists them.
  EXPECT_THAT(taken, testing::UnorderedElementsAre(
                         "propagate", "grow", "brush", "erase", "fill_holes", "smooth", "largest_part", "merge",
                         "split", "hand_over", "delete", "decide", "species", "comment", "rename", "bulk_decide",
                         "event", "remove_event", "bad_ping", "bad_interval", "good_interval", "calibrate", "detect"));
}

TEST(DescribeCommands, WhatIsWrittenIsReadAndNothingElseIsWritten) {
  for (const auto& [ping, command] : examples()) {
    const std::string name = command_name(command);
    const json args = to_json(command);
    const auto read = command_from_json(name, args, ping_time(ping));
    ASSERT_TRUE(read) << name << ": " << read.error().text;
    EXPECT_EQ(read->index(), command.index());
    EXPECT_EQ(command_name(*read), name);
    EXPECT_EQ(to_json(*read).dump(), args.dump()) << name;
    EXPECT_EQ(sentence_of(*read).words, sentence_of(command).words);
    // A member that nobody reads could hold anything.
    for (const auto& [member, value] : args.items()) {
      json wrong = args;
      wrong[member] = nullptr;
      EXPECT_FALSE(command_from_json(name, wrong, ping_time(ping))) << name << " reads no " << member;
    }
  }
}

// By hand, after docs/interfaces.md: journals of years ago read so, and other programs read ours.
TEST(DescribeCommands, LinesReadAsTheFormatSays) {
  const std::string school = R"({"channel":7,"ping_time":9,"sample":33})";
  const std::vector<std::pair<std::string, std::string>> lines{
      {"brush", R"({"runs":[[7,31,2],[8,30,4]],"school":)" + school + "}"},
      {"erase", R"({"runs":[[7,31,2]]})"},
      {"fill_holes", R"({"all_pings":false,"school":)" + school + "}"},
      {"smooth", R"({"all_pings":true,"school":)" + school + "}"},
      {"largest_part", R"({"all_pings":true,"school":)" + school + "}"},
      {"merge", R"({"schools":[)" + school + R"(,{"channel":8,"ping_time":9,"sample":1}]})"},
      {"split", R"({"school":)" + school + "}"},
      {"split", R"({"school":)" + school + R"(,"seed":{"channel":8,"sample":1}})"},
      {"hand_over", R"({"first":9,"last":12,"school":)" + school + "}"},
      {"hand_over", R"({"first":9,"last":12,"school":)" + school + R"(,"to":{"channel":8,"ping_time":9,"sample":1}})"},
      {"delete", R"({"school":)" + school + "}"},
      {"decide", R"({"comment":"by the wreck","school":)" + school + R"(,"status":"accepted"})"},
      {"species", R"({"school":)" + school + R"(,"species":"herring"})"},
      {"comment", R"({"comment":"","school":)" + school + "}"},
      {"rename", R"({"name":"north wall","school":)" + school + "}"},
      {"bulk_decide", R"({"decisions":[{"school":)" + school + R"(,"status":"rejected"}],"rule":"5 pings"})"},
      {"bulk_decide", R"({"decisions":[],"rule":""})"},
      {"event", R"({"kind":"trawl","text":"haul 12","time":9})"},
      {"event", R"({"kind":"bookmark","text":"","time":9,"view":{"fan":3}})"},
      {"remove_event", R"({"kind":"trawl","text":"haul 12","time":9})"},
      {"bad_ping", R"({"first":9,"last":9})"},
      {"bad_interval", R"({"first":9,"last":12})"},
      {"good_interval", R"({"first":9,"last":9})"},
      {"detect", R"({})"},
      {"detect", R"({"schools":4})"}};
  for (const auto& [name, text] : lines) {
    const auto read = command_from_json(name, json::parse(text), 5);
    ASSERT_TRUE(read) << name << text << ": " << read.error().text;
    EXPECT_EQ(command_name(*read), name);
    EXPECT_EQ(to_json(*read).dump(), text);
  }
  // What a line may leave out.
  const auto bad = command_from_json("bad_ping", json::object(), 5);
  ASSERT_TRUE(bad);
  EXPECT_EQ(to_json(*bad).dump(), R"({"first":5,"last":5})");
  const auto gone = command_from_json("delete", json::parse(R"({"school":{"channel":7,"sample":33}})"), 9);
  ASSERT_TRUE(gone);
  EXPECT_EQ(to_json(*gone).dump(), R"({"school":)" + school + "}");
}

TEST(DescribeCommands, WhatNeedsNoMaskIsCarriedOutWhereNoPingCanBeRead) {
  const SmallSea sea;
  CommandContext blind;
  blind.times = sea.context().times;
  std::vector<JournalLine> lines;
  for (const auto& [ping, command] : examples()) {
    lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, ping, command));
    if (needs_masks(command)) continue;
    lines.back().ping_time += 1000 * kSecondNs;  // said from elsewhere
    const auto act = act_of(lines.back());
    ASSERT_TRUE(act);
    const auto state = apply(*act, {}, blind);
    EXPECT_TRUE(state || std::holds_alternative<RemoveEventCommand>(command)) << command_name(command);
    EXPECT_TRUE(!state || state->schools.empty()) << command_name(command);
  }
  const JournalState whole = fold(lines, SmallSea::detected(), sea.context());
  const JournalState said = fold_without_masks(ReadJournal(lines).lines(), blind.times);
  EXPECT_FALSE(said.events.empty());
  EXPECT_EQ(said.events, whole.events);
  EXPECT_FALSE(said.bad_pings.empty());
  EXPECT_EQ(said.bad_pings, whole.bad_pings);
  ASSERT_TRUE(said.calibration && whole.calibration);
  EXPECT_EQ(said.calibration->water.salinity_psu, whole.calibration->water.salinity_psu);
  EXPECT_TRUE(said.schools.empty());
}

TEST(DescribeCommands, TimesAreThoseThatAnActSpeaksOf) {
  const auto spoken = [](const Command& command) {
    std::vector<std::pair<TimeNs, TimeNs>> spans;
    for (const TimeSpan& span : spoken_times(command)) spans.emplace_back(span.first, span.last);
    return spans;
  };
  using Spans = std::vector<std::pair<TimeNs, TimeNs>>;
  EXPECT_EQ(spoken(BadPingsCommand{5, 8}), (Spans{{5, 8}}));
  EXPECT_EQ(spoken(GoodPingsCommand{5, 5}), (Spans{{5, 5}}));
  EXPECT_EQ(spoken(EventCommand{"trawl", 7, ""}), (Spans{{7, 7}}));
  EXPECT_EQ(spoken(DecideCommand{{decision({3, 1, 2}, "accepted"), decision({4, 1, 2}, "accepted")}, ""}),
            (Spans{{3, 3}, {4, 4}}));
  EXPECT_EQ(spoken(CalibrateCommand{}),
            (Spans{{std::numeric_limits<TimeNs>::min(), std::numeric_limits<TimeNs>::max()}}));
  for (const auto& [ping, command] : examples()) {
    EXPECT_TRUE(about(command) != About::ping || spoken(command).empty()) << command_name(command);
  }
}

}  // namespace
}  // namespace sonar
