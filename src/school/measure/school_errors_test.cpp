// SPDX-License-Identifier: Apache-2.0
#include "school/measure/school_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

#include "base/units.h"
#include "school/grow/grow.h"
#include "school/measure/cell_steps.h"
#include "school/measure/correct_sizes.h"
#include "school/measure/fading_field.h"
#include "school/measure/measure.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

double error_of(const FigureValues& errors, std::string_view figure) { return errors.at(error_at(figure)); }

constexpr std::size_t kBackscatter = error_at("backscatter_m2");
constexpr std::size_t kCorrectedVolume = error_at("volume_corrected_m3");

SchoolPingRow row_of(double volume_m3) {
  SchoolPingRow row;
  row.volume_m3 = volume_m3;
  row.length_m = 40.0;
  row.depth_m = 60.0;
  row.sv_mean_db = -45.0;
  row.backscatter_m2 = 0.5;
  row.horizontal_range_m = 200.0;
  return row;
}

Repeats unchanged(const SchoolPingRow& row) {
  const FigureValues figures = figures_of(row);
  Repeats repeats(kFadings + 3);
  for (std::size_t k = 0; k < kFadings + 2; ++k) {
    for (std::size_t i = 0; i < kErrorCount; ++i) repeats[k][i] = static_cast<float>(figures[i]);
    repeats[k][kCorrectedVolume] = 1.0F;  // its share of the mean
  }
  return repeats;  // no steps
}

// By hand: 0.5 % of sound speed is 1.5 % of a volume; 200 m x 0.5 degrees are 1.745 m of depth.
TEST(SchoolErrors, WhatIsAlikeInAllPingsIsNotMadeSmallerByThem) {
  for (const std::size_t pings : {std::size_t{1}, std::size_t{9}}) {
    const std::vector<SchoolPingRow> rows(pings, row_of(1000.0));
    const Repeats one = unchanged(rows.front());
    const std::vector<const Repeats*> repeats(pings, &one);
    const FigureValues errors = school_errors(rows, repeats, {}, {});
    EXPECT_NEAR(error_of(errors, "volume_m3"), 15.0, 1e-3);
    EXPECT_NEAR(error_of(errors, "length_m"), 0.2, 1e-5);
    EXPECT_NEAR(error_of(errors, "sv_mean_db"), std::hypot(0.5, 10.0 * std::log10(1.005)), 1e-5);
    EXPECT_NEAR(error_of(errors, "depth_m"), std::hypot(0.3, 200.0 * 0.5 * std::numbers::pi / 180.0), 1e-4);
    EXPECT_TRUE(std::isnan(error_of(errors, "surface_m2"))) << "a figure that is unknown has no error";
  }
}

// Deviations +-1 in turn: 16 of them have the deviation sqrt(16 / 15); widened for their number. The threshold adds half of 6.
TEST(SchoolErrors, FadingAndThresholdAddInQuadrature) {
  const std::vector<SchoolPingRow> rows{row_of(1000.0)};
  Repeats one = unchanged(rows.front());
  for (std::size_t k = 0; k < kFadings; ++k) one[k][1] += k % 2 == 0 ? 1.0F : -1.0F;
  one[kFadings][1] = 1003.0F;
  one[kFadings + 1][1] = 997.0F;
  const std::vector<const Repeats*> repeats{&one};
  ErrorParams params;
  params.sound_speed_percent = 0.0;
  const double fading = std::sqrt(16.0 / 15.0) * 2.1314 / 1.95996;
  EXPECT_NEAR(error_of(school_errors(rows, repeats, {}, params), "volume_m3"), std::hypot(fading, 3.0), 1e-3);
  const Repeats none;
  const std::vector<const Repeats*> unknown{&none};
  EXPECT_TRUE(std::isnan(error_of(school_errors(rows, unknown, {}, params), "volume_m3")))
      << "it was not measured again";
}

ErrorParams nothing_alike() {
  ErrorParams params;
  params.threshold_db = params.calibration_db = params.sound_speed_percent = params.tilt_deg = 0.0;
  return params;
}

/// Its corrected volume is 500 m^3.
SchoolPingRow corrected_row() {
  SchoolPingRow row = row_of(1000.0);
  row.volume_corrected_m3 = 500.0;
  return row;
}

// 0.5 % of sound speed is 1.5 % of a volume, corrected or not, and as much of sv as of the mean Sv.
TEST(SchoolErrors, CorrectedSizesThatStandStillErrOnlyByWhatIsAlike) {
  const std::vector<SchoolPingRow> rows(9, corrected_row());
  const Repeats one = unchanged(rows.front());
  const std::vector<const Repeats*> repeats(rows.size(), &one);
  const FigureValues still = school_errors(rows, repeats, {}, nothing_alike());
  EXPECT_EQ(error_of(still, "volume_corrected_m3"), 0.0);
  EXPECT_EQ(error_of(still, "sv_corrected_db"), 0.0);
  const FigureValues alike = school_errors(rows, repeats, {}, {});
  EXPECT_NEAR(error_of(alike, "volume_corrected_m3"), 7.5, 1e-6);
  EXPECT_NEAR(error_of(alike, "sv_corrected_db"), std::hypot(0.5, 10.0 * std::log10(1.005)), 1e-6);
}

// By hand: shares of 1.1 and 0.9 in turn, whose dB lie (0.4139 + 0.4576) / 2 to both sides of their mean. Where the echo scatters
// with the volume, their ratio does not.
TEST(SchoolErrors, CorrectedSvErrsByTheRatioOfEchoAndVolume) {
  const std::vector<SchoolPingRow> rows{corrected_row()};
  Repeats one = unchanged(rows.front());
  const auto share = [](std::size_t k) { return k % 2 == 0 ? 1.1F : 0.9F; };
  for (std::size_t k = 0; k < kFadings; ++k) one[k][kCorrectedVolume] = share(k);
  const std::vector<const Repeats*> repeats{&one};
  const double widened = std::sqrt(16.0 / 15.0) * 2.1314 / 1.95996;
  const FigureValues alone = school_errors(rows, repeats, {}, nothing_alike());
  EXPECT_NEAR(error_of(alone, "volume_corrected_m3"), 50.0 * widened, 1e-4);
  EXPECT_NEAR(error_of(alone, "sv_corrected_db"), 5.0 * std::log10(1.1 / 0.9) * widened, 1e-5);
  EXPECT_EQ(error_of(alone, "backscatter_m2"), 0.0);
  for (std::size_t k = 0; k < kFadings; ++k) one[k][kBackscatter] *= share(k);
  const FigureValues together = school_errors(rows, repeats, {}, nothing_alike());
  EXPECT_NEAR(error_of(together, "sv_corrected_db"), 0.0, 1e-5);
  EXPECT_NEAR(error_of(together, "backscatter_m2"), 0.05 * widened, 1e-6);
}

// The echo is of the pings that know a corrected volume: one whose looks hide it still gives its echo.
TEST(SchoolErrors, LooksThatHideTheCorrectedVolumeLeaveTheErrorOfTheEcho) {
  std::vector<SchoolPingRow> rows(2, corrected_row());
  rows[1].backscatter_m2 = 2.0;
  std::vector<Repeats> seen{unchanged(rows[0]), unchanged(rows[1])};
  for (std::size_t k = 0; k < kFadings; ++k) seen[k % 2][k][kBackscatter] *= 1.3F;
  const std::vector<const Repeats*> repeats{&seen[0], &seen[1]};
  const FigureValues known = school_errors(rows, repeats, {}, {});
  for (auto& look : seen[1]) look[kCorrectedVolume] = static_cast<float>(kUnknown);
  const FigureValues hidden = school_errors(rows, repeats, {}, {});
  EXPECT_TRUE(std::isnan(error_of(hidden, "volume_corrected_m3")));
  EXPECT_TRUE(std::isnan(error_of(hidden, "sv_corrected_db")));
  EXPECT_EQ(error_of(hidden, "backscatter_m2"), error_of(known, "backscatter_m2"));
  for (SchoolPingRow& row : rows) row.volume_corrected_m3 = kUnknown;
  EXPECT_TRUE(std::isnan(error_of(school_errors(rows, repeats, {}, {}), "volume_corrected_m3")));
}

// No repeat moves the length, whose cell is 8 m: a step that came in none of 16 comes 0.5 times in 17.
TEST(SchoolErrors, WhatStoodStillByWholeCellsHasAnErrorYet) {
  const std::vector<SchoolPingRow> rows{row_of(1000.0)};
  Repeats one = unchanged(rows.front());
  one.back().fill(8.0F);
  const std::vector<const Repeats*> repeats{&one};
  ErrorParams params;
  params.sound_speed_percent = 0.0;
  EXPECT_NEAR(error_of(school_errors(rows, repeats, {}, params), "length_m"), 8.0 * std::sqrt(0.5 / 17.0 * 16.5 / 17.0),
              1e-5);
  const std::vector<SchoolPingRow> four(4, row_of(1000.0));
  Repeats few = one;
  few.erase(few.begin() + 5, few.begin() + kFadings);
  const std::vector<const Repeats*> all(4, &few);
  EXPECT_NEAR(error_of(school_errors(four, all, {}, params), "length_m"),
              8.0 * std::sqrt(0.5 / 21.0 * 20.5 / 21.0 / 4.0), 1e-5);
}

// Pings that are cut are not in the school's figures, and do not make their errors smaller.
TEST(SchoolErrors, CutPingsDoNotShareTheStepsOfAWholeOne) {
  std::vector<SchoolPingRow> rows(4, row_of(1000.0));
  for (std::size_t i = 1; i < rows.size(); ++i) rows[i].touches_edge = 1;
  Repeats one = unchanged(rows.front());
  one.back().fill(8.0F);
  const Repeats none;
  const std::vector<const Repeats*> repeats{&one, &none, &none, &none};
  ErrorParams params;
  params.sound_speed_percent = 0.0;
  EXPECT_NEAR(error_of(school_errors(rows, repeats, {}, params), "length_m"), 8.0 * std::sqrt(0.5 / 17.0 * 16.5 / 17.0),
              1e-5);
}

// The school's is the fourth's, for which the third stands: what is rounded between the two is no scatter.
TEST(SchoolErrors, AShareThatStandsStillHasNone) {
  std::vector<SchoolPingRow> rows(7, row_of(1000.0));
  std::vector<Repeats> repeats(rows.size());
  std::vector<const Repeats*> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].vacuole_fraction = 0.02 + 0.007 * static_cast<double>(i);
    if (fadings_of_ping(i, rows.size()) > 0) repeats[i] = unchanged(rows[i]);
    all.push_back(&repeats[i]);
  }
  EXPECT_TRUE(repeats[3].empty());
  EXPECT_TRUE(std::isnan(error_of(school_errors(rows, all, {}, {}), "vacuole_fraction")));
}

// 150 m off at 30 degrees down and abeam, school along the ship: cells of 2.5 degrees of azimuth, 45 / 19 of elevation, 0.3776 m.
TEST(SchoolErrors, StepsAreTheCellsEdges) {
  test::MeasuredPing scene;
  test::Ellipsoid body;
  body.centre = Sector::direction(rad_from_deg(-45.0 + 6.0 * 45.0 / 19.0), rad_from_deg(270.0)) * 150.0;
  body.half_x = 25.0;
  scene.add(body);
  SchoolPingRow row = scene.measured(1, false);
  row.axis_deg = 0.0;
  MeasureInput in;
  in.sector = &scene.sector;
  in.placement = scene.placement;
  const FigureValues steps = cell_steps(in, scene.mask, row);
  const double down = rad_from_deg(45.0 - 6.0 * 45.0 / 19.0);
  const double range = row.range_m;
  EXPECT_NEAR(error_of(steps, "length_m") / (range * std::cos(down) * rad_from_deg(2.5)), 1.0, 0.01);
  const double fan = range * rad_from_deg(45.0 / 19.0);
  EXPECT_NEAR(error_of(steps, "height_m") / std::hypot(fan * std::cos(down), 0.3776 * std::sin(down)), 1.0, 0.01);
  EXPECT_NEAR(error_of(steps, "width_m") / std::hypot(fan * std::sin(down), 0.3776 * std::cos(down)), 1.0, 0.01);
  EXPECT_EQ(error_of(steps, "sv_mean_db"), 0.0);
}

TEST(SchoolErrors, SixPingsSpreadEvenlyAreMeasuredAgain) {
  EXPECT_EQ(fadings_of_ping(0, 1), 16U);
  EXPECT_EQ(fadings_of_ping(0, 2), 9U);
  EXPECT_EQ(fadings_of_ping(1, 2), 9U);
  std::vector<std::size_t> places;
  for (std::size_t place = 0; place < 40; ++place) {
    if (fadings_of_ping(place, 40) == 4) places.push_back(place);
  }
  for (std::size_t place = 0; place < 7; ++place) EXPECT_EQ(fadings_of_ping(place, 7) > 0, place != 3) << place;
  EXPECT_EQ(places, (std::vector<std::size_t>{3, 10, 16, 23, 30, 36}));
}

/// Told variance of the mean depth of a school whose pings scatter by fadings of 3 and of 1 to both sides of theirs, in any
/// order.
double told_variance(std::size_t pings) {
  double variance = 0.0;
  constexpr std::size_t kSchools = 30;
  std::mt19937_64 random(pings);
  for (std::size_t school = 0; school < kSchools; ++school) {
    std::vector<SchoolPingRow> rows(pings, row_of(1000.0));
    std::vector<Repeats> repeats(pings);
    std::vector<const Repeats*> all;
    for (std::size_t ping = 0; ping < pings; ++ping) {
      rows[ping].depth_m += 10.0 * static_cast<double>(ping % 3);  // it swims: no error of its mean
      all.push_back(&repeats[ping]);
      if (fadings_of_ping(ping, pings) == 0) continue;
      repeats[ping] = unchanged(rows[ping]);
      repeats[ping].erase(repeats[ping].begin() + 4, repeats[ping].begin() + kFadings);
      std::array<float, 4> off{-3.0F, -1.0F, 1.0F, 3.0F};
      std::shuffle(off.begin(), off.end(), random);
      for (std::size_t k = 0; k < 4; ++k) repeats[ping][k][0] += off[k];
    }
    ErrorParams params;
    params.sound_speed_percent = params.tilt_deg = 0.0;
    variance += std::pow(error_of(school_errors(rows, all, {}, params), "depth_m"), 2) / kSchools;
  }
  return variance / std::pow(2.1314 / 1.95996, 2);
}

// The variance of one ping is 20 / 3, that of a mean over n pings the n-th part of it, whether each was measured again or
// some stand for those beside them.
TEST(SchoolErrors, PingsThatStandForOthersTellTheErrorOfAllPings) {
  for (const std::size_t pings : {4U, 6U, 15U, 40U}) {
    EXPECT_NEAR(told_variance(pings) / (20.0 / 3.0 / static_cast<double>(pings)), 1.0, 0.15) << pings;
  }
}

// A school hardly larger than the median's box: what it is measured as again is as loud as it was heard. Its filtered level
// alone is 2.5 dB lower than that.
TEST(SchoolErrors, RepeatsHoldAsMuchEchoAsTheSchool) {
  test::MeasuredPing scene;
  test::Ellipsoid body;
  body.centre = Sector::direction(rad_from_deg(-22.0), rad_from_deg(268.0)) * 180.0;
  scene.add(body);
  const SchoolPingRow row = scene.measured(1);
  MeasureInput in;
  in.sv = scene.counts.view();
  in.filtered = scene.filtered.view();
  in.flags = scene.flags.view();
  in.sector = &scene.sector;
  in.grid = &scene.grid;
  in.background = {scene.flat.power_db, scene.flat.calibration.view()};
  in.placement = scene.placement;
  in.threshold_db = -200.0;  // the mask stays as it is
  ErrorParams params;
  params.enabled = true;
  const Repeats repeats = measure_repeats(in, scene.mask, {}, 10.0, 7, kFadings, {}, params);
  ASSERT_EQ(repeats.size(), kFadings + 3);
  double mean = 0.0;
  for (std::size_t k = 0; k < kFadings; ++k) mean += static_cast<double>(repeats[k][kBackscatter]) / kFadings;
  EXPECT_NEAR(mean / row.backscatter_m2, 1.0, 0.15) << "of 16 repeats that scatter by 0.15 each";
  params.enabled = false;
  EXPECT_TRUE(measure_repeats(in, scene.mask, {}, 10.0, 7, kFadings, {}, params).empty());
}

/// Looks at one school through fading that beams and samples share, masked by the program's own growth.
class Looks {
 public:
  Looks() : shape_(scene_.expected.shape()), noise_(test::kNoise_db) {
    for (std::size_t fan = 0; fan < 20; ++fan) scene_.grid.frequency_hz[fan] += 2000.0 * static_cast<double>(fan);
    test::Ellipsoid body;
    body.centre = Sector::direction(rad_from_deg(-22.0), rad_from_deg(268.0)) * 150.0;
    body.half_x = 18.0;
    body.half_y = 14.0;
    body.half_z = 8.0;
    scene_.add(body);
    box_ = box_of(scene_.mask, shape_.beams).enlarged(4, 4, 50).clipped(shape_);
    field_.emplace(scene_.grid, box_, scene_.sector.range().spacing_m, kPulse_m);
    scene_.counts = Array3<std::int16_t>(shape_, count_from_linear(linear_from_db(noise_)));
  }
  MeasureInput see(std::uint64_t seed) {
    const Array3<std::int16_t> fading = field_->draw(seed);
    for (int f = 0; f < box_.fans(); ++f) {
      for (int b = 0; b < box_.beams(); ++b) {
        for (int s = 0; s < box_.samples(); ++s) {
          const double sv = scene_.expected(box_.first_fan + f, box_.first_beam + b, box_.first_sample + s);
          scene_.counts(box_.first_fan + f, box_.first_beam + b, box_.first_sample + s) =
              count_from_linear((sv + linear_from_db(noise_)) * linear_from_count(fading(f, b, s)));
        }
      }
    }
    scene_.filtered = test::filtered(scene_.counts, scene_.flags);
    const std::int16_t loud = percentile(scene_.filtered.view(), scene_.mask, 0.95);
    std::vector<VoxelIndex> loudest(1);
    std::int16_t most = kMinCount;
    for (const Run& run : scene_.mask.runs) {
      for (int s = run.first_sample; s < run.end(); ++s) {
        const std::int16_t count = scene_.filtered.view().row(run.row)[static_cast<std::size_t>(s)];
        if (count <= most) continue;
        most = count;
        loudest.front() = {run.row, s};
      }
    }
    mask = grow(scene_.filtered.view(), scene_.flags.view(), MemberTable::one_sided(db_from_counts(loud), 10.0),
                loudest, {});
    MeasureInput in;
    in.sv = scene_.counts.view();
    in.filtered = scene_.filtered.view();
    in.flags = scene_.flags.view();
    in.sector = &scene_.sector;
    in.grid = &scene_.grid;
    in.background = {scene_.flat.power_db, scene_.flat.calibration.view()};
    in.placement = scene_.placement;
    in.pulse_m = kPulse_m;
    in.threshold_db = db_from_counts(loud) - 10.0;
    return in;
  }
  PingMask mask;

 private:
  static constexpr double kPulse_m = 1.5104;
  test::MeasuredPing scene_;
  Shape3 shape_;
  double noise_;
  IndexBox box_;
  std::optional<FadingField> field_;
};

double deviation(const std::vector<double>& values) {
  double mean = 0.0;
  double square = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) square += (v - mean) * (v - mean) / static_cast<double>(values.size() - 1);
  return std::sqrt(square);
}

// The bench tells it for all figures over random bodies; here one body, and a deviation of 40 looks that is known to 11 %.
TEST(SchoolErrors, RepeatsOfOneLookScatterAsLooksDo) {
  Looks looks;
  const std::vector<std::string_view> figures{"volume_m3", "backscatter_m2", "surface_m2", "volume_corrected_m3"};
  std::vector<std::vector<double>> seen(figures.size());
  std::vector<double> told(figures.size());
  constexpr int kLooks = 40;
  constexpr int kRepeated = 4;
  ErrorParams params = nothing_alike();
  params.enabled = true;
  MeasureParams shape_given;  // all schools of an observation find the shape of the beam: one would not
  shape_given.find_beam_shape = false;
  for (int look = 0; look < kLooks; ++look) {
    const MeasureInput in = looks.see(static_cast<std::uint64_t>(look) + 100);
    const MeasuredSchool measured = measure(in, looks.mask, shape_given);
    const SchoolPingRow row = correct_sizes({{&measured}}, shape_given).front();
    const FigureValues values = figures_of(row);
    for (std::size_t i = 0; i < figures.size(); ++i) seen[i].push_back(error_of(values, figures[i]));
    if (look >= kRepeated) continue;
    const Repeats repeats = measure_repeats(in, looks.mask, {}, 10.0, static_cast<std::uint64_t>(look) * 1000, kFadings,
                                            shape_given, params);
    const std::vector<const Repeats*> all{&repeats};
    const std::vector<SchoolPingRow> rows{row};
    const FigureValues errors = school_errors(rows, all, {}, params);
    for (std::size_t i = 0; i < figures.size(); ++i) told[i] += std::pow(error_of(errors, figures[i]), 2) / kRepeated;
  }
  for (std::size_t i = 0; i < figures.size(); ++i) {
    EXPECT_NEAR(std::sqrt(told[i]) / 1.0875 / deviation(seen[i]), 1.0, 0.35) << figures[i];
  }
}

}  // namespace
}  // namespace sonar
