// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <ctime>
#include <system_error>
#include <utility>

#include "io/byte_source.h"
#include "io/recordings.h"

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

/// A name that nobody foresees, for libraries open it once more by its path; host and process tell whose it is.
std::string temporary_name(const std::string& target) {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof(number), 0) != sizeof(number)) number = static_cast<std::uint64_t>(::clock());
  return fmt::format("{}{}-{}-{:016x}-{}", kPrefix, host_name(), ::getpid(), number, target);
}

/// Some network file systems cannot flush a folder; the rename is still whole there.
int flush(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno; }

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

Result<int> open_folder(const fs::path& folder, Beside beside) {
  const int through = beside == Beside::own_folder ? O_NOFOLLOW : 0;
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | through);
  if (descriptor < 0) return refused(folder, "cannot write to the folder", errno);
  return descriptor;
}

Result<void> require_no_recording(const fs::path& target) {
  if (!is_recording(target)) return {};
  return fail(ErrorCode::usage, "is a recording, which is never written over", {.file = target.string()});
}

Result<void> make_folder(const fs::path& folder, Beside beside) {
  if (beside == Beside::own_folder) {
    if (auto own = require_own_folder(folder); !own) return own;
  }
  std::error_code made;
  fs::create_directories(folder, made);
  if (made) return fail(ErrorCode::io, "cannot make the folder: " + made.message(), {.file = folder.string()});
  const bool asks = beside == Beside::named_folder || beside == Beside::own_folder;
  const bool among = asks && holds_recordings(beside == Beside::own_folder ? folder_of(folder) : folder);
  if (!among) return {};
  return fail(ErrorCode::usage, "lies in the folder of the raw files, where nothing is ever written",
              {.file = folder.string()});
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
  std::string why = error == 0 ? std::string{} : ": " + std::generic_category().message(error);
  if (error == ELOOP) why = ": is a link, through which nothing is written";
  return fail(full ? ErrorCode::no_space : ErrorCode::io, std::string(what) + why, {.file = file});
}

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      beside_(other.beside_),
      folder_(std::exchange(other.folder_, -1)),
      file_(std::exchange(other.file_, -1)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  std::swap(beside_, other.beside_);
  std::swap(folder_, other.folder_);
  std::swap(file_, other.file_);
  return *this;
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) ::unlinkat(folder_, temporary_.filename().c_str(), 0);
  if (file_ >= 0) ::close(file_);
  if (folder_ >= 0) ::close(folder_);
}

Result<AtomicFile> AtomicFile::create(const fs::path& target, Beside beside) {
  const fs::path folder = folder_of(target);
  if (auto made = make_folder(folder, beside); !made) return pass_on(made);
  if (auto free = require_no_recording(target); !free) return pass_on(free);
  const auto opened = open_folder(folder, beside);
  if (!opened) return pass_on(opened);
  AtomicFile file(target, beside, *opened);
  if (auto made = file.make_temporary(); !made) return pass_on(made);
  return file;
}

Result<void> AtomicFile::make_temporary() {
  for (;;) {
    const std::string name = temporary_name(target_.filename().string());
    file_ = ::openat(folder_, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_APPEND | O_CLOEXEC, 0666);
    if (file_ >= 0) {
      temporary_ = folder_of(target_) / name;
      return {};
    }
    if (errno != EEXIST) return refused(target_, "cannot write", errno);
  }
}

Result<void> AtomicFile::write(std::string_view bytes) {
  const int error = write_all(file_, bytes);
  return error == 0 ? Result<void>{} : refused(target_, "cannot write", error);
}

/// What stands there now: a library may have made the file anew under the same name.
Result<void> AtomicFile::flush_temporary() const {
  const int written = ::openat(folder_, temporary_.filename().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (written < 0) return refused(target_, "cannot open to flush", errno);
  const int error = flush(written);
  ::close(written);
  return error == 0 ? Result<void>{} : refused(target_, "cannot flush", error);
}

Result<void> AtomicFile::commit() {
  const bool flushes = beside_ != Beside::users_cache;
  if (auto flushed = flushes ? flush_temporary() : Result<void>{}; !flushed) return flushed;
  if (auto free = require_no_recording(target_); !free) return free;
  const std::string name = target_.filename().string();
  if (::renameat(folder_, temporary_.filename().c_str(), folder_, name.c_str()) != 0) {
    return refused(target_, "cannot rename into place", errno);
  }
  temporary_.clear();
  const int error = flushes ? flush(folder_) : 0;
  return error == 0 ? Result<void>{} : refused(folder_of(target_), "cannot flush the folder", error);
}

Result<void> write_file(const fs::path& target, std::string_view bytes, Beside beside) {
  auto file = AtomicFile::create(target, beside);
  if (!file) return pass_on(file);
  if (auto written = file->write(bytes); !written) return written;
  return file->commit();
}

Result<void> require_own_folder(const fs::path& folder) {
  std::error_code absent;
  if (!fs::is_symlink(fs::symlink_status(folder, absent))) return {};
  return fail(ErrorCode::io,
              "is a link; expected a folder of the program's own: nothing is written or removed through it",
              {.file = folder.string()});
}

Result<std::string> read_file(const fs::path& path, std::uint64_t limit_bytes) {
  const auto source = open_file(path);
  if (!source) {
    const bool absent = source.error().code == ErrorCode::not_found;
    return fail(source.error().code, absent ? "no such file" : source.error().text, {.file = path.string()});
  }
  const auto size = (*source)->size();
  if (!size) return pass_on(size);
  if (*size > limit_bytes) {
    return fail(ErrorCode::format, fmt::format("{} bytes; at most {} were expected", *size, limit_bytes),
                {.file = path.string()});
  }
  std::string bytes(static_cast<std::size_t>(*size), '\0');
  const auto got = (*source)->read(0, std::as_writable_bytes(std::span(bytes)));
  if (!got) return pass_on(got);
  bytes.resize(*got);
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
