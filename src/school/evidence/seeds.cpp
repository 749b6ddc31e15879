// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/seeds.h"

#include <algorithm>
#include <utility>

namespace sonar {

std::vector<Run> seed_runs(const WaterLevels& water, const Shape3& shape) {
  std::vector<Run> runs;
  for (const EchoCell& cell : water.cells) {
    const int first = std::clamp(cell.block * water.block_samples, 0, shape.samples);
    const int end = std::clamp((cell.block + 1) * water.block_samples, 0, shape.samples);
    if (end <= first) continue;
    if (!runs.empty() && runs.back().row == cell.row && runs.back().end() == first) {
      runs.back().count += end - first;
    } else {
      runs.push_back({cell.row, first, end - first});
    }
  }
  return runs;
}

double evidence_of(const PingMask& mask, const WaterLevels& water) {
  double most = 0.0;
  for (const Run& run : mask.runs) {
    const auto first = run.first_sample / water.block_samples;
    const auto last = (run.end() - 1) / water.block_samples;
    const auto key = [](const EchoCell& cell) { return std::pair(cell.row, cell.block); };
    auto at = std::ranges::lower_bound(water.cells, std::pair(run.row, first), {}, key);
    for (; at != water.cells.end() && at->row == run.row && at->block <= last; ++at) {
      most = std::max(most, static_cast<double>(at->evidence));
    }
  }
  return most;
}

}  // namespace sonar
