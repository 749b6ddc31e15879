// SPDX-License-Identifier: Apache-2.0
#include "io/index_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cstring>
#include <string>
#include <system_error>

#include "base/hash.h"
#include "io/atomic_file.h"
#include "io/ping_source.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

struct FileState {
  std::string absolute;
  std::uint64_t size = 0;
  std::int64_t changed_ns = 0;

  [[nodiscard]] std::string key() const {
    return to_hex(hash_text(fmt::format("{}\n{}\n{}", absolute, size, changed_ns)));
  }
};

std::optional<FileState> state_of(const fs::path& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return std::nullopt;
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  if (error) return std::nullopt;
  return FileState{absolute.lexically_normal().string(), static_cast<std::uint64_t>(info.st_size),
                   static_cast<std::int64_t>(info.st_mtim.tv_sec) * 1'000'000'000 + info.st_mtim.tv_nsec};
}

fs::path entry_path(const IndexCache& cache, const FileState& state) {
  return cache.folder / (to_hex(hash_text(state.absolute)) + ".index");
}

std::optional<RawIndex> load(const IndexCache& cache, const FileState& state) {
  const auto source = open_file(entry_path(cache, state));
  if (!source) return std::nullopt;
  const auto size = (*source)->size();
  const std::string key = state.key();
  if (!size || *size < key.size() || *size > (std::uint64_t{4} << 30)) return std::nullopt;
  std::vector<std::byte> bytes(static_cast<std::size_t>(*size));
  const auto got = (*source)->read(0, bytes);
  if (!got || *got != bytes.size() || std::memcmp(bytes.data(), key.data(), key.size()) != 0) return std::nullopt;
  auto index = decode_index(std::span<const std::byte>(bytes).subspan(key.size()));
  if (index && index->size != state.size) return std::nullopt;
  return index;
}

/// Failure is no error: the next opening only takes longer.
void store(const IndexCache& cache, const FileState& state, const RawIndex& index) {
  const std::vector<std::byte> bytes = encode_index(index);
  auto file = AtomicFile::create(entry_path(cache, state), Beside::users_cache);
  if (!file || !file->write(state.key())) return;
  if (file->write({reinterpret_cast<const char*>(bytes.data()), bytes.size()})) (void)file->commit();
}

}  // namespace

void keep_index(const fs::path& path, const IndexCache& cache, const RawIndex& index) {
  const auto state = cache.folder.empty() ? std::nullopt : state_of(path);
  if (state && state->size == index.size) store(cache, *state, index);
}

Result<RawIndex> open_index(const fs::path& path, const IndexCache& cache, const Work& work) {
  const auto state = cache.folder.empty() ? std::nullopt : state_of(path);
  if (state) {
    if (auto index = load(cache, *state)) {
      index->name = path.string();
      for (Diagnostic& note : index->diagnostics) note.file = index->name;
      return std::move(*index);
    }
  }
  const auto source = open_file(path);
  if (!source) return pass_on(source);
  auto index = index_raw(*stoppable(*source, work));
  if (index && state) {
    const auto after = state_of(path);
    if (after && after->key() == state->key()) store(cache, *state, *index);
  }
  return index;
}

}  // namespace sonar
