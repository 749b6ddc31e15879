// SPDX-License-Identifier: Apache-2.0
#include "cli/file_to_write.h"

#include "render/draw_frame.h"

namespace sonar {

Result<void> require_place(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code absent;
  if (fs::is_directory(file, absent)) return fail(ErrorCode::usage, "is a folder; a file is meant", {file.string()});
  const fs::path folder = file.parent_path();
  if (folder.empty() || fs::is_directory(folder, absent)) return {};
  return fail(ErrorCode::not_found, "no such folder to write to", {folder.string()});
}

Result<void> require_picture_place(const std::filesystem::path& file) {
  if (file.empty()) return {};
  if (!is_picture_file(file)) {
    return fail(ErrorCode::usage, "expected a name that ends in .png, .svg or .pdf", {file.string()});
  }
  return require_place(file);
}

}  // namespace sonar
