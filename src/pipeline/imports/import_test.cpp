// SPDX-License-Identifier: Apache-2.0
#include "pipeline/imports/import.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/echoview_text.h"
#include "io/lsss_work.h"
#include "pipeline/commands/state.h"
#include "pipeline/commands/test_context.h"
#include "pipeline/imports/import_echoview.h"
#include "pipeline/imports/import_lsss.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What the ships' clocks differ by; no whole number of the format's 0.1 ms, which must not matter.
constexpr TimeNs kOffset = 250'012'345;

using Voxel = std::tuple<int, int, int>;  ///< ping, row, sample
using Voxels = std::set<Voxel>;

Voxels voxels_of(const SchoolMasks& school) {
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

/// Two schools of ragged form, with a hole, in several fans; the first is away in ping 4.
ObservationProduct ragged(const BeamGrid& grid, const RangeAxis& range) {
  ObservationProduct product;
  product.observation = "obs-0001";
  product.grid.emplace();
  product.grid->grid = grid;
  product.grid->range = range;
  for (int i = 0; i < kPings; ++i) product.pings.emplace_back().time = ping_time(i) + kOffset;
  for (const std::int64_t id : {3, 5}) product.schools.emplace_back().school_id = id;
  product.schools[1].species = "herring";
  for (int i = 0; i < kPings; ++i) {
    if (i == 4) continue;
    PingMask mask;
    for (int fan = 1; fan <= 3; ++fan) {
      for (int beam = 1; beam <= 5; ++beam) {
        mask.runs.push_back({fan * kBeams + beam, 20 + beam * i % 7, 4 + fan});
        if (beam == 3) mask.runs.push_back({fan * kBeams + beam, 40, 2 + i});
      }
    }
    product.masks.push_back({3, i, mask});
  }
  for (int i = 2; i < 6; ++i) product.masks.push_back({5, i, {{{2 * kBeams + 7, 60 + i, 1}, {4 * kBeams, 61, 9}}, {}}});
  return product;
}

// Export and import, fan by fan and all fans together: every voxel is back, and no other.
TEST_F(Import, WhatWasExportedComesBackVoxelByVoxel) {
  const ObservationProduct product = ragged(sea_.grid, sea_.sector.range());
  std::map<std::int64_t, Voxels> expected;
  for (const SchoolMask& mask : product.masks) {
    SchoolMasks one;
    one.pings.push_back({mask.ping_index, mask.mask});
    expected[mask.school_id].merge(voxels_of(one));
  }
  Imported all;
  for (int fan = 0; fan < kFans; ++fan) {
    const std::string text = evr_text(product, fan);
    if (text.empty()) continue;
    ASSERT_TRUE(import_evr(text, "a.evr", place_, all, work_).has_value());
    for (const auto& school : carried_out(read(text)).schools) {
      const bool herring = school->masks.decided.species == "herring";
      Voxels in_fan;
      for (const Voxel& voxel : expected[herring ? 5 : 3]) {
        if (std::get<1>(voxel) / kBeams == fan) in_fan.insert(voxel);
      }
      EXPECT_EQ(voxels_of(school->masks), in_fan) << "fan " << fan;
    }
  }
  const JournalState state = carried_out(all);
  ASSERT_EQ(state.schools.size(), 2U) << "one of all fans and stretches";
  for (const auto& school : state.schools) {
    EXPECT_EQ(voxels_of(school->masks), expected[school->masks.decided.species == "herring" ? 5 : 3]);
  }
  EXPECT_THAT(all.left_out, IsEmpty());
  EXPECT_THAT(state.notes, IsEmpty());
}

TEST_F(Import, IsStopped) {
  work_.cancel();
  Imported imported;
  const auto code_of = [](const Result<void>& done) { return done ? std::optional<ErrorCode>() : done.error().code; };
  EXPECT_EQ(code_of(import_evr(evr({}), "a.evr", place_, imported, work_)), ErrorCode::cancelled);
  ObservationProduct product = ragged(sea_.grid, sea_.sector.range());
  product.grid->sample_count.assign(kFans, kSamples);
  const std::string masks = lsss_work_text(product, kOffset, LsssNumbering::from_one);
  EXPECT_EQ(code_of(import_lsss(masks, "a.work", place_, imported, work_)), ErrorCode::cancelled);
  EXPECT_TRUE(imported.schools.empty());
}

// In both numberings, and without what the recipe added to the times; a ping that the survey has not is told.
TEST_F(Import, MasksOfLsssComeBackVoxelByVoxel) {
  ObservationProduct product = ragged(sea_.grid, sea_.sector.range());
  product.grid->sample_count.assign(kFans, kSamples);
  product.schools[1].species = "12";
  product.pings.emplace_back().time = ping_time(kPings) + kOffset + 60 * kSecondNs;
  product.masks.push_back({5, kPings, product.masks.back().mask});
  for (const LsssNumbering numbering : {LsssNumbering::from_one, LsssNumbering::from_zero}) {
    place_.lsss = numbering;
    Imported imported;
    const auto done = import_lsss(lsss_work_text(product, kOffset, numbering), "a.work", place_, imported, work_);
    ASSERT_TRUE(done.has_value()) << to_line(done.error());
    EXPECT_THAT(imported.left_out, ElementsAre("a.work: school 2: 1 ping that the survey does not have"));
    const JournalState state = carried_out(imported);
    ASSERT_EQ(state.schools.size(), 2U);
    EXPECT_THAT(state.notes, IsEmpty());
    for (const auto& school : state.schools) {
      const bool second = school->masks.decided.species == "12";
      Voxels expected;
      for (const SchoolMask& mask : product.masks) {
        if (mask.school_id != (second ? 5 : 3) || mask.ping_index >= kPings) continue;
        SchoolMasks one;
        one.pings.push_back({mask.ping_index, mask.mask});
        expected.merge(voxels_of(one));
      }
      EXPECT_EQ(voxels_of(school->masks), expected);
    }
  }
}

/// Whether a place lies in a polygon, by the angle that it is seen under: all round, or not at all.
bool inside(const std::vector<std::pair<double, double>>& polygon, double x, double y) {
  double turned = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto [ax, ay] = polygon[i];
    const auto [bx, by] = polygon[(i + 1) % polygon.size()];
    turned += std::atan2((ax - x) * (by - y) - (bx - x) * (ay - y), (ax - x) * (bx - x) + (ay - y) * (by - y));
  }
  return std::abs(turned) > 3.0;
}

TEST_F(Import, APolygonHoldsTheSamplesWhoseMiddlesLieInIt) {
  place_.fan = 2;
  place_.beams = BeamSpan{1, 4};
  // Drawn by hand, with a bay; no sample lies nearer than 2 cm to a side.
  const std::vector<std::pair<double, double>> polygon{{1.0, 12.0}, {7.0, 9.1},   {15.5, 14.25},
                                                       {9.0, 21.3}, {11.3, 30.4}, {3.0, 27.7}};
  std::vector<Corner> corners;
  for (const auto& [seconds, depth_m] : polygon) {
    corners.push_back({kBegin + kOffset + static_cast<TimeNs>(seconds * 1e9), depth_m});
  }
  Voxels expected;
  for (int ping = 0; ping < kPings; ++ping) {
    for (int sample = 5; sample < kSamples; ++sample) {
      if (!inside(polygon, 2.0 * ping, -0.2 + 0.5 * sample)) continue;
      for (int beam = 1; beam <= 4; ++beam) expected.insert({ping, 2 * kBeams + beam, sample});
    }
  }
  ASSERT_GT(expected.size(), 300U);
  const JournalState state = carried_out(read(evr({region(1, corners, "north wall", {"dense"})})));
  ASSERT_EQ(state.schools.size(), 1U);
  EXPECT_EQ(voxels_of(state.schools[0]->masks), expected);
  const SchoolRow& row = state.schools[0]->masks.decided;
  EXPECT_EQ(std::tuple(row.name, row.species, row.comment), std::tuple("north wall", "herring", "dense"));
  EXPECT_EQ(std::tuple(row.origin, row.operator_name), std::tuple("manual", "someone"));
}

// Samples 0 to 4 are near field: no brush takes them, and the import says the same as what is replayed.
TEST_F(Import, VoxelsThatCannotBelongToASchoolAreLeftOut) {
  place_.fan = 0;
  place_.beams = BeamSpan{0, 0};
  const Imported imported = read(evr({region(3, box(0, 1, -9999.99, 2.55)), region(1, box(3, 3, 0.0, 1.0))}));
  ASSERT_EQ(imported.schools.size(), 2U);
  const auto lines = school_lines(imported.schools[0], sea_.context(), {"", kBegin}, 7);
  ASSERT_TRUE(lines.has_value());
  EXPECT_EQ(lines->voxels, 2U) << "sample 5, at 2.3 m, in two pings";
  ASSERT_EQ(lines->lines.size(), 3U);
  for (const JournalLine& line : lines->lines) EXPECT_EQ(line.step, 7) << "undone together";
  EXPECT_EQ(lines->lines.back().n, 9);
  const auto none = school_lines(imported.schools[1], sea_.context(), {"", kBegin}, 1);
  ASSERT_TRUE(none.has_value());
  EXPECT_THAT(none->lines, IsEmpty());
  EXPECT_EQ(none->pings_left_out, 1U);
}

TEST_F(Import, TheBrushTakesVoxelsFromWhatWasDetected) {
  place_.fan = 2;
  place_.beams = BeamSpan{3, 3};
  const JournalState state = carried_out(read(evr({region(1, box(2, 3, 16.8, 25.0))})), SmallSea::detected());
  ASSERT_EQ(state.schools.size(), 3U);
  EXPECT_THAT(state.notes, IsEmpty());
  EXPECT_EQ(voxels_of(state.schools[2]->masks).size(), 2U * 17U) << "samples 34 to 50, at 16.8 to 24.8 m";
}

// The told cells are samples 20 to 29 of beam 2 and 26 to 31 of beam 4; the polygon was cut at 24 and drawn out to 33.
TEST_F(Import, AnOutlineThatWasChangedElsewhereIsFollowed) {
  const std::vector<std::string> notes{"fan 3", "beams 2 4", "cells " + text_of(shown_time(2)) + " 2 20 10 4 26 6"};
  const double near_m = -0.2 + 0.5 * 23.5;
  const double far_m = -0.2 + 0.5 * 33.5;
  const JournalState state = carried_out(read(evr({region(1, box(2, 3, near_m, far_m), "obs-0001/3", notes)})));
  ASSERT_EQ(state.schools.size(), 1U);
  Voxels expected;
  for (int sample = 24; sample <= 33; ++sample) {
    if (sample < 30) expected.insert({2, 3 * kBeams + 2, sample});
    if (sample >= 26 && sample < 32) expected.insert({2, 3 * kBeams + 4, sample});
    for (int beam = 2; beam <= 4; ++beam) {
      if (sample >= 32) expected.insert({2, 3 * kBeams + beam, sample});
      expected.insert({3, 3 * kBeams + beam, sample});  // a ping of which nothing is told
    }
  }
  EXPECT_EQ(voxels_of(state.schools[0]->masks), expected);
  EXPECT_EQ(state.schools[0]->masks.decided.name, "") << "the name of an export is none";
  const JournalState renamed = carried_out(read(evr({region(1, box(2, 3, near_m, far_m), "north wall", notes)})));
  ASSERT_EQ(renamed.schools.size(), 1U);
  EXPECT_EQ(renamed.schools[0]->masks.decided.name, "north wall");
}

TEST_F(Import, MarksAndBadPingsAreOnTheClockOfTheDatagrams) {
  const Imported imported = read(
      evr({region(2, {{shown_time(0), 5.0}}, "haul 12", {"cod"}), region(2, {{shown_time(3) + kSecondNs, 5.0}}, ""),
           region(0, box(2, 4, -9999.99, 9999.99)), region(0, box(5, 5, 0.0, 9999.99))}));
  EXPECT_THAT(imported.left_out, IsEmpty());
  ASSERT_EQ(imported.events.size(), 2U);
  EXPECT_EQ(imported.events[0], (EventCommand{"other", ping_time(0), "haul 12: cod"}));
  EXPECT_NEAR(static_cast<double>(imported.events[1].time - ping_time(3)), 1e9, 1e5);
  EXPECT_THAT(imported.bad,
              ElementsAre(BadPingsCommand{ping_time(2), ping_time(4)}, BadPingsCommand{ping_time(5), ping_time(5)}));
}

TEST_F(Import, WhatAJournalHasNoChoiceForIsTold) {
  place_.fan = 2;
  const TimeNs later = shown_time(kPings) + 60 * kSecondNs;
  const Imported imported = read(evr({region(0, box(2, 4, 10.0, 9999.99), "part"),
                                      region(4, box(2, 4, -1.0, 50.0), "empty"), region(2, {{later, 1.0}}, "late"),
                                      region(1, {{later, 1.0}, {later + kSecondNs, 1.0}, {later, 2.0}}, "never"),
                                      region(0, {{later, -1.0}, {later, 99.0}}, "gone")}));
  ASSERT_EQ(imported.left_out.size(), 5U);
  EXPECT_EQ(imported.left_out[0],
            "a.evr: line 4: region part: bad data of a part of the range; expected all of it, as only whole pings can "
            "be bad");
  EXPECT_THAT(imported.left_out[1], HasSubstr("region empty: bad data (empty water)"));
  EXPECT_THAT(imported.left_out[2], HasSubstr("region late: no observation of the survey was made at its time"));
  EXPECT_THAT(imported.left_out[3], HasSubstr("region never: no sample of the survey lies in it"));
  EXPECT_THAT(imported.left_out[4], HasSubstr("region gone: no ping of the survey lies in it"));
  EXPECT_TRUE(imported.schools.empty() && imported.events.empty() && imported.bad.empty());
}

TEST_F(Import, ARegionThatSaysTooLittleOrTooMuchIsRefused) {
  EXPECT_EQ(refused(evr({region(1, box(2, 4, 10.0, 20.0))})),
            "a.evr: line 4: region Region 1: its notes name no fan; name it with --fan");
  EXPECT_THAT(refused(evr({region(1, box(2, 4, 10.0, 20.0), "x", {"fan 6"})})),
              HasSubstr("fan 6: obs-0001 has fans 0 to 5"));
  EXPECT_THAT(refused(evr({region(1, box(2, 4, 10.0, 20.0), "x", {"fan 1", "beams 3 8"})})),
              HasSubstr("beam 8: obs-0001 has beams 0 to 7"));
  const std::string cells = "cells " + text_of(shown_time(2)) + " 9 20 10";
  EXPECT_THAT(refused(evr({region(1, box(2, 4, 10.0, 20.0), "x", {"fan 1", cells})})), HasSubstr("beam 9: "));
  EXPECT_THAT(refused("EVRG 7 13.0\n1\n"), HasSubstr("the file ends"));
}

// Three pings and eight beams are 24 runs; the second region is one too many.
TEST_F(Import, RegionsOfMoreRunsThanMemoryIsMeantForAreRefused) {
  place_.fan = 2;
  const std::string one = region(1, box(2, 4, 10.0, 20.0), "one");
  const std::string two = region(1, box(2, 4, 30.0, 40.0), "two");
  place_.most_runs = 48;
  EXPECT_EQ(refused(evr({one, two})), "");
  place_.most_runs = 47;
  EXPECT_THAT(refused(evr({one, two})), HasSubstr("region two: the regions up to here hold over 47 runs"));
}

TEST_F(Import, TheJournalIsReadBack) {
  place_.fan = 2;
  // A journal takes texts of one line and of up to 4096 bytes; of two bytes is each letter behind the first.
  std::string letters = "x";
  for (int i = 0; i < 2100; ++i) letters += "\xC3\xA5";
  const Imported imported = read(evr({region(1, box(2, 4, 10.0, 20.0), "north\twall", {"dense\tat", letters}, "a\tb"),
                                      region(2, {{shown_time(1), 5.0}}, "haul\t12", {letters})}));
  EXPECT_THAT(imported.left_out, ElementsAre(HasSubstr("line 4: region north?wall: its text beyond 4096 bytes"),
                                             HasSubstr("region haul?12: its text beyond 4096 bytes")));
  ImportedJournal made;
  made.journal.lines = school_lines(imported.schools[0], sea_.context(), {"someone", kBegin}, 1)->lines;
  const auto journal = parse_journal(journal_text(made.journal), "a.jsonl");
  ASSERT_TRUE(journal.has_value());
  EXPECT_THAT(journal->diagnostics, IsEmpty());
  const JournalState state = fold(effective_lines(journal->lines), {}, sea_.context());
  EXPECT_EQ(told(state), told(carried_out(imported)));
  EXPECT_THAT(state.notes, IsEmpty()) << "every line can be carried out";
  const SchoolRow& row = state.schools.at(0)->masks.decided;
  EXPECT_EQ(std::tuple(row.name, row.species), std::tuple("north wall", "a b"));
  EXPECT_EQ(row.comment, "dense at; " + letters.substr(0, 4085)) << "cut between letters";
  ASSERT_EQ(imported.events.size(), 1U);
  EXPECT_TRUE(act_of(line_of({1, kBegin, "", kBegin, imported.events[0]})).has_value());
}

TEST_F(Import, FilesAreKnownByTheirEndings) {
  Imported imported;
  const auto unknown = import_file("regions.txt", place_, imported, work_);
  ASSERT_FALSE(unknown.has_value());
  EXPECT_THAT(to_line(unknown.error()), HasSubstr("regions.txt: expected a name that ends in .evr"));
  const auto gone = import_file("not-there.EVR", place_, imported, work_);
  ASSERT_FALSE(gone.has_value());
  EXPECT_EQ(gone.error().code, ErrorCode::not_found);
  const auto nowhere = import_place(survey_, "obs-0002");
  ASSERT_FALSE(nowhere.has_value());
  EXPECT_EQ(nowhere.error().text, "no observation obs-0002 in the survey");
}

}  // namespace
}  // namespace sonar
