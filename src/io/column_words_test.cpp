// SPDX-License-Identifier: Apache-2.0
#include "io/column_words.h"

#include <gmock/gmock.h>

#include <string>

#include "io/table_columns.h"
#include "model/refused_echo.h"
#include "model/school.h"

namespace sonar {
namespace {

template <class Row>
void expect_words() {
  for (const TableColumn& column : columns_of(std::vector<Row>{})) {
    const ColumnWords* words = words_of(column.name);
    ASSERT_NE(words, nullptr) << column.name;
    EXPECT_FALSE(words->long_name.empty()) << column.name;
  }
}

TEST(ColumnWords, EveryColumnOfEveryTableHasSome) {
  expect_words<SchoolRow>();
  expect_words<SchoolPingRow>();
  expect_words<RefusedEcho>();
  EXPECT_EQ(words_of("no_such_column"), nullptr);
}

// The bits of INTERFACES section 3, in its order.
TEST(ColumnWords, EdgesAreTheBitsThatRowsHave) {
  const ColumnWords* edges = words_of("edge_flags");
  EXPECT_THAT(edges->flags(), testing::ElementsAre(kEdgeFore, kEdgeAft, kEdgeTopFan, kEdgeBottomFan, kEdgeNear,
                                                   kEdgeFar, kEdgeSeabed, kEdgeSurface, kEdgeFlagged));
  EXPECT_EQ(edges->meanings, "fore aft top_fan bottom_fan near far seabed surface flagged_data");
  EXPECT_THAT(words_of("touches_edge")->flags(), testing::ElementsAre(0, 1));
  EXPECT_TRUE(words_of("depth_m")->flags().empty());
}

}  // namespace
}  // namespace sonar
