// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

#include "pipeline/stages/observe.h"
#include "session/maps/observation_map_model.h"
#include "session/maps/strip_model.h"
#include "session/maps/survey_map_model.h"
#include "session/test_survey.h"
#include "session/timelines/timeline_model.h"

namespace sonar {

/// Maps and timelines of the small simulated survey, none of them seen; for tests.
class TestMaps {
 public:
  explicit TestMaps(const std::filesystem::path& journal = TestSurvey::easy().fresh())
      : workspace(queue, TestSurvey::options(journal)) {
    workspace.document.open({TestSurvey::easy().folder()});
    settle();
  }

  void see(LivePicture& picture, PixelSize size = {480, 360}) {
    picture.resize(size, 1.0);
    picture.set_seen(true);
    settle();
  }
  /// Returns when nothing runs or waits.
  void settle() {
    do {
      workspace.document.settle();
      echograms->wait();
      for (LivePicture* picture : std::vector<LivePicture*>{&map, &strip, &survey, &timeline, &survey_timeline}) {
        picture->wait();
      }
    } while (queue.drain() > 0);
  }
  /// Clicks as a human does: press and release at one place.
  static void click(LivePicture& picture, PixelPoint at) {
    picture.pointer({.action = PointerAction::press, .button = PointerButton::left, .at = at});
    picture.pointer({.action = PointerAction::release, .button = PointerButton::left, .at = at});
  }
  static void drag(LivePicture& picture, PixelPoint from, PixelPoint to, bool shift = false) {
    picture.pointer({.action = PointerAction::press, .button = PointerButton::left, .at = from, .shift = shift});
    picture.pointer({.action = PointerAction::move, .button = PointerButton::left, .at = to, .shift = shift});
    picture.pointer({.action = PointerAction::release, .button = PointerButton::left, .at = to, .shift = shift});
  }

  /// One of the surest voxels of what the recipe finds in the first observation, in the middle of a school.
  struct Bright {
    std::int64_t ping = 0;
    SeedKey seed;
  };
  Bright bright() {
    Work work;
    const auto& files = workspace.document.survey()->observations.front();
    const auto found = observe(*workspace.document.survey(), files, Recipe{}, {{}, {}, "test"}, work);
    const SchoolMask& mask = found->masks[found->masks.size() / 4];
    const auto at = std::max_element(mask.mask.confidence.begin(), mask.mask.confidence.end());
    auto left = static_cast<std::int32_t>(at - mask.mask.confidence.begin());
    for (const sonar::Run& run : mask.mask.runs) {
      if (left < run.count) {
        return {mask.ping_index, {files.grid->channel[static_cast<std::size_t>(run.row)], run.first_sample + left}};
      }
      left -= run.count;
    }
    return {};
  }
  void grow(const Bright& at) {
    GrowCommand command;
    command.seeds = {at.seed};
    workspace.document.act(at.ping, command);
    settle();
  }
  void propagate(const Bright& at, std::int64_t reach) {
    PropagateCommand command;
    command.seeds = {at.seed};
    command.reach = reach;
    workspace.document.act(at.ping, command);
    settle();
  }

  ChangeQueue queue;
  Workspace workspace;
  std::shared_ptr<Echograms> echograms = std::make_shared<Echograms>(queue, workspace.document);
  ObservationMapModel map{workspace};
  StripModel strip{workspace};
  SurveyMapModel survey{workspace};
  TimelineModel timeline{workspace, echograms, TimelineOf::observation};
  TimelineModel survey_timeline{workspace, echograms, TimelineOf::survey};
};

}  // namespace sonar
