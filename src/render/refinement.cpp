// SPDX-License-Identifier: Apache-2.0
#include "render/refinement.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sonar {
namespace {

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::size_t pixel(const RayImage& image, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.width) + static_cast<std::size_t>(x);
}

}  // namespace

RayImage enlarged(const RayImage& image, PixelSize size, int divisor, Work& work) {
  if (divisor <= 1) return image;
  RayImage out{size, std::vector<std::array<float, 4>>(size.count()), image.counts};
  const auto place = [divisor](int i, int count) {
    // A small pixel's centre stands over the centre of the pixels it replaces.
    const double at = std::clamp((i + 0.5) / divisor - 0.5, 0.0, count - 1.0);
    const int below = std::min(static_cast<int>(at), std::max(0, count - 2));
    return std::pair{below, static_cast<float>(at - below)};
  };
  std::vector<std::pair<int, float>> columns;
  for (int x = 0; x < size.width; ++x) columns.push_back(place(x, image.size.width));
  const auto row = [&](int y) {
    const auto [y0, ty] = place(y, image.size.height);
    const auto* upper = &image.rgba[pixel(image, 0, y0)];
    const auto* lower = &image.rgba[pixel(image, 0, std::min(y0 + 1, image.size.height - 1))];
    auto* to = &out.rgba[pixel(out, 0, y)];
    for (const auto& [x0, tx] : columns) {
      const int x1 = std::min(x0 + 1, image.size.width - 1);
      for (std::size_t c = 0; c < 4; ++c) {
        const float top = upper[x0][c] * (1.0F - tx) + upper[x1][c] * tx;
        const float low = lower[x0][c] * (1.0F - tx) + lower[x1][c] * tx;
        (*to)[c] = top * (1.0F - ty) + low * ty;
      }
      ++to;
    }
  };
  constexpr int kRows = 16;
  work.for_each((size.height + kRows - 1) / kRows, [&](std::int64_t band) {
    const int first = static_cast<int>(band) * kRows;
    for (int y = first; y < std::min(size.height, first + kRows); ++y) row(y);
  });
  return out;
}

Refinement::Refinement(VolumeRenderer& renderer, RefinementParams params, Clock clock)
    : renderer_(renderer),
      params_(params),
      clock_(clock ? std::move(clock) : Clock(steady_seconds)),
      seconds_per_pixel_(params.pace_s) {}

void Refinement::restart(const VolumeView& view) {
  view_ = view;
  divisor_ = 0;
  frames_ = 0;
  sum_.clear();
  started_s_ = clock_();
}

bool Refinement::late() const { return params_.rest_budget_s > 0.0 && clock_() - started_s_ > params_.rest_budget_s; }

int Refinement::divisor_within(double seconds) const {
  int divisor = 1;
  const auto pixels = static_cast<double>(view_->size.count());
  while (divisor < 8 && seconds_per_pixel_ * pixels / (divisor * divisor) > seconds) divisor *= 2;
  return divisor;
}

Result<RayImage> Refinement::timed(const DrawQuality& quality, Work& work) {
  const double start = clock_();
  auto image = renderer_.draw(*view_, quality, work);
  if (!image) return image;
  const double pixels = static_cast<double>(view_->size.count()) / (quality.divisor * quality.divisor);
  const double measured = std::max(0.0, clock_() - start) / std::max(1.0, pixels);
  // A frame dearer than thought counts at once, a cheaper one by and by: pictures must not flicker between sizes.
  seconds_per_pixel_ = measured > seconds_per_pixel_ ? measured : 0.5 * (measured + seconds_per_pixel_);
  return image;
}

Result<Refinement::Frame> Refinement::next(Work& work) {
  if (!view_) return fail(ErrorCode::bad_parameter, "nothing to draw: no view was set");
  if (divisor_ == 1) return average(work);
  const int divisor = divisor_ == 0 ? divisor_within(params_.moving_budget_s) : divisor_ / 2;
  const DrawQuality quality{divisor, params_.step_samples, params_.homogeneous_limit, 0};
  auto image = timed(quality, work);
  if (!image) return pass_on(image);
  divisor_ = divisor;
  const bool done = divisor == 1 && (params_.most_frames <= 0 || late());
  RayImage full = enlarged(*image, view_->size, divisor, work);
  if (divisor > 1 && work.cancelled()) return fail(ErrorCode::cancelled, "drawing was cancelled");
  return Frame{std::move(full), quality, 0, done};
}

Result<Refinement::Frame> Refinement::average(Work& work) {
  DrawQuality quality{1, params_.step_samples, params_.homogeneous_limit, static_cast<std::uint32_t>(frames_ + 1)};
  auto image = timed(quality, work);
  if (!image) return pass_on(image);
  sum_.resize(image->rgba.size());
  ++frames_;
  double change = 0.0;
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    auto& mean = image->rgba[i];
    for (std::size_t c = 0; c < 4; ++c) {
      const double before = frames_ > 1 ? sum_[i][c] / (frames_ - 1) : 1e9;
      sum_[i][c] += static_cast<double>(mean[c]);
      const double now = sum_[i][c] / frames_;
      change = std::max(change, std::abs(now - before));
      mean[c] = static_cast<float>(now);
    }
  }
  const bool done = frames_ >= params_.most_frames || change < params_.converged || late();
  return Frame{std::move(*image), quality, frames_, done};
}

Result<Refinement::Frame> Refinement::converged(Work& work) {
  for (;;) {
    auto frame = next(work);
    if (!frame || frame->done) return frame;
  }
}

}  // namespace sonar
