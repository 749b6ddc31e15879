// SPDX-License-Identifier: Apache-2.0
#include "signal/merge_network.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sonar {
namespace {

template <class Program>
std::vector<int> run(const std::vector<int>& inputs) {
  std::vector<int> values(kSize<Program>.values);
  std::vector<int> outputs(Program::kOutputs, -1);
  for (const MergeStep& step : kSteps<Program>) {
    switch (step.kind) {
      case MergeStep::Kind::load:
        values[step.value] = inputs[step.a];
        break;
      case MergeStep::Kind::minimum:
        values[step.value] = std::min(values[step.a], values[step.b]);
        break;
      case MergeStep::Kind::maximum:
        values[step.value] = std::max(values[step.a], values[step.b]);
        break;
      case MergeStep::Kind::store:
        outputs[step.b] = values[step.a];
        break;
    }
  }
  return outputs;
}

/// A network of minima and maxima is right for all inputs if it is for all zeros and ones; sorted lists of zeros and
/// ones are (m + 1)(n + 1).
template <int M, int N, int First, int Count>
void prove_merge() {
  for (int a = 0; a <= M; ++a) {
    for (int b = 0; b <= N; ++b) {
      std::vector<int> inputs(M + N, 0);
      std::fill(inputs.begin() + a, inputs.begin() + M, 1);
      std::fill(inputs.begin() + M + b, inputs.end(), 1);
      const auto outputs = run<MergeOf<M, N, First, Count>>(inputs);
      for (int i = 0; i < Count; ++i) {
        ASSERT_EQ(outputs[static_cast<std::size_t>(i)], First + i >= a + b ? 1 : 0) << M << '+' << N;
      }
    }
  }
}

TEST(merge_network, every_merge_by_all_zeros_and_ones) {
  prove_merge<1, 1, 0, 2>();
  prove_merge<3, 5, 0, 8>();
  prove_merge<5, 2, 1, 3>();
  prove_merge<9, 9, 0, 18>();
  prove_merge<18, 18, 0, 36>();
  prove_merge<36, 36, 0, 72>();
  prove_merge<72, 72, 40, 64>();
  prove_merge<64, 36, 36, 28>();
  prove_merge<28, 18, 18, 10>();
}

TEST(merge_network, sorting_nine_by_all_zeros_and_ones) {
  for (unsigned bits = 0; bits < 512; ++bits) {
    std::vector<int> inputs;
    for (unsigned i = 0; i < 9; ++i) inputs.push_back(static_cast<int>(bits >> i & 1U));
    auto sorted = inputs;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(run<SortOfNine>(inputs), sorted);
  }
}

TEST(merge_network, middle_of_ten_and_nine_by_all_zeros_and_ones) {
  for (int a = 0; a <= 10; ++a) {
    for (int b = 0; b <= 9; ++b) {
      std::vector<int> inputs(19, 0);
      std::fill(inputs.begin() + a, inputs.begin() + 10, 1);
      std::fill(inputs.begin() + 10 + b, inputs.end(), 1);
      const auto middle = run<MiddleOf<10, 9>>(inputs);
      ASSERT_EQ(middle[0], a + b >= 10 ? 0 : 1);
    }
  }
}

// Knuth, The Art of Computer Programming 3, 5.3.4: 30 comparators merge 9 with 9, each a minimum and a maximum.
TEST(merge_network, costs_what_the_book_says) {
  const auto work = [](const auto& steps) {
    return std::count_if(steps.begin(), steps.end(), [](const MergeStep& step) {
      return step.kind == MergeStep::Kind::minimum || step.kind == MergeStep::Kind::maximum;
    });
  };
  EXPECT_EQ(work(kSteps<MergeOf<9, 9>>), 60);
  EXPECT_EQ(work(kSteps<MergeOf<1, 1, 0, 1>>), 1);
  EXPECT_LT(work(kSteps<MergeOf<72, 72, 40, 64>>), work(kSteps<MergeOf<72, 72>>));
}

}  // namespace
}  // namespace sonar
