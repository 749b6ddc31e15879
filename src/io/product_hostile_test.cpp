// SPDX-License-Identifier: Apache-2.0
// Products that somebody made to do harm. Each has the seal that our own writer puts on its files: anybody can make one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/stat.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/test_paths.h"
#include "io/netcdf_model.h"
#include "io/product_example.h"
#include "io/product_file.h"
#include "io/product_seal.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ProductHostile : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    ObservationProduct p = example::empty("obs-0001", 5);
    example::add_school(p, 1, 0, 3, example::block(1, 1, 2, 20, 8, 200));
    ASSERT_TRUE(write_product(p, file_));
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put_sealed(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary | std::ios::trunc) << bytes;
    ASSERT_TRUE(example::append_seal(file_));
  }
  [[nodiscard]] hid_t opened() const { return H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT); }
  void sealed_after(hid_t file) const {
    H5Fclose(file);
    ASSERT_TRUE(example::append_seal(file_));
  }
  /// Five numbers of another file, in place of the pings' latitudes.
  void put_secret() const {
    std::ofstream secret(folder_ / "secret", std::ios::binary);
    for (const double number : {60.1, 60.2, 60.3, 60.4, 60.5}) {
      secret.write(reinterpret_cast<const char*>(&number), sizeof(number));
    }
  }

  fs::path folder_ = test::scratch_path("-hostile");
  fs::path file_ = folder_ / "obs-0001.nc";
};

TEST_F(ProductHostile, ValuesKeptInAnotherFileAreRefused) {
  put_secret();
  const hid_t file = opened();
  ASSERT_GE(file, 0);
  ASSERT_GE(H5Ldelete(file, "/pings/latitude", H5P_DEFAULT), 0);
  const hsize_t size = 5;
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
  ASSERT_GE(H5Pset_external(how, (folder_ / "secret").c_str(), 0, size * sizeof(double)), 0);
  H5Dclose(H5Dcreate2(file, "/pings/latitude", H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT));
  H5Pclose(how);
  H5Sclose(space);
  sealed_after(file);
  const auto product = read_product(file_);
  ASSERT_FALSE(product);
  EXPECT_EQ(product.error().code, ErrorCode::format);
  EXPECT_THAT(product.error().text, HasSubstr("another file"));
}

TEST_F(ProductHostile, LinksToAnotherFileAreRefused) {
  fs::copy_file(file_, folder_ / "other.nc");
  const hid_t file = opened();
  ASSERT_GE(file, 0);
  ASSERT_GE(H5Ldelete(file, "/mask", H5P_DEFAULT), 0);
  ASSERT_GE(H5Lcreate_external((folder_ / "other.nc").c_str(), "/mask", file, "mask", H5P_DEFAULT, H5P_DEFAULT), 0);
  sealed_after(file);
  const auto product = read_product(file_);
  ASSERT_FALSE(product);
  EXPECT_EQ(product.error().code, ErrorCode::format);
}

// HDF5 is not written to survive damaged metadata; under a seal that was made for the damage nothing else stands before it.
TEST_F(ProductHostile, NoDamageUnderASealBreaksTheProgram) {
  const std::string sound = bytes();
  int refused = 0;
  for (std::size_t i = 0; i < 120; ++i) {
    std::string spoilt = sound;
    const std::size_t at = 8 + i * 7919 % std::min<std::size_t>(sound.size() - 8, 40'000);
    for (std::size_t k = at; k < std::min(at + 1 + i % 4, sound.size()); ++k)
      spoilt[k] = static_cast<char>(255 - i % 3 * 128);
    put_sealed(spoilt);
    const auto product = read_product(file_);

    if (product) continue;
    ++refused;
    EXPECT_FALSE(product.error().text.empty());
  }
  EXPECT_GT(refused, 10);
}

TEST_F(ProductHostile, NamesThatLeadElsewhereAreRefused) {
  fuzz::NetcdfModel model = fuzz::read_netcdf_model(file_);
  for (const char* name : {"../../obs-0001", "obs-1", "obs-0001/../x", "", "obs-00012345678901234567890", "OBS-0001"}) {
    for (auto& attribute : model.attributes) {
      if (attribute.name == "observation") attribute.texts = {name};
    }
    ASSERT_TRUE(fuzz::write_netcdf_model(model, file_));
    ASSERT_TRUE(example::append_seal(file_));
    const auto product = read_product(file_);
    ASSERT_FALSE(product) << name;
    EXPECT_THAT(product.error().text, HasSubstr("obs-0001"));
    EXPECT_FALSE(read_product_key(file_)) << name;
  }
}

TEST_F(ProductHostile, APipeIsNotWaitedFor) {
  fs::remove(file_);
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_EQ(read_product(file_).error().code, ErrorCode::io);
  EXPECT_EQ(read_product_key(file_).error().code, ErrorCode::io);
}

}  // namespace
}  // namespace sonar
