// SPDX-License-Identifier: Apache-2.0
#include "io/sandbox.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <new>
#include <vector>

#include "io/child_process.h"
#include "io/wire.h"

namespace sonar {
namespace {

[[noreturn]] void wait_for_ever() {
  for (;;) ::pause();
}

/// What a child in the sandbox could still do, a byte for each, and whether it was watched.
std::array<std::byte, 7> tried(Reach reach) {
  const int before = ::open("/dev/null", O_WRONLY);
  std::array<std::byte, 7> done{};
  const auto child = ChildProcess::start(
      [before, reach](int stream) {
        const bool watched = enter_sandbox(stream, reach, 1U << 30U);
        const std::array<bool, 6> could{::open("/etc/passwd", O_RDONLY) >= 0,
                                        ::open("/tmp/x", O_CREAT | O_WRONLY, 0600) >= 0,
                                        ::socket(AF_INET, SOCK_STREAM, 0) >= 0,
                                        ::fork() >= 0,
                                        ::kill(::getppid(), 0) == 0,
                                        !kSanitized && ::write(before, "x", 1) == 1};
        std::array<std::byte, 7> told{};
        told.back() = std::byte{watched};
        for (std::size_t i = 0; i < could.size(); ++i) told[i] = std::byte{could[i]};
        (void)say_all(stream, told);
      },
      "x");
  EXPECT_TRUE(child);
  EXPECT_EQ(child->hear(done, 10), ChildProcess::Heard::all);
  ::close(before);
  return done;
}

TEST(Sandbox, NothingOutsideCanBeReached) {
  const auto done = tried(Reach::nothing);
  if (done.back() == std::byte{0}) GTEST_SKIP() << "this kernel lets no calls be watched";
  EXPECT_EQ(done, (std::array<std::byte, 7>{{{}, {}, {}, {}, {}, {}, std::byte{1}}}));
}

TEST(Sandbox, FilesCanBeReadWhereAllowedAndNothingElse) {
  const auto done = tried(Reach::files_to_read);
  if (done.back() == std::byte{0}) GTEST_SKIP() << "this kernel lets no calls be watched";
  EXPECT_EQ(done, (std::array<std::byte, 7>{{std::byte{1}, {}, {}, {}, {}, {}, std::byte{1}}}));
}

TEST(Sandbox, MemoryIsThereAndEnds) {
  if (kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  const auto child = ChildProcess::start(
      [](int stream) {
        (void)enter_sandbox(stream, Reach::nothing, 256U << 20U);
        std::array<std::byte, 2> told{};
        for (std::size_t i = 0; i < told.size(); ++i) {
          try {
            const std::vector<char> taken((i + 1) * (200U << 20U), 'x');
            told[i] = std::byte{taken.back() == 'x'};
          } catch (const std::bad_alloc&) {
          }
        }
        (void)say_all(stream, told);
      },
      "x");
  ASSERT_TRUE(child);
  std::array<std::byte, 2> done{};
  EXPECT_EQ(child->hear(done, 10), ChildProcess::Heard::all);
  EXPECT_EQ(done[0], std::byte{1});
  EXPECT_EQ(done[1], std::byte{0});
}

TEST(Wire, tells_who_survives) {
  const auto make = [](const std::function<void(int)>& body) {
    return [body] {
      return ChildProcess::start(
          [body](int stream) {
            if (wire::greet(stream)) body(stream);
          },
          "x");
    };
  };
  const auto said = wire::begin(make([](int stream) { (void)wire::tell(stream, {}, wire::encoded(7)); }), 100);
  ASSERT_TRUE(said);
  EXPECT_EQ(wire::decoded<int>(said->said), 7);
  const auto refused =
      wire::begin(make([](int stream) { (void)wire::tell(stream, fail(ErrorCode::mismatch, "elsewhere"), {}); }), 100);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::mismatch);
  EXPECT_EQ(refused.error().text, "elsewhere");
  // More than was allowed, a crash, and no end.
  EXPECT_FALSE(wire::begin(make([](int stream) { (void)wire::tell(stream, {}, wire::Bytes(101)); }), 100));
  EXPECT_EQ(wire::begin(make([](int) { ::raise(SIGSEGV); }), 100).error().code, ErrorCode::format);
  EXPECT_EQ(wire::begin(make([](int) { throw std::bad_alloc(); }), 100).error().code, ErrorCode::format);
  EXPECT_EQ(wire::begin(make([](int) { wait_for_ever(); }), 100, 1).error().code, ErrorCode::io);
}

// What a child waits for in vain may be free when the next is made.
TEST(Wire, a_child_that_hangs_is_made_again) {
  int made = 0;
  const auto said = wire::begin(
      [&] {
        return ChildProcess::start(
            [first = made++ == 0](int stream) {
              if (first) wait_for_ever();
              (void)wire::greet(stream);
              (void)wire::tell(stream, {}, {});
            },
            "x");
      },
      100, 12);
  EXPECT_TRUE(said);
  EXPECT_EQ(made, 2);
}

TEST(ChildProcess, ItsEndIsHeardAndItsSilenceToo) {
  std::array<std::byte, 1> byte{};
  const auto gone = ChildProcess::start([](int) { ::raise(SIGSEGV); }, "x");
  ASSERT_TRUE(gone);
  EXPECT_EQ(gone->hear(byte, 10), ChildProcess::Heard::gone);
  const auto silent = ChildProcess::start(
      [](int stream) {
        std::array<std::byte, 1> never{};
        (void)hear_all(stream, never);
      },
      "x");
  ASSERT_TRUE(silent);
  EXPECT_EQ(silent->hear(byte, 1), ChildProcess::Heard::silence);
}

}  // namespace
}  // namespace sonar
