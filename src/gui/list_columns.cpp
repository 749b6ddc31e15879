// SPDX-License-Identifier: Apache-2.0
#include "gui/list_columns.h"

#include <QEvent>
#include <QHeaderView>
#include <algorithm>
#include <utility>

namespace sonar {
namespace {

constexpr int kRowsThatFit = 200;  // columns are fitted to the first rows
constexpr int kWidestColumn_px = 320;
constexpr int kWidestSentence_px = 640;
constexpr int kLeastSentence_px = 120;
constexpr int kIndentation_px = 14;

}  // namespace

void ListColumns::begin() {
  QHeaderView& header = *list_.header();
  header.setSectionsMovable(true);
  header.setStretchLastSection(true);
  list_.setIndentation(kIndentation_px);
  list_.setTextElideMode(Qt::ElideRight);
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
  ours_ = true;
  list_.header()->setResizeContentsPrecision(kRowsThatFit);
  for (int c = 0; c < list_.model()->columnCount(); ++c) {
    const bool telling = rows_.columns()[static_cast<std::size_t>(c)].telling;
    const int cells = static_cast<const QAbstractItemView&>(list_).sizeHintForColumn(c);
    const int width = std::max(title_width(c), std::min(cells, telling ? kWidestSentence_px : kWidestColumn_px));
    if (telling) sentence_px_ = width;
    list_.setColumnWidth(c, width);
  }
  ours_ = false;
  end_sentences();
}

void ListColumns::end_sentences() {
  if (!fitted_ || by_hand_) return;
  ours_ = true;
  for (std::size_t c = 0; c < rows_.columns().size(); ++c) {
    if (!rows_.columns()[c].telling) continue;
    const int column = static_cast<int>(c);
    const int room = list_.viewport()->width() - list_.header()->sectionPosition(column);
    list_.setColumnWidth(column, std::min(sentence_px_, std::max(room, kLeastSentence_px)));
  }
  ours_ = false;
}

bool ListColumns::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) end_sentences();
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
