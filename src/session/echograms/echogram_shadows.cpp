// SPDX-License-Identifier: Apache-2.0
#include "session/echograms/echogram_shadows.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "pipeline/stages/voxel_statistics.h"

namespace sonar {
namespace {

constexpr int kBetween = 8;  ///< pings from one picture to the next

using SchoolsByPing = std::map<std::int64_t, std::vector<const PingMask*>>;

/// Of the pings whose schools lie in beams that the echogram shows: no other beam is in their shadow.
SchoolsByPing schools_by_ping(const ShadowWish& wish) {
  const auto casts = [&](const SchoolMask& mask) {
    const auto school = std::ranges::find(wish.product->schools, mask.school_id, &SchoolRow::school_id);
    return school == wish.product->schools.end() || school->status != "rejected";
  };
  const int beams = wish.open->sector().beams();
  const auto shown = [&](const Run& run) {
    return (!wish.of.fan || run.row / beams == *wish.of.fan) && (!wish.of.beam || run.row % beams == *wish.of.beam);
  };
  SchoolsByPing out;
  for (const SchoolMask& mask : wish.product->masks) {
    if (mask.ping_index < wish.open->pings() && std::ranges::any_of(mask.mask.runs, shown) && casts(mask)) {
      out[mask.ping_index].push_back(&mask.mask);
    }
  }
  return out;
}

Hash128 hash_of(const std::vector<const PingMask*>& schools) {
  Hasher hasher;
  for (const PingMask* mask : schools) hasher.add(std::as_bytes(std::span(mask->runs)));
  return hasher.value();
}

std::vector<EchogramStretch> shadow_in(const ShadowWish& wish, std::int64_t ping,
                                       const std::vector<const PingMask*>& schools) {
  const auto staged = wish.open->ping(ping);
  if (!staged) return {};
  const Sector& sector = wish.open->sector();
  return echogram_shadow(shadow_of(**staged, sector, schools, wish.open->recipe().measure.extinction),
                         echogram_rows(sector, wish.open->placement(ping), wish.of), wish.range, sector.range().count,
                         wish.least_db, static_cast<std::size_t>(ping));
}

}  // namespace

void EchogramShadows::turn_to(const ShadowWish& wish) {
  const bool same =
      of_.open.lock() == wish.open && of_.of == wish.of && of_.range == wish.range && of_.least_db == wish.least_db;
  if (same) return;
  of_ = {wish.open, wish.of, wish.range, wish.least_db};
  pings_.clear();
}

const EchogramShadows::Kept* EchogramShadows::kept(std::int64_t ping, const Hash128& schools) const {
  const auto found = pings_.find(ping);
  return found != pings_.end() && found->second.schools == schools ? &found->second : nullptr;
}

std::vector<EchogramStretch> EchogramShadows::so_far(const ShadowWish& wish) {
  const std::lock_guard lock(mutex_);
  turn_to(wish);
  std::vector<EchogramStretch> out;
  for (const auto& [ping, schools] : schools_by_ping(wish)) {
    if (const Kept* one = kept(ping, hash_of(schools))) out.insert(out.end(), one->shadow.begin(), one->shadow.end());
  }
  return out;
}

void EchogramShadows::work_out(const ShadowWish& wish, const CancelToken& token,
                               const std::function<void()>& before_each, const std::function<void()>& more) {
  int fresh = 0;
  for (const auto& [ping, schools] : schools_by_ping(wish)) {
    if (token.cancelled()) return;
    const Hash128 hash = hash_of(schools);
    {
      const std::lock_guard lock(mutex_);
      turn_to(wish);
      if (kept(ping, hash) != nullptr) continue;
    }
    before_each();
    Kept made{hash, shadow_in(wish, ping, schools)};
    {
      const std::lock_guard lock(mutex_);
      turn_to(wish);
      pings_[ping] = std::move(made);
    }
    if (++fresh % kBetween == 0) more();
  }
  if (fresh % kBetween != 0) more();
}

}  // namespace sonar
