// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QComboBox>
#include <QProgressBar>
#include <memory>

#include "gui/page_window.h"
#include "session/listening.h"
#include "session/numbers/integration_pictures.h"

namespace sonar {

/// The page of echo integration.
class IntegrationWindow : public PageWindow {
 public:
  /// The app outlives the window.
  explicit IntegrationWindow(AppModel& app);
  ~IntegrationWindow() override { end_results(); }

 private:
  void add_choices();
  void add_results();
  void add_foot();
  void show_state();
  void show_bins();

  Integration& integration_;
  std::unique_ptr<EffortPicture> nasc_;
  std::unique_ptr<EffortPicture> section_;
  QLabel* transects_ = nullptr;
  QComboBox* bins_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QPushButton* start_ = nullptr;
  QPushButton* stop_ = nullptr;
  QPushButton* write_ = nullptr;
  std::string shown_told_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
