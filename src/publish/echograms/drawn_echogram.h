// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/timelines/timeline.h"

namespace sonar {

/// An echogram made ready: everything that its picture points to.
struct DrawnEchogram {
  ObservationProduct product;                 ///< the pings that are shown, and the schools that are asked for
  std::unique_ptr<EchogramPyramid> echogram;  ///< null without raw files
  std::vector<EchogramSchool> schools;
  std::vector<EchogramStretch> shadow;  ///< of the schools that are shown, where the options ask for it
  std::string of;                       ///< what it is of
  TimelineHeights heights;              ///< that it covers
  SvScale scale;                        ///< unless a user chose another
  bool searched = false;
  bool filtered = false;  ///< its noise was removed
};

/// Reads the pings that the options ask for.
/// errors  as echogram_frame()
[[nodiscard]] Result<DrawnEchogram> drawn_echogram(DrawnObservation& observation, const PictureOptions& options,
                                                   Work& work);

}  // namespace sonar
