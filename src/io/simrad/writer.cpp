// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace sonar {
namespace {

tl::unexpected<Error> system_failure(const std::filesystem::path& path, const char* what, std::uint64_t offset) {
  const int reason = errno;
  return fail(reason == ENOSPC ? ErrorCode::no_space : ErrorCode::io,
              fmt::format("cannot {}: {}", what, std::generic_category().message(reason)),
              {.file = path.string(), .offset = static_cast<std::int64_t>(offset)});
}

Result<void> flush_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return system_failure(folder, "open the folder", 0);
  const bool flushed = ::fsync(descriptor) == 0 || errno == EINVAL;  // some file systems cannot flush folders
  const auto failure = system_failure(folder, "flush the folder", 0);
  ::close(descriptor);
  if (!flushed) return failure;
  return {};
}

}  // namespace

Result<RawFileWriter> RawFileWriter::create(std::filesystem::path path) {
  std::filesystem::path temporary = path;
  temporary += fmt::format(".{}.tmp", ::getpid());
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return system_failure(path, "make the file", 0);
  return RawFileWriter(std::move(path), std::move(temporary), descriptor);
}

RawFileWriter::RawFileWriter(std::filesystem::path path, std::filesystem::path temporary, int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor) {}

RawFileWriter::RawFileWriter(RawFileWriter&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

RawFileWriter& RawFileWriter::operator=(RawFileWriter&& other) noexcept {
  if (this == &other) return *this;
  abandon();
  path_ = std::move(other.path_);
  temporary_ = std::move(other.temporary_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  size_ = other.size_;
  return *this;
}

RawFileWriter::~RawFileWriter() { abandon(); }

void RawFileWriter::abandon() {
  if (descriptor_ < 0) return;
  ::close(std::exchange(descriptor_, -1));
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

tl::unexpected<Error> RawFileWriter::failed(const char* what) const { return system_failure(path_, what, size_); }

Result<void> RawFileWriter::write(std::span<const std::byte> datagrams) {
  while (!datagrams.empty()) {
    const ssize_t written = ::write(descriptor_, datagrams.data(), datagrams.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return failed("write");
    size_ += static_cast<std::uint64_t>(written);
    datagrams = datagrams.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

Result<void> RawFileWriter::finish() {
  if (::fsync(descriptor_) != 0) return failed("flush");
  if (::close(std::exchange(descriptor_, -1)) != 0) return failed("close");
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) return failed("rename");
  const std::filesystem::path folder = path_.parent_path();
  return flush_folder(folder.empty() ? std::filesystem::path(".") : folder);
}

}  // namespace sonar
