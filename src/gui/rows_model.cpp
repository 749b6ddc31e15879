// SPDX-License-Identifier: Apache-2.0
#include "gui/rows_model.h"

#include <QColor>
#include <QGuiApplication>
#include <QPalette>
#include <QPixmap>
#include <QPixmapCache>

#include "gui/translated.h"
#include "session/open/thumbnails.h"

namespace sonar {
namespace {

/// Half of the pixels that it is kept with: crisp on a dense screen too.
constexpr qreal kDensity = 2.0;

/// As large for every row, with or without a picture.
QPixmap small_picture(const std::filesystem::path& file) {
  QPixmap picture;
  const QString name = QString::fromStdString(file.string());
  if (!file.empty() && QPixmapCache::find(name, &picture)) return picture;
  if (file.empty() || !picture.load(name)) {
    picture = QPixmap(kThumbnail.width, kThumbnail.height);
    picture.fill(Qt::transparent);
  }
  picture.setDevicePixelRatio(kDensity);
  if (!file.empty()) QPixmapCache::insert(name, picture);
  return picture;
}

}  // namespace

RowsModel::RowsModel(const Rows& rows, QObject* parent) : QAbstractItemModel(parent), rows_(rows) { reset(); }

void RowsModel::reset() {
  beginResetModel();
  const std::size_t count = rows_.rows();
  top_.clear();
  parent_.assign(count, kTop);
  children_.assign(count, {});
  place_.assign(count, 0);
  std::vector<std::size_t> branch;  // the last row of each level so far
  for (std::size_t row = 0; row < count; ++row) {
    const auto level = std::min(static_cast<std::size_t>(std::max(rows_.level(row), 0)), branch.size());
    branch.resize(level);
    if (level > 0) parent_[row] = branch.back();
    auto& siblings = level > 0 ? children_[branch.back()] : top_;
    place_[row] = static_cast<int>(siblings.size());
    siblings.push_back(row);
    branch.push_back(row);
  }
  endResetModel();
}

void RowsModel::refresh() {
  if (!top_.empty()) Q_EMIT dataChanged(index(0, 0), index(static_cast<int>(top_.size()) - 1, columnCount() - 1));
}

const std::vector<std::size_t>& RowsModel::below(const QModelIndex& parent) const {
  return parent.isValid() ? children_[row_of(parent)] : top_;
}

QModelIndex RowsModel::index_of(std::size_t row, int column) const {
  return row < place_.size() ? createIndex(place_[row], column, static_cast<quintptr>(row)) : QModelIndex();
}

QModelIndex RowsModel::index(int row, int column, const QModelIndex& parent) const {
  const auto& siblings = below(parent);
  const auto at = static_cast<std::size_t>(row);
  return row >= 0 && at < siblings.size() ? createIndex(row, column, static_cast<quintptr>(siblings[at]))
                                          : QModelIndex();
}

QModelIndex RowsModel::parent(const QModelIndex& index) const {
  if (!index.isValid() || parent_[row_of(index)] == kTop) return {};
  return index_of(parent_[row_of(index)]);
}

int RowsModel::rowCount(const QModelIndex& parent) const {
  return parent.column() > 0 ? 0 : static_cast<int>(below(parent).size());
}

int RowsModel::columnCount(const QModelIndex& /*parent*/) const { return static_cast<int>(rows_.columns().size()); }

QVariant RowsModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || row_of(index) >= rows_.rows()) return {};
  const auto column = static_cast<std::size_t>(index.column());
  switch (role) {
    case Qt::DisplayRole: {
      const Cell cell = rows_.cell(row_of(index), column);
      return QString::fromStdString(cell.brief.empty() ? cell.text : cell.brief);
    }
    case Qt::ToolTipRole:
      return QString::fromStdString(rows_.cell(row_of(index), column).text);
    case kKeyRole: {
      const Cell cell = rows_.cell(row_of(index), column);
      const auto* key = std::get_if<double>(&cell.key);
      return key != nullptr ? QVariant(*key) : QVariant();
    }
    case Qt::TextAlignmentRole:
      return QVariant(rows_.columns()[column].number ? Qt::AlignRight | Qt::AlignVCenter
                                                     : Qt::AlignLeft | Qt::AlignVCenter);
    case Qt::DecorationRole:
      if (const auto file = rows_.picture(row_of(index)); file && index.column() == 0) return small_picture(*file);
      return {};
    case Qt::ForegroundRole:
      if (rows_.faded(row_of(index))) return QGuiApplication::palette().color(QPalette::Disabled, QPalette::Text);
      return {};
    default:
      return {};
  }
}

QVariant RowsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) return {};
  const ListColumn& column = rows_.columns()[static_cast<std::size_t>(section)];
  if (role == Qt::ToolTipRole) return translated(column.tip);
  if (role == Qt::TextAlignmentRole) return QVariant(column.number ? Qt::AlignRight : Qt::AlignLeft);
  if (role != Qt::DisplayRole) return {};
  return translated(column.title) + QString::fromStdString(column.unit.empty() ? "" : " [" + column.unit + "]");
}

}  // namespace sonar
