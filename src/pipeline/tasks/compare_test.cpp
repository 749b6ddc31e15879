// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "io/atomic_file.h"
#include "io/product_example.h"
#include "io/product_file.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

ObservationProduct sample() {
  ObservationProduct p = example::empty("obs-0001", 5);
  example::add_school(p, 1, 0, 3, example::block(1, 1, 2, 20, 8));
  return p;
}

std::string first_difference(const ObservationProduct& a, const ObservationProduct& b,
                             Compared what = Compared::everything) {
  return compare_products(a, b, what).difference;
}

Result<Comparison> compared_at(const fs::path& a, const fs::path& b, Compared what = Compared::everything) {
  Work work(1);
  return compare_paths(a, b, what, work);
}

std::string compared(const fs::path& a, const fs::path& b, Compared what = Compared::everything) {
  return compared_at(a, b, what).value().difference;
}

TEST(Compare, names_the_first_difference) {
  const ObservationProduct a = sample();
  EXPECT_EQ(first_difference(a, sample()), "");
  ObservationProduct b = sample();
  b.schools[0].volume_m3 *= 1.0 + 1e-8;
  EXPECT_EQ(first_difference(a, b), "/schools/volume_m3[0]: 1000, 1000.00001");
  b = sample();
  b.school_pings[2].depth_m = kUnknown;
  EXPECT_EQ(first_difference(a, b), "/school_pings/depth_m[2]: 20, unknown");
  b = sample();
  b.masks[1].mask.runs[1].first_sample = 21;
  EXPECT_EQ(first_difference(a, b), "/mask/first_sample (school 1, ping 1) run 1: 20, 21");
  b = sample();
  b.masks[1].mask.confidence[3] = 7;
  EXPECT_EQ(first_difference(a, b), "/mask/confidence (school 1, ping 1)[3]: 255, 7");
  ObservationProduct sound = sample();
  for (SchoolMask& m : sound.masks) m.fault.assign(m.mask.voxels(), false);
  b = sound;
  b.masks[2].fault[5] = true;
  EXPECT_EQ(first_difference(sound, b), "/mask/fault (school 1, ping 2)[5]: false, true");
  b = sample();
  b.pings[4].heading_deg = 1.0;
  EXPECT_EQ(first_difference(a, b), "/pings/heading[4]: 0, 1");
  b = sample();
  b.grid->grid.azimuth_deg[0] = 262.0;
  EXPECT_EQ(first_difference(a, b), "/grid/azimuth[0]: 262.5, 262");
  b = sample();
  b.pings.pop_back();
  EXPECT_THAT(first_difference(a, b), StartsWith("/pings (length)"));
}

TEST(Compare, content_comes_before_how_it_was_made) {
  ObservationProduct b = sample();
  b.input_hash = "another";
  b.recipe_hash = "another";
  EXPECT_THAT(first_difference(sample(), b), StartsWith("/recipe_hash: "));
  EXPECT_EQ(first_difference(sample(), b, Compared::content), "");
  b.schools[0].volume_m3 *= 2.0;
  EXPECT_EQ(first_difference(sample(), b), "/schools/volume_m3[0]: 1000, 2000");
  b.masks[1].mask.confidence[3] = 7;
  EXPECT_EQ(first_difference(sample(), b), "/mask/confidence (school 1, ping 1)[3]: 255, 7");
}

// The first product differs in its key alone, the second in what it says.
TEST(Compare, content_of_any_product_comes_first) {
  const fs::path folder = fs::temp_directory_path() / ("sonar_compare_order_" + std::to_string(::getpid()));
  ObservationProduct second = sample();
  second.observation = "obs-0002";
  ASSERT_TRUE(write_product(sample(), folder / "a" / "obs-0001.nc"));
  ASSERT_TRUE(write_product(second, folder / "a" / "obs-0002.nc"));
  ObservationProduct other = sample();
  other.input_hash = "another";
  ASSERT_TRUE(write_product(other, folder / "b" / "obs-0001.nc"));
  ASSERT_TRUE(write_product(second, folder / "b" / "obs-0002.nc"));
  EXPECT_THAT(compared(folder / "a", folder / "b"), StartsWith("obs-0001.nc: /input_hash"));
  EXPECT_EQ(compared(folder / "a", folder / "b", Compared::content), "");
  second.school_pings[2].depth_m = 21.0;
  ASSERT_TRUE(write_product(second, folder / "b" / "obs-0002.nc"));
  EXPECT_EQ(compared(folder / "a", folder / "b"), "obs-0002.nc: /school_pings/depth_m[2]: 20, 21");
  fs::remove_all(folder);
}

TEST(Compare, doubles_count_as_equal_to_one_part_in_a_billion) {
  ObservationProduct b = sample();
  EXPECT_EQ(compare_products(sample(), b).tolerated, 0);
  b.schools[0].volume_m3 *= 1.0 + 0.9e-9;
  b.schools[0].latitude *= 1.0 + 0.9e-9;
  const Comparison told = compare_products(sample(), b);
  EXPECT_EQ(told.difference, "");
  EXPECT_EQ(told.tolerated, 2);
  b.schools[0].volume_m3 = std::numeric_limits<double>::infinity();
  EXPECT_NE(compare_products(sample(), b).difference, "");
  EXPECT_THAT(told.first_tolerated, StartsWith("/schools/latitude[0]: "));
}

TEST(Compare, files_and_folders) {
  const fs::path folder = fs::temp_directory_path() / ("sonar_compare_" + std::to_string(::getpid()));
  ASSERT_TRUE(write_product(sample(), folder / "a" / "products" / "obs-0001.nc"));
  ASSERT_TRUE(write_product(sample(), folder / "b" / "products" / "obs-0001.nc"));
  EXPECT_EQ(compared(folder / "a", folder / "b"), "");
  ASSERT_TRUE(write_file(folder / "a" / "schools.csv", "school_id,depth_m\n1,20\n"));
  EXPECT_THAT(compared(folder / "a", folder / "b"), HasSubstr("schools.csv"));
  ASSERT_TRUE(write_file(folder / "b" / "schools.csv", "school_id,depth_m\n1,20.000000001\n"));
  EXPECT_EQ(compared(folder / "a", folder / "b"), "");
  EXPECT_EQ(compared_at(folder / "a", folder / "b")->tolerated, 1);
  EXPECT_EQ(compared_at(folder / "a", folder / "b")->first_tolerated, "schools.csv: depth_m[0]: '20', '20.000000001'");
  ASSERT_TRUE(write_file(folder / "b" / "schools.csv", "school_id,depth_m\n1,21\n"));
  EXPECT_EQ(compared(folder / "a", folder / "b"), "schools.csv: depth_m[0]: '20', '21'");
  ASSERT_TRUE(write_product(example::empty("obs-0002", 1), folder / "b" / "products" / "obs-0002.nc"));
  EXPECT_THAT(compared(folder / "a", folder / "b"), StartsWith("products (length): 1, 2"));
  EXPECT_EQ(compared_at(folder / "a", folder / "none").error().code, ErrorCode::not_found);
  EXPECT_EQ(compared_at(folder / "a", folder / "b" / "schools.csv").error().code, ErrorCode::usage);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sonar
