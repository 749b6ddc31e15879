// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "session/tools/measure_tool.h"
#include "view/slices/slice_picture.h"

namespace sonar {

/// The measure tool in one slice: a drag is a line, with shift a box, with control a lasso; a press that goes nowhere ends
/// what was measured.
/// threads  the window's
class SliceMeasure {
 public:
  explicit SliceMeasure(Workspace& workspace) : workspace_(workspace) {}

  /// picture  on show; null = none
  /// scale    its pixels in a unit of the window
  /// out      true: the event was for the tool alone
  bool take(const PointerEvent& event, const SlicePicture* picture, double scale);
  /// What was measured in the slice on show.
  [[nodiscard]] std::vector<Overlay> overlays(const SlicePicture& picture) const;

 private:
  struct Drag {
    Measurement::Shape shape = Measurement::Shape::line;
    PixelPoint from;  ///< in the picture that was pressed upon
    PixelPoint last;  ///< the last point of a lasso
    bool moved = false;
  };
  void move(PixelPoint at, const SlicePicture& picture, double scale);
  void begin(const SlicePicture& picture);
  [[nodiscard]] bool still_drawing(const SlicePicture& picture) const;

  Workspace& workspace_;
  std::optional<Drag> drag_;
};

}  // namespace sonar
