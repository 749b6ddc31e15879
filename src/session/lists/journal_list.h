// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "session/lists/document_rows.h"

namespace sonar {

/// Every act on the survey, the newest first; those that were undone are marked. A double-click goes to the ping that it
/// was done on.
class JournalList : public DocumentRows {
 public:
  explicit JournalList(Workspace& workspace);
  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return lines_ ? lines_->size() : 0; }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;
  [[nodiscard]] bool faded(std::size_t row) const override;
  void open(std::size_t row) override;

 protected:
  void make() override;
  void school_selected() override {}

 private:
  struct Place {
    std::size_t observation = 0;
    std::int64_t ping_index = 0;
  };
  [[nodiscard]] const JournalLine& line(std::size_t row) const { return (*lines_)[lines_->size() - 1 - row]; }
  [[nodiscard]] std::optional<Place> place_of(const JournalLine& line) const;
  [[nodiscard]] std::string what(const JournalLine& line) const;

  std::vector<ListColumn> titles_;
  std::shared_ptr<const std::vector<JournalLine>> lines_;
  std::set<std::int64_t> undone_;
};

}  // namespace sonar
