// SPDX-License-Identifier: Apache-2.0
#include "gui/rows_view.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QHeaderView>
#include <QItemSelection>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QMetaObject>
#include <QPersistentModelIndex>
#include <QScrollBar>
#include <QVBoxLayout>
#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "gui/own_keys.h"
#include "gui/translated.h"

namespace sonar {

RowsOrder::RowsOrder(RowsModel& model, QObject* parent) : QSortFilterProxyModel(parent), model_(model) {
  setSourceModel(&model);
  connect(&model, &QAbstractItemModel::modelAboutToBeReset, this, [this] { keys_.clear(); });
  setRecursiveFilteringEnabled(true);
}

void RowsOrder::set_filter(std::string filter) {
  filter_ = std::move(filter);
  invalidateFilter();
}

const Cell& RowsOrder::key_of(const QModelIndex& index) const {
  // Making a cell costs more than comparing two: sorting makes each once.
  if (keyed_column_ != index.column()) keys_.clear();
  keyed_column_ = index.column();
  keys_.resize(model_.rows_known());
  std::optional<Cell>& key = keys_[RowsModel::row_of(index)];
  if (!key) key = model_.rows().cell(RowsModel::row_of(index), static_cast<std::size_t>(index.column()));
  return *key;
}

bool RowsOrder::lessThan(const QModelIndex& a, const QModelIndex& b) const {
  (void)key_of(b);  // both are there before either is looked at
  return cell_less(key_of(a), key_of(b), sortOrder() == Qt::DescendingOrder);
}

bool RowsOrder::filterAcceptsRow(int row, const QModelIndex& parent) const {
  return row_matches(model_.rows(), RowsModel::row_of(model_.index(row, 0, parent)), filter_);
}

RowsView::RowsView(Rows& rows, bool tree, QWidget* parent)
    : QWidget(parent), rows_(rows), model_(rows), order_(model_), list_(new QTreeView(this)), columns_(rows, *list_) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  add_filter_line();
  column->addWidget(list_);
  list_->setObjectName("rows");
  list_->setModel(&order_);
  list_->setRootIsDecorated(tree);
  list_->setUniformRowHeights(true);
  list_->setAlternatingRowColors(!tree);
  list_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  list_->setSortingEnabled(true);
  order_.sort(-1);  // as the rows come, until somebody clicks a title
  list_->header()->setSortIndicator(-1, Qt::AscendingOrder);
  columns_.begin();
  list_->installEventFilter(this);
  connect(list_->selectionModel(), &QItemSelectionModel::currentChanged, this, [this](const QModelIndex& now) {
    if (following_ || !now.isValid()) return;
    // When the click has been worked in: what it brings may make the rows anew.
    QMetaObject::invokeMethod(
        this,
        [this, at = QPersistentModelIndex(now)] {
          if (at.isValid() && !was_let_go(at)) rows_.select(RowsModel::row_of(order_.mapToSource(at)));
        },
        Qt::QueuedConnection);
  });
  connect(list_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    if (following_) return;
    tell_chosen(chosen_rows());
    QMetaObject::invokeMethod(
        this, [this] { stay_with_chosen(); }, Qt::QueuedConnection);
  });
  // A click on the row that is current already goes there once more.
  connect(list_, &QTreeView::clicked, this, [this](const QModelIndex& at) {
    if (!was_let_go(at)) go_to(RowsModel::row_of(order_.mapToSource(at)));
  });
  connect(list_, &QTreeView::doubleClicked, this,
          [this](const QModelIndex& at) { rows_.open(RowsModel::row_of(order_.mapToSource(at))); });
  listening_.to(rows_.changed(), [this] { rows_changed(); });
  listening_.to(rows_.moved(), [this] {
    if (!stale_ && !following_) show_selected();
  });
}

void RowsView::set_title(const QString& title) {
  setAccessibleName(title);
  list_->setAccessibleName(title);
  findChild<QLineEdit*>("filter")->setAccessibleName(translated("Filter of %1").arg(title));
}

/// By a click with Ctrl: it is current, and others alone are chosen.
bool RowsView::was_let_go(const QModelIndex& at) const {
  const QItemSelectionModel& chosen = *list_->selectionModel();
  return chosen.hasSelection() && !chosen.isSelected(at);
}

void RowsView::tell_chosen(const std::vector<std::size_t>& rows) {
  following_ = true;  // what the rows make of it is seen here already
  rows_.choose(rows);
  following_ = false;
}

/// What the window has selected is one of the rows that are chosen: also where Ctrl has let go of it, or all were chosen
/// before any was clicked.
void RowsView::stay_with_chosen() {
  const std::vector<std::size_t> chosen = chosen_rows();
  const auto row = rows_.selected();
  const bool stays = row && std::find(chosen.begin(), chosen.end(), *row) != chosen.end();
  if (rows_.chosen() && !chosen.empty() && !stays) rows_.select(chosen.back());
}

/// A key must not decide about what the filter hides.
void RowsView::leave_out_hidden(std::vector<std::size_t> chosen) {
  const auto hidden = [&](std::size_t row) { return !order_.mapFromSource(model_.index_of(row)).isValid(); };
  if (std::erase_if(chosen, hidden) > 0) tell_chosen(chosen);
}

void RowsView::go_to(std::size_t row) {
  if (rows_.selected() != row) rows_.select(row);
}

void RowsView::add_filter_line() {
  auto* line = new QLineEdit(this);
  line->setObjectName("filter");
  const QString limit = QString::fromStdString(rows_.example_limit());
  line->setPlaceholderText(limit.isEmpty() ? translated("Filter: words")
                                           : translated("Filter: words, or %1").arg(limit));
  line->setToolTip(translated("Words that a row has, or a title's beginning and a limit: %1")
                       .arg(limit.isEmpty() ? QString("line>80") : limit));
  line->setAccessibleName(translated("Filter"));
  line->setClearButtonEnabled(true);
  keep_own_keys(*line);
  layout()->addWidget(line);
  connect(line, &QLineEdit::textChanged, this, [this](const QString& text) {
    rows_.narrow(text.toStdString());
    // The list moves on where its current row goes. Nobody clicked there, and rows that are made anew meanwhile would pull
    // the ground from under the filter.
    const std::vector<std::size_t> chosen = chosen_rows();
    following_ = true;
    order_.set_filter(text.toStdString());
    following_ = false;
    leave_out_hidden(chosen);
    show_selected();
  });
}

void RowsView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (stale_) rows_changed();
}

void RowsView::rows_changed() {
  stale_ = !isVisible();
  if (stale_) return;  // a list that nobody sees costs nothing
  following_ = true;
  const int scrolled = list_->verticalScrollBar()->value();
  std::set<std::size_t> open;
  for (std::size_t row = 0; list_->rootIsDecorated() && row < model_.rows_known(); ++row) {
    if (list_->isExpanded(order_.mapFromSource(model_.index_of(row)))) open.insert(row);
  }
  const std::size_t before = model_.rows_known();
  const std::vector<std::size_t> chosen = chosen_rows();
  model_.reset();
  if (model_.rows_known() == before) choose(chosen);
  for (const std::size_t row : open) list_->setExpanded(order_.mapFromSource(model_.index_of(row)), true);
  if (rows_.rows() > 0) columns_.fit();
  list_->verticalScrollBar()->setValue(scrolled);
  following_ = false;
  show_selected();
}

void RowsView::show_selected() {
  show_current();
  show_chosen();
}

void RowsView::show_current() {
  const auto row = rows_.selected();
  const QModelIndex at = row ? order_.mapFromSource(model_.index_of(*row)) : QModelIndex();
  const bool let_go = !row && showed_;
  showed_ = row.has_value();
  if (at == list_->currentIndex().siblingAtColumn(0) && at.isValid()) return;
  following_ = true;
  // What the list had marked for the window is let go with it; a list that follows nothing keeps what a human marked.
  if (let_go) {
    list_->selectionModel()->clearSelection();
    list_->selectionModel()->clearCurrentIndex();
  }
  if (at.isValid()) {
    // One of several that were chosen to be copied stays one of them.
    const bool chosen = list_->selectionModel()->isSelected(at);
    list_->selectionModel()->setCurrentIndex(
        at, chosen ? QItemSelectionModel::NoUpdate : QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    list_->scrollTo(at);
  }
  following_ = false;
}

/// In as few ranges as there are: thousands one by one take seconds.
void RowsView::show_chosen() {
  const auto chosen = rows_.chosen();
  if (!chosen) return;
  std::vector<int> at;
  for (const std::size_t row : *chosen) {
    const QModelIndex index = order_.mapFromSource(model_.index_of(row));
    if (index.isValid()) at.push_back(index.row());
  }
  std::sort(at.begin(), at.end());
  QItemSelection shown;
  for (std::size_t first = 0, end = 0; first < at.size(); first = end) {
    for (end = first + 1; end < at.size() && at[end] == at[end - 1] + 1;) ++end;
    shown.select(order_.index(at[first], 0), order_.index(at[end - 1], order_.columnCount() - 1));
  }
  if (shown == list_->selectionModel()->selection()) return;
  following_ = true;
  list_->selectionModel()->select(shown, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  following_ = false;
}

std::vector<std::size_t> RowsView::chosen_rows() const {
  const QModelIndexList chosen = list_->selectionModel()->selectedRows();
  std::vector<std::size_t> rows;
  for (const QModelIndex& at : chosen) rows.push_back(RowsModel::row_of(order_.mapToSource(at)));
  return rows;
}

void RowsView::choose(const std::vector<std::size_t>& rows) {
  for (const std::size_t row : rows) {
    list_->selectionModel()->select(order_.mapFromSource(model_.index_of(row)),
                                    QItemSelectionModel::Select | QItemSelectionModel::Rows);
  }
}

void RowsView::copy() {
  const std::vector<std::size_t> chosen = chosen_rows();
  std::vector<std::size_t> which;
  // In the order in which they are seen, not in which they were clicked.
  for (QModelIndex at = order_.index(0, 0); at.isValid(); at = list_->indexBelow(at)) {
    const std::size_t row = RowsModel::row_of(order_.mapToSource(at));
    if (std::find(chosen.begin(), chosen.end(), row) != chosen.end()) which.push_back(row);
  }
  QApplication::clipboard()->setText(QString::fromStdString(tab_separated(rows_, which)));
}

void RowsView::contextMenuEvent(QContextMenuEvent* event) {
  if (menu_ == nullptr) return;
  // What the menu offers is asked for as it opens: the row comes first.
  const QModelIndex at = list_->currentIndex();
  if (at.isValid() && list_->selectionModel()->isSelected(at)) go_to(RowsModel::row_of(order_.mapToSource(at)));
  menu_->popup(event->globalPos());
}

bool RowsView::key_is_ours(const QKeyEvent& event) const {
  if (event.matches(QKeySequence::SelectAll)) return true;
  if ((event.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) != 0) return false;
  switch (event.key()) {
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_PageUp:
    case Qt::Key_PageDown:
    case Qt::Key_Home:
    case Qt::Key_End:
    case Qt::Key_Return:
    case Qt::Key_Enter:
      return true;
    case Qt::Key_Left:
    case Qt::Key_Right:
      return list_->rootIsDecorated();
    default:
      return false;
  }
}

bool RowsView::eventFilter(QObject* watched, QEvent* event) {
  const auto* key = dynamic_cast<QKeyEvent*>(event);
  if (key == nullptr) return QWidget::eventFilter(watched, event);
  if (event->type() == QEvent::ShortcutOverride && key_is_ours(*key)) {
    event->accept();  // the key moves in the list and is no shortcut of the window
    return true;
  }
  const bool enter = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter;
  if (event->type() == QEvent::KeyPress && enter && list_->currentIndex().isValid()) {
    rows_.open(RowsModel::row_of(order_.mapToSource(list_->currentIndex())));
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace sonar
