// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QTreeView>
#include <optional>

#include "gui/rows_model.h"
#include "session/batch/batch_rows.h"
#include "session/listening.h"

namespace sonar {

/// The surveys of a batch, a row each, in the order in which they are run; a bar behind its text shows how far one is.
class BatchTable : public QTreeView {
 public:
  explicit BatchTable(Batch& batch, QWidget* parent = nullptr);

  /// Empty where no row is marked.
  [[nodiscard]] std::optional<std::size_t> current() const;
  void set_current(std::size_t row);

 private:
  void follow();
  void fit_columns();

  BatchRows rows_;
  RowsModel model_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
