// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <QTreeView>

#include "session/rows.h"

namespace sonar {

/// How wide the columns of a list are: as wide as what stands in them, but a sentence ends where the list ends, with dots
/// where it is cut. It goes on doing so while the list changes its width, until a human has given a column another.
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
  void end_sentences();

  const Rows& rows_;
  QTreeView& list_;
  QStringList fitted_to_;  ///< titles
  int sentence_px_ = 0;    ///< that the whole sentence would need
  bool fitted_ = false;
  bool by_hand_ = false;
  bool ours_ = false;  ///< nobody dragged
};

}  // namespace sonar
