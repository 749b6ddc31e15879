// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".partial-";

tl::unexpected<Error> refused(const fs::path& path, std::string_view what, int error) {
  return refused_write(what, error, path.string());
}

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "host";
  return name.data();
}

/// Everything before the number that makes the name free; host and process tell whose it is.
std::string own_prefix() { return fmt::format("{}{}-{}-", kPrefix, host_name(), ::getpid()); }

Result<void> flush(const fs::path& path, int flags) {
  const int fd = ::open(path.c_str(), flags | O_CLOEXEC);
  if (fd < 0) return refused(path, "cannot open to flush", errno);
  const int status = ::fsync(fd);
  const int error = errno;
  ::close(fd);
  // Some network file systems cannot flush a folder; the rename is still whole there.
  if (status != 0 && error != EINVAL) return refused(path, "cannot flush", error);
  return {};
}

/// Process number in a temporary file's name of this machine; 0 = none of ours.
int owner(std::string_view file_name, std::string_view prefix_of_host) {
  if (!file_name.starts_with(prefix_of_host)) return 0;
  file_name.remove_prefix(prefix_of_host.size());
  int pid = 0;
  const auto [end, error] = std::from_chars(file_name.data(), file_name.data() + file_name.size(), pid);
  const bool whole = error == std::errc{} && end != file_name.data() + file_name.size() && *end == '-';
  return whole && pid > 0 ? pid : 0;
}

}  // namespace

tl::unexpected<Error> refused_write(std::string_view what, int error, const std::string& file) {
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return fail(full ? ErrorCode::no_space : ErrorCode::io,
              error == 0 ? std::string(what) : fmt::format("{}: {}", what, std::generic_category().message(error)),
              {.file = file});
}

AtomicFile::AtomicFile(fs::path target, fs::path temporary)
    : target_(std::move(target)), temporary_(std::move(temporary)) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)), temporary_(std::exchange(other.temporary_, {})) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  return *this;
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

Result<AtomicFile> AtomicFile::create(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code made;
  fs::create_directories(folder, made);
  if (made) return fail(ErrorCode::io, "cannot make the folder: " + made.message(), {.file = folder.string()});
  const std::string prefix = own_prefix();
  const std::string name = target.filename().string();
  for (int n = 0;; ++n) {
    fs::path temporary = folder / fmt::format("{}{}-{}", prefix, n, name);
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0) {
      ::close(fd);
      return AtomicFile(target, std::move(temporary));
    }
    if (errno != EEXIST) return refused(target, "cannot write", errno);
  }
}

Result<void> AtomicFile::commit() {
  if (auto flushed = flush(temporary_, O_RDWR); !flushed) return flushed;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return refused(target_, "cannot rename into place", errno);
  temporary_.clear();
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  return flush(folder, O_RDONLY | O_DIRECTORY);
}

Result<void> write_file(const fs::path& target, std::string_view bytes) {
  auto file = AtomicFile::create(target);
  if (!file) return pass_on(file);
  const int fd = ::open(file->temporary().c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) return refused(target, "cannot write", errno);
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      ::close(fd);
      return refused(target, "cannot write", error);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::close(fd) != 0) return refused(target, "cannot write", errno);
  return file->commit();
}

Result<std::string> read_file(const fs::path& path, std::uint64_t limit_bytes) {
  const Where where{.file = path.string()};
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) return fail(ErrorCode::not_found, "no such file", where);
  if (!fs::is_regular_file(status)) return fail(ErrorCode::io, "is not a file", where);
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) return fail(ErrorCode::io, error.message(), where);
  if (size > limit_bytes) {
    return fail(ErrorCode::format, fmt::format("{} bytes; at most {} were expected", size, limit_bytes), where);
  }
  std::ifstream in(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in) return fail(ErrorCode::io, "cannot be read", where);
  return bytes;
}

Result<void> require_free_space(const fs::path& folder, std::uint64_t bytes) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (!fs::exists(there, error) && there.has_relative_path()) there = there.parent_path();
  const fs::space_info space = fs::space(there, error);
  if (error) return fail(ErrorCode::io, "cannot ask for free space: " + error.message(), {.file = there.string()});
  if (space.available < bytes) {
    return fail(ErrorCode::no_space,
                fmt::format("{:.1f} MB free, {:.1f} MB needed", static_cast<double>(space.available) / 1e6,
                            static_cast<double>(bytes) / 1e6),
                {.file = folder.string()});
  }
  return {};
}

void remove_leftovers(const fs::path& folder) {
  const std::string prefix_of_host = fmt::format("{}{}-", kPrefix, host_name());
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const int pid = owner(it->path().filename().string(), prefix_of_host);
    const bool dead = pid > 0 && ::kill(pid, 0) != 0 && errno == ESRCH;
    std::error_code ignored;
    if (dead) fs::remove(it->path(), ignored);
  }
}

}  // namespace sonar
