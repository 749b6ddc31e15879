// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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
  std::string named{};  ///< the number and what a human called the school, where there is room for it; may be empty
};

/// A label at the first of these places where there is room, each at a distance from what it names; from the second on
/// a line leads there, which is added to the picture. Empty where there is none.
/// place    what it names
/// nearest  0 = beside it; else only with a line
[[nodiscard]] std::optional<TextItem> placed_about(FrameDescription& frame, LabelRoom& room, const TextItem& label,
                                                   const NumberedPlace& place, const Theme& theme,
                                                   std::size_t nearest = 0);

/// Anchors of a label right and left of what it names, above and below it, and beyond its corners.
[[nodiscard]] std::array<PixelPoint, 8> places_beside(const PixelRect& named, const TextItem& label);

/// A selected school's name beside what is seen of the school; else its number, which is always there: beside it, farther
/// off with a line to it, upon it where it fills the picture, at last on other words.
/// room  knows nothing of what is seen of the school, and then that as taken
/// name  anchored in its middle
/// seen  the part of the school that lies in the room
void add_selected_name(FrameDescription& frame, LabelRoom& room, TextItem name, const std::string& number,
                       const PixelRect& seen, const Theme& theme);

/// "3 Big one"; empty without a name. A long one is cut.
[[nodiscard]] std::string named_text(std::int64_t number, const std::string& name, const Theme& theme);

/// Numbers beside their places, in order of importance: none on another, none cut by the map's edge, off lines where
/// there is a choice. One that finds room only farther off has a line to its place.
/// returns  what found no room even so
[[nodiscard]] std::vector<std::string> add_school_numbers(FrameDescription& frame, LabelRoom& room,
                                                          std::span<const NumberedPlace> places, const Theme& theme);

/// "numbers left out: 5, 9 and 3 more"; empty for none.
/// what  are left out
[[nodiscard]] std::string left_out_text(std::span<const std::string> labels, const char* what = "numbers");

/// Numbers as one text: "3", "1, 4", "1–5", "7 schools" where that is too long.
/// numbers  rising, at least one
/// schools  that these are
[[nodiscard]] std::string numbers_text(std::span<const std::int64_t> numbers, std::size_t schools);

}  // namespace sonar
