// SPDX-License-Identifier: Apache-2.0
#include "io/fed_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <sstream>

namespace sonar {
namespace {

namespace fs = std::filesystem;

bool never() { return false; }

std::string sh() { return program_in_path("sh").value().string(); }

TEST(FedCommand, TakesEveryByteOfALongStream) {
  const fs::path file = fs::temp_directory_path() / "sonar-fed-command";
  std::string bytes(3'000'000, 'a');
  for (std::size_t i = 0; i < bytes.size(); i += 7) bytes[i] = static_cast<char>(i % 251);
  auto command = FedCommand::start({sh(), "-c", "cat >\"$0\"", file.string()});
  ASSERT_TRUE(command);
  ASSERT_TRUE(command->feed(bytes, never));
  ASSERT_TRUE(command->end(never));
  std::ifstream in(file, std::ios::binary);
  std::stringstream read;
  read << in.rdbuf();
  EXPECT_EQ(read.str(), bytes);
  fs::remove(file);
}

TEST(FedCommand, TheLastComplaintIsTold) {
  auto command = FedCommand::start({sh(), "-c", "echo one >&2; echo 'the disk is full' >&2; cat >/dev/null; exit 3"});
  ASSERT_TRUE(command);
  const auto ended = command->end(never);
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().text, "sh failed: the disk is full");
}

TEST(FedCommand, OneThatEndsEarlyIsNoSignalButALine) {
  auto command = FedCommand::start({sh(), "-c", "echo 'wants no more' >&2; exit 1"});
  ASSERT_TRUE(command);
  const std::string bytes(1'000'000, 'x');
  Result<void> fed;
  for (int i = 0; i < 100 && fed; ++i) fed = command->feed(bytes, never);
  ASSERT_FALSE(fed);
  EXPECT_EQ(fed.error().text, "sh failed: wants no more");
}

TEST(FedCommand, IsStoppedQuicklyAndIsGoneWithItsObject) {
  const auto begun = std::chrono::steady_clock::now();
  {
    auto command = FedCommand::start({sh(), "-c", "exec sleep 60"});
    ASSERT_TRUE(command);
    int asked = 0;
    const std::string bytes(10'000'000, 'x');
    const auto fed = command->feed(bytes, [&] { return ++asked > 3; });
    ASSERT_FALSE(fed);
    EXPECT_EQ(fed.error().code, ErrorCode::cancelled);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20));
}

TEST(FedCommand, APathThatNamesNoSuchProgram) {
  EXPECT_FALSE(program_in_path("sonar-no-such-program"));
  const auto none = FedCommand::start({"/nowhere/sonar-no-such-program"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace sonar
