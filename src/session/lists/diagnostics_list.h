// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "session/lists/document_rows.h"

namespace sonar {

/// Everything that is damaged or doubtful, and what the program had to tell, in one list. A double-click goes to the ping.
class DiagnosticsList : public DocumentRows {
 public:
  explicit DiagnosticsList(Workspace& workspace);
  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return notices().size() + remarks_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;
  void open(std::size_t row) override;

 protected:
  void make() override;
  void school_selected() override {}

 private:
  struct Remark {
    const Diagnostic* note = nullptr;  ///< null = a file that cannot be read
    std::size_t file = 0;
    std::ptrdiff_t observation = -1;
  };
  [[nodiscard]] const std::vector<std::string>& notices() const { return workspace().document.notices(); }
  /// Which remarks on decisions that were lost: those of the choices as they are now count alone.
  enum class Lost { with, without, alone };
  void add(const Diagnostics& notes, std::ptrdiff_t observation, Lost which = Lost::with);
  void add_observation(std::size_t index);
  [[nodiscard]] Cell unreadable_cell(const Remark& remark, std::size_t column) const;

  std::vector<ListColumn> titles_;
  std::vector<Remark> remarks_;
  std::vector<std::shared_ptr<const void>> kept_;  ///< what the remarks point into
};

}  // namespace sonar
