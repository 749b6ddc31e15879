// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "session/listening.h"
#include "session/lists/document_rows.h"

namespace sonar {

/// An echo that detection refused, by its loudest sighting.
struct SurveyEcho {
  EchoName name;
  OpenObservationPtr observation;
  RefusedPtr rows;  ///< keeps what `sightings` points to
  RefusedSightings sightings;
};

/// What lay above the background and is no school, of all observations in which schools were looked for. A click on one goes to it.
class RefusedTable : public DocumentRows {
 public:
  explicit RefusedTable(Workspace& workspace);
  RefusedTable(const RefusedTable&) = delete;
  RefusedTable& operator=(const RefusedTable&) = delete;

  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return echoes_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;
  void select(std::size_t row) override;
  void open(std::size_t row) override { select(row); }
  [[nodiscard]] std::optional<std::size_t> selected() const override;
  [[nodiscard]] std::string example_limit() const override { return "level>-50"; }

 protected:
  void make() override;
  void school_selected() override {}

 private:
  std::vector<ListColumn> titles_;
  std::vector<SurveyEcho> echoes_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
