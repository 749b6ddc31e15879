// SPDX-License-Identifier: Apache-2.0
#include "session/maps/masked_pings.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace sonar {
namespace {

/// Masks that are shared between states are the same without a look at them.
bool same(const std::vector<MosaicMask>& a, const std::vector<MosaicMask>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const MosaicMask& x, const MosaicMask& y) {
    return x.school == y.school && (x.mask == y.mask || *x.mask == *y.mask);
  });
}

}  // namespace

void keep_running(RunningMasks& kept, const std::map<std::int64_t, PingMask>& running) {
  std::erase_if(kept, [&](const auto& one) { return !running.contains(one.first); });
  for (const auto& [ping, mask] : running) {
    auto& there = kept[ping];
    if (!there || there->voxels() != mask.voxels()) there = std::make_shared<const PingMask>(mask);
  }
}

MaskedPings masked_pings(JournalStatePtr state, RunningMasks running, bool rejected,
                         std::optional<std::int64_t> carried) {
  MaskedPings out;
  out.state = std::move(state);
  out.running = std::move(running);
  if (out.state) {
    for (const auto& school : out.state->schools) {
      if (!rejected && school->masks.decided.status == "rejected") continue;
      for (const auto& there : school->masks.pings) {
        if (there.mask.empty()) continue;
        if (carried == school->number && out.running.contains(there.ping_index)) continue;  // it is being replaced
        out.pings[there.ping_index].push_back({static_cast<int>(school->number), &there.mask});
      }
    }
  }
  const int next = static_cast<int>(carried.value_or(out.state ? out.state->next_number : 1));
  for (const auto& [ping, mask] : out.running) {
    if (!mask->empty()) out.pings[ping].push_back({next, mask.get()});
  }
  return out;
}

std::vector<bool> rejected_schools(const JournalState& state) {
  std::vector<bool> rejected(MaskMosaic::kSchools, false);
  for (const auto& school : state.schools) {
    rejected[static_cast<std::size_t>(school->number) % rejected.size()] = school->masks.decided.status == "rejected";
  }
  return rejected;
}

void MosaicFollower::start(MaskMosaic mosaic) {
  mosaic_ = std::make_unique<MaskMosaic>(std::move(mosaic));
  shown_ = {};
}

std::size_t MosaicFollower::follow(const Sector& sector, const std::vector<PingNavigation>& navigation,
                                   MaskedPings masks) {
  std::size_t set = 0;
  const auto show = [&](std::int64_t ping, const std::vector<MosaicMask>& now) {
    if (ping < 0 || ping >= static_cast<std::int64_t>(navigation.size())) return;
    const auto i = static_cast<std::size_t>(ping);
    mosaic_->set(i, sector, navigation[i], now);
    ++set;
  };
  for (const auto& [ping, before] : shown_.pings) {
    if (!masks.pings.contains(ping)) show(ping, {});
  }
  for (const auto& [ping, now] : masks.pings) {
    const auto before = shown_.pings.find(ping);
    if (before == shown_.pings.end() || !same(before->second, now)) show(ping, now);
  }
  shown_ = std::move(masks);
  return set;
}

}  // namespace sonar
