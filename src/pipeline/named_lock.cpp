// SPDX-License-Identifier: Apache-2.0
#include "pipeline/named_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "io/atomic_file.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr int kTries = 5;

struct Holder {
  std::string host;
  std::string machine;  ///< what /etc/machine-id says: hosts may have one name
  std::int64_t process = 0;
  std::string operator_name;
  std::string since;
};

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string machine_id() {
  const auto text = read_file("/etc/machine-id", 256);
  return text ? text->substr(0, text->find('\n')) : std::string{};
}

std::string text_of(const Holder& holder) {
  return nlohmann::json{{"lock_version", 1},
                        {"host", holder.host},
                        {"machine", holder.machine},
                        {"process", holder.process},
                        {"operator", holder.operator_name},
                        {"since", holder.since}}
             .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
         "\n";
}

std::optional<Holder> holder_in(const fs::path& file) {
  const auto text = read_file(file, 4096);
  const auto json = nlohmann::json::parse(text ? *text : std::string{}, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto word = [&](const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string{};
  };
  const auto process = json.find("process");
  if (process == json.end() || !process->is_number_integer()) return std::nullopt;
  return Holder{word("host"), word("machine"), process->get<std::int64_t>(), word("operator"), word("since")};
}

std::string words(const Holder& holder) {
  const std::string who = holder.operator_name.empty() ? "another window" : printable(holder.operator_name);
  return fmt::format("{} (host {}, process {}) since {}", who, printable(holder.host), holder.process,
                     printable(holder.since));
}

/// Whether a path still leads to an open file.
bool still_there(const fs::path& path, int file) {
  struct stat open {};
  struct stat there {};
  return ::fstat(file, &open) == 0 && ::lstat(path.c_str(), &there) == 0 && open.st_ino == there.st_ino &&
         open.st_dev == there.st_dev;
}

bool lives(const Holder& holder) { return ::kill(static_cast<pid_t>(holder.process), 0) == 0 || errno == EPERM; }

/// What becomes of a lock that is there already.
struct Found {
  std::string held_by{};
  std::string notice{};
  bool gone = false;  ///< it was taken away, or is no more
};

Found look_at(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return {.gone = errno == ENOENT};
  const auto close = [&](Found found) {
    ::close(file);
    return found;
  };
  const int locked = ::flock(file, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  const std::optional<Holder> holder = holder_in(path);
  if (locked == EWOULDBLOCK) return close({.held_by = holder ? words(*holder) : "another window"});
  if (!holder) return close({});  // it is being written, or nobody knows what it is
  if (holder->host != host_name() || holder->machine != machine_id()) {
    return close({.held_by = fmt::format("{}; if that program is gone, remove {}", words(*holder), path.string())});
  }
  // A disk without locks does not tell by them.
  if (locked != 0 && lives(*holder)) return close({.held_by = words(*holder)});
  if (still_there(path, file)) ::unlink(path.c_str());
  return close(
      {.notice = fmt::format("the lock of {} was left by a program that has ended", words(*holder)), .gone = true});
}

}  // namespace

NamedLock::~NamedLock() { let_go(); }

void NamedLock::let_go() {
  if (file_ < 0) return;
  if (still_there(path_, file_)) ::unlink(path_.c_str());
  ::close(file_);
  file_ = -1;
}

Result<NamedLock::Taken> NamedLock::take(const fs::path& file, const std::string& operator_name, TimeNs now) {
  if (auto ours = require_own_folder(file.parent_path()); !ours) return pass_on(ours);
  std::error_code there;  // what is wrong with the folder is told when the file cannot be made
  fs::create_directories(file.parent_path(), there);
  Taken taken;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const int made = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (made >= 0) {
      (void)::flock(made, LOCK_EX | LOCK_NB);  // a disk without locks has the name alone
      const std::string text = text_of({host_name(), machine_id(), ::getpid(), operator_name, iso_time(now)});
      file_ = made;
      path_ = file;
      const int error = write_all(made, text);
      if (error == 0) return taken;
      let_go();
      return refused_write("could not be written", error, file.string());
    }
    if (errno != EEXIST) return refused_write("could not be written", errno, file.string());
    Found found = look_at(file);
    if (!found.notice.empty()) taken.notice = std::move(found.notice);
    if (!found.held_by.empty()) return Taken{std::move(found.held_by), {}};
    if (!found.gone) ::usleep(20'000);
  }
  return fail(ErrorCode::io, "is a lock that names nobody; remove it if no other program is at work here",
              {file.string()});
}

}  // namespace sonar
