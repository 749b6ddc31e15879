// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMenu>
#include <QSortFilterProxyModel>
#include <QTreeView>
#include <QWidget>
#include <optional>
#include <string>
#include <vector>

#include "gui/list_columns.h"
#include "gui/rows_model.h"
#include "session/listening.h"
#include "session/review/rows.h"

namespace sonar {

/// Order and filter as the rows' own functions say.
class RowsOrder : public QSortFilterProxyModel {
 public:
  explicit RowsOrder(RowsModel& model, QObject* parent = nullptr);
  void set_filter(std::string filter);

 protected:
  [[nodiscard]] bool lessThan(const QModelIndex& a, const QModelIndex& b) const override;
  [[nodiscard]] bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

 private:
  [[nodiscard]] const Cell& key_of(const QModelIndex& index) const;

  RowsModel& model_;
  std::string filter_;
  mutable int keyed_column_ = -1;
  mutable std::vector<std::optional<Cell>> keys_;  ///< [row] of that column, as far as they were asked for
};

/// A list with a filter line over it: sorts by a click on a title, copies to a spreadsheet, opens on a double-click.
class RowsView : public QWidget {
 public:
  /// The rows outlive the view. tree: levels are shown as branches
  RowsView(Rows& rows, bool tree, QWidget* parent = nullptr);
  [[nodiscard]] QSize sizeHint() const override { return {420, 220}; }
  /// What a screen reader calls the list.
  void set_title(const QString& title);
  /// The marked rows into the clipboard, in the order in which they are seen.
  void copy();
  /// Several selected rows are no more than the current one: nobody sees them any longer.
  void let_go() { rows_.choose({}); }
  /// What a right click opens; it outlives the view.
  void set_menu(QMenu* menu) { menu_ = menu; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  void add_filter_line();
  void rows_changed();
  void show_selected();
  void show_current();
  void show_chosen();
  [[nodiscard]] bool was_let_go(const QModelIndex& at) const;
  void tell_chosen(const std::vector<std::size_t>& rows);
  void stay_with_chosen();
  void leave_out_hidden(std::vector<std::size_t> chosen);
  void go_to(std::size_t row);
  /// Rows that are marked, in no order; and marking them again.
  [[nodiscard]] std::vector<std::size_t> chosen_rows() const;
  void choose(const std::vector<std::size_t>& rows);
  [[nodiscard]] bool key_is_ours(const class QKeyEvent& event) const;

  Rows& rows_;
  RowsModel model_;
  RowsOrder order_;
  QTreeView* list_;
  ListColumns columns_;
  QMenu* menu_ = nullptr;
  bool following_ = false;  ///< the selection follows the rows: nobody clicked
  bool showed_ = false;     ///< the rows had one that the window has selected
  bool stale_ = true;       ///< changed while nobody saw it
  Listening listening_;     // the last member: it ends first
};

}  // namespace sonar
