// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/group_water.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "school/detect/detect_params.h"
#include "school/evidence/null_model.h"

namespace sonar {

std::vector<std::optional<WaterLevels>> waters_of(std::span<const std::shared_ptr<StagedPing>> pings, std::size_t first,
                                                  std::size_t end, const Sector& sector) {
  constexpr auto kSide = static_cast<std::size_t>(kGroupSide);
  std::vector<std::optional<WaterLevels>> waters(end - first);
  std::vector<WaterPing> told;
  std::vector<std::size_t> of_told;
  for (std::size_t i = first - std::min(first, kSide); i < std::min(pings.size(), end + kSide); ++i) {
    if (!pings[i]) continue;
    const bool asked = i >= first && i < end;
    if (pings[i]->water) {
      if (asked) waters[i - first] = pings[i]->water;
      continue;
    }
    told.push_back({&pings[i]->means, &pings[i]->seabed, pings[i]->background(), asked});
    of_told.push_back(i);
  }
  std::vector<WaterLevels> levels = water_levels(told, sector, kLeastEvidence);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (told[i].asked) waters[of_told[i] - first] = std::move(levels[i]);
  }
  return waters;
}

PingWindow group_window(std::int64_t ping_index, std::int64_t pings) {
  const std::int64_t first = ping_index / kGroupPings * kGroupPings;
  return {std::max<std::int64_t>(0, first - kGroupSide), std::min(pings, first + kGroupPings + kGroupSide) - 1};
}

Result<WaterLevels> GroupWater::of(std::int64_t ping_index) {
  const std::int64_t group = ping_index / kGroupPings;
  const std::int64_t first = group * kGroupPings;
  if (group != group_) {
    const auto [from, last] = group_window(ping_index, engine_.pings());
    std::vector<std::shared_ptr<StagedPing>> window;
    for (std::int64_t i = from; i <= last; ++i) {
      if (work_ != nullptr) work_->progress("water", i - from, last - from + 1);
      if (work_ != nullptr && work_->cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
      auto ping = engine_.is_bad(i) ? Result<StagedPing>(fail(ErrorCode::format, "bad")) : engine_.staged(i);
      window.push_back(ping ? std::make_shared<StagedPing>(std::move(*ping)) : nullptr);
    }
    const auto begin = static_cast<std::size_t>(first - from);
    const auto end = static_cast<std::size_t>(std::min(engine_.pings(), first + kGroupPings) - from);
    waters_ = waters_of(window, begin, end, engine_.sector());
    group_ = group;
  }
  const auto& water = waters_[static_cast<std::size_t>(ping_index - first)];
  if (water) return *water;
  auto staged = engine_.staged(ping_index);
  if (!staged) return pass_on(staged);
  return engine_.own_water(*staged);
}

}  // namespace sonar
