// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "publish/curves_picture.h"
#include "session/charts/school_looks.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"
#include "view/charts/panel_chart.h"

namespace sonar {

/// What the curves show, and where.
struct CurvesSight {
  PanelChartData data;
  PanelChart chart;
};

/// Curves of the selected schools (picture_file.kind.curves): the distribution of Sv in them and round them, over all of their
/// pings or the ping on show; their size over the tolerance in the ping on show, from the clicks that made them there, or
/// as a file's picture has it; or, of the whole survey, how schools behave against the ship.
class CurvesModel : public LivePicture {
 public:
  explicit CurvesModel(Workspace& workspace);

  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// Of the picture on show; null without one.
  [[nodiscard]] const std::shared_ptr<const CurvesSight>& sight() const { return sight_; }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  void hear(DocumentChange change);
  [[nodiscard]] Build build_avoidance(const PictureLook& look) const;
  [[nodiscard]] Build build_of_schools(const PictureLook& look) const;
  [[nodiscard]] const CurvesParams& params() const { return workspace_.picture_file.values().kind.curves; }

  Workspace& workspace_;
  CurvesParams asked_;
  std::shared_ptr<HeardSchools<SchoolCurves>> heard_;  ///< of distributions, those of panels too
  std::shared_ptr<const CurvesSight> sight_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
