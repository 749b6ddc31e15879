// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "view/frame_description.h"
#include "view/label_room.h"
#include "view/theme.h"

namespace sonar {

/// The number of a school, or of several that share a marker, and what on a map it names.
struct NumberedPlace {
  PixelPoint at;
  std::string text;
  double radius_px = 0.0;  ///< of what is drawn there: the number stands outside
  bool selected = false;
};

/// Numbers beside their places, in order of importance: none on another, none cut by the map's edge, off lines where
/// there is a choice. One that finds room only farther off has a line to its place.
/// returns  what found no room even so
[[nodiscard]] std::vector<std::string> add_school_numbers(FrameDescription& frame, LabelRoom& room,
                                                          std::span<const NumberedPlace> places, const Theme& theme);

/// "numbers left out: 5, 9 and 3 more"; empty for none.
[[nodiscard]] std::string left_out_text(std::span<const std::string> numbers);

/// Numbers as one text: "3", "1, 4", "1–5", "7 schools" where that is too long.
/// numbers  rising, at least one
[[nodiscard]] std::string numbers_text(std::span<const std::int64_t> numbers);

}  // namespace sonar
