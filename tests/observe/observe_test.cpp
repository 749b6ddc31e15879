// SPDX-License-Identifier: Apache-2.0
// From raw bytes to products, on small synthetic surveys.
#include "pipeline/observe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"
#include "io/simrad/test_bytes.h"
#include "pipeline/compare.h"
#include "pipeline/engine.h"
#include "pipeline/manual.h"
#include "pipeline/survey.h"
#include "synth/beam_table.h"
#include "synth/presets.h"
#include "synth/simulate.h"

namespace sonar {
namespace {

/// One small survey for all tests: 24 pings, two schools, easy water.
class Observe : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() / ("sonar-observe-" + std::to_string(::getpid()));
    synth::SurveyParams params = synth::survey_params(synth::Preset::easy);
    params.observations = 1;
    params.pings = 24;
    params.schools = 2;
    Work work;
    ASSERT_TRUE(synth::simulate_survey(folder_, params, synth::ms70_beams(), false, "test", work));
    const std::vector<std::filesystem::path> paths{folder_};
    auto survey = open_survey(paths, {}, {}, {}, work);
    ASSERT_TRUE(survey);
    survey_ = std::make_unique<SurveyFiles>(std::move(*survey));
    auto product = observe(*survey_, observation(), {}, {{}, {}, "test"}, work);
    ASSERT_TRUE(product);
    product_ = std::make_unique<ObservationProduct>(std::move(*product));
  }
  static void TearDownTestSuite() {
    survey_.reset();
    product_.reset();
    std::filesystem::remove_all(folder_);
  }

  static const ObservationFiles& observation() { return survey_->observations.front(); }

  /// A click on the middle of a school that was found.
  static JournalLine click(GrowMode mode) {
    const SchoolMask& found = product_->masks[product_->masks.size() / 2];
    const auto longest = std::max_element(found.mask.runs.begin(), found.mask.runs.end(),
                                          [](const auto& a, const auto& b) { return a.count < b.count; });
    PropagateCommand command;
    command.mode = mode;
    command.grow.mode = mode;
    command.grow.tolerance_opacity = 0.25;
    const int channel = observation().grid->channel[static_cast<std::size_t>(longest->row)];
    command.seeds = {{channel, longest->first_sample + longest->count / 2}};
    JournalLine line;
    line.n = 1;
    line.decided = 1'600'000'000 * kSecondNs;
    line.operator_name = "someone";
    line.command = "propagate";
    line.ping_time = survey_->ping_time(observation(), static_cast<std::size_t>(found.ping_index));
    line.args = to_json(command);
    return line;
  }

  static ObservationProduct observed(const Recipe& recipe, std::vector<JournalLine> journal) {
    Work work(2);
    auto product = observe(*survey_, observation(), recipe, {{}, journal, "test"}, work);
    EXPECT_TRUE(product);
    return product ? *product : ObservationProduct{};
  }

  static int count(const ObservationProduct& product, DiagnosticCode code) {
    return static_cast<int>(std::count_if(product.diagnostics.begin(), product.diagnostics.end(),
                                          [&](const Diagnostic& note) { return note.code == code; }));
  }

  static inline std::filesystem::path folder_;
  static inline std::unique_ptr<SurveyFiles> survey_;
  static inline std::unique_ptr<ObservationProduct> product_;
};

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
    EXPECT_EQ(first_difference(*product_, *again), "");
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

// Law: what the ship's sentences say nothing of for a while, in the middle or from the start, is no other sea: the same
// schools in the same pings, but no place where there was none.
TEST_F(Observe, AGapInTheNavigationBreaksNoTrack) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [first, last] : {std::pair{9, 15}, std::pair{0, 7}}) {
    ObservationFiles silent = observation();
    for (int i = first; i <= last; ++i) {
      PingNavigation& at = silent.navigation[static_cast<std::size_t>(i)];
      at.transducer = {unknown, unknown};
      at.heading_deg = at.speed_mps = at.course_deg = unknown;
    }
    Work work(2);
    const auto product = observe(*survey_, silent, {}, {{}, {}, "test"}, work);
    ASSERT_TRUE(product);
    EXPECT_EQ(count(*product, DiagnosticCode::dead_reckoned), 1);
    EXPECT_EQ(count(*product_, DiagnosticCode::dead_reckoned), 0);
    ASSERT_EQ(product->school_pings.size(), product_->school_pings.size());
    for (std::size_t i = 0; i < product->school_pings.size(); ++i) {
      const SchoolPingRow& row = product->school_pings[i];
      const SchoolPingRow& whole = product_->school_pings[i];
      EXPECT_EQ(row.school_id, whole.school_id);
      EXPECT_EQ(row.ping_index, whole.ping_index);
      EXPECT_EQ(row.n_voxels, whole.n_voxels);
      EXPECT_DOUBLE_EQ(row.range_m, whole.range_m);
      const bool lost = row.ping_index >= first && row.ping_index <= last;
      for (const double place : {row.latitude, row.longitude, row.bearing_deg, row.axis_deg}) {
        EXPECT_EQ(std::isnan(place), lost) << row.ping_index;
      }
    }
  }
}

// Pings that were made without transmitting are passed over: no rows there, and no track that ends at them.
TEST_F(Observe, SilentPingsAreNeitherMeasuredNorInTheWay) {
  ObservationFiles listening = observation();
  const auto silent = [](std::int64_t ping_index) { return ping_index % 4 == 3; };
  for (std::size_t i = 0; i < listening.navigation.size(); ++i) {
    listening.navigation[i].bad = silent(static_cast<std::int64_t>(i));
  }
  Work work(2);
  const auto product = observe(*survey_, listening, {}, {{}, {}, "test"}, work);
  ASSERT_TRUE(product);
  EXPECT_EQ(product->schools.size(), product_->schools.size());
  std::map<std::int64_t, std::size_t> rows;
  for (const SchoolPingRow& row : product->school_pings) {
    EXPECT_FALSE(silent(row.ping_index));
    ++rows[row.ping_index];
  }
  std::map<std::int64_t, std::size_t> heard;
  for (const SchoolPingRow& row : product_->school_pings) {
    if (!silent(row.ping_index)) ++heard[row.ping_index];
  }
  EXPECT_EQ(rows, heard);
  Recipe by_hand;
  by_hand.automatic = false;
  for (const GrowMode mode : {GrowMode::tracked, GrowMode::paper}) {
    JournalLine line = click(mode);
    const auto clicked = ping_at(*survey_, listening, line.ping_time);
    ASSERT_TRUE(clicked);
    for (std::size_t i = 0; i < listening.navigation.size(); ++i) {
      listening.navigation[i].bad = static_cast<std::int64_t>(i) == *clicked + 1;
    }
    const auto carried = observe(*survey_, listening, by_hand, {{}, {&line, 1}, "test"}, work);
    ASSERT_TRUE(carried);
    const auto has = [&](std::int64_t ping_index) {
      return std::any_of(carried->masks.begin(), carried->masks.end(),
                         [&](const SchoolMask& mask) { return mask.ping_index == ping_index; });
    };
    EXPECT_TRUE(has(*clicked));
    EXPECT_FALSE(has(*clicked + 1));
    EXPECT_TRUE(has(*clicked + 2));
  }
}

// By hand from each row of the stabilised sonar: its place relative to the ship, turned by a roll of 5 degrees port up and
// a pitch of 0, has the depth and the bearing that a hull-fixed sonar with the same samples must tell.
TEST_F(Observe, BeamsThatAreNotStabilisedTurnWithTheShip) {
  constexpr double roll = 5.0 * std::numbers::pi / 180.0;
  ObservationFiles rolled = observation();
  for (PingNavigation& at : rolled.navigation) {
    at.roll_deg = 5.0;
    at.pitch_deg = 0.0;
  }
  Recipe hull;
  hull.navigation.beams_stabilised = false;
  Work work(2);
  const auto stabilised = observe(*survey_, rolled, {}, {{}, {}, "test"}, work);
  const auto fixed = observe(*survey_, rolled, hull, {{}, {}, "test"}, work);
  ASSERT_TRUE(stabilised && fixed);
  ASSERT_EQ(fixed->school_pings.size(), stabilised->school_pings.size());
  for (std::size_t i = 0; i < fixed->school_pings.size(); ++i) {
    const SchoolPingRow& was = stabilised->school_pings[i];
    const SchoolPingRow& is = fixed->school_pings[i];
    const PingNavigation& at = rolled.navigation[static_cast<std::size_t>(was.ping_index)];
    const double down = was.depth_m - at.transducer_depth_m;
    const double level = std::sqrt(was.range_m * was.range_m - down * down);
    const double bow = level * std::cos(rad_from_deg(was.bearing_deg - at.heading_deg));
    const double starboard = level * std::sin(rad_from_deg(was.bearing_deg - at.heading_deg));
    const double rolled_starboard = starboard * std::cos(roll) - down * std::sin(roll);
    EXPECT_DOUBLE_EQ(is.range_m, was.range_m);
    EXPECT_NEAR(is.depth_m, at.transducer_depth_m + starboard * std::sin(roll) + down * std::cos(roll), 1e-6);
    EXPECT_NEAR(wrap_180(is.bearing_deg - at.heading_deg - deg_from_rad(std::atan2(rolled_starboard, bow))), 0.0, 1e-6);
    EXPECT_EQ(is.n_voxels, was.n_voxels);
  }
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
    EXPECT_EQ(first_difference(once, twice), "");
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
  line.args = to_json(command);
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
  line.args["seeds"][0]["sample"] = 0;  // the transducer's ringing
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
  for (const SampleFlags flags : ping->sv.flags.view().row(row)) ASSERT_TRUE(any(flags & SampleFlags::lost));
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

TEST_F(Observe, PingThatCannotBeReadAgainIsBadAndNoted) {
  const test::TemporaryFolder folder;
  const std::filesystem::path raw = folder.path() / "survey.raw";
  for (const auto& file : std::filesystem::directory_iterator(folder_)) {
    if (file.path().extension() == ".raw") std::filesystem::copy_file(file.path(), raw);
  }
  Work work(2);
  const std::vector<std::filesystem::path> paths{raw};
  const auto survey = open_survey(paths, {}, {}, {}, work);
  ASSERT_TRUE(survey);
  const ObservationFiles& whole = survey->observations.at(0);
  ASSERT_EQ(whole.pings.size(), 24U);
  std::filesystem::resize_file(raw, survey->entry(whole.pings[20]).offset);  // after the index was made
  const auto product = observe(*survey, whole, {}, {{}, {}, "test"}, work);
  ASSERT_TRUE(product);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(product->pings[i].bad, i >= 20) << "ping " << i;
  EXPECT_EQ(count(*product, DiagnosticCode::ping_unreadable), 4);
  EXPECT_EQ(count(*product, DiagnosticCode::unreadable), 0);
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
