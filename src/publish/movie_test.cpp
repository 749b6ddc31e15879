// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "publish/picture_output.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class Movie : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path picture(const char* name, PixelSize size, Rgba8 colour) {
    fs::path file = folder_ / name;
    EXPECT_TRUE(write_pixels(Image(size, colour), file));
    return file;
  }
  static std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream bytes;
    bytes << in.rdbuf();
    return bytes.str();
  }
  fs::path folder_ = fs::temp_directory_path() /
                     (std::string("sonar-movie-") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// Type and length of every chunk.
std::vector<std::pair<std::string, std::size_t>> chunks_in(const std::string& png) {
  std::vector<std::pair<std::string, std::size_t>> chunks;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length * 256 + static_cast<unsigned char>(png[at + i]);
    chunks.emplace_back(png.substr(at + 4, 4), length);
    at += 12 + length;
  }
  return chunks;
}

TEST_F(Movie, HasTheChunksOfAnAnimatedPng) {
  const std::vector<fs::path> pictures{picture("a.png", {3, 2}, {255, 0, 0, 255}),
                                       picture("b.png", {3, 2}, {0, 0, 255, 255})};
  ASSERT_TRUE(write_movie(pictures, 0.25, folder_ / "movie.png"));
  const std::string movie = bytes_of(folder_ / "movie.png");
  std::vector<std::string> types;
  for (const auto& [type, length] : chunks_in(movie)) types.push_back(type);
  EXPECT_THAT(types, testing::ElementsAre("IHDR", "acTL", "fcTL", "IDAT", "fcTL", "fdAT", "IEND"));
  // By the specification: sequence 0, 3 x 2 pixels at (0, 0), 250/1000 s, no disposal, no
  // blending. The check sum of IEND is in every PNG.
  const auto control = movie.find("fcTL");
  const std::string expected("fcTL\0\0\0\0\0\0\0\x03\0\0\0\x02\0\0\0\0\0\0\0\0\0\xFA\x03\xE8\0\0", 30);
  EXPECT_EQ(movie.substr(control, 30), expected);
  EXPECT_EQ(movie.substr(movie.size() - 8), std::string("IEND\xAE\x42\x60\x82", 8));
}

TEST_F(Movie, RefusesWhatDoesNotFit) {
  const fs::path small = picture("small.png", {3, 2}, {});
  const std::vector<fs::path> unequal{small, picture("large.png", {4, 2}, {})};
  EXPECT_EQ(write_movie(unequal, 0.1, folder_ / "movie.png").error().code, ErrorCode::mismatch);
  EXPECT_EQ(write_movie({}, 0.1, folder_ / "movie.png").error().code, ErrorCode::usage);
  EXPECT_EQ(write_movie(std::vector{small}, 0.1, folder_ / "movie.gif").error().code, ErrorCode::usage);
  const std::string whole = bytes_of(small);
  for (const std::size_t length : {std::size_t{4}, std::size_t{20}, whole.size() - 3}) {
    std::ofstream(folder_ / "cut.png", std::ios::binary) << whole.substr(0, length);
    EXPECT_EQ(write_movie(std::vector{folder_ / "cut.png"}, 0.1, folder_ / "movie.png").error().code,
              ErrorCode::format);
  }
  EXPECT_FALSE(fs::exists(folder_ / "movie.png"));
  EXPECT_EQ(write_pixels(Image({1, 1}), folder_ / "a.svg").error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace sonar
