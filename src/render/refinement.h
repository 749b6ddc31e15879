// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "base/result.h"
#include "base/work.h"
#include "render/volume_renderer.h"
#include "view/volume/volume_scene.h"

namespace sonar {

/// How long a picture may take, and when it is good enough.
struct RefinementParams {
  double moving_budget_s = 0.05;    ///< of a frame while something moves
  double step_samples = 1.0;        ///< as DrawQuality
  double homogeneous_limit = 0.03;  ///< as DrawQuality
  int most_frames = 32;             ///< jittered frames that are averaged at rest
  double rest_budget_s = 0.0;       ///< no further frame is begun later than this after restart(); 0 = no limit
  double converged = 0.25 / 255.0;  ///< largest change of a colour by one more frame; below it the picture is done
  double pace_s = 1e-7;             ///< seconds a pixel of full resolution: a guess until the first frame tells
};

/// Draws a view coarsely at once and better and better while it stays: half or quarter resolution as time allows, then
/// full resolution, then the mean of jittered frames until one more changes nothing that can be seen. How coarse the
/// first picture must be is told by the time that earlier rays took, not by a count of them.
/// threads  one caller at a time; `Work::cancel` ends a frame early, and the picture so far stays
class Refinement {
 public:
  using Clock = std::function<double()>;  ///< seconds, rising

  /// The renderer outlives this. Clock: empty = the steady clock.
  explicit Refinement(VolumeRenderer& renderer, RefinementParams params = {}, Clock clock = {});

  /// A changed camera, mode, mask style or size, or a changed volume, table or masks of the renderer: the next frame is
  /// a new picture.
  void restart(const VolumeView& view);

  struct Frame {
    RayImage image;       ///< full size of the view; enlarged where it was drawn small
    DrawQuality quality;  ///< of the last frame drawn
    int averaged = 0;     ///< jittered frames in it
    bool done = false;    ///< one more would change nothing
  };
  /// The next better picture. errors: as VolumeRenderer::draw(); bad_parameter before restart()
  [[nodiscard]] Result<Frame> next(Work& work);

  /// next() until it is done.
  [[nodiscard]] Result<Frame> converged(Work& work);

 private:
  [[nodiscard]] bool late() const;
  [[nodiscard]] int divisor_within(double seconds) const;
  [[nodiscard]] Result<RayImage> timed(const DrawQuality& quality, Work& work);
  [[nodiscard]] Result<Frame> average(Work& work);

  VolumeRenderer& renderer_;
  RefinementParams params_;
  Clock clock_;
  std::optional<VolumeView> view_;
  double seconds_per_pixel_;  ///< of full resolution
  double started_s_ = 0.0;    ///< when restart() was called
  int divisor_ = 0;           ///< of the last frame; 0 = none yet
  std::vector<std::array<double, 4>> sum_;
  int frames_ = 0;
};

/// Enlarged to `size`, bilinear.
[[nodiscard]] RayImage enlarged(const RayImage& image, PixelSize size, int divisor, Work& work);

}  // namespace sonar
