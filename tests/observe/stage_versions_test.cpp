// SPDX-License-Identifier: Apache-2.0
// Products of different stage versions are not merged, so a stage whose results change must have its number raised. Here
// fixed pings go through every stage; the hash of each stage's result stands beside the number it was made under.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.h"
#include "fixed_survey.h"
#include "io/table_columns.h"
#include "pipeline/journal/manual.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/group_water.h"
#include "pipeline/stages/load_volume.h"
#include "pipeline/stages/observe.h"
#include "school/detect/detect.h"
#include "school/track/track.h"

namespace sonar {
namespace {

struct Recorded {
  std::string_view stage;
  int version;
  std::string_view hash;
};

// In the order of the stages: where one changes, those after it change with it and keep their numbers.
constexpr std::array<Recorded, 11> kRecorded{{
    {"decode", 3, "a195b195c94c61832b89d7888875ee9f"},
    {"flags", 4, "99eb9d72fcb1c77755e090f45acd994c"},
    {"calibrate", 1, "1edf455df7cc0b4fda57ebe6875d49f6"},
    {"background", 4, "4f44a41c3ce12e5f2db11de0a9dfdcf5"},
    {"median", 1, "29ae415283b450c6c185eacc33b42f65"},
    {"seabed", 7, "bd52c987c7035c50998bb977009262fe"},
    {"detect", 16, "377014ec67318b80c167d6dd11887fbb"},
    {"track", 11, "91393a19123f317dd64eee83037c0240"},
    {"propagate", 5, "07fc13208a4339c9753bc8d5d859fd72"},
    {"measure", 22, "90682cad4440b1a91f7e7be4084a0acd"},
    {"summarise", 9, "cd15b6d83dc74d4f606e166cb537c967"},
}};

class Digest {
 public:
  template <class T>
  void array(const Array3<T>& values) {
    const auto view = values.view();
    for (int row = 0; row < static_cast<int>(values.shape().rows()); ++row) hasher_.add(std::as_bytes(view.row(row)));
  }
  void mask(const PingMask& mask) {
    for (const Run& run : mask.runs) text(fmt::format("{} {} {},", run.row, run.first_sample, run.count));
    hasher_.add(std::as_bytes(std::span(mask.confidence)));
  }
  /// Six digits: the last bits of a logarithm may differ from one processor to another.
  void number(double value) { text(fmt::format("{:.6g} ", value)); }
  void text(std::string_view value) { hasher_.add(value); }
  template <class Row>
  void rows(const std::vector<Row>& all) {
    for (const TableColumn& column : columns_of(all)) {
      if (column.name == "survey_school") continue;  // no stage's: the merge gives it
      text(column.name);
      std::visit(
          [&](const auto& values) {
            for (const auto& value : values) one(value);
          },
          column.values);
    }
  }
  /// Which members of the masks are faulty.
  void faults(const std::vector<SchoolMask>& masks) {
    std::size_t faulty = 0;
    for (const SchoolMask& there : masks) {
      text(fmt::format("{} {}:", there.school_id, there.ping_index));
      for (std::size_t i = 0; i < there.fault.size(); ++i) {
        if (!there.fault[i]) continue;
        text(fmt::format("{} ", i));
        ++faulty;
      }
    }
    EXPECT_GT(faulty, 0U) << "a change of these bits would not be seen";
  }
  [[nodiscard]] std::string hex() const { return to_hex(hasher_.value()); }

 private:
  void one(double value) { number(value); }
  void one(const std::string& value) { text(value + ";"); }
  void one(std::int64_t value) { text(fmt::format("{};", value)); }
  Hasher hasher_;
};

/// Detected pings, and the hashes of what came before.
std::vector<DetectedPing> detected(Engine& engine, std::map<std::string, Digest>& digests) {
  std::vector<DetectedPing> pings;
  GroupWater waters(engine);
  for (std::int64_t i = 0; i < engine.pings(); ++i) {
    const auto volume = load_volume(engine.survey(), engine.observation(), static_cast<std::size_t>(i));
    const auto ping = engine.staged(i);
    EXPECT_TRUE(volume && ping);
    if (!volume || !ping) return pings;
    digests["decode"].array(volume->volume.counts);
    digests["decode"].array(volume->volume.flags);
    Array3<SampleFlags> noises = ping->sv.flags;  // the ground is the seabed's stage
    for (SampleFlags& flag : noises.all()) {
      if (any(flag & SampleFlags::seabed)) {
        flag = static_cast<SampleFlags>(static_cast<int>(flag) - static_cast<int>(SampleFlags::seabed));
      }
    }
    digests["flags"].array(noises);
    digests["calibrate"].array(ping->sv.counts);
    for (const float level : engine.background_db(i)) digests["background"].number(static_cast<double>(level));
    digests["median"].array(ping->filtered->counts);
    digests["seabed"].array(ping->filtered->flags);
    digests["seabed"].array(ping->sv.flags);
    EXPECT_TRUE(ping->seabed.found) << "ping " << i;
    DetectedPing found;
    found.ping_index = i;
    found.time = engine.observation().navigation[static_cast<std::size_t>(i)].time;
    found.placement = engine.placement(i);
    const auto water = waters.of(i);
    EXPECT_TRUE(water);
    if (!water) return pings;
    found.detections = detect(engine.echo(*ping, *water), engine.recipe().detect);
    for (const Detection& detection : found.detections) digests["detect"].mask(detection.mask);
    pings.push_back(std::move(found));
  }
  return pings;
}

JournalLine click(const Engine& engine, GrowMode mode) {
  PropagateCommand command;
  command.mode = mode;
  command.grow.mode = mode;
  command.grow.tolerance_opacity = 0.25;
  command.seeds = {{engine.grid().channel[4 * fixed::kBeams + 5], fixed::kSchoolSample - 4}};
  JournalLine line;
  line.n = 1;
  line.command = "propagate";
  line.ping_time = test::kStart + 4 * kSecondNs;  // ping 2
  *line.args = to_json(command);
  return line;
}

std::map<std::string, Digest> digests_of(const SurveyFiles& survey) {
  std::map<std::string, Digest> digests;
  Work work(1);
  const ObservationFiles& observation = survey.observations.front();
  Engine engine(survey, observation, {});
  EXPECT_TRUE(engine.estimate_background(0, fixed::kPings - 1, work));
  const auto pings = detected(engine, digests);
  const Tracks tracks = track(pings, engine.sector(), engine.grid().channel, engine.recipe().track);
  EXPECT_EQ(tracks.schools.size(), 1U);
  for (const SchoolTrack& school : tracks.schools) {
    for (const TrackedDetection& in_ping : school.pings) {
      digests["track"].text(fmt::format("{} {} {};", school.school_id, in_ping.ping_index, in_ping.detections.size()));
    }
  }
  for (const TrackEvent& event : tracks.events) digests["track"].text(to_text(event));
  for (const GrowMode mode : {GrowMode::tracked, GrowMode::paper}) {
    Diagnostics notes;
    const std::vector<JournalLine> lines{click(engine, mode)};
    const auto schools = replay(engine, lines, {0, fixed::kPings - 1}, notes);
    EXPECT_EQ(schools.size(), 1U);
    for (const SchoolMasks& school : schools) {
      for (const SchoolMasks::InPing& in_ping : school.pings) digests["propagate"].mask(in_ping.mask);
    }
  }
  const auto product = observe(survey, observation, {}, {{}, {}, "test"}, work);
  EXPECT_TRUE(product);
  if (!product) return digests;
  digests["measure"].rows(product->school_pings);
  digests["measure"].faults(product->masks);
  digests["summarise"].rows(product->schools);
  return digests;
}

std::map<std::string, int> current_versions() {
  std::map<std::string, int> versions;
  std::istringstream in{std::string(kStageVersions)};
  std::string stage;
  std::string number;
  while (in >> stage >> number) versions[stage] = std::stoi(number);
  return versions;
}

TEST(StageVersions, AreRaisedWhenResultsChange) {
  const test::TemporaryFolder folder;
  const std::vector<std::filesystem::path> paths{folder.write("fixed.raw", fixed::file())};
  Work work(1);
  const auto survey = open_survey(paths, {}, {}, {}, work);
  ASSERT_TRUE(survey);
  ASSERT_EQ(survey->observations.size(), 1U);
  const auto digests = digests_of(*survey);
  const auto versions = current_versions();
  std::string table;
  std::string changed;  // the first stage whose results are not those that its number stands for
  bool same = versions.size() == kRecorded.size();
  for (const Recorded& recorded : kRecorded) {
    const std::string stage(recorded.stage);
    ASSERT_TRUE(versions.contains(stage)) << "kStageVersions has no stage '" << stage << "'";
    ASSERT_TRUE(digests.contains(stage)) << "no result of stage '" << stage << "' is looked at";
    const std::string hash = digests.at(stage).hex();
    table += fmt::format("    {{\"{}\", {}, \"{}\"}},\n", stage, versions.at(stage), hash);
    same = same && hash == recorded.hash && versions.at(stage) == recorded.version;
    if (changed.empty() && hash != recorded.hash) changed = versions.at(stage) == recorded.version ? stage : "-";
  }
  if (!changed.empty() && changed != "-") {
    ADD_FAILURE()
        << "The results of stage '" << changed << "' changed, but its number in kStageVersions "
        << "(src/pipeline/stages/observe.h) did not. If the change is meant, raise the number, so that old and new "
        << "products are never merged; then record the new hashes here.";
  }
  EXPECT_TRUE(same) << "Record these in kRecorded (tests/observe/stage_versions_test.cpp):\n" << table;
}

}  // namespace
}  // namespace sonar
