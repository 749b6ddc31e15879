// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/numbers/integration.h"
#include "view/charts/effort_charts.h"

namespace sonar {

/// A chart of the last echo integration over sailed distance: its NASC, or Sv by depth channel. A click goes to the ping.
class EffortPicture : public LivePicture {
 public:
  enum class Kind : std::uint8_t { nasc, section };
  /// Both outlive the picture.
  EffortPicture(Workspace& workspace, Integration& integration, Kind kind);

  /// Where the range bins of the result begin, m.
  [[nodiscard]] std::vector<double> range_bins() const;
  /// empty = the mean of all
  void show_range_bin(std::optional<double> from_m);

  void pointer(const PointerEvent& event) override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// Of the picture on show; null without one.
  [[nodiscard]] const std::shared_ptr<const EffortChart>& chart() const { return chart_; }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  Workspace& workspace_;
  Integration& integration_;
  Kind kind_;
  std::shared_ptr<const Integrated> shown_;
  std::optional<double> range_from_m_;
  std::shared_ptr<const EffortChart> chart_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
