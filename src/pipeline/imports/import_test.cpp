// SPDX-License-Identifier: Apache-2.0
#include "pipeline/imports/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "io/echoview_text.h"
#include "io/lsss_work.h"
#include "pipeline/imports/import_echoview.h"
#include "pipeline/imports/import_lsss.h"
#include "pipeline/imports/test_import.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

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
