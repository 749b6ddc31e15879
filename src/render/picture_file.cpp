// SPDX-License-Identifier: Apache-2.0
#include "render/picture_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace sonar {

Result<void> write_picture_file(const std::string& bytes, const std::filesystem::path& file) {
  std::filesystem::path part = file;
  part += ".part";
  std::error_code code;
  {
    errno = 0;
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
      const int error = errno;  // of the call below the stream, where there was one
      std::filesystem::remove(part, code);
      const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
      const std::string why = error == 0 ? std::string{} : std::string(": ") + std::generic_category().message(error);
      return fail(full ? ErrorCode::no_space : ErrorCode::io, "the picture cannot be written there" + why,
                  {file.string()});
    }
  }
  std::filesystem::rename(part, file, code);
  if (!code) return {};
  const std::string reason = code.message();
  std::filesystem::remove(part, code);
  return fail(ErrorCode::io, fmt::format("the picture cannot be put in its place: {}", reason), {file.string()});
}

}  // namespace sonar
