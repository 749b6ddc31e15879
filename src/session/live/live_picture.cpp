// SPDX-License-Identifier: Apache-2.0
#include "session/live/live_picture.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "base/within_memory.h"
#include "publish/picture_output.h"
#include "session/open/workspace.h"

namespace sonar {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

LivePicture::LivePicture(Workspace& workspace)
    : queue_(workspace.queue),
      dark_(workspace.dark),
      units_read_(workspace.units),
      units_heard_(workspace.units.changed(), [this] { update(); }) {}

LivePicture::~LivePicture() {
  if (wish_) wish_->cancel();
}

void LivePicture::resize(PixelSize units, double scale) {
  if (units == units_ && scale == scale_) return;
  units_ = units;
  scale_ = scale;
  size_ = {static_cast<int>(std::lround(units.width * scale)), static_cast<int>(std::lround(units.height * scale))};
  update();
}

void LivePicture::set_seen(bool seen) {
  if (seen == seen_) return;
  seen_ = seen;
  if (!seen_ && wish_) {
    // What was under way is begun anew when the picture is seen again.
    wish_->cancel();
    stale_ = true;
  }
  if (!seen_) hidden();
  if (seen_ && stale_) update();
}

void LivePicture::set_on_page(bool on) {
  if (std::exchange(on_page_, on) && !on) left_page();
}

void LivePicture::behind(std::function<void()> job) {
  background_.post([job = std::move(job)](const CancelToken& /*token*/) { job(); });
}

void LivePicture::end_behind(const std::function<void()>& last) {
  background_.post_latest([&last](const CancelToken& /*token*/) { last(); });
  background_.wait();
}

void LivePicture::update() {
  stale_ = true;
  ++version_;
  outdated_.tell();
  if (!seen_ || size_.width < 1 || size_.height < 1) return;
  stale_ = false;
  Build build_now = build({size_, scale_, dark_(), {}, units_read_()});
  if (!build_now) {
    if (wish_) wish_->cancel();
    alive_ = std::make_shared<bool>(true);  // what is on its way shows what is no more
    image_ = {};
    problem_.clear();
    changed_.tell();
    return;
  }
  const double asked_s = seconds_now();
  wish_ = background_.post_latest([this, build_now = std::move(build_now), size = size_, asked_s,
                                   alive = std::weak_ptr<bool>(alive_)](const CancelToken& token) {
    const auto post = [&](std::function<void()> change) {
      queue_.post([alive, change = std::move(change)] {
        if (!alive.expired()) change();
      });
    };
    // Shown even where a later wish has come: while wishes come faster than pictures something must be seen.
    const Show show = [&](Built built) {
      auto image = built.image ? Result<Image>(std::move(*built.image)) : painted(built.frame, built.scale);
      if (!image) return post([this, line = to_line(image.error())] { fail_with(line); });
      post([this, built = std::move(built), image = std::move(*image), asked_s]() mutable {
        put(built, std::move(image), asked_s);
      });
    };
    if (auto done = within_memory([&] { return build_now(size, token, show); });
        !done && done.error().code != ErrorCode::cancelled) {
      post([this, line = to_line(done.error())] { fail_with(line); });
    }
  });
}

LivePicture::Panel LivePicture::panel(const PictureLook& look) {
  Build build_now = build(look);
  if (!build_now) return {};
  return [build_now = std::move(build_now), size = look.size](const CancelToken& token,
                                                              const ShowPanel& show) -> Result<void> {
    return within_memory(
        [&] { return build_now(size, token, [&show](Built built) { show(std::move(built.frame), built.scale); }); });
  };
}

void LivePicture::put(const Built& built, Image image, double asked_s) {
  image_ = std::move(image);
  problem_.clear();
  latency_ms_ = 1e3 * (seconds_now() - asked_s);
  ++pictures_;
  take(built.detail);
  changed_.tell();
}

std::string LivePicture::timing() const { return fmt::format("{:.1f} ms", latency_ms_); }

void LivePicture::fail_with(std::string line) {
  problem_ = std::move(line);
  image_ = {};
  ++pictures_;
  changed_.tell();
}

}  // namespace sonar
