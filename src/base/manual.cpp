// SPDX-License-Identifier: Apache-2.0
#include "base/manual.h"

#include <system_error>

namespace sonar {

namespace fs = std::filesystem;

std::string manual_place() {
  std::error_code unknown;
  return manual_place(fs::read_symlink("/proc/self/exe", unknown));
}

std::string manual_place(const fs::path& program) {
  const auto is_there = [](const fs::path& file) {
    std::error_code absent;
    return fs::is_regular_file(file, absent);
  };
  // Above bin/ where it is installed, above build/ where it is not: no path of the machine it was built on is needed.
  for (fs::path folder = program; folder != folder.parent_path();) {
    folder = folder.parent_path();
    const fs::path installed = folder / SONAR_DOCDIR / "user-guide.md";
    if (is_there(installed)) return installed.string();
    const fs::path guide = folder / "docs" / "user-guide.md";
    if (is_there(guide) && is_there(folder / "src" / "base" / "manual.h"))
      return guide.string();  // not another's pages
  }
  return "docs/user-guide.md";
}

}  // namespace sonar
