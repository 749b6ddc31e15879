// SPDX-License-Identifier: Apache-2.0
// A survey that is opened again has its schools' figures from beside its journal.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "model/school.h"
#include "pipeline/stages/detected_cache.h"
#include "pipeline/stages/measured_pings.h"
#include "pipeline/stages/observe.h"
#include "session/test_document.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// Rows as text: what is unknown equals what is unknown.
struct RowsAsText {
  std::string text;
  void operator()(std::string_view name, std::string_view, const auto& value) {
    text += fmt::format("{}={} ", name, value);
  }
  void operator()(std::string_view name, std::string_view, TimeColumn c) { (*this)(name, "", c.value); }
  void operator()(std::string_view name, std::string_view, DegreesColumn c) { (*this)(name, "", c.value); }
};
template <class Row>
std::string text_of(std::vector<Row> rows) {
  RowsAsText out;
  for (Row& row : rows) columns(out, row);
  return out.text;
}

class KeptMeasures : public TestDocument {
 protected:
  [[nodiscard]] fs::path file() const {
    return measured_file({folder_ / "found"}, *document_->survey(), observation());
  }
  [[nodiscard]] std::string key() const {
    Recipe recipe = document_->measuring_recipe();
    recipe.automatic = true;
    return observation_key(*document_->survey(), observation(), recipe, {{}, {}, "test"});
  }
  [[nodiscard]] std::vector<SchoolPingRow> rows() const { return document_->product(0)->school_pings; }
};

TEST_F(KeptMeasures, AreTheSameAfterReopening) {
  open();
  detect();
  const ObservationProduct before = *document_->product(0);
  ASSERT_FALSE(before.school_pings.empty());
  open();
  const ObservationProduct& after = *document_->product(0);
  EXPECT_EQ(text_of(after.school_pings), text_of(before.school_pings));
  EXPECT_EQ(text_of(after.schools), text_of(before.schools));
  ASSERT_EQ(after.masks.size(), before.masks.size());
  for (std::size_t i = 0; i < after.masks.size(); ++i) EXPECT_EQ(after.masks[i].fault, before.masks[i].fault);
}

TEST_F(KeptMeasures, AreTakenInPlaceOfMeasuring) {
  open();
  detect();
  const fs::path kept_in = file();
  const std::string under = key();
  open();
  document_.reset();
  MeasuredPings kept = kept_measured(kept_in, under);
  ASSERT_FALSE(kept.pings.empty());
  // Nobody measures such a value.
  for (auto& [ping_index, ping] : kept.pings) {
    for (MeasuredMask& mask : ping.second) mask.school.row.snr_db = 123.25;
  }
  keep_measured(kept_in, under, kept);
  open();
  ASSERT_FALSE(rows().empty());
  for (const SchoolPingRow& row : rows()) EXPECT_EQ(row.snr_db, 123.25) << row.ping_index;
}

TEST_F(KeptMeasures, OfPingsWhoseMasksHaveChangedSinceAreMeasured) {
  open();
  detect();
  const fs::path kept_in = file();
  const std::string under = key();
  document_.reset();
  MeasuredPings kept = kept_measured(kept_in, under);
  ASSERT_GE(kept.pings.size(), 2U);
  auto& [changed, ping] = *kept.pings.begin();
  for (MeasuredMask& mask : ping.second) mask.school.row.snr_db = 123.25;
  ++ping.first.low;
  keep_measured(kept_in, under, kept);
  open();
  for (const SchoolPingRow& row : rows()) EXPECT_NE(row.snr_db, 123.25) << row.ping_index;
}

TEST_F(KeptMeasures, OfAPingAreMeasuredAnewOnceAHumanErasesThere) {
  open();
  detect();
  ASSERT_TRUE(document_->shown());
  const SchoolMask mask = document_->product(0)->masks.at(document_->product(0)->masks.size() / 2);
  const auto row_of_mask = [&] {
    const auto all = rows();
    const auto found = std::find_if(all.begin(), all.end(), [&](const SchoolPingRow& row) {
      return row.school_id == mask.school_id && row.ping_index == mask.ping_index;
    });
    return found == all.end() ? SchoolPingRow{} : *found;
  };
  const sonar::Run run = mask.mask.runs.at(0);
  ASSERT_EQ(row_of_mask().n_voxels, static_cast<std::int64_t>(mask.mask.voxels()));
  const auto& channels = document_->shown()->grid().channel;
  document_->act(mask.ping_index,
                 EraseCommand{{{channels[static_cast<std::size_t>(run.row)], run.first_sample, run.count}}, {}});
  document_->settle();
  EXPECT_EQ(row_of_mask().n_voxels, static_cast<std::int64_t>(mask.mask.voxels()) - run.count);
}

TEST_F(KeptMeasures, ThatAreDamagedOrOfAnotherRecipeAreMeasuredAnew) {
  open();
  detect();
  const std::vector<SchoolPingRow> before = rows();
  const fs::path kept_in = file();
  const std::string under = key();
  document_.reset();
  EXPECT_TRUE(kept_measured(kept_in, "of another recipe").pings.empty());
  std::fstream(kept_in, std::ios::in | std::ios::out | std::ios::binary).seekp(400).put('\x55');
  EXPECT_TRUE(kept_measured(kept_in, under).pings.empty());
  open();
  EXPECT_EQ(text_of(rows()), text_of(before));
}

TEST_F(KeptMeasures, OfAnEarlierVersionAreTakenFromTheCache) {
  open();
  detect();
  const fs::path kept_in = file();
  const fs::path earlier = folder_ / "cache" / kept_in.filename();
  document_.reset();
  ASSERT_TRUE(fs::exists(kept_in));
  EXPECT_FALSE(fs::exists(earlier)) << "one place is enough";
  fs::rename(kept_in, earlier);
  open();
  document_.reset();
  EXPECT_FALSE(fs::exists(kept_in)) << "nothing had to be measured";
}

TEST_F(KeptMeasures, WithoutAJournalAreKeptInTheCache) {
  DocumentOptions without = options();
  without.journal_folders = [](const auto&) { return std::vector<fs::path>{}; };
  open(without);
  detect();
  EXPECT_TRUE(fs::exists(detected_file(without.cache, *document_->survey(), observation())));
}

}  // namespace
}  // namespace sonar
