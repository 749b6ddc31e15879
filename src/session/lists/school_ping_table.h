// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/lists/document_rows.h"
#include "session/open/survey_schools.h"

namespace sonar {

/// A school in one ping, as it is measured.
struct SchoolInPing {
  SchoolName name;
  ProductPtr product;  ///< keeps `row`
  const SchoolPingRow* row = nullptr;
};

/// Figures of the selected school in each of its pings, or of all schools. A click on one goes to the ping.
class SchoolPingTable : public DocumentRows {
 public:
  explicit SchoolPingTable(Workspace& workspace);
  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return pings_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;
  void select(std::size_t row) override;
  void open(std::size_t row) override { select(row); }
  [[nodiscard]] std::optional<std::size_t> selected() const override;
  [[nodiscard]] std::string example_limit() const override { return "depth>80"; }

  [[nodiscard]] bool all() const { return all_; }
  void show_all(bool all);

 protected:
  void make() override;
  void school_selected() override { all_ ? moved().tell() : refresh(); }

 private:
  std::vector<ListColumn> titles_;
  std::vector<SchoolInPing> pings_;
  bool all_ = false;
};

}  // namespace sonar
