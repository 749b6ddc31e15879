// SPDX-License-Identifier: Apache-2.0
#include "cli/file_to_write.h"

namespace sonar {

Result<void> require_place(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code absent;
  if (fs::is_directory(file, absent)) return fail(ErrorCode::usage, "is a folder; a file is meant", {file.string()});
  const fs::path folder = file.parent_path();
  if (folder.empty() || fs::is_directory(folder, absent)) return {};
  return fail(ErrorCode::not_found, "no such folder to write to", {folder.string()});
}

}  // namespace sonar
