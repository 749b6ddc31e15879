// SPDX-License-Identifier: Apache-2.0
#include "window_at_work.h"

#include <algorithm>

#include "pipeline/observe.h"

namespace sonar {

WindowAtWork::Target WindowAtWork::look_at_school() {
  Work work;
  const auto found = observe(*document().survey(), document().shown()->files(), Recipe{}, {{}, {}, "test"}, work);
  EXPECT_TRUE(found && !found->masks.empty());
  Target target;
  const SchoolMask& mask = found->masks[found->masks.size() / 4];
  target.ping = mask.ping_index;
  auto left = std::max_element(mask.mask.confidence.begin(), mask.mask.confidence.end()) - mask.mask.confidence.begin();
  for (const sonar::Run& run : mask.mask.runs) {
    if (left < run.count) {
      const int beams = document().shown()->sector().beams();
      target.voxel = {run.row / beams, run.row % beams, run.first_sample + static_cast<int>(left)};
      break;
    }
    left -= run.count;
  }
  document().look_at(target.ping);
  desk_->workspace.slices.set({target.voxel.fan, target.voxel.beam});
  settle();
  return target;
}

}  // namespace sonar
