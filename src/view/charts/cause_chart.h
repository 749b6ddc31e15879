// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

/// One cause of doubt in a number: how far the number reaches for it, dB, and what lies between.
struct CauseBar {
  std::string name;
  double down_db = 0.0;  ///< NaN = unknown: no bar, and the row says so
  double up_db = 0.0;
  struct Mark {
    std::string name;
    double at_db = 0.0;
  };
  std::vector<Mark> marks = {};
};

/// A bar for each cause, all on one axis of dB.
/// errors  bad_parameter: too small a picture; not_found: no cause has a known bar
[[nodiscard]] Result<FrameDescription> cause_chart(const std::string& title, const std::vector<CauseBar>& bars,
                                                   PixelSize size, const Theme& theme);

}  // namespace sonar
