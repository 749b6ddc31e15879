// SPDX-License-Identifier: Apache-2.0
// Rasters, and files beside them, that would have the program ask a server. One listens here and counts.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/test_paths.h"
#include "io/depth_raster.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class Listening {
 public:
  Listening() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(at);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&at), size), 0);
    EXPECT_EQ(::listen(socket_, 64), 0);
    EXPECT_EQ(::getsockname(socket_, reinterpret_cast<sockaddr*>(&at), &size), 0);
    at_ = at;
  }
  ~Listening() { ::close(socket_); }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  [[nodiscard]] std::string address(const std::string& file) const {
    return "/vsicurl/http://127.0.0.1:" + std::to_string(ntohs(at_.sin_port)) + "/" + file;
  }
  /// How many have come since the last question.
  [[nodiscard]] int requests() const {
    int count = 0;
    for (int one = -1; (one = ::accept(socket_, nullptr, nullptr)) >= 0; ++count) ::close(one);
    return count;
  }
  void ask() const {
    const int one = ::socket(AF_INET, SOCK_STREAM, 0);
    EXPECT_EQ(::connect(one, reinterpret_cast<const sockaddr*>(&at_), sizeof(at_)), 0);
    ::close(one);
  }

 private:
  int socket_;
  sockaddr_in at_{};
};

class RasterHostile : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    DepthGrid grid{59.0, 4.0, 0.001, 0.001, 1000, 1000, {}, "made"};
    grid.depth_m.assign(1'000'000, 200.0F);
    ASSERT_TRUE(write_depth_raster(tiff_, grid));
  }
  void TearDown() override { fs::remove_all(folder_); }
  void put(const std::string& ending, const std::string& text) const { std::ofstream(tiff_.string() + ending) << text; }
  /// As a map asks: far coarser than the file, so that overviews would be taken.
  [[nodiscard]] Result<DepthGrid> read() const {
    return read_depth_raster(tiff_, {59.1, 59.9, 4.1, 4.9}, {RasterSign::automatic, 20});
  }

  fs::path folder_ = test::scratch_path("-raster-hostile");
  fs::path tiff_ = folder_ / "depth.tif";
  Listening server_;
};

TEST_F(RasterHostile, TheServerHearsWhoAsks) {
  server_.ask();
  EXPECT_EQ(server_.requests(), 1);
  EXPECT_TRUE(read());
  EXPECT_EQ(server_.requests(), 0);
}

TEST_F(RasterHostile, OverviewsThatAFileNamesAreNotFetched) {
  {
    auto* file = static_cast<GDALDataset*>(GDALOpenEx(tiff_.c_str(), GDAL_OF_UPDATE, nullptr, nullptr, nullptr));
    ASSERT_NE(file, nullptr);
    file->SetMetadataItem("OVERVIEW_FILE", server_.address("a.tif").c_str(), "OVERVIEWS");
    GDALClose(file);
  }
  (void)read();
  EXPECT_EQ(server_.requests(), 0);
}

TEST_F(RasterHostile, WhatLiesBesideAFileIsNotLookedAt) {
  put(".aux.xml", "<PAMDataset><Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">" + server_.address("a.tif") +
                      "</MDI></Metadata></PAMDataset>");
  const std::string virtual_raster =
      "<VRTDataset rasterXSize=\"10\" rasterYSize=\"10\"><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
      "<SourceFilename>" +
      server_.address("b.tif") +
      "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
  for (const char* ending : {".ovr", ".msk", ".msk.ovr", ".ovr.aux.xml"}) put(ending, virtual_raster);
  EXPECT_TRUE(read());
  EXPECT_EQ(server_.requests(), 0);
  fs::rename(tiff_.string() + ".ovr", tiff_);  // a raster that is nothing but the address of another
  const auto grid = read();
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.error().code, ErrorCode::format);
  EXPECT_EQ(server_.requests(), 0);
}

TEST_F(RasterHostile, NothingIsWrittenBesideAFile) {
  ASSERT_TRUE(read());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1);
}

}  // namespace
}  // namespace sonar
