// SPDX-License-Identifier: Apache-2.0
#include "base/manual.h"

#include <initializer_list>
#include <system_error>

namespace sonar {
namespace {

namespace fs = std::filesystem;

fs::path this_program() {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/exe", unknown);
}

bool is_there(const fs::path& file) {
  std::error_code absent;
  return fs::is_regular_file(file, absent);
}

/// A page that was installed with a program, or lies in the tree that it was built in; empty where it is neither.
/// installed  its names below the folder of pages, the best first
/// in_tree    its place in the tree
fs::path page_of(const fs::path& program, std::initializer_list<const char*> installed, const char* in_tree) {
  // Above bin/ where it is installed, above build/ where it is not: no path of the machine it was built on is needed.
  for (fs::path folder = program; folder != folder.parent_path();) {
    folder = folder.parent_path();
    for (const char* name : installed) {
      if (fs::path page = folder / SONAR_DOCDIR / name; is_there(page)) return page;
    }
    fs::path page = folder / in_tree;
    if (is_there(page) && is_there(folder / "src" / "base" / "manual.h")) return page;  // not another's pages
  }
  return {};
}

}  // namespace

std::string manual_place() { return manual_place(this_program()); }

std::string manual_place(const fs::path& program) {
  const fs::path page = page_of(program, {"user-guide.md"}, "docs/user-guide.md");
  return page.empty() ? "docs/user-guide.md" : page.string();
}

fs::path guide_place() { return guide_place(this_program()); }

fs::path guide_place(const fs::path& program) {
  return page_of(program, {"html/guide.html", "guide.md"}, "docs/guide.md");
}

fs::path tutorial_place() { return tutorial_place(this_program()); }

fs::path tutorial_place(const fs::path& program) {
  return page_of(program, {"html/tutorial.html", "tutorial.md"}, "docs/tutorial.md");
}

fs::path changes_place() { return changes_place(this_program()); }

fs::path changes_place(const fs::path& program) {
  return page_of(program, {"html/CHANGELOG.html", "CHANGELOG.md"}, "CHANGELOG.md");
}

}  // namespace sonar
