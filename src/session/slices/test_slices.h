// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include "pipeline/stages/observe.h"
#include "session/app_model.h"
#include "session/playing/playback.h"
#include "session/slices/slice_model.h"
#include "session/test_survey.h"
#include "session/tools/brush_tool.h"
#include "session/tools/seed_tool.h"

namespace sonar {

/// An app on the small simulated survey, its two slices seen at 480 x 360; for tests.
class SlicesApp {
 public:
  explicit SlicesApp(const Recipe& recipe = {}) : app(queue, options(journal, recipe)) {
    app.workspace.document.open({TestSurvey::easy().folder()});
    for (SliceModel* slice : {&top(), &side()}) {
      slice->resize({480, 360}, 1.0);
      slice->set_seen(true);
    }
    settle();
  }

  [[nodiscard]] Workspace& workspace() { return app.workspace; }
  [[nodiscard]] Document& document() { return app.workspace.document; }
  [[nodiscard]] SliceModel& top() { return dynamic_cast<SliceModel&>(*app.picture("top_slice")); }
  [[nodiscard]] SliceModel& side() { return dynamic_cast<SliceModel&>(*app.picture("side_slice")); }
  [[nodiscard]] SliceModel& range() { return dynamic_cast<SliceModel&>(*app.picture("range_slice")); }
  [[nodiscard]] SliceModel& plane() { return dynamic_cast<SliceModel&>(*app.picture("plane_slice")); }
  /// Switches on the two views that a window begins without.
  void show_all_four() {
    ViewSwitches views = workspace().views.values();
    views.range_slice = views.plane_slice = true;
    workspace().views.assign(views);
    for (SliceModel* slice : {&range(), &plane()}) {
      slice->resize({480, 360}, 1.0);
      slice->set_seen(true);
    }
    settle();
  }

  /// Returns when nothing runs or waits.
  void settle() {
    do {
      document().settle();
      app.seed_tool->wait();
      top().wait();
      side().wait();
      range().wait();
      plane().wait();
    } while (queue.drain() > 0);
  }
  /// Asks as keys and menus do.
  void ask(const std::string& id) {
    const Action* action = app.actions.find(id);
    if (action != nullptr) action->run();
  }

  /// The surest voxel of what the recipe finds in the first observation, in a ping with neighbours on both sides.
  struct Bright {
    std::int64_t ping = 0;
    Voxel voxel;
    SeedKey seed;
  };
  [[nodiscard]] static const Bright& bright() {
    static const Bright found = [] {
      SlicesApp searching;
      return searching.find_bright();
    }();
    return found;
  }
  /// Looks at the bright voxel: its ping, its fan, its beam.
  void look_at_bright() {
    document().look_at(bright().ping);
    workspace().slices.set({bright().voxel.fan, bright().voxel.beam});
    settle();
  }
  [[nodiscard]] PointerEvent at(SliceModel& slice, const Voxel& voxel, PointerAction action,
                                PointerButton button = PointerButton::none) {
    const auto place = slice.picture() ? slice.picture()->place_of(voxel) : std::nullopt;
    return {action, button, place.value_or(PixelPoint{-1.0, -1.0})};
  }
  void click(SliceModel& slice, const Voxel& voxel, bool shift = false, bool control = false) {
    for (const PointerAction action : {PointerAction::move, PointerAction::press, PointerAction::release}) {
      PointerEvent event = at(slice, voxel, action, PointerButton::left);
      if (action == PointerAction::move) event.button = PointerButton::none;
      event.shift = shift;
      event.control = control;
      slice.pointer(event);
    }
  }

  std::filesystem::path journal = TestSurvey::easy().fresh();
  ChangeQueue queue;
  AppModel app;

 private:
  static DocumentOptions options(const std::filesystem::path& journal, const Recipe& recipe) {
    DocumentOptions options = TestSurvey::options(journal);
    options.recipe = recipe;
    return options;
  }
  Bright find_bright() {
    Work work;
    const auto found = observe(*document().survey(), document().shown()->files(), Recipe{}, {{}, {}, "test"}, work);
    const BeamGrid& grid = document().shown()->grid();
    for (const SchoolMask& mask : found->masks) {
      if (mask.ping_index < 3 || mask.ping_index > TestSurvey::kPings - 4) continue;
      auto left =
          std::max_element(mask.mask.confidence.begin(), mask.mask.confidence.end()) - mask.mask.confidence.begin();
      for (const sonar::Run& run : mask.mask.runs) {
        if (left < run.count) {
          const int sample = run.first_sample + static_cast<int>(left);
          return {mask.ping_index,
                  {run.row / grid.beams(), run.row % grid.beams(), sample},
                  {grid.channel[static_cast<std::size_t>(run.row)], sample}};
        }
        left -= run.count;
      }
    }
    return {};
  }
};

}  // namespace sonar
