// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/commands/test_context.h"
#include "pipeline/imports/import.h"
#include "pipeline/imports/import_echoview.h"

namespace sonar::test {

/// What the ships' clocks differ by; no whole number of the format's 0.1 ms, which must not matter.
inline constexpr TimeNs kOffset = 250'012'345;

using Voxel = std::tuple<int, int, int>;  ///< ping, row, sample
using Voxels = std::set<Voxel>;

inline Voxels voxels_of(const SchoolMasks& school) {
  Voxels all;
  for (const SchoolMasks::InPing& there : school.pings) {
    for (const Run& run : there.mask.runs) {
      for (int sample = run.first_sample; sample < run.end(); ++sample) {
        all.insert({static_cast<int>(there.ping_index), run.row, sample});
      }
    }
  }
  return all;
}

/// The small sea as a survey of one observation.
class Import : public testing::Test {
 protected:
  Import() {
    survey_.files.resize(1);
    ObservationFiles one;
    one.name = "obs-0001";
    one.grid = sea_.grid;
    one.range = sea_.sector.range();
    one.sample_count.assign(kFans, kSamples);
    for (int i = 0; i < kPings; ++i) {
      survey_.files[0].index.pings.emplace_back().time = ping_time(i);
      one.pings.push_back({0, static_cast<std::uint32_t>(i)});
      one.navigation.emplace_back().time = shown_time(i);
    }
    survey_.observations.push_back(one);
    place_ = *import_place(survey_, "");
  }

  /// As products and exports have it.
  static TimeNs shown_time(int ping) { return ping_time(ping) + kOffset; }
  static std::string text_of(TimeNs time) {
    const std::string name = raw_name_time(time);
    return fmt::format("{} {}{:04}", name.substr(0, 8), name.substr(10), time % kSecondNs / 100'000);
  }

  struct Corner {
    TimeNs time;
    double depth_m;
  };
  static std::string region(int type, const std::vector<Corner>& corners, const std::string& name = "Region 1",
                            const std::vector<std::string>& notes = {}, const std::string& of_class = "herring") {
    std::string text = fmt::format("\r\n13 {} 1 0 6 -1 0\r\n{}\r\n", corners.size(), notes.size());
    for (const std::string& note : notes) text += note + "\r\n";
    text += "0\r\n" + of_class + "\r\n";
    for (const Corner& corner : corners) text += fmt::format("{} {:.4f} ", text_of(corner.time), corner.depth_m);
    return text + fmt::format("{}\r\n{}\r\n", type, name);
  }
  static std::string evr(const std::vector<std::string>& regions) {
    std::string text = fmt::format("EVRG 7 13.0\r\n{}\r\n", regions.size());
    for (const std::string& one : regions) text += one;
    return text;
  }
  static std::vector<Corner> box(int first_ping, int last_ping, double near_m, double far_m) {
    const TimeNs begin = shown_time(first_ping) - kSecondNs / 2;
    const TimeNs end = shown_time(last_ping) + kSecondNs / 2;
    return {{begin, near_m}, {end, near_m}, {end, far_m}, {begin, far_m}};
  }

  Imported read(const std::string& text) {
    Imported imported;
    const auto done = import_evr(text, "a.evr", place_, imported, work_);
    EXPECT_TRUE(done.has_value()) << (done ? "" : to_line(done.error()));
    return imported;
  }
  std::string refused(const std::string& text) {
    Imported imported;
    const auto done = import_evr(text, "a.evr", place_, imported, work_);
    return done ? "" : to_line(done.error());
  }
  /// Schools that the journal of what was read makes, upon these.
  [[nodiscard]] JournalState carried_out(const Imported& imported, JournalState upon = {}) const {
    std::vector<JournalLine> lines;
    for (const ImportedSchool& school : imported.schools) {
      const auto of_school = school_lines(school, sea_.context(), {"someone", kBegin}, std::ssize(lines) + 1);
      EXPECT_TRUE(of_school.has_value());
      lines.insert(lines.end(), of_school->lines.begin(), of_school->lines.end());
    }
    return fold(lines, std::move(upon), sea_.context());
  }

  SmallSea sea_;
  SurveyFiles survey_;
  ImportPlace place_;
  Work work_{1};
};

}  // namespace sonar::test
