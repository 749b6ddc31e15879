// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/named_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
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

std::optional<Holder> holder_in(int file) {
  std::string text(4096, '\0');
  const ssize_t got = ::pread(file, text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  const auto json = nlohmann::json::parse(text, nullptr, false);
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

/// A lock that is there already.
struct Found {
  enum class State { gone, unnamed, held, left } state = State::gone;
  std::string words = "another window";
};

/// An open lock file; whoever looks at it in earnest takes it along, when it was left behind.
Found look_at(const fs::path& path, int file, bool take_away) {
  const int locked = ::flock(file, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  const std::optional<Holder> holder = holder_in(file);
  if (!holder) return {locked == EWOULDBLOCK ? Found::State::held : Found::State::unnamed};
  if (locked == EWOULDBLOCK) return {Found::State::held, words(*holder)};
  if (holder->host != host_name() || holder->machine != machine_id()) {
    return {Found::State::held, fmt::format("{}; if that program is gone, remove {}", words(*holder), path.string())};
  }
  // A disk without locks does not tell by them.
  if (locked != 0 && lives(*holder)) return {Found::State::held, words(*holder)};
  if (!still_there(path, file)) return {Found::State::gone};  // let go of while it was opened here
  const bool stays = take_away && ::unlink(path.c_str()) != 0;
  if (!stays) return {Found::State::left, words(*holder)};
  return {Found::State::held, fmt::format("{}, which has ended; remove {}", words(*holder), path.string())};
}

Found look_at(const fs::path& path, bool take_away) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return {errno == ENOENT ? Found::State::gone : Found::State::unnamed};
  Found found = look_at(path, file, take_away);
  ::close(file);
  return found;
}

/// In a folder that several share the locks may be taken away by each of them.
void make_folder(const fs::path& folder) {
  std::error_code ignored;  // what is wrong with it is told when the file cannot be made
  if (!fs::create_directories(folder, ignored)) return;
  fs::permissions(folder, fs::status(folder.parent_path(), ignored).permissions(), ignored);
}

}  // namespace

NamedLock::~NamedLock() { let_go(); }

void NamedLock::let_go() {
  if (file_ < 0) return;
  if (still_there(path_, file_)) ::unlink(path_.c_str());
  ::close(file_);
  file_ = -1;
}

std::string NamedLock::holder(const fs::path& file) {
  const Found found = look_at(file, false);
  return found.state == Found::State::held ? found.words : std::string{};
}

Result<NamedLock::Taken> NamedLock::take(const fs::path& file, const std::string& operator_name, TimeNs now) {
  if (auto ours = require_own_folder(file.parent_path()); !ours) return pass_on(ours);
  make_folder(file.parent_path());
  Taken taken;
  Found found;
  bool names_nobody = true;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const int made = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (made >= 0) {
      (void)::flock(made, LOCK_EX);  // who looks at it holds it for a moment; a disk without locks has the name alone
      const std::string text = text_of({host_name(), machine_id(), ::getpid(), operator_name, iso_time(now)});
      file_ = made;
      path_ = file;
      const int error = write_all(made, text);
      if (error == 0) return taken;
      let_go();
      return refused_write("could not be written", error, file.string());
    }
    if (errno != EEXIST) return refused_write("could not be written", errno, file.string());
    found = look_at(file, true);
    names_nobody = names_nobody && found.state == Found::State::unnamed;
    if (found.state == Found::State::left) {
      taken.notice = fmt::format("the lock of {} was left by a program that has ended", found.words);
    } else if (found.state != Found::State::gone) {
      ::usleep(10'000);  // somebody may be about to take it, or only looking
    }
  }
  if (!names_nobody) return Taken{std::move(found.words), {}};
  return fail(ErrorCode::io, "is a lock that names nobody; remove it if no other program is at work here",
              {file.string()});
}

}  // namespace sonar
