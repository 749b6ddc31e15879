// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/school_numbers.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "io/product_example.h"
#include "io/product_file.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

SchoolMasks school(const std::vector<std::pair<std::int64_t, PingMask>>& pings) {
  SchoolMasks made;
  for (const auto& [ping_index, mask] : pings) made.pings.push_back({ping_index, mask, -60.0});
  return made;
}

std::vector<TimeNs> times_of(const ObservationProduct& product) {
  std::vector<TimeNs> times;
  for (const PingNavigation& ping : product.pings) times.push_back(ping.time);
  return times;
}

std::vector<std::int64_t> kept(std::vector<SchoolMasks> schools, const EarlierSchools& earlier, std::int64_t& next,
                               const ObservationProduct& now = example::empty("obs-0001", 10)) {
  schools = numbered(std::move(schools), now.grid->grid);
  next = keep_numbers(schools, now.grid->grid, times_of(now), earlier);
  std::vector<std::int64_t> numbers;
  for (const SchoolMasks& s : schools) numbers.push_back(s.decided.school_id);
  return numbers;
}

TEST(SchoolNumbers, StayWithTheVoxelsAndGoOnAboveAllThatWere) {
  ObservationProduct before = example::empty("obs-0001", 10);
  example::add_school(before, 1, 2, 4, example::block(0, 0, 2, 10, 10));
  example::add_school(before, 2, 5, 9, example::block(1, 0, 2, 30, 10));
  before.next_school_id = 6;  // 3 to 5 were given and are gone
  EarlierSchools earlier;
  earlier.add(before, 0.0);
  std::int64_t next = 0;
  // A school in ping 0 comes first now; the two others grew or shrank; by number alone they would be 2 and 3.
  const auto numbers = kept({school({{0, example::block(2, 0, 2, 10, 10)}}),
                             school({{3, example::block(0, 0, 2, 12, 12)}, {4, example::block(0, 0, 2, 12, 12)}}),
                             school({{6, example::block(1, 1, 2, 35, 10)}})},
                            earlier, next);
  EXPECT_EQ(numbers, (std::vector<std::int64_t>{6, 1, 2}));
  EXPECT_EQ(next, 7);
}

TEST(SchoolNumbers, OfTwoHalvesTheLargerKeepsTheNumber) {
  ObservationProduct before = example::empty("obs-0001", 10);
  example::add_school(before, 4, 2, 2, example::block(0, 0, 4, 0, 20));
  EarlierSchools earlier;
  earlier.add(before, 0.0);
  std::int64_t next = 0;
  const auto numbers = kept(
      {school({{2, example::block(0, 0, 4, 0, 6)}}), school({{2, example::block(0, 0, 4, 10, 10)}})}, earlier, next);
  EXPECT_EQ(numbers, (std::vector<std::int64_t>{5, 4}));
  // And of two that became one, it is the number of the larger part.
  ObservationProduct halves = example::empty("obs-0001", 10);
  example::add_school(halves, 1, 2, 2, example::block(0, 0, 4, 0, 6));
  example::add_school(halves, 2, 2, 2, example::block(0, 0, 4, 10, 10));
  EarlierSchools two;
  two.add(halves, 0.0);
  EXPECT_EQ(kept({school({{2, example::block(0, 0, 4, 0, 20)}})}, two, next), (std::vector<std::int64_t>{2}));
}

TEST(SchoolNumbers, GoByTimeAndChannelNotByPlace) {
  // Earlier, the observation began three pings later, its rows ran the other way and its clock was shifted by 5 s.
  const ObservationProduct now = example::empty("obs-0001", 10);
  ObservationProduct before = example::empty("obs-0002", 7);
  for (std::size_t i = 0; i < before.pings.size(); ++i) before.pings[i].time = now.pings[i + 3].time + 5 * kSecondNs;
  auto& channels = before.grid->grid.channel;
  std::reverse(channels.begin(), channels.end());
  PingMask mirrored = example::block(2, 2, 2, 10, 10);  // fan 0, beams 0 and 1 of the grid now
  example::add_school(before, 3, 1, 1, mirrored);
  EarlierSchools earlier;
  earlier.add(before, 5.0);
  std::int64_t next = 0;
  EXPECT_EQ(kept({school({{4, example::block(0, 0, 2, 10, 10)}})}, earlier, next, now), (std::vector<std::int64_t>{3}));
  EXPECT_EQ(kept({school({{1, example::block(0, 0, 2, 10, 10)}})}, earlier, next, now), (std::vector<std::int64_t>{4}));
}

TEST(SchoolNumbers, OfTwoProductsTheFirstHasItsNumbers) {
  ObservationProduct first = example::empty("obs-0001", 10);
  example::add_school(first, 1, 0, 1, example::block(0, 0, 2, 10, 10));
  ObservationProduct second = example::empty("obs-0002", 10);
  example::add_school(second, 1, 6, 7, example::block(0, 0, 2, 10, 10));
  example::add_school(second, 5, 8, 9, example::block(0, 0, 2, 10, 10));
  EarlierSchools earlier;
  earlier.add(first, 0.0);
  earlier.add(second, 0.0);
  std::int64_t next = 0;
  // 1 is taken by another school already, 5 is free.
  EXPECT_EQ(kept({school({{0, example::block(0, 0, 2, 10, 10)}}), school({{6, example::block(0, 0, 2, 10, 10)}}),
                  school({{8, example::block(0, 0, 2, 10, 10)}})},
                 earlier, next),
            (std::vector<std::int64_t>{1, 6, 5}));
}

class Earlier : public testing::Test {
 protected:
  Earlier() : out_(fs::temp_directory_path() / ("sonar_earlier_" + std::to_string(::getpid()))) {}
  ~Earlier() override { fs::remove_all(out_); }
  Earlier(const Earlier&) = delete;
  Earlier& operator=(const Earlier&) = delete;
  void put(const ObservationProduct& p) const { ASSERT_TRUE(write_product(p, product_path(out_, p.observation))); }
  static Plan plan_for(const std::string& observation, const std::string& key) {
    Plan plan;
    PlanTask task;
    task.observation = observation;
    task.key = key;
    plan.tasks.push_back(task);
    return plan;
  }
  fs::path out_;
};

TEST_F(Earlier, WhatThePlanCallsForAnewIsHeldUntilItIsThere) {
  ObservationProduct old = example::empty("obs-0001", 10);
  example::add_school(old, 7, 2, 4, example::block(0, 0, 2, 10, 10));
  put(old);
  ASSERT_TRUE(set_aside(out_, plan_for("obs-0001", old.input_hash)));
  EXPECT_FALSE(fs::exists(out_ / "earlier"));  // right as it is
  ASSERT_TRUE(set_aside(out_, plan_for("obs-0002", "other")));

  // A file came in before: other pings take the name.
  const ObservationProduct other = example::empty("obs-0001", 5, {60.0, 5.0}, example::kStart - 3600 * kSecondNs);
  put(other);
  const auto found = EarlierProducts(out_).schools_of(old.source, times_of(old));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->next_school_id, 8);
  EXPECT_EQ(found->layers.at(0).masks.size(), 3U);
  EXPECT_FALSE(EarlierProducts(out_).schools_of("another sounder", times_of(old)));
  EXPECT_FALSE(EarlierProducts(out_).schools_of(old.source, times_of(other)));
  EXPECT_TRUE(EarlierProducts(out_).of_pings(old.source, times_of(old)));

  forget_superseded(out_, {other});
  EXPECT_TRUE(fs::exists(out_ / "earlier"));
  ObservationProduct shorter = example::empty("obs-0002", 5);
  forget_superseded(out_, {other, shorter});
  EXPECT_TRUE(fs::exists(out_ / "earlier"));
  forget_superseded(out_, {other, example::empty("obs-0002", 10)});
  EXPECT_FALSE(fs::exists(out_ / "earlier"));
}

}  // namespace
}  // namespace sonar
