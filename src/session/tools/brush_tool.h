// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "session/listening.h"
#include "session/open/workspace.h"
#include "view/slices/slice.h"

namespace sonar {

/// The voxels of a slice under a disc that is drawn from one place to another: those that its pixels show, and those that
/// lie between them because a pixel holds several samples.
/// from, to  in the map's pixels
/// out       sorted, not overlapping
[[nodiscard]] std::vector<Run> runs_under(const SliceMap& map, PixelPoint from, PixelPoint to, double radius_px);

/// Voxels that can belong to a school, with full confidence, as the commands take them.
[[nodiscard]] PingMask that_can_belong(const std::vector<Run>& runs, View3<const SampleFlags> flags);

/// Brush and eraser: one drag over a slice is one act. What it will change is the workspace's preview meanwhile.
///
/// The brush adds to the selected school, or makes a new one and selects it; the eraser takes from the selected school
/// where it is in the ping, else from all schools.
/// threads  the window's
class BrushTool {
 public:
  explicit BrushTool(Workspace& workspace);
  ~BrushTool() = default;
  BrushTool(const BrushTool&) = delete;
  BrushTool& operator=(const BrushTool&) = delete;

  /// at     in the map's pixels
  /// scale  of the map's pixels in a unit of the window, in which the brush has its size
  void press(const SliceMap& map, PixelPoint at, bool erase, double scale = 1.0);
  void move(const SliceMap& map, PixelPoint at);
  void release();
  /// The drag has never been.
  void cancel();
  [[nodiscard]] bool drawing() const { return ping_ != nullptr; }

 private:
  void paint(const SliceMap& map, PixelPoint to);
  void hear(DocumentChange change);

  Workspace& workspace_;
  OpenObservationPtr observation_;
  StagedPingPtr ping_;  ///< that is drawn upon; null = no drag
  bool erase_ = false;
  double scale_ = 1.0;
  PixelPoint last_;
  PingMask stroke_;
  ActTicket selects_ = 0;  ///< of the act that makes a school
  Listening listening_;    // the last member: it ends first
};

}  // namespace sonar
