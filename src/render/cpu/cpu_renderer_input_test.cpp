// SPDX-License-Identifier: Apache-2.0
// What the vector ray-caster refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "base/work.h"
#include "render/test_scenes.h"
#include "render/transfer_table.h"
#include "render/volume_renderer.h"

namespace sonar {
namespace {

using namespace scenes;

TEST(CpuRendererInput, BadInputIsAnError) {
  Work work(1);
  auto r = make_cpu_renderer();
  const auto code = [](const auto& result) { return result ? ErrorCode::io : result.error().code; };
  VolumeView view;
  view.camera = overview(fan());
  view.size = {48, 36};
  EXPECT_EQ(code(r->draw(view, {}, work)), ErrorCode::bad_parameter);
  EXPECT_EQ(code(r->set_volume(nullptr)), ErrorCode::bad_parameter);
  EXPECT_EQ(code(r->set_volume(volume(fan(1)))), ErrorCode::bad_parameter);
  auto unknown = volume(fan());
  for (auto& sv : unknown->sv.all()) sv = kNoData;
  EXPECT_EQ(code(r->set_volume(unknown)), ErrorCode::bad_parameter);
  auto other = volume(fan());
  other->sector = {even(-80.0, 20.0, 11), even(-130.0, 130.0, 27), RangeAxis{0.0, 0.5, 100}};
  EXPECT_EQ(code(r->set_volume(other)), ErrorCode::bad_parameter);
  OpticalTable bad = table(false);
  bad.rgb_extinction.resize(1);
  EXPECT_EQ(code(r->set_transfer(bad)), ErrorCode::bad_parameter);
  bad = table(false);
  bad.rgb_extinction[3][3] = std::nanf("");
  EXPECT_EQ(code(r->set_transfer(bad)), ErrorCode::bad_parameter);
  bad.rgb_extinction[3][3] = -1.0F;
  EXPECT_EQ(code(r->set_transfer(bad)), ErrorCode::bad_parameter);
  ASSERT_TRUE(r->set_volume(volume(fan())));
  EXPECT_EQ(code(r->draw(view, {}, work)), ErrorCode::bad_parameter);
  ASSERT_TRUE(r->set_transfer(table(false)));
  VolumeView none = view;
  none.size = {0, 10};
  EXPECT_EQ(code(r->draw(none, {}, work)), ErrorCode::bad_parameter);
  VolumeView odd = view;
  odd.opaque_m = std::make_shared<std::vector<float>>(5, 1.0F);
  EXPECT_EQ(code(r->draw(odd, {}, work)), ErrorCode::bad_parameter);
  EXPECT_EQ(code(r->draw(view, {0, 1.0, 0.03, 0}, work)), ErrorCode::bad_parameter);
  EXPECT_EQ(code(r->draw(view, {1, 0.0, 0.03, 0}, work)), ErrorCode::bad_parameter);
  auto outside = std::make_shared<PingMask>();
  outside->runs = {{0, 115, 10}};
  outside->confidence.assign(10, 255);
  const std::vector<MaskLayer> masks{{outside, {1, 1, 1}}};
  EXPECT_EQ(code(r->set_masks(masks)), ErrorCode::bad_parameter);
  work.cancel();
  EXPECT_EQ(code(r->draw(view, {}, work)), ErrorCode::cancelled);
}

}  // namespace
}  // namespace sonar
