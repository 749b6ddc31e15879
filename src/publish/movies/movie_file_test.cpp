// SPDX-License-Identifier: Apache-2.0
#include "publish/movies/movie_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "io/external_command.h"
#include "io/fed_command.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

bool never() { return false; }

class Movies : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream bytes;
    bytes << in.rdbuf();
    return bytes.str();
  }
  [[nodiscard]] std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder_), {}); }
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

TEST_F(Movies, AnAnimatedPngHasTheChunksOfOne) {
  auto movie = animated_png(folder_ / "movie.png", {{3, 2}, 2, 4.0, "a title", ""});
  ASSERT_TRUE(movie);
  ASSERT_TRUE((*movie)->add(Image({3, 2}, {255, 0, 0, 255})));
  EXPECT_FALSE(fs::exists(folder_ / "movie.png")) << "it is not whole yet";
  ASSERT_TRUE((*movie)->add(Image({3, 2}, {0, 0, 255, 255})));
  ASSERT_TRUE((*movie)->finish());
  const std::string bytes = bytes_of(folder_ / "movie.png");
  std::vector<std::string> types;
  for (const auto& [type, length] : chunks_in(bytes)) types.push_back(type);
  EXPECT_THAT(types, testing::ElementsAre("IHDR", "acTL", "iTXt", "fcTL", "IDAT", "fcTL", "fdAT", "IEND"));
  EXPECT_EQ(bytes.substr(bytes.find("acTL") + 4, 8), std::string("\0\0\0\2\0\0\0\0", 8)) << "2 pictures, for ever";
  // By the specification: sequence 0, 3 x 2 pixels at (0, 0), 250/1000 s, no disposal, no
  // blending. The check sum of IEND is in every PNG.
  const std::string expected("fcTL\0\0\0\0\0\0\0\x03\0\0\0\x02\0\0\0\0\0\0\0\0\0\xFA\x03\xE8\0\0", 30);
  EXPECT_EQ(bytes.substr(bytes.find("fcTL"), 30), expected);
  EXPECT_EQ(bytes.substr(bytes.size() - 8), std::string("IEND\xAE\x42\x60\x82", 8));
}

TEST_F(Movies, WhatIsNotWholeLeavesNothing) {
  {
    auto movie = animated_png(folder_ / "movie.png", {{3, 2}, 3, 4.0, "", ""});
    ASSERT_TRUE(movie);
    ASSERT_TRUE((*movie)->add(Image({3, 2})));
    EXPECT_EQ((*movie)->add(Image({4, 2})).error().code, ErrorCode::mismatch);
    EXPECT_EQ((*movie)->finish().error().code, ErrorCode::mismatch);
  }
  EXPECT_EQ(files(), 0);
  EXPECT_EQ(animated_png(folder_ / "movie.png", {{3, 2}, 0, 4.0, "", ""}).error().code, ErrorCode::usage);
  EXPECT_EQ(animated_png(folder_ / "movie.gif", {{3, 2}, 1, 4.0, "", ""}).error().code, ErrorCode::usage);
  EXPECT_EQ(mp4(folder_ / "movie.avi", {{3, 2}, 1, 4.0, "", ""}, never).error().code, ErrorCode::usage);
}

TEST_F(Movies, AnMp4HasItsPicturesAndEvenSides) {
  const auto probe = program_in_path("ffprobe");
  if (!mp4_can_be_made() || !probe) GTEST_SKIP() << "there is no ffmpeg";
  const auto write = [&](const char* name) {
    auto movie = mp4(folder_ / name, {{65, 47}, 10, 4.0, "a \"title\"; $HOME", "where it is from"}, never);
    ASSERT_TRUE(movie) << to_line(movie.error());
    for (int i = 0; i < 10; ++i) {
      const auto shade = static_cast<std::uint8_t>(20 * i);
      ASSERT_TRUE((*movie)->add(Image({65, 47}, {shade, 100, 0, 255})));
    }
    ASSERT_TRUE((*movie)->finish());
  };
  write("a:movie.mp4");  // no protocol "a"
  const auto said = run_command({probe->string(), "-v", "error", "-count_frames", "-show_entries",
                                 "stream=width,height,nb_read_frames,pix_fmt,codec_name:format=duration:format_tags",
                                 "-of", "default=noprint_wrappers=1", "file:" + (folder_ / "a:movie.mp4").string()});
  ASSERT_TRUE(said);
  for (const char* line : {"codec_name=h264", "width=66", "height=48", "pix_fmt=yuv420p", "nb_read_frames=10",
                           "duration=2.5", "TAG:title=a \"title\"; $HOME", "TAG:comment=where it is from"}) {
    EXPECT_THAT(said->output, testing::HasSubstr(line));
  }
  write("b.mp4");
  EXPECT_EQ(bytes_of(folder_ / "a:movie.mp4"), bytes_of(folder_ / "b.mp4")) << "the same pictures are the same file";
  EXPECT_EQ(files(), 2);
}

TEST_F(Movies, AStoppedMp4LeavesNothing) {
  if (!mp4_can_be_made()) GTEST_SKIP() << "there is no ffmpeg";
  {
    bool stopped = false;
    auto movie = mp4(folder_ / "movie.mp4", {{64, 48}, 100, 4.0, "", ""}, [&] { return stopped; });
    ASSERT_TRUE(movie);
    ASSERT_TRUE((*movie)->add(Image({64, 48})));
    stopped = true;
    EXPECT_EQ((*movie)->add(Image({64, 48})).error().code, ErrorCode::cancelled);
  }
  EXPECT_EQ(files(), 0);
}

}  // namespace
}  // namespace sonar
