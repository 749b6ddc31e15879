// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "base/test_corpus.h"
#include "session/fuzz_bodies.h"

namespace sonar {
namespace {

TEST(FuzzCorpus, Preferences) {
  const test::CorpusFolder folder("preferences");
  test::replay("preferences", [&](const std::string& text) { fuzz::preferences(text, folder.path()); });
}

TEST(FuzzCorpus, Bookmark) {
  test::replay("bookmark", [](const std::string& text) { fuzz::bookmark(text); });
}

}  // namespace
}  // namespace sonar
