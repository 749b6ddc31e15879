// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "pipeline/survey/calibration_in_force.h"
#include "session/lists/document_rows.h"

namespace sonar {

/// calibration_in_force() of the observation on show, under the calibration that is chosen.
class CalibrationTable : public DocumentRows {
 public:
  explicit CalibrationTable(Workspace& workspace);

  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return beams_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;
  [[nodiscard]] std::string example_limit() const override { return "gain<20"; }

 protected:
  void make() override;
  void school_selected() override {}

 private:
  std::vector<ListColumn> titles_;
  std::vector<BeamInForce> beams_;
};

}  // namespace sonar
