// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "view/frame_description.h"

namespace sonar {

/// The room that labels leave each other in a picture: none lies on another or reaches out, and none crosses a line
/// where it has the choice.
class LabelRoom {
 public:
  explicit LabelRoom(const PixelRect& inside) : inside_(inside) {}

  /// A line that labels rather keep off.
  void add_line(PixelPoint a, PixelPoint b) { lines_.push_back({a, b}); }
  /// What else no label may lie on: a symbol, a box of words.
  void take(const PixelRect& place) { taken_.push_back(place); }

  /// The label at the first of `places` (its anchor) where it lies inside, on no label and on no line; else at the first
  /// where it lies inside and on no label; empty where there is none. Room that was given stays taken.
  /// on_lines  false: rather none than one that crosses a line
  [[nodiscard]] std::optional<TextItem> place(TextItem label, std::span<const PixelPoint> places, bool on_lines = true);

  /// The label where it lies inside and on no label, as near to its anchor as that is, whatever line it crosses: it
  /// finds the last free place.
  [[nodiscard]] std::optional<TextItem> place_nearest(const TextItem& label);
  /// The label as near to its anchor as it lies inside, whatever it lies on; its room is taken.
  [[nodiscard]] TextItem force(TextItem label);

  /// What a level text covers, pixels; a little wide, since no font is asked.
  [[nodiscard]] static PixelRect box_of(const TextItem& label);

 private:
  struct Line {
    PixelPoint a;
    PixelPoint b;
  };
  [[nodiscard]] bool free(const PixelRect& box) const;
  [[nodiscard]] bool crossed(const PixelRect& box) const;

  PixelRect inside_;
  std::vector<PixelRect> taken_;
  std::vector<Line> lines_;
};

}  // namespace sonar
