// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/beam_grid.h"
#include "session/lists/document_rows.h"

namespace sonar {

/// The survey as a tree: observations, below them their files, below these what is wrong with them; beside the
/// files how the stated beam angles compare with the widths, fan by fan. A double-click on
/// anything of an observation looks at it.
class SurveyTree : public DocumentRows {
 public:
  explicit SurveyTree(Workspace& workspace);
  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return rows_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;
  [[nodiscard]] int level(std::size_t row) const override { return rows_[row].level; }
  [[nodiscard]] bool for_now() const override { return workspace().document.glance() != nullptr; }
  void open(std::size_t row) override;
  [[nodiscard]] std::optional<std::size_t> selected() const override;
  [[nodiscard]] std::string example_limit() const override { return "pings>100"; }

 protected:
  void make() override;
  void school_selected() override {}

 private:
  struct Row {
    int level = 0;
    std::optional<std::size_t> observation;
    std::string name;
    Cell time;
    Cell pings;
    Cell schools;
    std::string notes;
  };
  void add_glanced(const SurveyFiles& glance);
  void add_observation(std::size_t index);
  void add_beams(const BeamGrid& grid, std::size_t observation);
  void add_file(std::size_t file, std::optional<std::size_t> observation);
  void add_notes(const Diagnostics& notes, int level, std::optional<std::size_t> observation);

  std::vector<ListColumn> titles_;
  std::vector<Row> rows_;
};

}  // namespace sonar
