// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <span>
#include <string>

#include "base/test_corpus.h"
#include "publish/fuzz_bodies.h"

namespace sonar {
namespace {

TEST(FuzzCorpus, KeptEchogram) {
  const test::CorpusFolder folder("echogram");
  test::replay("kept_echogram", [&](const std::string& bytes) {
    fuzz::kept_echogram_file(std::as_bytes(std::span(bytes)), folder.path());
  });
}

}  // namespace
}  // namespace sonar
