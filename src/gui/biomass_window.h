// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QListWidget>
#include <memory>
#include <string>
#include <vector>

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
  void hideEvent(QHideEvent* event) override;

 private:
  [[nodiscard]] PanelSection section(const char* title, std::vector<std::string> names);
  void add_choices();
  void add_foot();
  void open_table(const char* title, Result<void> (FishBiomass::*read)(const std::filesystem::path&));
  void show_state();
  void show_relations();

  FishBiomass& fish_;
  std::unique_ptr<CausePicture> causes_;
  QVBoxLayout* strength_ = nullptr;
  QWidget* relation_choice_ = nullptr;
  QListWidget* relations_ = nullptr;
  QLabel* relation_ = nullptr;
  QLabel* files_ = nullptr;
  QPushButton* write_ = nullptr;
  std::string shown_told_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
