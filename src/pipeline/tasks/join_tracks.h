// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "model/product.h"
#include "pipeline/tasks/merge_params.h"

// Schools that something other than their end parts are joined by `continues`: what ends there and what begins after it, where
// the one would be by then. Nearest pairs first, each school once; a school of several rows is joined as a whole.
namespace sonar {

/// Over cuts between observations that observation_max_s, or sound speed alone, made.
/// products  of one survey, in any order
/// params    empty = those of the products' recipe, the defaults where it tells none
void join_over_cuts(std::span<ObservationProduct> products, const std::optional<MergeParams>& params = {});

/// Where a propagation by hand had its reach. Ends at which nothing goes on are noted (`ended-at-reach`).
void join_at_reach(ObservationProduct& product, const MergeParams& params);

}  // namespace sonar
