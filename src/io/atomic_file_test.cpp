// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace sonar {
namespace {

namespace fs = std::filesystem;

class Atomic : public testing::Test {
 protected:
  Atomic() : folder_(fs::temp_directory_path() / ("sonar_atomic_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Atomic() override { fs::remove_all(folder_); }
  Atomic(const Atomic&) = delete;
  Atomic& operator=(const Atomic&) = delete;
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }
  fs::path folder_;
};

TEST_F(Atomic, replaces_whole_files_only) {
  const fs::path target = folder_ / "new" / "a.txt";
  ASSERT_TRUE(write_file(target, "first"));
  EXPECT_EQ(*read_file(target), "first");
  {
    auto file = AtomicFile::create(target);
    ASSERT_TRUE(file);
    std::ofstream(file->temporary()) << "half";
    EXPECT_EQ(file->temporary().extension(), ".txt");
    EXPECT_EQ(*read_file(target), "first");
  }
  EXPECT_EQ(*read_file(target), "first");
  ASSERT_TRUE(write_file(target, "second"));
  EXPECT_EQ(*read_file(target), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "new"), fs::directory_iterator{}), 1);
}

TEST_F(Atomic, refuses_in_one_line) {
  EXPECT_EQ(read_file(folder_ / "none").error().code, ErrorCode::not_found);
  EXPECT_EQ(read_file(folder_).error().code, ErrorCode::io);
  ASSERT_TRUE(write_file(folder_ / "a", "0123456789"));
  EXPECT_EQ(read_file(folder_ / "a", 9).error().code, ErrorCode::format);
  EXPECT_FALSE(write_file(folder_ / "a" / "b", "a file is no folder"));
}

TEST_F(Atomic, free_space) {
  EXPECT_TRUE(require_free_space(folder_ / "not" / "yet" / "there", 1));
  EXPECT_EQ(require_free_space(folder_, 1ULL << 62).error().code, ErrorCode::no_space);
}

TEST_F(Atomic, leftovers_of_dead_processes_go) {
  auto mine = AtomicFile::create(folder_ / "a.nc");
  ASSERT_TRUE(mine);
  // The largest process number of Linux is below 2^22.
  std::string name = mine->temporary().filename().string();
  const std::string own = "-" + std::to_string(::getpid()) + "-";
  name.replace(name.rfind(own), own.size(), "-99999999-");
  std::ofstream(folder_ / name) << "x";
  std::ofstream(folder_ / "kept.nc") << "x";
  EXPECT_EQ(entries(), 3U);
  remove_leftovers(folder_);
  EXPECT_EQ(entries(), 2U);
  EXPECT_TRUE(fs::exists(mine->temporary()));
}

}  // namespace
}  // namespace sonar
