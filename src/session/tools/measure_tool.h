// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"

namespace sonar {

/// Whether a measurement is of what is on show: of the chart, or of the ping looked at.
[[nodiscard]] bool on_show(const Workspace& workspace, const Measurement& measured);
/// What the status line says of it; empty where there is none on show.
[[nodiscard]] std::string measured_text(const Workspace& workspace);

/// Keeps the measurement right: its figures follow the ping's Sv and the switch for all fans, and it ends with its survey
/// or observation.
/// threads  the window's
class MeasureTool {
 public:
  explicit MeasureTool(Workspace& workspace);
  /// Whether a line, a box or a lasso is in the hand.
  [[nodiscard]] bool drawing() const;
  /// What was measured is forgotten, and a drag has never been.
  void cancel() { workspace_.measurement.set(std::nullopt); }

 private:
  void hear(DocumentChange change);
  void measure_again();

  Workspace& workspace_;
  Listening listening_;  // the last member: it ends first
};

/// Nothing measured yet, of the ping on show.
[[nodiscard]] Measurement of_ping(const Workspace& workspace, Measurement::On on);
/// Whether there is a ping to measure in.
[[nodiscard]] bool has_ping(const Workspace& workspace);
/// A place in the sector of the ping on show, with what is known of it.
[[nodiscard]] MeasuredEnd end_at(const Workspace& workspace, const Point<Sonar>& place, std::optional<Voxel> voxel);
/// With the figures of the ping on show as it is now.
[[nodiscard]] Measurement figured(const Workspace& workspace, Measurement measured);

/// The tool in the volume: one press is an end of a line, the next one the other.
void measure_voxel(Workspace& workspace, const Voxel& voxel);
/// Where the other end would be.
void hover_voxel(Workspace& workspace, const Voxel& voxel);

/// A drag of less is a press that went nowhere, units of the window.
inline constexpr double kMeasureBegins_px = 3.0;

/// The line, or the dashed outline, of what was measured, with its figures beside it; in a picture's pixels.
/// plot  what it is drawn in and must not leave
[[nodiscard]] std::vector<Overlay> measured_overlays(const Measurement& measured, const std::vector<PixelPoint>& at,
                                                     const PixelRect& plot, const Units& units);

}  // namespace sonar
