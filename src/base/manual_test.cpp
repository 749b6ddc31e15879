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

TEST(Manual, TheGuideIsHtmlWhereThatWasInstalled) {
  const fs::path html = "usr/share/doc/sonarx/html/guide.html";
  const fs::path page = "usr/share/doc/sonarx/guide.md";
  const fs::path whole = tree_with({html, page});
  EXPECT_EQ(guide_place(whole / "usr/bin/sonar-explorer"), whole / html);
  const fs::path plain = tree_with({page});
  EXPECT_EQ(guide_place(plain / "usr/bin/sonar-explorer"), plain / page);
}

TEST(Manual, TheGuideOfATreeIsItsPageAndElsewhereThereIsNone) {
  const fs::path root = tree_with({"docs/guide.md", "src/base/manual.h"});
  EXPECT_EQ(guide_place(root / "build/dev/src/gui/sonar-explorer"), root / "docs/guide.md");
  EXPECT_EQ(guide_place(tree_with({"docs/guide.md"}) / "bin/sonar-explorer"), "") << "another program's";
  EXPECT_EQ(guide_place(""), "");
}

TEST(Manual, TheTutorialLiesBesideTheGuide) {
  const fs::path whole = tree_with({"usr/share/doc/sonarx/html/tutorial.html", "usr/share/doc/sonarx/tutorial.md"});
  EXPECT_EQ(tutorial_place(whole / "usr/bin/sonar-explorer"), whole / "usr/share/doc/sonarx/html/tutorial.html");
  const fs::path root = tree_with({"docs/tutorial.md", "src/base/manual.h"});
  EXPECT_EQ(tutorial_place(root / "build/dev/src/gui/sonar-explorer"), root / "docs/tutorial.md");
}

TEST(Manual, WhatIsNewLiesBesideTheGuideAndAboveItInATree) {
  const fs::path whole = tree_with({"usr/share/doc/sonarx/html/CHANGELOG.html", "usr/share/doc/sonarx/CHANGELOG.md"});
  EXPECT_EQ(changes_place(whole / "usr/bin/sonar-explorer"), whole / "usr/share/doc/sonarx/html/CHANGELOG.html");
  const fs::path root = tree_with({"CHANGELOG.md", "src/base/manual.h"});
  EXPECT_EQ(changes_place(root / "build/dev/src/gui/sonar-explorer"), root / "CHANGELOG.md");
  EXPECT_EQ(changes_place(tree_with({"CHANGELOG.md"}) / "bin/sonar-explorer"), "") << "another program's";
}

}  // namespace
}  // namespace sonar
