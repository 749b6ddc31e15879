// SPDX-License-Identifier: Apache-2.0
#include "pipeline/continued.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "model/school_totals.h"
#include "pipeline/join_tracks.h"

namespace sonar {
namespace {

using InPing = SchoolMasks::InPing;

/// Both are sorted by ping.
bool side_by_side(const SchoolMasks& a, const SchoolMasks& b) {
  auto at = b.pings.begin();
  return std::any_of(a.pings.begin(), a.pings.end(), [&](const InPing& there) {
    while (at != b.pings.end() && at->ping_index < there.ping_index) ++at;
    return at != b.pings.end() && at->ping_index == there.ping_index;
  });
}

/// Schools that are other than this one and the same fish, those that begin first ahead.
std::vector<std::size_t> selected_out_of(std::size_t school, std::span<const SchoolMasks* const> schools,
                                         double share) {
  std::vector<std::size_t> parts;
  for (std::size_t i = 0; i < schools.size(); ++i) {
    if (i == school || schools[i]->pings.empty()) continue;
    if (same_fish(*schools[school]->found, schools[i]->pings, share)) parts.push_back(i);
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

/// Makes two chains one; the first of `part` goes on the first of `whole`.
void join(std::vector<int>& continues, std::size_t part, std::size_t whole) {
  const std::size_t first = first_of(continues, part);
  const std::size_t root = first_of(continues, whole);
  if (first != root) continues[first] = static_cast<int>(root);
}

/// A school's track as its rows tell it.
struct Ends {
  SchoolRow* school;
  const SchoolPingRow* begin;
  const SchoolPingRow* end;

  [[nodiscard]] bool open_first() const { return ends_first(school->ended_at_reach); }
  [[nodiscard]] bool open_last() const { return ends_last(school->ended_at_reach); }
};

std::vector<Ends> ends_of(ObservationProduct& product) {
  std::vector<Ends> ends;
  for (SchoolRow& school : product.schools) {
    const auto* begin = end_row(product, school.school_id, false);
    if (begin != nullptr) ends.push_back({&school, begin, end_row(product, school.school_id, true)});
  }
  return ends;
}

/// A track that ends, and one that begins, where either end is at a propagation's reach.
struct Meeting {
  double miss_m;
  std::size_t before;
  std::size_t after;
  [[nodiscard]] auto key() const { return std::tuple(miss_m, before, after); }
};

std::vector<Meeting> meetings(const std::vector<Ends>& ends, const MergeParams& params) {
  std::vector<Meeting> found;
  for (std::size_t a = 0; a < ends.size(); ++a) {
    for (std::size_t b = 0; b < ends.size(); ++b) {
      const std::int64_t unseen = ends[b].begin->ping_index - ends[a].end->ping_index - 1;
      if (a == b || unseen < 0 || unseen > params.edge_pings) continue;
      if (!ends[a].open_last() && !ends[b].open_first()) continue;
      const double miss_m = miss(*ends[a].school, *ends[a].end, *ends[b].school, *ends[b].begin, params);
      if (miss_m >= 0.0) found.push_back({miss_m, a, b});
    }
  }
  std::sort(found.begin(), found.end(), [](const Meeting& a, const Meeting& b) { return a.key() < b.key(); });
  return found;
}

void note_open_ends(const std::vector<Ends>& ends, const std::vector<int>& chains, ObservationProduct& product) {
  const auto goes_on = [&](std::size_t school, auto beyond) {
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (chains[i] == chains[school] && beyond(ends[i])) return true;
    }
    return false;
  };
  const auto note = [&](const Ends& one, std::int64_t ping_index, const char* side) {
    product.diagnostics.push_back({DiagnosticCode::ended_at_reach, "", -1, ping_index,
                                   fmt::format("school {} goes on {} ping {}, where its propagation by hand had the "
                                               "reach that it was given: carry it on from there",
                                               one.school->school_id, side, ping_index)});
  };
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Ends& one = ends[i];
    const std::int64_t first = one.begin->ping_index;
    const std::int64_t last = one.end->ping_index;
    if (one.open_first() && !goes_on(i, [&](const Ends& e) { return e.begin->ping_index < first; })) {
      note(one, first, "before");
    }
    if (one.open_last() && !goes_on(i, [&](const Ends& e) { return e.end->ping_index > last; })) {
      note(one, last, "after");
    }
  }
}

}  // namespace

std::span<const InPing> as_found(const SchoolMasks& school) { return school.found ? *school.found : school.pings; }

bool same_fish(std::span<const InPing> a, std::span<const InPing> b, double share) {
  std::size_t shared = 0;
  std::size_t of_a = 0;
  std::size_t of_b = 0;
  auto other = b.begin();
  for (const InPing& there : a) {
    while (other != b.end() && other->ping_index < there.ping_index) ++other;
    if (other == b.end()) break;
    if (other->ping_index != there.ping_index) continue;
    shared += overlap(there.mask, other->mask);
    of_a += there.mask.voxels();
    of_b += other->mask.voxels();
  }
  return shared > 0 && static_cast<double>(shared) >= share * static_cast<double>(std::min(of_a, of_b));
}

std::vector<int> continued(std::span<const SchoolMasks* const> schools, double share) {
  std::vector<int> continues(schools.size(), -1);
  for (std::size_t i = 0; i < schools.size(); ++i) {
    if (!schools[i]->found) continue;
    const std::vector<std::size_t> parts = selected_out_of(i, schools, share);
    if (parts.empty()) continue;
    std::vector<std::size_t> joined{parts.front()};
    for (const std::size_t part : parts) {
      const bool apart = std::none_of(joined.begin(), joined.end(),
                                      [&](std::size_t one) { return side_by_side(*schools[one], *schools[part]); });
      if (apart) joined.push_back(part);
    }
    for (const std::size_t part : joined) join(continues, part, joined.front());
    join(continues, i, joined.front());
  }
  return continues;
}

std::string ended_at_reach(const SchoolMasks& school) {
  if (school.pings.empty()) return {};
  const bool first = school.reach.first == school.pings.front().ping_index;
  const bool last = school.reach.last == school.pings.back().ping_index;
  return std::string(kEndNames[static_cast<std::size_t>(first) + 2 * static_cast<std::size_t>(last)]);
}

void name_parts(std::vector<SchoolMasks>& schools, const std::string& observation, double share) {
  std::vector<const SchoolMasks*> all;
  for (const SchoolMasks& school : schools) all.push_back(&school);
  const std::vector<int> continues = continued(all, share);
  for (std::size_t i = 0; i < schools.size(); ++i) {
    if (continues[i] < 0) continue;
    const SchoolMasks& whole = schools[static_cast<std::size_t>(continues[i])];
    schools[i].decided.continues = school_name(observation, whole.decided.school_id);
  }
}

void join_at_reach(ObservationProduct& product, const MergeParams& params) {
  const std::vector<Ends> ends = ends_of(product);
  std::vector<bool> followed(ends.size(), false);
  for (const Meeting& meeting : meetings(ends, params)) {
    SchoolRow& after = *ends[meeting.after].school;
    if (!after.continues.empty() || followed[meeting.before]) continue;
    const std::vector<int> chains = chains_of(product.schools);
    const auto chain = [&](const SchoolRow& row) {
      return chains[static_cast<std::size_t>(&row - product.schools.data())];
    };
    if (chain(after) == chain(*ends[meeting.before].school)) continue;
    after.continues = school_name(product.observation, ends[meeting.before].school->school_id);
    followed[meeting.before] = true;
  }
  const std::vector<int> chains = chains_of(product.schools);
  std::vector<int> of_ends;
  for (const Ends& one : ends) of_ends.push_back(chains[static_cast<std::size_t>(one.school - product.schools.data())]);
  note_open_ends(ends, of_ends, product);
}

}  // namespace sonar
