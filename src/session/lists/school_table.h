// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/lists/document_rows.h"
#include "session/open/survey_schools.h"

namespace sonar {

/// Columns of tables of schools.
[[nodiscard]] const std::vector<ColumnOf<SurveySchool>>& school_columns();

/// All schools of the observations that are open. A click on one selects it and goes to its middle ping. Several that are
/// selected together are so in every table, and by school: rows that move keep that.
class SchoolTable : public DocumentRows {
 public:
  explicit SchoolTable(Workspace& workspace);
  SchoolTable(const SchoolTable&) = delete;
  SchoolTable& operator=(const SchoolTable&) = delete;
  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return schools_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;
  void select(std::size_t row) override;
  void open(std::size_t row) override { select(row); }
  [[nodiscard]] std::optional<std::size_t> selected() const override;
  void choose(const std::vector<std::size_t>& rows) override;
  [[nodiscard]] std::optional<std::vector<std::size_t>> chosen() const override;
  [[nodiscard]] std::string example_limit() const override { return "depth>80"; }
  [[nodiscard]] bool faded(std::size_t row) const override { return schools_[row].decided().status == "rejected"; }

 protected:
  void make() override;
  [[nodiscard]] std::vector<SurveySchool>& schools() { return schools_; }
  [[nodiscard]] const std::vector<SurveySchool>& schools() const { return schools_; }

 private:
  std::vector<ListColumn> titles_;
  std::vector<SurveySchool> schools_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
