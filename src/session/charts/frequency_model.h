// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "publish/frequency_picture.h"
#include "session/charts/school_looks.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"
#include "view/charts/frequency_chart.h"

namespace sonar {

/// What the chart shows, and where.
struct FrequencySight {
  FrequencyChartData data;
  PanelChart chart;
};

/// The selected schools over the frequencies of their fans, of all their pings or of the ping on show
/// (picture_file.kind.frequency), and the water round them. Pings are looked at behind the window, one after the other: the
/// chart is there after the first few, and becomes that of all.
class FrequencyModel : public LivePicture {
 public:
  explicit FrequencyModel(Workspace& workspace);

  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// Of the picture on show; null without one.
  [[nodiscard]] const std::shared_ptr<const FrequencySight>& sight() const { return sight_; }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  void hear(DocumentChange change);
  [[nodiscard]] const FrequencyParams& params() const { return workspace_.picture_file.values().kind.frequency; }

  Workspace& workspace_;
  FrequencyParams asked_;
  std::shared_ptr<HeardSchools<SchoolFans>> heard_;  ///< of builds, those of panels too
  std::shared_ptr<const FrequencySight> sight_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
