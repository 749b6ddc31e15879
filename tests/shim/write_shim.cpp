// SPDX-License-Identifier: Apache-2.0
// Loaded before the C library (LD_PRELOAD): a disk that is full, or breaks, at the Nth call that would change it, and a log of
// such calls. For tests.
//   SONAR_SHIM_BELOW  only files whose path begins so count
//   SONAR_SHIM_FAIL   N: the Nth such call and all later ones fail with SONAR_SHIM_ERROR (28 = no space)
//   SONAR_SHIM_LOG    a line a call: "write 17 /path", "fsync - /path", "rename /from /to"
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

template <class F>
F* next(const char* name) {
  return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

std::atomic<long> calls{0};

std::string path_of(int descriptor) {
  char link[64];
  char path[PATH_MAX];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t size = ::readlink(link, path, sizeof path);
  return size > 0 ? std::string(path, static_cast<std::size_t>(size)) : std::string();
}

std::string whole(int folder, const char* name) {
  return name[0] == '/' || folder == AT_FDCWD ? std::string(name) : path_of(folder) + "/" + name;
}

bool counts(const std::string& path) {
  const char* below = std::getenv("SONAR_SHIM_BELOW");
  return below != nullptr && path.compare(0, std::strlen(below), below) == 0;
}

void log(const std::string& line) {
  const char* to = std::getenv("SONAR_SHIM_LOG");
  if (to == nullptr) return;
  static const auto open_next = next<int(const char*, int, ...)>("open");
  static const auto write_next = next<ssize_t(int, const void*, size_t)>("write");
  static const int file = open_next(to, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  const std::string text = line + "\n";
  (void)write_next(file, text.data(), text.size());
}

/// Whether this call is to fail; errno is set.
bool refused() {
  const char* at = std::getenv("SONAR_SHIM_FAIL");
  const long call = ++calls;
  if (at == nullptr || call < std::atol(at)) return false;
  const char* error = std::getenv("SONAR_SHIM_ERROR");
  errno = error != nullptr ? std::atoi(error) : ENOSPC;
  return true;
}

bool refused_on(int descriptor, const char* what, const std::string& size) {
  const std::string path = path_of(descriptor);
  if (!counts(path)) return false;
  if (refused()) return true;
  log(std::string(what) + " " + size + " " + path);
  return false;
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, size_t size) {
  if (refused_on(file, "write", std::to_string(size))) return -1;
  return next<ssize_t(int, const void*, size_t)>("write")(file, bytes, size);
}
ssize_t writev(int file, const iovec* parts, int count) {
  if (refused_on(file, "write", "-")) return -1;
  return next<ssize_t(int, const iovec*, int)>("writev")(file, parts, count);
}
ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  if (refused_on(file, "write", std::to_string(size))) return -1;
  return next<ssize_t(int, const void*, size_t, off_t)>("pwrite")(file, bytes, size, at);
}
ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  if (refused_on(file, "write", std::to_string(size))) return -1;
  return next<ssize_t(int, const void*, size_t, off64_t)>("pwrite64")(file, bytes, size, at);
}
int ftruncate(int file, off_t size) {
  if (refused_on(file, "write", "-")) return -1;
  return next<int(int, off_t)>("ftruncate")(file, size);
}
int ftruncate64(int file, off64_t size) {
  if (refused_on(file, "write", "-")) return -1;
  return next<int(int, off64_t)>("ftruncate64")(file, size);
}
int fsync(int file) {
  if (refused_on(file, "fsync", "-")) return -1;
  return next<int(int)>("fsync")(file);
}
int fdatasync(int file) {
  if (refused_on(file, "fsync", "-")) return -1;
  return next<int(int)>("fdatasync")(file);
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  const std::string target = whole(to_folder, to);
  if (counts(target)) {
    if (refused()) return -1;
    log("rename " + whole(from_folder, from) + " " + target);
  }
  return next<int(int, const char*, int, const char*)>("renameat")(from_folder, from, to_folder, to);
}
int rename(const char* from, const char* to) { return renameat(AT_FDCWD, from, AT_FDCWD, to); }

}  // extern "C"
