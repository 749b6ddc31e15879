// SPDX-License-Identifier: Apache-2.0
#include "gui/list_columns.h"

#include <QEvent>
#include <QHeaderView>
#include <QStyledItemDelegate>
#include <algorithm>
#include <numeric>
#include <utility>

namespace sonar {
namespace {

constexpr int kRowsThatFit = 200;  // columns are fitted to the first rows
constexpr int kWidestColumn_px = 320;
constexpr int kWidestSentence_px = 640;
constexpr int kLeastSentence_px = 120;
constexpr int kIndentation_px = 14;

/// What a cell needs for a text, with its margins.
int needed_px(const QString& text, const QFontMetrics& font, const QStyle& style, const QWidget* of) {
  return font.horizontalAdvance(text) + 2 * (style.pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, of) + 1);
}

/// A cell's whole text (a standard error behind its figure, a span with its year) where its column is wide enough for it, else
/// the brief one.
class WholeWhereRoom : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    if (!option->rect.isValid() || option->widget == nullptr) return;  // it is asked how wide the cell wants to be
    const QString whole = index.data(Qt::ToolTipRole).toString();
    const QStyle& style = *option->widget->style();
    if (needed_px(whole, option->fontMetrics, style, option->widget) <= option->rect.width()) option->text = whole;
  }
};

}  // namespace

void ListColumns::begin() {
  QHeaderView& header = *list_.header();
  header.setSectionsMovable(true);
  header.setStretchLastSection(true);
  list_.setIndentation(kIndentation_px);
  list_.setTextElideMode(Qt::ElideRight);
  list_.setItemDelegate(new WholeWhereRoom(&list_));
  for (int c = 0; c < list_.model()->columnCount(); ++c) list_.setColumnWidth(c, title_width(c));
  connect(&header, &QHeaderView::sortIndicatorChanged, this, [this](int by) {
    if (by < 0 || !fitted_) return;
    ours_ = true;
    list_.setColumnWidth(by, std::max(list_.columnWidth(by), title_width(by)));
    ours_ = false;
  });
  connect(&header, &QHeaderView::sectionResized, this, [this](int column) {
    // The last is stretched by the header itself.
    if (fitted_ && !ours_ && list_.header()->visualIndex(column) != list_.header()->count() - 1) by_hand_ = true;
  });
  list_.viewport()->installEventFilter(this);
}

void ListColumns::fit() {
  const bool same = by_hand_ || titles() == fitted_to_;
  if (std::exchange(fitted_, !rows_.for_now()) && same) return;
  fitted_to_ = titles();
  list_.header()->setResizeContentsPrecision(kRowsThatFit);
  fit_px_.clear();
  whole_px_.clear();
  for (int c = 0; c < list_.model()->columnCount(); ++c) {
    const int cells = static_cast<const QAbstractItemView&>(list_).sizeHintForColumn(c);
    fit_px_.push_back(std::max(title_width(c), std::min(cells, telling(c) ? kWidestSentence_px : kWidestColumn_px)));
    whole_px_.push_back(whole_width(c));
  }
  by_hand_ = false;
  share_room();
}

bool ListColumns::telling(int column) const { return rows_.columns()[static_cast<std::size_t>(column)].telling; }

void ListColumns::share_room() {
  if (by_hand_) return;
  ours_ = true;
  const int last = list_.header()->logicalIndex(list_.header()->count() - 1);
  int room = list_.viewport()->width() - std::accumulate(fit_px_.begin(), fit_px_.end(), 0);
  for (int c = 0; c < fit_px_.size(); ++c) {
    if (telling(c)) continue;
    const int more = whole_px_[c] - fit_px_[c];
    const bool whole = c != last && more > 0 && more <= room;  // the last is stretched by the header itself
    if (whole) room -= more;
    list_.setColumnWidth(c, std::max(whole ? whole_px_[c] : fit_px_[c], title_width(c)));
  }
  for (int c = 0; c < fit_px_.size(); ++c) {
    if (!telling(c)) continue;
    const int left = list_.viewport()->width() - list_.header()->sectionPosition(c);
    list_.setColumnWidth(c, std::min(fit_px_[c], std::max(left, kLeastSentence_px)));
  }
  ours_ = false;
}

int ListColumns::whole_width(int column) const {
  int widest = 0;
  for (std::size_t row = 0; row < std::min(rows_.rows(), std::size_t{kRowsThatFit}); ++row) {
    const Cell cell = rows_.cell(row, static_cast<std::size_t>(column));
    if (cell.brief.empty()) continue;
    widest =
        std::max(widest, needed_px(QString::fromStdString(cell.text), list_.fontMetrics(), *list_.style(), &list_));
  }
  return widest;
}

bool ListColumns::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) share_room();
  return QObject::eventFilter(watched, event);
}

QStringList ListColumns::titles() const {
  QStringList all;
  for (int c = 0; c < list_.model()->columnCount(); ++c) {
    all.push_back(list_.model()->headerData(c, Qt::Horizontal).toString());
  }
  return all;
}

/// Qt leaves room for the mark of the order beside every title; here only the title that has it does.
int ListColumns::title_width(int column) const {
  const QHeaderView& header = *list_.header();
  const QString title = list_.model()->headerData(column, Qt::Horizontal).toString();
  const int margin = header.style()->pixelMetric(QStyle::PM_HeaderMargin, nullptr, &header);
  const int mark = header.style()->pixelMetric(QStyle::PM_HeaderMarkSize, nullptr, &header) + margin;
  return header.fontMetrics().horizontalAdvance(title) + 4 * margin +
         (header.sortIndicatorSection() == column ? mark : 0);
}

}  // namespace sonar
