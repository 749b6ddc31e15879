// SPDX-License-Identifier: Apache-2.0
#include "publish/picture_source.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/product_example.h"

namespace sonar {
namespace {

TEST(PictureSource, DrawsTheFirstObservationThatHasSchools) {
  ObservationProduct second = example::empty("obs-0002", 8);
  example::add_school(second, 1, 0, 7, example::block(1, 1, 2, 20, 8, 200));
  second.schools[0].status = "rejected";
  ObservationProduct third = example::empty("obs-0003", 8);
  example::add_school(third, 1, 2, 5, example::block(1, 1, 2, 20, 8, 200));
  const auto drawn = [](std::vector<ObservationProduct> products, std::string_view named = {}) {
    const auto source = PictureSource::of(nullptr, std::move(products), Recipe{});
    const auto chosen = source->observation(named);
    EXPECT_TRUE(chosen);
    return chosen ? (*chosen)->name() : std::string();
  };
  const ObservationProduct first = example::empty("obs-0001", 8);
  EXPECT_EQ(drawn({first, second, third}), "obs-0003") << "rejected ones are none";
  EXPECT_EQ(drawn({first, second, third}, "obs-0001"), "obs-0001");
  EXPECT_EQ(drawn({first, second}), "obs-0001") << "where there are none";
}

}  // namespace
}  // namespace sonar
