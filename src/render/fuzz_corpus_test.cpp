// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <span>
#include <string>

#include "base/test_corpus.h"
#include "render/fuzz_bodies.h"

namespace sonar {
namespace {

TEST(FuzzCorpus, Png) {
  const test::CorpusFolder folder("png");
  test::replay("png", [&](const std::string& bytes) { fuzz::png(std::as_bytes(std::span(bytes)), folder.path()); });
}

}  // namespace
}  // namespace sonar
