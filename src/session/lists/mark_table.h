// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "session/listening.h"
#include "session/lists/document_rows.h"
#include "session/marks/marks.h"
#include "session/marks/transects.h"

namespace sonar {

/// What was marked in the time of the survey, or what a table tells of its transects, and the ping where it begins.
struct MarkRow {
  std::variant<SurveyMark, SurveyPeriod> what;
  std::size_t observation_index = 0;
  std::string observation;
  std::int64_t ping = 0;
  PingNavigation at;
};

/// What was marked in the time of the survey, bookmarks with a small picture, and its transects. A click on one goes to it.
class MarkTable : public DocumentRows {
 public:
  explicit MarkTable(AppModel& app);
  MarkTable(const MarkTable&) = delete;
  MarkTable& operator=(const MarkTable&) = delete;

  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return marks_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;
  [[nodiscard]] std::optional<std::filesystem::path> picture(std::size_t row) const override;
  void select(std::size_t row) override;
  void open(std::size_t row) override { select(row); }
  [[nodiscard]] std::optional<std::size_t> selected() const override;

 protected:
  void make() override;
  void school_selected() override {}

 private:
  std::vector<ListColumn> titles_;
  std::vector<MarkRow> marks_;
  bool pictures_ = false;  ///< a bookmark is among them
  Listening listening_;    // the last member: it ends first
};

}  // namespace sonar
