// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/continued.h"

#include <algorithm>
#include <cstddef>

#include "model/school_totals.h"

namespace sonar {
namespace {

using InPing = SchoolMasks::InPing;

/// Of all schools but the detected one itself, those that begin first ahead.
std::vector<std::size_t> made_of(std::size_t detected, std::span<const SchoolMasks* const> schools) {
  std::vector<std::size_t> parts;
  for (std::size_t i = 0; i < schools.size(); ++i) {
    if (i != detected && same_fish(*schools[detected]->found, schools[i]->pings)) parts.push_back(i);
  }
  std::stable_sort(parts.begin(), parts.end(), [&](std::size_t a, std::size_t b) {
    return schools[a]->pings.front().ping_index < schools[b]->pings.front().ping_index;
  });
  return parts;
}

std::size_t first_of(const std::vector<int>& continues, std::size_t school) {
  while (continues[school] >= 0) school = static_cast<std::size_t>(continues[school]);
  return school;
}

/// Of all pings in which the two have voxels in common.
struct Shared {
  std::size_t voxels = 0;
  std::size_t of_a = 0;
  std::size_t of_b = 0;
};

Shared shared(std::span<const InPing> a, std::span<const InPing> b) {
  Shared sum;
  auto other = b.begin();
  for (const InPing& there : a) {
    while (other != b.end() && other->ping_index < there.ping_index) ++other;
    if (other == b.end()) break;
    const std::size_t common = other->ping_index == there.ping_index ? overlap(there.mask, other->mask) : 0;
    if (common == 0) continue;
    sum.voxels += common;
    sum.of_a += there.mask.voxels();
    sum.of_b += other->mask.voxels();
  }
  return sum;
}

}  // namespace

std::size_t shared_voxels(std::span<const InPing> a, std::span<const InPing> b) { return shared(a, b).voxels; }

bool same_fish(std::span<const InPing> a, std::span<const InPing> b) {
  const Shared sum = shared(a, b);
  return sum.voxels > 0 &&
         static_cast<double>(sum.voxels) >= kSameFishShare * static_cast<double>(std::min(sum.of_a, sum.of_b));
}

std::vector<int> continued(std::span<const SchoolMasks* const> schools) {
  std::vector<int> continues(schools.size(), -1);
  for (std::size_t i = 0; i < schools.size(); ++i) {
    if (!schools[i]->found) continue;
    std::vector<std::size_t> parts = made_of(i, schools);
    if (parts.empty()) continue;
    const std::size_t whole = parts.front();
    parts.push_back(i);
    for (const std::size_t part : parts) {
      const std::size_t of_part = first_of(continues, part);
      const std::size_t of_whole = first_of(continues, whole);
      if (of_part != of_whole) continues[of_part] = static_cast<int>(of_whole);
    }
  }
  return continues;
}

std::string open_ends(const JournalState& state, const StateSchool& school) {
  const std::string ends = ended_at_reach(school.masks);
  if (ends.empty()) return ends;
  std::vector<const SchoolMasks*> all;
  std::size_t own = 0;
  for (std::size_t i = 0; i < state.schools.size(); ++i) {
    if (state.schools[i]->number == school.number) own = i;
    all.push_back(&state.schools[i]->masks);
  }
  const std::vector<int> continues = continued(all);
  bool first = ends_first(ends);
  bool last = ends_last(ends);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool part = first_of(continues, i) == first_of(continues, own) && !all[i]->pings.empty();
    if (!part || all[i]->decided.status == "rejected") continue;
    first = first && all[i]->pings.front().ping_index >= school.masks.pings.front().ping_index;
    last = last && all[i]->pings.back().ping_index <= school.masks.pings.back().ping_index;
  }
  return std::string(kEndNames[static_cast<std::size_t>(first) + 2 * static_cast<std::size_t>(last)]);
}

void name_parts(std::vector<SchoolMasks>& schools, const std::string& observation) {
  std::vector<const SchoolMasks*> all;
  for (const SchoolMasks& school : schools) all.push_back(&school);
  const std::vector<int> continues = continued(all);
  for (std::size_t i = 0; i < schools.size(); ++i) {
    if (continues[i] < 0) continue;
    const SchoolMasks& whole = schools[static_cast<std::size_t>(continues[i])];
    schools[i].decided.continues = school_name(observation, whole.decided.school_id);
  }
}

}  // namespace sonar
