// SPDX-License-Identifier: Apache-2.0
#include "io/hdf5_image.h"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <algorithm>
#include <string>

#include "base/test_paths.h"
#include "io/atomic_file.h"
#include "io/netcdf_file.h"

namespace sonar::netcdf {
namespace {

// Beside a file that the library wrote to a disk by itself.
TEST(Hdf5Image, TheSumOfASuperblockIsTheLibrarys) {
  const auto path = test::scratch_path(".nc");
  {
    const auto held = lock();
    int file = -1;
    ASSERT_EQ(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &file), NC_NOERR);
    int dimension = -1;
    ASSERT_EQ(nc_def_dim(file, "a", 7, &dimension), NC_NOERR);
    ASSERT_EQ(nc_close(file), NC_NOERR);
  }
  const std::string written = *read_file(path);
  std::string image = written;
  std::fill_n(image.begin() + 44, 4, '\0');
  EXPECT_TRUE(seal_superblock(std::as_writable_bytes(std::span(image))));
  EXPECT_EQ(image, written);
  std::filesystem::remove(path);
}

TEST(Hdf5Image, WhatIsNoSuchFileStaysAsItIs) {
  for (std::string bytes :
       {std::string{}, std::string(100, '\0'), std::string("\x89HDF\r\n\x1a\n\0\0", 10) + std::string(90, 'x')}) {
    const std::string before = bytes;
    EXPECT_FALSE(seal_superblock(std::as_writable_bytes(std::span(bytes))));
    EXPECT_EQ(bytes, before);
  }
}

}  // namespace
}  // namespace sonar::netcdf
