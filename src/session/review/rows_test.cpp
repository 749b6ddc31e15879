// SPDX-License-Identifier: Apache-2.0
#include "session/review/rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/integration.h"
#include "session/lists/cells.h"
#include "session/numbers/table_rows.h"

namespace sonar {
namespace {

/// Three fish in two columns.
class Fish : public Rows {
 public:
  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return columns_; }
  [[nodiscard]] std::size_t rows() const override { return 3; }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override { return cells_[row][column]; }

 private:
  std::vector<ListColumn> columns_{{"Name", "", "", false}, {"Depth mean", "m", "", true}};
  std::vector<std::vector<Cell>> cells_{{text_cell("Herring"), number_cell(9.5, 1)},
                                        {text_cell("Blue\twhiting"), number_cell(120.0, 1)},
                                        {text_cell("Cod"), number_cell(std::nan(""), 1)}};
};

TEST(Rows, NumbersSortAsNumbersAndTheUnknownLastBothWays) {
  const std::vector<Cell> cells{number_cell(120.0, 1), {}, number_cell(9.5, 1)};
  std::vector<std::size_t> up{0, 1, 2};
  std::sort(up.begin(), up.end(), [&](auto a, auto b) { return cell_less(cells[a], cells[b], false); });
  EXPECT_EQ(up, (std::vector<std::size_t>{2, 0, 1}));
  // A widget that sorts downwards asks with the cells exchanged.
  std::vector<std::size_t> down{0, 1, 2};
  std::sort(down.begin(), down.end(), [&](auto a, auto b) { return cell_less(cells[b], cells[a], true); });
  EXPECT_EQ(down, (std::vector<std::size_t>{0, 2, 1}));
}

TEST(Rows, ASpreadsheetGetsTabsBetweenAndNoneWithin) {
  EXPECT_EQ(tab_separated(Fish(), {1, 2}), "Name\tDepth mean [m]\nBlue whiting\t120.0\nCod\t\n");
}

/// Depths of two schools; a run told the error of one.
class Depths : public Rows {
 public:
  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return columns_; }
  [[nodiscard]] std::size_t rows() const override { return cells_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t /*column*/) const override { return cells_[row]; }

 private:
  std::vector<ListColumn> columns_{{"Depth", "m", "", true}};
  std::vector<Cell> cells_{with_error(number_cell(63.24, 1), 1.36), number_cell(9.5, 1)};
};

TEST(Rows, ASpreadsheetGetsNumbersAndTheirErrorsInColumnsOfTheirOwn) {
  EXPECT_EQ(tab_separated(Depths(), {0, 1}), "Depth [m]\tDepth standard error [m]\n63.2\t1.4\n9.5\t\n");
  EXPECT_EQ(tab_separated(Depths(), {1}), "Depth [m]\n9.5\n") << "no empty column";
}

TEST(Rows, AFilterTakesWordsAndLimits) {
  const Fish fish;
  const auto left = [&](const std::string& filter) {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < 3; ++row) {
      if (row_matches(fish, row, filter)) rows.push_back(row);
    }
    return rows;
  };
  using Left = std::vector<std::size_t>;
  EXPECT_EQ(left(""), (Left{0, 1, 2}));
  EXPECT_EQ(left("HER"), (Left{0}));
  EXPECT_EQ(left("h i"), (Left{0, 1}));
  EXPECT_EQ(left("depth>10"), (Left{1}));
  EXPECT_EQ(left("depthmean<=9.5"), (Left{0}));
  EXPECT_EQ(left("depth>1 blue"), (Left{1}));
  EXPECT_EQ(left("length>1"), Left{});  // no such column: a word like any other
}

TEST(Cells, AreAsPeopleReadThem) {
  EXPECT_EQ(time_cell(1'600'000'000 * kSecondNs).text, "2020-09-13 12:26:40");
  EXPECT_EQ(time_cell(0).text, "");
  EXPECT_EQ(span_brief(1'600'000'000 * kSecondNs, 1'600'001'000 * kSecondNs), "13 Sep 12:26 \u2013 12:43");
  EXPECT_EQ(span_brief(1'600'000'000 * kSecondNs, 1'600'100'000 * kSecondNs), "13 Sep 12:26 \u2013 14 Sep 16:13");
  EXPECT_EQ(span_text(1'600'000'000 * kSecondNs, 1'600'000'060 * kSecondNs), "2020-09-13 12:26:40 \u2013 12:27:40");
  EXPECT_EQ(span_text(1'600'000'000 * kSecondNs, 1'600'086'400 * kSecondNs),
            "2020-09-13 12:26:40 \u2013 2020-09-14 12:26:40");
  EXPECT_EQ(latitude_cell(60.5).text, "60\u00B030.000\u2032 N");
  EXPECT_EQ(longitude_cell(std::nan("")).text, "");
}

// 1 ft = 0.3048 m, 1 kn = 1852 m an hour; areas stay.
TEST(Cells, OfLengthsAndSpeedsAreInTheUnitsThatAreRead) {
  const Units units{LengthUnit::feet, SpeedUnit::knots};
  EXPECT_EQ(in_units(number_cell(30.48, 1), "m", units).text, "100.0");
  EXPECT_EQ(in_units(number_cell(10.0, 2), "m/s", units).text, "19.44");
  EXPECT_EQ(in_units(number_cell(10.0, 2), "kn", units).text, "10.00");
  EXPECT_EQ(in_units(number_cell(30.48, 1), "m\u00B2", units).text, "30.5");
  EXPECT_EQ(in_units(number_cell(std::nan(""), 1), "m", units).text, "");
  const Cell deep = in_units(with_error(number_cell(30.48, 1), 1.524), "m", units);
  EXPECT_EQ(deep.text, "100.0 \u00B1 5.0") << "its error too";
  EXPECT_EQ(deep.brief, "100.0");
  TableRows<NascRow> table;
  NascRow row;
  row.depth_from_m = 30.48;
  table.set({row});
  const auto& columns = table.columns();
  const auto at =
      static_cast<std::size_t>(std::ranges::find(columns, "depth_from_m", &ListColumn::tip) - columns.begin());
  ASSERT_LT(at, columns.size());
  EXPECT_EQ(columns[at].unit, "m");
  EXPECT_EQ(table.cell(0, at).text, "30.5");
  table.show_in(units);
  EXPECT_EQ(table.columns()[at].unit, "ft");
  EXPECT_EQ(table.cell(0, at).text, "100");
  table.show_in({});
  EXPECT_EQ(table.columns()[at].unit, "m");
}

}  // namespace
}  // namespace sonar
