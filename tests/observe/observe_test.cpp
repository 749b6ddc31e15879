// SPDX-License-Identifier: Apache-2.0
// From raw bytes to products, on small synthetic surveys.
#include "pipeline/stages/observe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"
#include "io/simrad/test_bytes.h"
#include "observed_survey.h"
#include "pipeline/journal/manual.h"
#include "pipeline/stages/detect_pings.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/ping_schools.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/compare.h"

namespace sonar {
namespace {

using Observe = test::ObservedSurvey;

TEST_F(Observe, FindsTheSchoolsAndNotesTheirBirths) {
  EXPECT_EQ(product_->schools.size(), 2U);
  EXPECT_GE(count(*product_, DiagnosticCode::track_event), 2);
  for (const SchoolPingRow& row : product_->school_pings) {
    EXPECT_LE(row.valid_fraction, 1.0);
    EXPECT_GT(row.snr_db, 0.0);
  }
}

TEST_F(Observe, AnyNumberOfThreadsGivesTheSameProduct) {
  for (const int threads : {1, 2, 5}) {
    Work work(threads);
    const auto again = observe(*survey_, observation(), {}, {{}, {}, "test"}, work);
    ASSERT_TRUE(again);
    EXPECT_EQ(compare_products(*product_, *again).difference, "");
  }
}

TEST_F(Observe, PingsInAnyOrderAreTheSamePings) {
  Work work(1);
  Engine forwards(*survey_, observation(), {});
  Engine backwards(*survey_, observation(), {});
  ASSERT_TRUE(forwards.estimate_background(0, forwards.pings() - 1, work));
  ASSERT_TRUE(backwards.estimate_background(0, backwards.pings() - 1, work));
  std::vector<Array3<std::int16_t>> filtered;
  for (std::int64_t i = 0; i < forwards.pings(); ++i) filtered.push_back(forwards.staged(i)->filtered->counts);
  for (std::int64_t i = backwards.pings() - 1; i >= 0; --i) {
    EXPECT_EQ(backwards.staged(i)->filtered->counts, filtered[static_cast<std::size_t>(i)]) << "ping " << i;
  }
}

TEST_F(Observe, APingAloneShowsWhatDetectionFindsThereInTheWholeObservation) {
  Work work(2);
  Engine engine(*survey_, observation(), {});
  ASSERT_TRUE(engine.estimate_background(0, engine.pings() - 1, work));
  ObservationProduct product = *product_;
  const auto whole = detect_pings(engine, {0, engine.pings() - 1}, product, work);
  ASSERT_EQ(whole.size(), static_cast<std::size_t>(engine.pings()));
  std::size_t found = 0;
  for (const std::int64_t ping : {0, 7, 8, 23}) {  // at both ends, and where one group of pings meets the next
    const auto& expected = whole[static_cast<std::size_t>(ping)].detections;
    const auto ready = PingBeforeDetection::of(*survey_, observation(), {}, ping, work);
    ASSERT_TRUE(ready);
    const auto alone = (*ready)->schools({});
    ASSERT_EQ(alone.size(), expected.size()) << ping;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(alone[i].mask, expected[i].mask) << ping;
      EXPECT_EQ(alone[i].volume_m3, expected[i].volume_m3) << ping;
    }
    found += expected.size();
  }
  EXPECT_GT(found, 0U);
  work.cancel();
  const auto stopped = PingBeforeDetection::of(*survey_, observation(), {}, 7, work);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST_F(Observe, PingsThatWereLeftOutAreTold) {
  Work work(2);
  EXPECT_EQ(count(*product_, DiagnosticCode::pings_left_out), 0);
  const auto part = observe(*survey_, observation(), {}, {PingSelection{1, 2}, {}, "test"}, work);
  ASSERT_TRUE(part);
  EXPECT_EQ(count(*part, DiagnosticCode::pings_left_out), 1);
  const auto again = remeasure(*survey_, observation(), *part, {}, {PingSelection{1, 2}, {}, "test"}, work);
  ASSERT_TRUE(again);
  EXPECT_EQ(count(*again, DiagnosticCode::pings_left_out), 1);
}

TEST_F(Observe, RemeasuringUnderTheSameRecipeChangesNothing) {
  Work work(2);
  const auto again = remeasure(*survey_, observation(), *product_, {}, {{}, {}, "test"}, work);
  ASSERT_TRUE(again);
  ASSERT_EQ(again->school_pings.size(), product_->school_pings.size());
  for (std::size_t i = 0; i < again->school_pings.size(); ++i) {
    EXPECT_EQ(again->school_pings[i].sv_mean_db, product_->school_pings[i].sv_mean_db);
    EXPECT_EQ(again->school_pings[i].backscatter_m2, product_->school_pings[i].backscatter_m2);
  }
}

TEST_F(Observe, OneDecibelMoreGainIsTwoDecibelsLessSv) {
  Recipe louder;
  for (const BeamConfig& beam : observation().config.beams) {
    const auto channel = static_cast<int>(louder.calibration.beams.size());
    louder.calibration.beams.push_back({channel, beam.gain_db + 1.0, kUnknown, kUnknown});
  }
  Work work(2);
  const auto again = remeasure(*survey_, observation(), *product_, louder, {{}, {}, "test"}, work);
  ASSERT_TRUE(again);
  // Background is subtracted in the same step, so the law holds to the rounding of one count.
  for (std::size_t i = 0; i < again->school_pings.size(); ++i) {
    EXPECT_NEAR(again->school_pings[i].sv_mean_db, product_->school_pings[i].sv_mean_db - 2.0, 0.012);
  }
}

TEST_F(Observe, ClickIsReplayedFromItsJournalLine) {
  for (const GrowMode mode : {GrowMode::tracked, GrowMode::paper}) {
    Recipe recipe;
    recipe.automatic = false;
    const ObservationProduct once = observed(recipe, {click(mode)});
    const ObservationProduct twice = observed(recipe, {click(mode)});
    ASSERT_EQ(once.schools.size(), 1U);
    EXPECT_EQ(once.schools[0].origin, "manual");
    EXPECT_EQ(once.schools[0].operator_name, "someone");
    EXPECT_EQ(compare_products(once, twice).difference, "");
    EXPECT_EQ(count(once, DiagnosticCode::decision_lost), 0);
    EXPECT_GE(count(once, DiagnosticCode::propagation_ended), 1);
  }
}

/// Masks of an observation's manual schools by ping time: what a journal stands for, whatever things are called.
std::map<TimeNs, PingMask> manual_masks(const SurveyFiles& survey, std::span<const JournalLine> journal) {
  Recipe recipe;
  recipe.automatic = false;
  Work work(2);
  std::map<TimeNs, PingMask> masks;
  for (const ObservationFiles& in : survey.observations) {
    const auto product = observe(survey, in, recipe, {{}, journal, "test"}, work);
    EXPECT_TRUE(product);
    if (!product) continue;
    for (const SchoolMask& mask : product->masks) {
      masks[survey.ping_time(in, static_cast<std::size_t>(mask.ping_index))] = mask.mask;
    }
  }
  return masks;
}

TEST_F(Observe, ChoicesStayOnTheirPingsWhateverHappensToTheFiles) {
  namespace fs = std::filesystem;
  synth::SurveyParams params = synth::survey_params(synth::Preset::easy);
  params.observations = 2;
  params.pings = 16;
  params.schools = 2;
  const fs::path all = folder_ / "two";
  Work work(2);
  ASSERT_TRUE(synth::simulate_survey(all, params, synth::ms70_beams(), false, "test", work));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(all)) {
    if (entry.path().extension() == ".raw") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  ASSERT_EQ(files.size(), 2U);
  const auto open = [&](const std::vector<fs::path>& paths) { return *open_survey(paths, {}, {}, {}, work); };

  const SurveyFiles later = open({files[1]});  // the first file is not there yet
  const auto found = observe(later, later.observations.front(), {}, {{}, {}, "test"}, work);
  ASSERT_TRUE(found);
  ASSERT_FALSE(found->masks.empty());
  const SchoolMask& mask = found->masks.front();
  const auto longest = std::max_element(mask.mask.runs.begin(), mask.mask.runs.end(),
                                        [](const auto& a, const auto& b) { return a.count < b.count; });
  PropagateCommand command;
  command.seeds = {{later.observations.front().grid->channel[static_cast<std::size_t>(longest->row)],
                    longest->first_sample + longest->count / 2}};
  JournalLine line;
  line.n = 1;
  line.command = "propagate";
  line.ping_time = later.ping_time(later.observations.front(), static_cast<std::size_t>(mask.ping_index));
  *line.args = to_json(command);
  const std::vector<JournalLine> journal{line};
  const auto expected = manual_masks(later, journal);
  ASSERT_FALSE(expected.empty());

  EXPECT_EQ(manual_masks(open(files), journal), expected);  // a file came in before: the observation is obs-0002 now
  const fs::path renamed = all / "another name.raw";
  fs::copy_file(files[1], renamed);
  EXPECT_EQ(manual_masks(open({files[0], files[1], renamed}), journal), expected);  // and a duplicate
  fs::remove(files[1]);
  EXPECT_EQ(manual_masks(open({files[0], renamed}), journal), expected);  // and under its new name alone
}

TEST_F(Observe, DetectionNeverTakesAHumansVoxel) {
  const ObservationProduct both = observed({}, {click(GrowMode::tracked)});
  ASSERT_GE(both.schools.size(), 2U);
  for (const SchoolMask& a : both.masks) {
    for (const SchoolMask& b : both.masks) {
      if (a.ping_index != b.ping_index || a.school_id >= b.school_id) continue;
      EXPECT_EQ(overlap(a.mask, b.mask), 0U);
    }
  }
}

TEST_F(Observe, ChoiceThatDoesNotHoldIsListedAndNeverMoved) {
  JournalLine line = click(GrowMode::tracked);
  (*line.args)["seeds"][0]["sample"] = 0;  // the transducer's ringing
  JournalLine unknown = click(GrowMode::tracked);
  unknown.command = "paint";
  Recipe recipe;
  recipe.automatic = false;
  const ObservationProduct product = observed(recipe, {line, unknown});
  EXPECT_TRUE(product.schools.empty());
  EXPECT_EQ(count(product, DiagnosticCode::decision_lost), 2);
}

TEST_F(Observe, ChannelWithoutCalibrationIsNotedAndNotUsed) {
  Recipe recipe;
  ObservationFiles altered = observation();
  altered.config.beams[7].gain_db = kUnknown;
  altered.config.beams[7].pulse_length_s = {};
  Work work(2);
  const auto product = observe(*survey_, altered, recipe, {{}, {}, "test"}, work);
  ASSERT_TRUE(product);
  EXPECT_EQ(count(*product, DiagnosticCode::not_calibrated), 1);
  Engine engine(*survey_, altered, recipe);
  ASSERT_TRUE(engine.estimate_background(0, 0, work));
  const auto ping = engine.staged(0);
  ASSERT_TRUE(ping);
  const int row = altered.grid->row_of_channel()[7];
  for (const SampleFlags flags : ping->sv.flags.view().row(row)) ASSERT_TRUE(any(flags & SampleFlags::dropout));
  for (const std::int16_t sv : ping->sv.counts.view().row(row)) ASSERT_EQ(sv, kNoData);
}

TEST_F(Observe, CalibrationOfAChannelThatIsNotThereIsNoted) {
  Recipe recipe;
  recipe.calibration.beams.push_back({700, 20.0, kUnknown, kUnknown});
  Work work(2);
  const auto product = observe(*survey_, observation(), recipe, {PingSelection{0, 0}, {}, "test"}, work);
  ASSERT_TRUE(product);
  ASSERT_EQ(count(*product, DiagnosticCode::calibration_unused), 1);
  EXPECT_EQ(count(*product, DiagnosticCode::not_calibrated), 0);
  for (const Diagnostic& note : product->diagnostics) {
    if (note.code != DiagnosticCode::calibration_unused) continue;
    EXPECT_THAT(note.text, testing::HasSubstr("names channel 700, the grid has 0 to 499"));
  }
}

TEST_F(Observe, OneFanShowsNoSchoolsAndSaysWhy) {
  const test::TemporaryFolder folder;
  test::Con0Spec one_fan;
  for (const float azimuth : {-2.5F, 0.0F, 2.5F}) one_fan.beams.push_back({100'000.0F, -10.0F, azimuth, 20.0F});
  test::Bytes bytes = test::con0(one_fan);
  for (int channel = 1; channel <= 3; ++channel) bytes.add(test::raw0(test::kStart, {.channel = channel}, {1, 2, 3}));
  folder.write("one fan.raw", bytes);
  Work work(1);
  const std::vector<std::filesystem::path> paths{folder.path()};
  const auto survey = open_survey(paths, {}, {}, {}, work);
  ASSERT_TRUE(survey);
  const auto product = observe(*survey, survey->observations.at(0), {}, {{}, {}, "test"}, work);
  ASSERT_TRUE(product);
  EXPECT_TRUE(product->schools.empty());
  ASSERT_EQ(count(*product, DiagnosticCode::grid_too_small), 1);
  EXPECT_EQ(count(*product, DiagnosticCode::no_grid), 0);
  EXPECT_EQ(count(*product_, DiagnosticCode::grid_too_small), 0);
}

TEST_F(Observe, JudgesThatAreLeftOutAreNotAsked) {
  Recipe strict;
  strict.detect.size.min_fans = 15;  // no school is so high ...
  Recipe patient;
  patient.track.confirmation = {.pings = 100, .window = 100};  // ... or is seen so often
  for (const auto& [recipe, judge] : {std::pair{strict, "size"}, std::pair{patient, "confirmation"}}) {
    Work work(2);
    const auto asked = observe(*survey_, observation(), recipe, {{}, {}, "test"}, work);
    ASSERT_TRUE(asked);
    EXPECT_TRUE(asked->schools.empty()) << judge;
    Recipe without = recipe;
    without.detect.left_out = judge;
    const auto left_out = observe(*survey_, observation(), without, {{}, {}, "test"}, work);
    ASSERT_TRUE(left_out);
    EXPECT_GE(left_out->schools.size(), product_->schools.size()) << judge;
  }
}

TEST_F(Observe, CancelledWorkGivesNoProduct) {
  Work work(2);
  work.cancel();
  const auto product = observe(*survey_, observation(), {}, {{}, {}, "test"}, work);
  ASSERT_FALSE(product);
  EXPECT_EQ(product.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace sonar
