// SPDX-License-Identifier: Apache-2.0
#include "io/byte_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

namespace sonar {
namespace {

std::string system_text(int error) { return std::system_category().message(error); }

class FileSource final : public ByteSource {
 public:
  FileSource(std::string name, int descriptor) : name_(std::move(name)), descriptor_(descriptor) {}
  ~FileSource() override { ::close(descriptor_); }
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] Result<std::uint64_t> size() const override {
    struct stat info {};
    if (::fstat(descriptor_, &info) != 0) return fail(ErrorCode::io, system_text(errno), {.file = name_});
    return static_cast<std::uint64_t>(info.st_size);
  }

  [[nodiscard]] Result<std::size_t> read(std::uint64_t offset, std::span<std::byte> out) const override {
    std::size_t done = 0;
    while (done < out.size()) {
      const ssize_t n = ::pread(descriptor_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
      if (n == 0) break;
      if (n < 0) {
        if (errno == EINTR) continue;
        return fail(ErrorCode::io, system_text(errno),
                    {.file = name_, .offset = static_cast<std::int64_t>(offset + done)});
      }
      done += static_cast<std::size_t>(n);
    }
    return done;
  }

 private:
  std::string name_;
  int descriptor_;
};

class StoppableSource final : public ByteSource {
 public:
  StoppableSource(std::shared_ptr<const ByteSource> source, const Work& work)
      : source_(std::move(source)), work_(work) {}
  [[nodiscard]] const std::string& name() const override { return source_->name(); }
  [[nodiscard]] Result<std::uint64_t> size() const override { return source_->size(); }
  [[nodiscard]] Result<std::size_t> read(std::uint64_t offset, std::span<std::byte> out) const override {
    if (work_.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    return source_->read(offset, out);
  }

 private:
  std::shared_ptr<const ByteSource> source_;
  const Work& work_;
};

class GrowingFile final : public ByteSource {
 public:
  explicit GrowingFile(const std::filesystem::path& path) : path_(path), name_(path.string()) {}
  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] Result<std::uint64_t> size() const override {
    const auto file = open_file(path_);
    if (!file) return pass_on(file);
    auto size = (*file)->size();
    if (!size) return size;
    const auto another = [&](const char* why) { return fail(ErrorCode::mismatch, why, {.file = name_}); };
    if (*size < seen_) return another("is shorter than it was: another file");
    if (*size == seen_) return size;
    if (auto same = begins_as_before(**file); !same)
      return pass_on(same);
    else if (!*same)
      return another("begins otherwise than it did: another file");
    seen_ = *size;
    return size;
  }

  [[nodiscard]] Result<std::size_t> read(std::uint64_t offset, std::span<std::byte> out) const override {
    const auto file = open_file(path_);
    return file ? (*file)->read(offset, out) : Result<std::size_t>(pass_on(file));
  }

 private:
  /// By its first bytes, which in a recording tell when it was begun.
  Result<bool> begins_as_before(const ByteSource& file) const {
    std::array<std::byte, 4096> head{};
    const auto got = file.read(0, head);
    if (!got) return pass_on(got);
    const auto now = std::span<const std::byte>(head).first(*got);
    const std::scoped_lock lock(mutex_);
    const bool same = now.size() >= head_.size() && std::equal(head_.begin(), head_.end(), now.begin());
    if (same) head_.assign(now.begin(), now.end());
    return same;
  }

  std::filesystem::path path_;
  std::string name_;
  mutable std::atomic<std::uint64_t> seen_{0};
  mutable std::mutex mutex_;
  mutable std::vector<std::byte> head_;
};

}  // namespace

std::shared_ptr<const ByteSource> growing_file(const std::filesystem::path& path) {
  return std::make_shared<const GrowingFile>(path);
}

std::shared_ptr<const ByteSource> stoppable(std::shared_ptr<const ByteSource> source, const Work& work) {
  return std::make_shared<const StoppableSource>(std::move(source), work);
}

Result<std::shared_ptr<const ByteSource>> open_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe is refused, not waited for
  if (descriptor < 0) {
    const int error = errno;
    return fail(error == ENOENT ? ErrorCode::not_found : ErrorCode::io, system_text(error), {.file = path.string()});
  }
  auto source = std::make_shared<const FileSource>(path.string(), descriptor);
  struct stat info {};
  if (::fstat(descriptor, &info) == 0 && S_ISDIR(info.st_mode)) {
    return fail(ErrorCode::io, "is a folder, not a file", {.file = path.string()});
  }
  if (!S_ISREG(info.st_mode))
    return fail(ErrorCode::io, "is not a file that can be read from any place", {.file = path.string()});
  return std::shared_ptr<const ByteSource>(std::move(source));
}

MemorySource::MemorySource(std::string name, std::span<const std::byte> bytes)
    : name_(std::move(name)), bytes_(bytes.begin(), bytes.end()) {}

void MemorySource::append(std::span<const std::byte> bytes) {
  const std::scoped_lock lock(mutex_);
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

Result<std::uint64_t> MemorySource::size() const {
  const std::scoped_lock lock(mutex_);
  return static_cast<std::uint64_t>(bytes_.size());
}

Result<std::size_t> MemorySource::read(std::uint64_t offset, std::span<std::byte> out) const {
  const std::scoped_lock lock(mutex_);
  if (offset >= bytes_.size()) return std::size_t{0};
  const auto first = static_cast<std::size_t>(offset);
  const std::size_t count = std::min(out.size(), bytes_.size() - first);
  std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(first), count, out.begin());
  return count;
}

}  // namespace sonar
