// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "session/listeners.h"

namespace sonar {

/// A cell: what is shown, and what it is sorted by.
struct Cell {
  std::string text;
  std::variant<std::monostate, double, std::string> key;  ///< monostate: unknown, sorted last
  std::string brief = {};  ///< shown in the text's stead where lists are narrow; empty = the text
  int decimals = -1;       ///< that a number is written with; -1 = three significant digits
  double se = std::numeric_limits<double>::quiet_NaN();  ///< of a number, told in the text; NaN = none is
};

struct ListColumn {
  std::string title;  ///< "Depth"
  std::string unit;   ///< "m"
  std::string tip;
  bool number = false;   ///< aligned to the right
  bool telling = false;  ///< a sentence: it ends where the list ends, however long it is
};

/// A list for a table widget: all rows at once, replaced as a whole. Filtering and sorting are the widget's affair.
/// threads  the window's
class Rows {
 public:
  virtual ~Rows() = default;
  [[nodiscard]] virtual const std::vector<ListColumn>& columns() const = 0;
  [[nodiscard]] virtual std::size_t rows() const = 0;
  [[nodiscard]] virtual Cell cell(std::size_t row, std::size_t column) const = 0;
  /// What a double-click or Enter on a row does.
  virtual void open(std::size_t /*row*/) {}
  /// What selecting a row does.
  virtual void select(std::size_t /*row*/) {}
  /// The row to be shown as selected.
  [[nodiscard]] virtual std::optional<std::size_t> selected() const { return std::nullopt; }
  /// Rows that a human has selected together; fewer than two: no more than selected().
  virtual void choose(const std::vector<std::size_t>& /*rows*/) {}
  /// All rows to be shown as selected; nullopt = several are the widget's own affair.
  [[nodiscard]] virtual std::optional<std::vector<std::size_t>> chosen() const { return std::nullopt; }
  /// What stands behind the list's title: "7 of 20 left"; empty = nothing.
  [[nodiscard]] virtual std::string note() const { return {}; }
  /// Depth in a tree, 0 = top; rows of a plain table are all 0.
  [[nodiscard]] virtual int level(std::size_t /*row*/) const { return 0; }
  /// Whether the rows stand here only until those come that are meant.
  [[nodiscard]] virtual bool for_now() const { return false; }
  /// Of a list whose rows have small pictures before them: where a row's is, or an empty path; nullopt = a list of texts.
  [[nodiscard]] virtual std::optional<std::filesystem::path> picture(std::size_t /*row*/) const { return std::nullopt; }
  /// Shown in grey: undone, rejected.
  [[nodiscard]] virtual bool faded(std::size_t /*row*/) const { return false; }
  /// A limit that makes sense here, "depth>80", to show how one is written; empty = words alone.
  [[nodiscard]] virtual std::string example_limit() const { return {}; }
  /// What stands in the filter line, for those who go through the rows that it leaves.
  virtual void narrow(const std::string& /*filter*/) {}
  /// Called when rows or cells have changed.
  [[nodiscard]] Listeners<>& changed() { return changed_; }
  /// Called when nothing but selected() has changed.
  [[nodiscard]] Listeners<>& moved() { return moved_; }

 private:
  Listeners<> changed_;
  Listeners<> moved_;
};

/// Whether a filter leaves a row: each of its words stands in some cell, in any case of letters; a word "depth>80" holds
/// the number of the column whose title begins so against 80 (<, <=, >, >=, =). Empty = every row.
[[nodiscard]] bool row_matches(const Rows& rows, std::size_t row, const std::string& filter);
/// Rising order of two cells: numbers before texts, unknown last whichever way is asked for.
[[nodiscard]] bool cell_less(const Cell& a, const Cell& b, bool descending);

/// Cells with tabulators between and line ends behind, a title line first: what a spreadsheet takes from the clipboard.
/// Standard errors stand in a column of their own behind their figures', where one of the rows has some: numbers stay numbers.
[[nodiscard]] std::string tab_separated(const Rows& rows, const std::vector<std::size_t>& which);

}  // namespace sonar
