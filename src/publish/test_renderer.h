// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "render/volume_renderer.h"

namespace sonar {

/// Draws as the processor does, and tells how many of its kind live and draw, and whether all on one thread.
struct Watch {
  int living = 0;
  int made = 0;
  int drawn = 0;
  bool fails = false;  ///< draw() does
  std::set<const void*> threads;
};

/// Names the thread that asks.
inline const void* this_thread() {
  thread_local char mark;
  return &mark;
}

class WatchedRenderer : public VolumeRenderer {
 public:
  explicit WatchedRenderer(std::shared_ptr<Watch> watch) : watch_(std::move(watch)), inner_(make_cpu_renderer()) {
    ++watch_->living;
    ++watch_->made;
    watch_->threads.insert(this_thread());
  }
  WatchedRenderer(const WatchedRenderer&) = delete;
  WatchedRenderer& operator=(const WatchedRenderer&) = delete;
  ~WatchedRenderer() override {
    --watch_->living;
    watch_->threads.insert(this_thread());
  }
  [[nodiscard]] std::string name() const override { return "watched"; }
  Result<void> set_volume(std::shared_ptr<const VolumeData> volume) override { return inner_->set_volume(volume); }
  Result<void> set_transfer(const OpticalTable& table) override { return inner_->set_transfer(table); }
  Result<void> set_masks(std::span<const MaskLayer> masks) override { return inner_->set_masks(masks); }
  Result<RayImage> draw(const VolumeView& view, const DrawQuality& quality, Work& work) override {
    ++watch_->drawn;
    watch_->threads.insert(this_thread());
    if (watch_->fails) return fail(ErrorCode::unsupported, "the driver was taken away");
    return inner_->draw(view, quality, work);
  }

 private:
  std::shared_ptr<Watch> watch_;
  std::unique_ptr<VolumeRenderer> inner_;
};

}  // namespace sonar
