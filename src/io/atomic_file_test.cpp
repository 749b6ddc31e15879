// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "base/test_full_disk.h"
#include "io/raw_datagrams.h"

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

std::string recording() {
  RawBytes bytes;
  append_nme0(bytes, TimeNs{1'258'099'909'000'000'000}, "$GPHDT,1,T");
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(Atomic, recordings_are_never_written_over_nor_written_beside) {
  std::ofstream(folder_ / "a.raw") << recording();
  std::ofstream(folder_ / "no_ending") << recording();
  fs::create_directories(folder_ / "elsewhere");
  std::ofstream(folder_ / "elsewhere" / "no_ending") << recording();
  std::ofstream(folder_ / "elsewhere" / "damaged.RAW") << "?";
  for (const char* name : {"a.raw", "no_ending", "table.csv", "elsewhere/no_ending", "elsewhere/damaged.RAW"}) {
    const auto written = write_file(folder_ / name, "gone");
    ASSERT_FALSE(written) << name;
    EXPECT_EQ(written.error().code, ErrorCode::usage);
    const auto as_recording = write_file(folder_ / name, "gone", Beside::recordings);
    EXPECT_EQ(as_recording.has_value(), std::string(name) == "table.csv") << name;
  }
  EXPECT_EQ(*read_file(folder_ / "a.raw"), recording());
  EXPECT_EQ(*read_file(folder_ / "elsewhere" / "no_ending"), recording());
  EXPECT_TRUE(write_file(folder_ / "elsewhere" / "table.csv", "no recording beside it is sound"));
  // One that came while the file was written.
  auto late = AtomicFile::create(folder_ / "elsewhere" / "late");
  ASSERT_TRUE(late);
  std::ofstream(folder_ / "elsewhere" / "late") << recording();
  EXPECT_EQ(late->commit().error().code, ErrorCode::usage);
  EXPECT_EQ(*read_file(folder_ / "elsewhere" / "late"), recording());
}

TEST_F(Atomic, nothing_is_written_through_a_link) {
  std::ofstream(folder_ / "others") << "theirs";
  fs::create_directories(folder_ / "behind");
  fs::create_symlink(folder_ / "others", folder_ / "link");
  ASSERT_TRUE(write_file(folder_ / "link", "ours"));
  EXPECT_EQ(*read_file(folder_ / "others"), "theirs");
  EXPECT_EQ(*read_file(folder_ / "link"), "ours");
  // A folder that a user named may be a link; one that we make inside it may not.
  fs::create_directory_symlink(folder_ / "behind", folder_ / "products");
  EXPECT_TRUE(write_file(folder_ / "products" / "a", "named"));
  const auto refused = write_file(folder_ / "products" / "b", "ours", Beside::own_folder);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where.file, (folder_ / "products").string());
  EXPECT_FALSE(fs::exists(folder_ / "behind" / "b"));
  // A link that takes the place of what is being written.
  auto file = AtomicFile::create(folder_ / "new");
  ASSERT_TRUE(file);
  fs::remove(file->temporary());
  fs::create_symlink(folder_ / "others", file->temporary());
  EXPECT_FALSE(file->commit());
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(Atomic, a_full_disk_leaves_what_was_there) {
  const fs::path target = folder_ / "a";
  ASSERT_TRUE(write_file(target, "before"));
  const auto written = [&] {
    const FullDisk disk(1000);
    return write_file(target, std::string(5000, 'x'));
  }();
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::no_space);
  EXPECT_EQ(to_line(written.error()), target.string() + ": cannot write: File too large");
  EXPECT_EQ(*read_file(target), "before");
  EXPECT_EQ(entries(), 1U);
}

}  // namespace
}  // namespace sonar
