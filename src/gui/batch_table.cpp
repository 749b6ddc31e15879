// SPDX-License-Identifier: Apache-2.0
#include "gui/batch_table.h"

#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>
#include <array>

namespace sonar {
namespace {

constexpr int kBarAlpha = 80;  ///< of 255: text stays legible over it
constexpr int kBarMargin_px = 2;

/// In letters of the font, by BatchRows::Column; the last takes what is left.
constexpr std::array<int, 6> kColumnWidths{24, 20, 24, 11, 50, 12};

/// A bar behind the text, while something is on its way.
class ProgressDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const double share = index.data(RowsModel::kKeyRole).toDouble();
    QStyledItemDelegate::paint(painter, option, index);
    if (share <= 0.0 || share >= 1.0) return;
    QColor colour = option.palette.color(QPalette::Highlight);
    colour.setAlpha(kBarAlpha);
    QRect bar = option.rect.adjusted(0, kBarMargin_px, 0, -kBarMargin_px);
    bar.setWidth(std::max(1, static_cast<int>(share * bar.width())));
    painter->fillRect(bar, colour);
  }
};

}  // namespace

BatchTable::BatchTable(Batch& batch, QWidget* parent) : QTreeView(parent), rows_(batch), model_(rows_) {
  setObjectName("surveys");
  setModel(&model_);
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setAlternatingRowColors(true);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setTextElideMode(Qt::ElideMiddle);
  header()->setStretchLastSection(true);
  setItemDelegateForColumn(static_cast<int>(BatchRows::Column::progress), new ProgressDelegate(this));
  listening_.to(rows_.changed(), [this] { follow(); });
  listening_.to(rows_.moved(), [this] { model_.refresh(); });
  fit_columns();
}

void BatchTable::fit_columns() {
  const int letter = fontMetrics().averageCharWidth();
  for (std::size_t c = 0; c < kColumnWidths.size(); ++c) {
    header()->resizeSection(static_cast<int>(c), kColumnWidths[c] * letter);
  }
}

std::optional<std::size_t> BatchTable::current() const {
  if (!currentIndex().isValid()) return std::nullopt;
  return RowsModel::row_of(currentIndex());
}

void BatchTable::set_current(std::size_t row) { setCurrentIndex(model_.index_of(row)); }

/// The marked row stays the marked one.
void BatchTable::follow() {
  if (rows_.rows() == model_.rows_known()) return model_.refresh();
  const auto marked = current();
  model_.reset();
  if (rows_.rows() == 0) return;
  set_current(std::min(marked.value_or(0), rows_.rows() - 1));
}

}  // namespace sonar
