// SPDX-License-Identifier: Apache-2.0
#include "io/raw_file_writer.h"

#include <string_view>
#include <utility>

namespace sonar {

Result<RawFileWriter> RawFileWriter::create(const std::filesystem::path& path) {
  auto file = AtomicFile::create(path, Beside::recordings);
  if (!file) return pass_on(file);
  return RawFileWriter(std::move(*file));
}

Result<void> RawFileWriter::write(std::span<const std::byte> datagrams) {
  auto written = file_.write({reinterpret_cast<const char*>(datagrams.data()), datagrams.size()});
  if (!written) {
    written.error().where.offset = static_cast<std::int64_t>(size_);
    return written;
  }
  size_ += datagrams.size();
  return {};
}

}  // namespace sonar
