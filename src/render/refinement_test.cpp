// SPDX-License-Identifier: Apache-2.0
#include "render/refinement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sonar {
namespace {

/// Takes a known time a pixel; jittered frames waver about 0.5 by a known amount.
class PacedRenderer : public VolumeRenderer {
 public:
  double seconds_per_pixel = 1e-6;
  double waver = 0.1;
  double now = 0.0;
  std::vector<DrawQuality> drawn;
  bool cancel = false;

  [[nodiscard]] std::string name() const override { return "paced"; }
  Result<void> set_volume(std::shared_ptr<const VolumeData> /*volume*/) override { return {}; }
  Result<void> set_transfer(const OpticalTable& /*table*/) override { return {}; }
  Result<void> set_masks(std::span<const MaskLayer> /*masks*/) override { return {}; }
  Result<RayImage> draw(const VolumeView& view, const DrawQuality& quality, Work& /*work*/) override {
    if (cancel) return fail(ErrorCode::cancelled, "stopped");
    drawn.push_back(quality);
    const PixelSize size{(view.size.width + quality.divisor - 1) / quality.divisor,
                         (view.size.height + quality.divisor - 1) / quality.divisor};
    now += seconds_per_pixel * static_cast<double>(size.count());
    const double sign = quality.jitter_frame % 2 == 1 ? 1.0 : -1.0;
    const auto value = static_cast<float>(quality.jitter_frame == 0 ? 0.5 : 0.5 + sign * waver);
    return RayImage{size, std::vector<std::array<float, 4>>(size.count(), {value, value, value, value}), {}};
  }
};

VolumeView view_of(int width, int height) {
  VolumeView view;
  view.size = {width, height};
  return view;
}

TEST(Refinement, TheFirstPictureKeepsToItsTimeAndLaterOnesGetFiner) {
  PacedRenderer renderer;
  Work work(1);
  // 100 000 pixels take 100 ms; a quarter of them 25 ms, within 50.
  Refinement refinement(renderer, {}, [&] { return renderer.now; });
  refinement.restart(view_of(400, 250));
  ASSERT_TRUE(refinement.next(work));  // learns the pace
  refinement.restart(view_of(400, 250));
  const double start = renderer.now;
  const auto first = refinement.next(work);
  ASSERT_TRUE(first);
  EXPECT_LE(renderer.now - start, 0.05);
  EXPECT_EQ(first->quality.divisor, 2);
  EXPECT_EQ(first->image.size, (PixelSize{400, 250}));
  EXPECT_EQ(refinement.next(work)->quality.divisor, 1);
  EXPECT_EQ(refinement.next(work)->averaged, 1);
}

TEST(Refinement, ASlowRendererStartsCoarser) {
  PacedRenderer renderer;
  renderer.seconds_per_pixel = 1e-5;
  Work work(1);
  Refinement refinement(renderer, {}, [&] { return renderer.now; });
  refinement.restart(view_of(400, 250));
  ASSERT_TRUE(refinement.next(work));
  refinement.restart(view_of(400, 250));
  const double start = renderer.now;
  ASSERT_TRUE(refinement.next(work));
  EXPECT_LE(renderer.now - start, 0.05);
  EXPECT_GE(renderer.drawn.back().divisor, 4);
}

TEST(Refinement, AtRestItBecomesTheMeanOfItsFrames) {
  PacedRenderer renderer;
  Work work(1);
  Refinement refinement(renderer, {.most_frames = 10}, [&] { return renderer.now; });
  refinement.restart(view_of(8, 6));
  const auto frame = refinement.converged(work);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->averaged, 10);
  EXPECT_NEAR(frame->image.rgba[0][0], 0.5, 1e-6) << "five frames above, five below";
}

TEST(Refinement, AtRestItEndsInItsTimeWithAWholePicture) {
  PacedRenderer renderer;  // 0.1 s a full frame
  Work work(1);
  Refinement refinement(renderer, {.most_frames = 1000, .rest_budget_s = 1.05}, [&] { return renderer.now; });
  refinement.restart(view_of(400, 250));
  const auto frame = refinement.converged(work);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->quality.divisor, 1);
  EXPECT_GE(frame->averaged, 7);
  EXPECT_LE(renderer.now, 1.05 + 0.11);
}

TEST(Refinement, EndsEarlyWhereNothingChanges) {
  PacedRenderer renderer;
  renderer.waver = 0.0;
  Work work(1);
  Refinement refinement(renderer, {.most_frames = 100}, [&] { return renderer.now; });
  refinement.restart(view_of(8, 6));
  EXPECT_EQ(refinement.converged(work)->averaged, 2);
}

TEST(Refinement, RestartForgetsTheOldPicture) {
  PacedRenderer renderer;
  Work work(1);
  Refinement refinement(renderer, {.most_frames = 4}, [&] { return renderer.now; });
  EXPECT_FALSE(refinement.next(work)) << "no view yet";
  refinement.restart(view_of(8, 6));
  ASSERT_TRUE(refinement.converged(work));
  refinement.restart(view_of(16, 6));
  const auto frame = refinement.next(work);
  EXPECT_EQ(frame->averaged, 0);
  EXPECT_EQ(frame->image.size, (PixelSize{16, 6}));
  renderer.cancel = true;
  EXPECT_EQ(refinement.next(work).error().code, ErrorCode::cancelled);
}

TEST(Refinement, EnlargingKeepsAPlane) {
  RayImage small{{5, 4}, {}, {}};
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x)
      small.rgba.push_back({0.1F * static_cast<float>(x), 0.1F * static_cast<float>(y), 0.0F, 1.0F});
  }
  Work work(2);
  const RayImage big = enlarged(small, {10, 8}, 2, work);
  for (int y = 1; y < 7; ++y) {
    for (int x = 1; x < 9; ++x) {
      const auto& p = big.rgba[static_cast<std::size_t>(y * 10 + x)];
      EXPECT_NEAR(p[0], 0.1 * ((x + 0.5) / 2 - 0.5), 1e-6);
      EXPECT_NEAR(p[1], 0.1 * ((y + 0.5) / 2 - 0.5), 1e-6);
    }
  }
}

}  // namespace
}  // namespace sonar
