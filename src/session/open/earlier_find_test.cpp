// SPDX-License-Identifier: Apache-2.0
// Decisions that were made upon what another version found, whose masks lay a little elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/stages/detected_cache.h"
#include "pipeline/stages/observe.h"
#include "session/test_document.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class EarlierFind : public TestDocument {
 protected:
  [[nodiscard]] fs::path find() const {
    return detected_file({folder_ / "found"}, *document_->survey(), observation());
  }
  /// A voxel of the last sample of a school's middle mask, farther out than its own end by so many samples.
  [[nodiscard]] SchoolKey beyond(std::int64_t school_id, const ObservationProduct& product, int samples) const {
    std::vector<const SchoolMask*> masks;
    for (const SchoolMask& mask : product.masks) {
      if (mask.school_id == school_id) masks.push_back(&mask);
    }
    const SchoolMask& middle = *masks[masks.size() / 2];
    const auto last = std::max_element(middle.mask.runs.begin(), middle.mask.runs.end(),
                                       [](const auto& a, const auto& b) { return a.end() < b.end(); });
    return {document_->survey()->ping_time(observation(), static_cast<std::size_t>(middle.ping_index)),
            observation().grid->channel[static_cast<std::size_t>(last->row)], last->end() - 1 + samples};
  }
  void say(const SchoolKey& school, const std::string& species) {
    Decision decision;
    decision.school = school;
    decision.species = species;
    JournalAct act{static_cast<std::int64_t>(lines_.size()) + 1, 0, "someone", school.ping_time,
                   DecideCommand{{decision}, {}}};
    lines_.push_back(line_of(act));
  }
  [[nodiscard]] std::vector<std::string> species() const {
    std::vector<std::string> all;
    for (const auto& school : document_->state(0).schools) all.push_back(school->masks.decided.species);
    return all;
  }
  [[nodiscard]] std::ptrdiff_t notes(DiagnosticCode code) const {
    const Diagnostics& all = document_->state(0).notes;
    return std::count_if(all.begin(), all.end(), [&](const Diagnostic& note) { return note.code == code; });
  }

  std::vector<JournalLine> lines_;
};

TEST_F(EarlierFind, PlacesDecisionsAtEachOpening) {
  open();
  detect();
  const std::size_t schools = document_->state(0).schools.size();
  ASSERT_GE(schools, 2U);
  lines_ = *document_->choices().lines;  // `detect`
  Work work;
  auto older = observe(*document_->survey(), observation(), Recipe{}, {{}, {}, "0.1.0"}, work);
  ASSERT_TRUE(older);
  // Another version's masks reach a few samples farther.
  constexpr int kFarther = 3;
  older->stage_versions = "detect 11";
  older->input_hash = "of another version";
  for (SchoolMask& mask : older->masks) {
    for (sonar::Run& run : mask.mask.runs) run.first_sample += kFarther;
  }
  const std::int64_t first = older->schools[0].school_id;
  const SchoolKey rim = beyond(first, *older, 0);
  EXPECT_FALSE(school_at(document_->state(0), document_->open_observation(0)->context(), rim)) << "nobody's now";
  say(rim, "herring");
  say(beyond(first, *older, 150), "water");
  const fs::path file = find();
  document_.reset();
  keep_detected(file, *older);
  fs::remove(folder_ / "session.jsonl");
  for (const JournalLine& line : lines_) ASSERT_TRUE(append_journal((folder_ / "session.jsonl").string(), {}, line));
  // The second time the find is this version's own.
  for (int opening = 0; opening < 2; ++opening) {
    open();
    ASSERT_EQ(document_->state(0).schools.size(), schools);
    const std::vector<std::string> now = species();
    EXPECT_EQ(now[0], "herring") << opening;
    EXPECT_EQ(std::count(now.begin(), now.end(), ""), static_cast<std::ptrdiff_t>(schools) - 1);
    EXPECT_EQ(notes(DiagnosticCode::decision_carried), 1) << opening;
    EXPECT_EQ(notes(DiagnosticCode::decision_lost), 1) << "open water, as it always was";
  }
}

}  // namespace
}  // namespace sonar
