// SPDX-License-Identifier: Apache-2.0
#include "base/manual.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "base/test_paths.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// A tree of its own that holds these files alone.
fs::path tree_with(const std::vector<fs::path>& files) {
  fs::path root = test::scratch_path("manual");
  fs::remove_all(root);
  for (const fs::path& file : files) {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << "\n";
  }
  return root;
}

TEST(Manual, LiesWhereItWasInstalledWithTheProgram) {
  const fs::path root = tree_with({"usr/share/doc/sonarx/user-guide.md"});
  EXPECT_EQ(manual_place(root / "usr/bin/sonarx"), root / "usr/share/doc/sonarx/user-guide.md");
}

TEST(Manual, LiesInTheTreeThatTheProgramWasBuiltIn) {
  const fs::path root = tree_with({"docs/user-guide.md", "src/base/manual.h"});
  EXPECT_EQ(manual_place(root / "build/dev/src/cli/sonarx"), root / "docs/user-guide.md");
}

TEST(Manual, OfWhichNothingIsKnownNamesNoFolderOfAMachine) {
  EXPECT_EQ(manual_place(tree_with({}) / "bin/sonarx"), "docs/user-guide.md");
  EXPECT_EQ(manual_place(tree_with({"docs/user-guide.md"}) / "bin/sonarx"), "docs/user-guide.md")
      << "another program's";
  EXPECT_EQ(manual_place(""), "docs/user-guide.md");
}

}  // namespace
}  // namespace sonar
