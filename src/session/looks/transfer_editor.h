// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/looks/curves.h"
#include "session/open/workspace.h"
#include "view/axes.h"

namespace sonar {

/// The transfer function over the histogram of the ping on show: corners are dragged, added by a double-click on the
/// empty plot and taken away by a right click; the colour bar's ends are the display limits.
class TransferEditor : public LivePicture {
 public:
  explicit TransferEditor(Workspace& workspace);

  void pointer(const PointerEvent& event) override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;

  /// Which curve the corners belong to.
  [[nodiscard]] Shared<bool>& growth_shown() { return growth_shown_; }
  void take_preset(std::string_view name);
  /// Corners of the curve that is edited.
  [[nodiscard]] std::vector<OpacityPoint> points() const;
  /// Places in the frame, which is in the window's units.
  [[nodiscard]] PixelPoint place_of(const OpacityPoint& point) const;
  [[nodiscard]] PlotFrame plot() const;

 protected:
  Build build(const PictureLook& look) override;

 private:
  enum class Grip : std::uint8_t { none, corner, low_limit, high_limit };

  [[nodiscard]] PixelPoint in_frame(PixelPoint pixel) const { return {pixel.x / scale(), pixel.y / scale()}; }
  void set_points(const std::vector<OpacityPoint>& points);
  void press(const PointerEvent& event);
  void drag(PixelPoint to);
  [[nodiscard]] std::optional<std::size_t> corner_at(PixelPoint at) const;
  [[nodiscard]] OpacityPoint point_at(PixelPoint at) const;
  [[nodiscard]] PixelRect bar() const;

  Workspace& workspace_;
  Shared<bool> growth_shown_;
  Grip grip_ = Grip::none;
  std::size_t held_ = 0;
  Listening listening_;  // the last member: it ends first
};

/// Shares of a ping's voxels by Sv: bins of 1 dB from first_db on, in parts of the fullest bin, on a logarithmic scale.
[[nodiscard]] std::vector<double> sv_histogram(const Volume& volume, double first_db, int bins);

}  // namespace sonar
