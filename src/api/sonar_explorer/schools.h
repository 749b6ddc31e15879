// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sonar_explorer/product.h"
#include "sonar_explorer/survey.h"

namespace sonar_explorer {

/// A voxel inside a school, all from 0.
struct Seed {
  int fan = 0;
  int beam = 0;
  int sample = 0;
};

/// How a selection grows; what is empty is the recipe's.
struct GrowOptions {
  std::optional<double> tolerance_db;  ///< mode tracked: members lie at most this much below the reference level, dB
  std::optional<double> tolerance_opacity;  ///< mode paper: members differ at most this much in opacity, 0 to 1
  std::optional<std::string> mode;          ///< "tracked" or "paper"
};

/// Schools of an observation, detected, tracked and measured: what `sonarx run` makes of it.
/// throws   Error: io; usage: the beams make no grid
[[nodiscard]] Product detect(const Observation& observation);

/// One school in one ping: what a click selects.
/// seeds    in the ping; what they grow is joined
/// throws   Error: usage: no such ping, or the beams make no grid; bad_parameter: no such voxel, or nothing grows there; io
[[nodiscard]] Product grow(const Observation& observation, std::int64_t ping, const std::vector<Seed>& seeds,
                           const GrowOptions& options = {});

/// One school, grown in one ping as by grow() and followed through the pings before and after.
/// reach    pings to each side; negative = as far as it goes
/// throws   as grow()
[[nodiscard]] Product propagate(const Observation& observation, std::int64_t ping, const std::vector<Seed>& seeds,
                                std::int64_t reach = -1, const GrowOptions& options = {});

/// All figures of a product's masks worked out anew, under the recipe that the survey was opened with.
/// throws   Error: mismatch: the product is of other pings; io
[[nodiscard]] Product measure(const Observation& observation, const Product& product);

}  // namespace sonar_explorer
