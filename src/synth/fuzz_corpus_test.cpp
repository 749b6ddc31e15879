// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/test_corpus.h"
#include "synth/fuzz_bodies.h"

namespace sonar {
namespace {

TEST(FuzzCorpus, BeamTable) {
  test::replay("beam_table", [](const std::string& text) { fuzz::beam_table(text); });
}

}  // namespace
}  // namespace sonar
