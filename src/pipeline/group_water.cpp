// SPDX-License-Identifier: Apache-2.0
#include "pipeline/group_water.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "school/detect_params.h"
#include "school/evidence/null_model.h"

namespace sonar {

std::vector<std::optional<WaterLevels>> waters_of(std::span<const std::shared_ptr<StagedPing>> window,
                                                  const Sector& sector) {
  std::vector<std::optional<WaterLevels>> waters(window.size());
  std::vector<WaterPing> told;
  std::vector<std::size_t> of_told;
  for (std::size_t i = 0; i < window.size(); ++i) {
    if (!window[i]) continue;
    waters[i] = window[i]->water;
    if (waters[i]) continue;
    told.push_back({&window[i]->means, &window[i]->seabed, window[i]->background()});
    of_told.push_back(i);
  }
  std::vector<WaterLevels> levels = water_levels(told, sector, kChanceEvidence);
  for (std::size_t i = 0; i < levels.size(); ++i) waters[of_told[i]] = std::move(levels[i]);
  return waters;
}

Result<WaterLevels> GroupWater::of(std::int64_t ping_index) {
  const std::int64_t group = ping_index / kGroupPings;
  const std::int64_t first = group * kGroupPings;
  if (group != group_) {
    const std::int64_t from = std::max<std::int64_t>(0, first - kGroupSide);
    const std::int64_t to = std::min(engine_.pings(), first + kGroupPings + kGroupSide);
    std::vector<std::shared_ptr<StagedPing>> window;
    for (std::int64_t i = from; i < to; ++i) {
      auto ping = engine_.is_bad(i) ? Result<StagedPing>(fail(ErrorCode::format, "bad")) : engine_.staged(i);
      window.push_back(ping ? std::make_shared<StagedPing>(std::move(*ping)) : nullptr);
    }
    waters_ = waters_of(window, engine_.sector());
    waters_.erase(waters_.begin(), waters_.begin() + (first - from));
    group_ = group;
  }
  const auto& water = waters_[static_cast<std::size_t>(ping_index - first)];
  if (water) return *water;
  auto staged = engine_.staged(ping_index);
  if (!staged) return pass_on(staged);
  return engine_.own_water(*staged);
}

}  // namespace sonar
