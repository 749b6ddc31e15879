// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "session/batch/batch.h"
#include "session/listening.h"
#include "session/review/rows.h"

namespace sonar {

/// The surveys of a batch in their order, each with how it stands.
/// threads  the window's
class BatchRows : public Rows {
 public:
  enum class Column : std::uint8_t { survey, raw_files, results, state, progress, schools, problems };

  /// The batch outlives the rows.
  explicit BatchRows(Batch& batch);
  [[nodiscard]] const std::vector<ListColumn>& columns() const override;
  [[nodiscard]] std::size_t rows() const override { return batch_.surveys().size(); }
  /// The key of progress is its share, 0 to 1.
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;

 private:
  Batch& batch_;
  Listening listening_;
};

/// "survey 2 of 5, 41 %, 3.5 h left"; how many are done and failed where nothing runs.
[[nodiscard]] std::string total_text(const Batch& batch);

}  // namespace sonar
