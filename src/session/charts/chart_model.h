// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"
#include "view/charts/chart.h"

namespace sonar {

/// What a chart shows, and where.
struct ChartSight {
  ChartData data;
  ChartPlaces places;
  ChartPart whole;                        ///< what it shows without zooming
  std::vector<std::size_t> observations;  ///< index in the survey, by ChartSchool::observation
  [[nodiscard]] SchoolName name_of(std::size_t row) const;
};

/// Figures of the survey's schools, one column of a table over another or the histogram of one: which, the parameters of
/// pictures say (picture_file.kind.chart), so that a picture in a file is that of the window. Dragging over points or bars
/// selects their schools, with Shift in addition; a click on a point goes to its ping; on nothing it selects nothing. The
/// wheel zooms about the pointer, dragging with the middle button pans, a double press shows everything.
class ChartModel : public LivePicture {
 public:
  explicit ChartModel(Workspace& workspace);

  void pointer(const PointerEvent& event) override;
  [[nodiscard]] bool pans() const override { return true; }
  bool aim(PixelPoint at) override;
  [[nodiscard]] std::vector<Overlay> overlays() const override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// Of the picture on show; null without one.
  [[nodiscard]] const std::shared_ptr<const ChartSight>& sight() const { return sight_; }
  /// Everything again.
  void show_all();
  [[nodiscard]] bool zoomed() const { return shown_.has_value(); }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  struct Drag {
    PixelPoint from;
    PixelPoint to;
    bool adds = false;
    bool moved = false;
  };
  struct Pan {
    PixelPoint from;
    ChartPart part;
  };
  void hear(DocumentChange change);
  void parameters_changed();
  void press(const PointerEvent& event);
  void move(const PointerEvent& event);
  void release();
  void click(PixelPoint at);
  void go_to_row(std::size_t row);
  void select(const std::vector<std::size_t>& rows, bool adds);
  void zoom(PixelPoint at, double factor);
  void pan_to(PixelPoint at);
  /// Where there is a line instead of a chart, the last one is not what is pointed at.
  [[nodiscard]] bool in_sight() const { return sight_ && problem().empty(); }
  /// What was asked for last; its picture may still be on its way.
  [[nodiscard]] ChartPart part() const { return shown_.value_or(sight_->whole); }

  Workspace& workspace_;
  ChartParams asked_;
  std::optional<Drag> drag_;
  std::optional<Pan> pan_;
  std::optional<ChartPart> shown_;  ///< empty = everything
  std::shared_ptr<const ChartSight> sight_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
