// SPDX-License-Identifier: Apache-2.0
// The selected school's number in slices, however near one looks.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <variant>

#include "session/slices/test_slices.h"

namespace sonar {
namespace {

bool shows(const SlicePicture& picture, const PingMask& mask, int beams, const Voxel& of) {
  for (const sonar::Run& run : mask.runs) {
    for (int sample = run.first_sample; sample < run.end(); ++sample) {
      const Voxel voxel{run.row / beams, run.row % beams, sample};
      const auto at = picture.place_of(voxel);
      if (voxel.fan == of.fan && at && inside(picture.plot.place, *at)) return true;
    }
  }
  return false;
}

int names_in(const SlicePicture& picture) {
  int names = 0;
  for (const auto& item : picture.frame.items) {
    const auto* text = std::get_if<TextItem>(&item);
    const bool name = text != nullptr && text->bold && (text->text == "1" || text->text == "school 1");
    names += name && inside(picture.plot.place, text->at) ? 1 : 0;
  }
  return names;
}

TEST(SelectedNameInASlice, IsThereWhereverAVoxelOfTheSchoolIs) {
  SlicesApp app;
  app.look_at_bright();
  const Voxel& bright = SlicesApp::bright().voxel;
  SliceModel& top = app.top();
  app.click(top, bright);
  app.settle();
  const PingMask mask = in_ping(app.document().state().schools.front()->masks, app.document().ping())->mask;
  const int beams = app.document().shown()->sector().beams();
  std::mt19937 random(20200105);
  const auto even = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  int seen = 0;
  for (int view = 0; view < 40; ++view) {
    app.ask("display.all");
    app.settle();
    PointerEvent wheel = app.at(top, bright, PointerAction::wheel);
    wheel.at = {wheel.at.x + even(-8.0, 8.0), wheel.at.y + even(-8.0, 8.0)};
    wheel.wheel_steps = std::floor(even(1.0, 20.0));
    wheel.control = true;
    top.pointer(wheel);
    app.settle();
    if (!shows(*top.picture(), mask, beams, bright)) continue;
    ++seen;
    ASSERT_EQ(names_in(*top.picture()), 1) << view << ": " << wheel.wheel_steps << " steps nearer";
  }
  EXPECT_GT(seen, 15);
}

}  // namespace
}  // namespace sonar
