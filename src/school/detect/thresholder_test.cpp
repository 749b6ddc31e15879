// SPDX-License-Identifier: Apache-2.0
#include "school/detect/thresholder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/units.h"
#include "model/filtered_ping.h"
#include "school/detect/detect_params.h"
#include "school/evidence/block_means.h"
#include "school/evidence/null_model.h"
#include "school/grow/grow.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{20, 25, 700};

struct Water {
  explicit Water(double layer_db) : sector(test::grid().sector(test::range_axis(kShape.samples))), expected(kShape) {
    test::Ellipsoid e;
    e.centre = {0.0, -160.0, 50.0};
    e.sv = linear_from_db(-70.0);
    test::add_ellipsoid(expected, sector, e);
    for (int row = 0; row < 500; ++row) {
      for (int s = 500; s < 560; ++s) {
        expected.view().row(row)[static_cast<std::size_t>(s)] += linear_from_db(layer_db);
      }
    }
    flags = test::cropped_flags(kShape, sector);
    counts = test::counts_of(expected, 1);
    sv = test::filtered(counts, flags);
  }
  [[nodiscard]] PingMask standing(double margin_db, Above above) const {
    const test::FlatBackground flat(kShape);
    const Background noise{flat.power_db, flat.calibration.view()};
    const Array3<std::int16_t> means = block_means(counts.view(), flags.view(), block_samples(sector.range()));
    const WaterPing alone{&means, nullptr, noise};
    const WaterLevels water = water_levels({&alone, 1}, sector, kLeastEvidence).front();
    PingMask mask;
    mask.runs = Thresholder(sv.view(), flags.view(), noise, above == Above::water ? &water : nullptr)
                    .above_background(margin_db);
    return mask;
  }

  Sector sector;
  Array3<double> expected;
  Array3<SampleFlags> flags;
  Array3<std::int16_t> counts;
  Array3<std::int16_t> sv;
};

std::int64_t samples(const PingMask& mask, int first, int end) {
  std::int64_t sum = 0;
  for (const Run& run : mask.runs) sum += std::max(0, std::min(run.end(), end) - std::max(run.first_sample, first));
  return sum;
}

TEST(AboveBackground, SchoolsDoAndNoiseDoesNot) {
  const Water water(-400.0);
  const PingMask mask = water.standing(3.0, Above::noise);
  const PingMask truth = test::truth_of(water.expected);
  EXPECT_GT(static_cast<double>(overlap(mask, truth)), 0.95 * static_cast<double>(truth.voxels()));
  // Everything else is noise: 340 000 samples.
  EXPECT_LT(samples(mask, 0, 300) + samples(mask, 600, kShape.samples), 50);
}

// Beams hear nothing of a layer when they are silent, and all of them hear it.
TEST(AboveBackground, ALayerStandsAboveTheNoiseAndNotAboveTheWater) {
  const Water water(-55.0);
  EXPECT_GT(samples(water.standing(3.0, Above::noise), 510, 550), 500 * 40 * 9 / 10);
  EXPECT_LT(samples(water.standing(3.0, Above::water), 510, 550), 500 * 40 / 100);
}

TEST(AboveBackground, AClickThereStaysThereWhateverTheTolerance) {
  const Water water(-400.0);
  const TransferFunction curve = *TransferFunction::make({{-100.0, 0.0, {}}, {-30.0, 1.0, {}}}, 10.0);
  const PingMask inside = water.standing(3.0, Above::noise);
  const PingMask truth = test::truth_of(water.expected);
  const sonar::Run& middle = truth.runs[truth.runs.size() / 2];
  const VoxelIndex seed{middle.row, middle.first_sample + middle.count / 2};
  const GrowParams params{.tolerance_db = 25.0};
  const auto anywhere = grow_from_click(water.sv.view(), water.flags.view(), seed, curve, params);
  const auto limited = grow_from_click(water.sv.view(), water.flags.view(), seed, curve, params, &inside);
  ASSERT_TRUE(anywhere && limited);
  EXPECT_GT(anywhere->voxels(), 100 * truth.voxels());
  EXPECT_LT(limited->voxels(), 4 * truth.voxels());
  EXPECT_GE(overlap(*limited, truth), truth.voxels() * 9 / 10);
}

TEST(AboveBackground, ASeedInTheNoiseIsRefusedInOneLine) {
  const Water water(-400.0);
  const PingMask inside = water.standing(3.0, Above::noise);
  const TransferFunction curve = *TransferFunction::make({{-120.0, 0.0, {}}, {-30.0, 1.0, {}}}, 10.0);
  const auto refused = grow_from_click(water.sv.view(), water.flags.view(), {3 * 25 + 4, 620}, curve, {}, &inside);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("fan 3, beam 4, sample 620"), std::string::npos) << refused.error().text;
  EXPECT_NE(refused.error().text.find("3 dB above the noise"), std::string::npos) << refused.error().text;
}

}  // namespace
}  // namespace sonar
