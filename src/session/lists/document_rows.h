// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <utility>
#include <vector>

#include "session/listening.h"
#include "session/lists/cells.h"
#include "session/open/workspace.h"
#include "session/review/rows.h"

namespace sonar {

/// Rows that are made anew from the document whenever something changed that they show.
class DocumentRows : public Rows {
 public:
  DocumentRows(Workspace& workspace, std::vector<DocumentChange> shown)
      : workspace_(workspace), shown_(std::move(shown)) {
    listening_.to(workspace.document.changes(), [this](DocumentChange change) {
      for (const DocumentChange one : shown_) {
        if (one == change) return refresh();
      }
      if (change == DocumentChange::ping || change == DocumentChange::looking || change == DocumentChange::observation)
        moved().tell();
    });
    listening_.to(workspace.school.changed(), [this] { school_selected(); });
    listening_.to(workspace.units.changed(), [this] { refresh(); });
  }
  ~DocumentRows() override = default;
  DocumentRows(const DocumentRows&) = delete;
  DocumentRows& operator=(const DocumentRows&) = delete;

 protected:
  /// Makes the rows anew.
  virtual void make() = 0;
  virtual void school_selected() { moved().tell(); }
  void refresh() {
    make();
    changed().tell();
  }
  [[nodiscard]] Workspace& workspace() const { return workspace_; }

 private:
  Workspace& workspace_;
  std::vector<DocumentChange> shown_;
  Listening listening_;
};

/// A column and what stands in it for one of what the rows are about.
template <class T>
struct ColumnOf {
  ListColumn column;
  Cell (*cell)(const T&);
};

template <class T>
[[nodiscard]] std::vector<ListColumn> titles_of(const std::vector<ColumnOf<T>>& columns, const Units& units = {}) {
  std::vector<ListColumn> titles;
  for (const ColumnOf<T>& one : columns) {
    titles.push_back(one.column);
    titles.back().unit = shown_unit(one.column.unit, units).name;
  }
  return titles;
}

template <class T>
[[nodiscard]] Cell cell_of(const ColumnOf<T>& column, const T& row, const Units& units) {
  return in_units(column.cell(row), column.column.unit, units);
}

}  // namespace sonar
