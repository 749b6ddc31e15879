// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QAbstractItemModel>
#include <vector>

#include "session/review/rows.h"

namespace sonar {

/// Rows as Qt wants them; levels become branches. Row numbers of Rows are the indexes' internal ids.
class RowsModel : public QAbstractItemModel {
 public:
  /// The rows outlive the model.
  explicit RowsModel(const Rows& rows, QObject* parent = nullptr);

  /// What a cell is sorted by, where that is a number.
  static constexpr int kKeyRole = Qt::UserRole;

  /// Asks the rows anew.
  void reset();
  /// Asks for the cells anew; there are as many rows as before.
  void refresh();
  [[nodiscard]] static std::size_t row_of(const QModelIndex& index) {
    return static_cast<std::size_t>(index.internalId());
  }
  [[nodiscard]] QModelIndex index_of(std::size_t row, int column = 0) const;
  [[nodiscard]] const Rows& rows() const { return rows_; }
  /// How many rows there were when they were asked last.
  [[nodiscard]] std::size_t rows_known() const { return place_.size(); }

  [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override;
  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
  [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  static constexpr std::size_t kTop = static_cast<std::size_t>(-1);
  [[nodiscard]] const std::vector<std::size_t>& below(const QModelIndex& parent) const;

  const Rows& rows_;
  std::vector<std::size_t> top_;                    ///< rows of level 0
  std::vector<std::size_t> parent_;                 ///< [row], kTop = none
  std::vector<std::vector<std::size_t>> children_;  ///< [row]
  std::vector<int> place_;                          ///< [row] among its siblings
};

}  // namespace sonar
