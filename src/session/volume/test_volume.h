// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "publish/picture_output.h"
#include "publish/picture_source.h"
#include "publish/volumes/volume_picture.h"
#include "session/looks/screen_theme.h"
#include "session/test_survey.h"
#include "session/volume/volume_model.h"

namespace sonar {

inline constexpr PixelSize kVolumeTestSize{340, 260};

/// A small survey at work, and the view in three dimensions of its first ping; for tests.
class VolumeApp {
 public:
  VolumeApp() {
    auto& volume = workspace_.volume;
    VolumeParams params;
    params.frames = 2;
    params.moving_budget_ms = 5.0;
    params.renderer = RendererChoice::cpu;
    volume.assign(params);
    workspace_.document.open({TestSurvey::easy().folder()});
    workspace_.document.settle();
    show(std::make_unique<VolumeModel>(workspace_));
  }

  void show(std::unique_ptr<VolumeModel> model) {
    model_ = std::move(model);
    model_->resize(kVolumeTestSize, 1.0);
    model_->set_seen(true);
    settle();
  }

  void settle() {
    do {
      workspace_.document.settle();
      model_->wait();
    } while (queue_.drain() > 0);
  }

  void look_at(std::int64_t ping) {
    workspace_.document.look_at(ping);
    settle();
  }

  void point(PointerAction action, PixelPoint at, PointerButton button = PointerButton::none) {
    model_->pointer({action, button, at});
  }
  void drag(PointerButton button, PixelPoint from, PixelPoint to) {
    point(PointerAction::press, from, button);
    point(PointerAction::move, to, button);
    point(PointerAction::release, to, button);
    settle();
  }

  /// A place of the picture where something is seen; its corner where nothing is.
  PixelPoint seen_place() {
    const PixelRect& place = model_->shown()->place;
    for (double y = 0.3; y < 0.9; y += 0.05) {
      for (double x = 0.1; x < 0.9; x += 0.05) {
        const PixelPoint at{std::floor(place.x + x * place.width) + 0.5, std::floor(place.y + y * place.height) + 0.5};
        if (model_->shown()->picked_at(at)) return at;
      }
    }
    return {};
  }

  Camera camera() { return model_->camera().value_or(model_->shown()->view.camera); }

  /// What `sonarx render volume` draws of the ping looked at.
  Image rendered(const Camera& camera) {
    PictureOptions options;
    options.size = kVolumeTestSize;
    options.least_text_px = kLeastText_px;
    options.ping = static_cast<int>(workspace_.document.ping());
    options.transfer = workspace_.view_curve();
    options.camera = camera;
    options.fan = workspace_.slices().fan;
    options.beam = workspace_.slices().beam;
    options.display = workspace_.display.values();
    options.volume = workspace_.volume.values();
    const std::filesystem::path folder = TestSurvey::easy().folder();
    Work work;
    auto source = PictureSource::open({&folder, 1}, std::nullopt, work);
    auto frame = volume_frame((*source)->observations().front(), options, work);
    return *painted(*frame, 1.0);
  }

 protected:
  std::filesystem::path journal_ = TestSurvey::easy().fresh();
  ChangeQueue queue_;
  Workspace workspace_{queue_, TestSurvey::options(journal_)};
  std::unique_ptr<VolumeModel> model_;
};

}  // namespace sonar
