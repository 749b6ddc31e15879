// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QListWidget>
#include <memory>
#include <string>

#include "gui/page_window.h"
#include "session/listening.h"
#include "session/numbers/fish_biomass.h"

namespace sonar {

/// The page of numbers and biomass.
class BiomassWindow : public PageWindow {
 public:
  /// The app outlives the window.
  explicit BiomassWindow(AppModel& app);
  ~BiomassWindow() override { end_results(); }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void add_choices();
  void add_foot();
  void open_table(const char* title, Result<void> (FishBiomass::*read)(const std::filesystem::path&));
  void show_state();
  void show_relations();

  FishBiomass& fish_;
  std::unique_ptr<CausePicture> causes_;
  QListWidget* relations_ = nullptr;
  QLabel* relation_ = nullptr;
  QLabel* files_ = nullptr;
  QPushButton* write_ = nullptr;
  std::string shown_told_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
