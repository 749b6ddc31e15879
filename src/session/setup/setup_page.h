// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "pipeline/calibrate/setup_report.h"
#include "session/app_model.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "view/charts/leg_chart.h"

namespace sonar {

/// What the page shows.
struct SetupSight {
  SetupReport report;
  LegChartData data;
  LegChart chart;
};

/// The setup check of the open survey, as `sonarx check` makes it of a run: the mean speeds of its schools on each course
/// leg, and the mounting angle and sound speed that would null them, which a human may put into the recipe.
/// threads  the window's
class SetupPage : public LivePicture {
 public:
  /// The app outlives the page. All observations are opened, so that their schools are measured.
  explicit SetupPage(AppModel& app);

  /// How many observations are measured, and what can be done.
  [[nodiscard]] std::string told() const;
  /// Null without a picture.
  [[nodiscard]] const std::shared_ptr<const SetupSight>& sight() const { return sight_; }
  /// Whether there is something to put into the recipe.
  [[nodiscard]] bool proposes() const;
  /// The survey is opened under the recipe with what is proposed; Document::use_recipe() with the one before takes it back.
  /// errors  bad_parameter: a recipe does not take the values
  [[nodiscard]] Result<void> use(bool mounting_angle, bool sound_speed);

  [[nodiscard]] std::string hint(PixelPoint at) const override;

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  AppModel& app_;
  std::shared_ptr<const SetupSight> sight_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
