// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>

#include "io/netcdf_model.h"
#include "io/product_example.h"
#include "io/product_file.h"
#include "io/product_seal.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Sealed files that are sound for netCDF and say nonsense.
class ProductSpoilt : public testing::Test {
 protected:
  ProductSpoilt() : folder_(fs::temp_directory_path() / ("sonar_product_spoilt_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    ObservationProduct p = example::empty("obs-0001", 5);
    example::add_school(p, 1, 0, 3, example::block(1, 1, 2, 20, 8, 200));
    EXPECT_TRUE(write_product(p, folder_ / "sound.nc"));
    file_ = fuzz::read_netcdf_model(folder_ / "sound.nc");
  }
  ~ProductSpoilt() override { fs::remove_all(folder_); }
  ProductSpoilt(const ProductSpoilt&) = delete;
  ProductSpoilt& operator=(const ProductSpoilt&) = delete;

  [[nodiscard]] Result<ObservationProduct> read() const {
    EXPECT_TRUE(fuzz::write_netcdf_model(file_, folder_ / "spoilt.nc"));
    EXPECT_TRUE(example::append_seal(folder_ / "spoilt.nc"));
    return read_product(folder_ / "spoilt.nc");
  }
  fuzz::NetcdfModel::Group& group(const std::string& name) {
    for (auto& group : file_.groups) {
      if (group.name == name) return group;
    }
    ADD_FAILURE() << name;
    return file_.groups.front();
  }
  fuzz::NetcdfModel::Variable& variable(const std::string& in, const std::string& name) {
    for (auto& variable : group(in).variables) {
      if (variable.name == name) return variable;
    }
    ADD_FAILURE() << name;
    return group(in).variables.front();
  }

  fs::path folder_;
  fuzz::NetcdfModel file_;
};

TEST_F(ProductSpoilt, a_sound_one_is_read) {
  const auto product = read();
  ASSERT_TRUE(product) << to_line(product.error());
  EXPECT_EQ(product->school_pings.size(), 4U);
}

TEST_F(ProductSpoilt, small_files_do_not_pretend_to_hold_large_tables) {
  // Variables of which nothing was ever written take no room: some kilobytes could ask for gigabytes.
  for (const char* name : {"pings", "schools", "school_pings", "mask", "diagnostics"}) {
    auto& dimension = group(name).dimensions.front();
    const std::size_t before = dimension.length;
    for (const int power : {26, 40}) {
      dimension.length = std::size_t{1} << power;
      const auto product = read();
      ASSERT_FALSE(product) << name << " 2^" << power;
      EXPECT_EQ(product.error().code, ErrorCode::format);
      EXPECT_THAT(product.error().text, HasSubstr("than the file can hold")) << name << " 2^" << power;
    }
    dimension.length = before;
  }
}

TEST_F(ProductSpoilt, times_may_be_as_far_apart_as_they_like) {
  variable("pings", "time_ns").wholes.front() = 9'223'372'036'854'775'807LL;
  variable("school_pings", "time_utc").texts.front() = "1700-01-01T00:00:00.000Z";
  EXPECT_TRUE(read());
}

TEST_F(ProductSpoilt, angles_that_hardly_rise_are_refused) {
  // Neighbours among the doubles in degrees may be one number in radians.
  auto& elevation_deg = variable("grid", "elevation").numbers;
  elevation_deg[1] = std::nextafter(elevation_deg[0], 90.0);
  const auto product = read();
  ASSERT_FALSE(product);
  EXPECT_THAT(product.error().text, HasSubstr("grid makes no sense"));
}

TEST_F(ProductSpoilt, a_variable_of_another_type_is_refused) {
  variable("pings", "latitude").type = NC_STRING;
  variable("pings", "latitude").numbers.clear();
  const auto product = read();
  ASSERT_FALSE(product);
  EXPECT_THAT(product.error().text, HasSubstr("'latitude'"));
}

}  // namespace
}  // namespace sonar
