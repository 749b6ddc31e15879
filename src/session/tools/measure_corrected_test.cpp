// SPDX-License-Identifier: Apache-2.0
// What the measure tool and the rows of schools say where the recipe corrects for extinction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/work.h"
#include "pipeline/journal/state_product.h"
#include "session/slices/test_slices.h"
#include "session/tools/measure_tool.h"

namespace sonar {
namespace {

using testing::HasSubstr;

/// One school, by a click. The ratio is so large that a small school casts a shadow.
class MeasureCorrected : public testing::Test {
 protected:
  MeasureCorrected() : app_(recipe()) {
    app_.look_at_bright();
    app_.workspace().tool.set(ToolName::seed);
    app_.click(app_.side(), SlicesApp::bright().voxel);
    app_.settle();
  }
  static Recipe recipe() {
    Recipe recipe;
    recipe.measure.extinction.correct = true;
    recipe.measure.extinction.ratio = 20.0;
    return recipe;
  }

  SlicesApp app_;
};

// Corrected for extinction, a school's voxels are measured as its row is, whose figures the stage `measure` makes; a box says
// what it was given back, and no more is where its school is gone.
TEST_F(MeasureCorrected, FiguresAreThoseOfASchoolThatIsCorrected) {
  const PingMask mask = app_.document().state().schools.at(0)->masks.pings.front().mask;
  const ProductPtr product = app_.document().product(0);
  ASSERT_TRUE(product);
  const SchoolPingRow& row = product->school_pings.at(0);
  ASSERT_EQ(row.extinction_corrected, 1.0);
  ASSERT_GT(row.extinction_loss_db, 0.1);
  const auto& shown = *app_.document().shown();
  const StagedPing& ping = *app_.document().staged();
  const Placement placement = shown.placement(app_.document().ping());
  const std::vector<const PingMask*> schools{&mask};
  const VoxelStatistics corrected =
      corrected_statistics_of(mask, ping, shown.sector(), placement, schools, shown.recipe().measure.extinction);
  EXPECT_NEAR(corrected.echo.backscatter_m2 / row.backscatter_m2, 1.0, 1e-9);
  EXPECT_NEAR(corrected.echo.sv_mean_db, row.sv_mean_db, 1e-9);
  const VoxelStatistics heard = statistics_of(mask, ping, shown.sector(), placement);
  EXPECT_NEAR(1.0 - heard.echo.backscatter_m2 / corrected.echo.backscatter_m2, row.extinction_share, 0.002)
      << "but for steps of counts, and voxels that noise hit";

  app_.workspace().tool.set(ToolName::measure);
  const auto m = app_.top().picture()->place_of(SlicesApp::bright().voxel);
  ASSERT_TRUE(m);
  for (const auto& [action, dx] :
       {std::pair{PointerAction::press, -30.0}, {PointerAction::move, 20.0}, {PointerAction::release, 20.0}}) {
    PointerEvent event{action, PointerButton::left, {m->x + dx, m->y + 0.7 * dx}};
    event.shift = true;
    app_.top().pointer(event);
  }
  ASSERT_TRUE(app_.workspace().measurement());
  const auto given_back = app_.workspace().measurement()->area.extinction_db;
  ASSERT_TRUE(given_back);
  EXPECT_GT(*given_back, 0.05);
  EXPECT_THAT(measured_text(app_.workspace()), HasSubstr("corrected for extinction by"));
  app_.ask("edit.undo");
  app_.settle();
  ASSERT_TRUE(app_.document().state().schools.empty());
  EXPECT_EQ(app_.workspace().measurement()->area.extinction_db, 0.0) << "no school is left to take sound out";
}

// What a human says is no fish takes nothing from the school behind it, which lies some samples farther in the same beams;
// its own row tells what it would be as fish, as it did before.
TEST_F(MeasureCorrected, ARejectedSchoolTakesNothingFromTheOneBehindIt) {
  std::map<int, int> ends;  // of the near school, by row
  for (const sonar::Run& run : app_.document().state().schools.at(0)->masks.pings.front().mask.runs) {
    ends[run.row] = std::max(ends[run.row], run.end());
  }
  BrushCommand behind;
  for (const auto& [row, end] : ends) {
    behind.runs.push_back({app_.document().shown()->grid().channel[static_cast<std::size_t>(row)], end + 5, 6});
  }
  app_.document().act(app_.document().ping(), behind);
  app_.settle();
  ASSERT_EQ(app_.document().state().schools.size(), 2U);
  const auto row_of = [&](std::size_t school) {
    const std::int64_t number = app_.document().state().schools.at(school)->number;
    const ProductPtr product = app_.document().product(0);
    const auto found = std::ranges::find(product->school_pings, number, &SchoolPingRow::school_id);
    return found == product->school_pings.end() ? SchoolPingRow{} : *found;
  };
  const SchoolPingRow near = row_of(0);
  const SchoolPingRow far = row_of(1);
  ASSERT_GT(near.extinction_loss_db, 0.1);
  ASSERT_GT(far.extinction_loss_db, 0.9 * near.extinction_loss_db);
  const SchoolKey key = key_of(app_.document().state().schools.at(0)->masks, app_.document().shown()->context());
  app_.document().act(DecideCommand{{{key, "rejected", {}, {}}}, ""});
  app_.settle();
  EXPECT_LT(row_of(1).extinction_loss_db, 0.5 * far.extinction_loss_db) << "its own water alone";
  EXPECT_EQ(row_of(0).extinction_loss_db, near.extinction_loss_db);
  EXPECT_EQ(row_of(0).backscatter_m2, near.backscatter_m2);
  app_.ask("edit.undo");
  app_.settle();
  EXPECT_EQ(row_of(1).extinction_loss_db, far.extinction_loss_db);
}

// A school that holds no beam of the rejected one hears its water there, and beams that are given nothing back are other water.
// What was kept of the ping is of no use then.
TEST_F(MeasureCorrected, ARejectedSchoolChangesTheWaterOfOneBesideIt) {
  const auto& shown = *app_.document().shown();
  const int beams = shown.sector().beams();
  const std::vector<sonar::Run> runs = app_.document().state().schools.at(0)->masks.pings.front().mask.runs;
  const auto [low, high] = std::ranges::minmax(runs, {}, [&](const sonar::Run& run) { return run.row % beams; });
  const int beam = high.row % beams + 1 < beams ? high.row % beams + 1 : low.row % beams - 1;
  ASSERT_GE(beam, 0) << "the school fills its fans";
  BrushCommand beside;
  for (const sonar::Run& run : runs) {
    const int row = run.row - run.row % beams + beam;
    beside.runs.push_back({shown.grid().channel[static_cast<std::size_t>(row)], run.first_sample, run.count});
  }
  app_.document().act(app_.document().ping(), beside);
  app_.settle();
  ASSERT_EQ(app_.document().state().schools.size(), 2U);
  const auto total_of = [](const ObservationProduct& product, std::int64_t school) {
    const auto found = std::ranges::find(product.school_pings, school, &SchoolPingRow::school_id);
    return found == product.school_pings.end() ? kUnknown : found->backscatter_total_m2;
  };
  const std::int64_t school = app_.document().state().schools.at(1)->number;
  const double before_m2 = total_of(*app_.document().product(0), school);
  const SchoolKey key = key_of(app_.document().state().schools.at(0)->masks, shown.context());
  app_.document().act(DecideCommand{{{key, "rejected", {}, {}}}, ""});
  app_.settle();
  Work work;
  const auto anew = state_product(app_.document().shown()->engine(), app_.document().state(), {}, work);
  ASSERT_TRUE(anew);
  ASSERT_NE(total_of(*anew, school), before_m2) << "else this tells nothing";
  EXPECT_EQ(total_of(*app_.document().product(0), school), total_of(*anew, school));
}

}  // namespace
}  // namespace sonar
