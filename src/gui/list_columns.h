// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QList>
#include <QObject>
#include <QStringList>
#include <QTreeView>

#include "session/review/rows.h"

namespace sonar {

/// How wide the columns of a list are: as wide as what stands in them, brief where there is no room for the whole text, but a
/// sentence ends where the list ends, with dots where it is cut. It goes on doing so while the list changes its width, until a
/// human has given a column another.
class ListColumns : public QObject {
 public:
  /// Both outlive this.
  ListColumns(const Rows& rows, QTreeView& list) : rows_(rows), list_(list) {}
  /// As wide as the titles, until there are rows; the list has its model.
  void begin();
  /// By the first rows that there are; once, but anew after those that were there for now, and where titles have changed (another
  /// unit) until a human has given a column another width.
  void fit();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] int title_width(int column) const;
  [[nodiscard]] QStringList titles() const;
  [[nodiscard]] bool telling(int column) const;
  /// Room that is left goes to columns whose cells have a brief text, for their whole one; sentences end where the list ends.
  void share_room();
  /// That the whole texts of a column's first rows need; 0 = it has no brief ones.
  [[nodiscard]] int whole_width(int column) const;

  const Rows& rows_;
  QTreeView& list_;
  QStringList fitted_to_;  ///< titles
  QList<int> fit_px_;      ///< [column] of the title and the first rows, brief
  QList<int> whole_px_;    ///< [column] of whole texts; 0 = none is brief
  bool fitted_ = false;
  bool by_hand_ = false;
  bool ours_ = false;  ///< nobody dragged
};

}  // namespace sonar
