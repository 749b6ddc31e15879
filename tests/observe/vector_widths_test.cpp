// SPDX-License-Identifier: Apache-2.0
// Whatever vectors the processor has, the product is the same.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "observed_survey.h"
#include "pipeline/tasks/compare.h"

namespace sonar {
namespace {

using Observe = test::ObservedSurvey;

TEST_F(Observe, EveryVectorWidthGivesTheSameProduct) {
  int targets = 0;
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const ObservationProduct product = observed({}, {});
    const Comparison compared = compare_products(*product_, product);
    EXPECT_EQ(compared.difference, "") << hwy::TargetName(target);
    EXPECT_EQ(compared.tolerated, 0) << hwy::TargetName(target) << ": " << compared.first_tolerated;
    hwy::SetSupportedTargetsForTest(0);
    ++targets;
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GE(targets, 2);
}

}  // namespace
}  // namespace sonar
