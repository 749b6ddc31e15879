// SPDX-License-Identifier: Apache-2.0
#include "pipeline/commands/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "pipeline/journal/carried.h"
#include "pipeline/journal/continued.h"

namespace sonar {
namespace {

/// Of a detected mask what a human's voxels leave.
PingMask left_beside(const PingMask& mask, const PingMask& voxels, bool whole) {
  const auto shared = static_cast<double>(overlap(mask, voxels));
  const auto smaller = static_cast<double>(std::min(mask.voxels(), voxels.voxels()));
  if (whole && shared >= kSameFishShare * smaller) return {};
  return subtract(mask, voxels);
}

std::vector<SchoolMasks::InPing> without(std::vector<SchoolMasks::InPing> pings,
                                         const std::vector<SchoolMasks::InPing>& voxels) {
  for (SchoolMasks::InPing& there : pings) {
    for (const SchoolMasks::InPing& other : voxels) {
      if (other.ping_index == there.ping_index) there.mask = subtract(there.mask, other.mask);
    }
  }
  return pings;
}

}  // namespace

Result<std::size_t> Edit::find(const SchoolKey& key) {
  const auto found = school_at(state_, context_, key);
  if (found) return *found;
  if (const auto heir =
          context_.earlier != nullptr ? heir_of(key, state_, context_, *context_.earlier) : std::nullopt) {
    note_carried(key, key_of(masks(*heir), context_));
    return *heir;
  }
  return fail(ErrorCode::bad_parameter,
              fmt::format("there is no school at channel {}, sample {} of that ping", key.channel, key.sample));
}

Result<std::vector<Run>> Edit::rows_of(const std::vector<RunKey>& runs, const Shape3& shape) const {
  const std::vector<int> rows = context_.grid->row_of_channel();
  std::vector<Run> out;
  for (const RunKey& run : runs) {
    const auto channel = static_cast<std::size_t>(run.channel);
    if (run.channel < 0 || channel >= rows.size() || rows[channel] < 0) {
      return fail(ErrorCode::bad_parameter, fmt::format("there is no channel {}", run.channel));
    }
    if (run.sample < 0 || run.count < 1 || run.count > shape.samples - run.sample) {
      return fail(ErrorCode::bad_parameter, fmt::format("channel {} has no samples {} to {}", run.channel, run.sample,
                                                        static_cast<std::int64_t>(run.sample) + run.count - 1));
    }
    out.push_back({rows[channel], run.sample, run.count});
  }
  return out;
}

PingMask Edit::taken(std::int64_t ping_index, std::optional<std::size_t> but) const {
  PingMask voxels;
  for (std::size_t i = 0; i < state_.schools.size(); ++i) {
    if (i == but || !keeps_its_voxels(*state_.schools[i])) continue;
    if (const auto* there = in_ping(masks(i), ping_index)) voxels = unite(voxels, there->mask);
  }
  return voxels;
}

const PingMask& Edit::mask(std::size_t school, std::int64_t ping_index) const {
  static const PingMask none;
  const auto* there = in_ping(masks(school), ping_index);
  return there == nullptr ? none : there->mask;
}

StateSchool& Edit::writable(std::size_t school) {
  auto copy = std::make_shared<StateSchool>(*state_.schools[school]);
  StateSchool& changed = *copy;
  state_.schools[school] = std::move(copy);
  return changed;
}

std::size_t Edit::add(SchoolMasks masks) {
  auto school = std::make_shared<StateSchool>();
  school->number = state_.next_number++;
  school->made_by = act_.n;
  school->by_hand = true;
  school->masks = std::move(masks);
  school->masks.decided.operator_name = act_.operator_name;
  state_.schools.push_back(std::move(school));
  return state_.schools.size() - 1;
}

void Edit::touch(std::size_t school) {
  StateSchool& changed = writable(school);
  changed.by_hand = true;
  changed.grown.reset();
  SchoolRow& row = changed.masks.decided;
  if (row.origin == "automatic") row.status = "corrected";
  row.operator_name = act_.operator_name;
  row.decided_utc = act_.decided;
}

void Edit::decide(std::size_t school, const Decision& decision) {
  SchoolRow& row = writable(school).masks.decided;
  if (decision.status) row.status = *decision.status;
  if (decision.species) row.species = *decision.species;
  if (decision.comment) row.comment = *decision.comment;
  if (decision.name) row.name = *decision.name;
  row.operator_name = act_.operator_name;
  row.decided_utc = act_.decided;
}

void Edit::number_detected(std::int64_t at_least) {
  for (std::size_t i = 0; i < state_.schools.size(); ++i) {
    const std::int64_t number = state_.schools[i]->number;
    // Each has its place, also where an earlier line took another one's voxels.
    if (number < 0) writable(i).number = state_.next_number + state_.unnumbered + number;
  }
  state_.next_number += std::max(state_.unnumbered, at_least);
  state_.unnumbered = 0;
  std::stable_sort(state_.schools.begin(), state_.schools.end(),
                   [](const auto& a, const auto& b) { return a->number < b->number; });
}

void Edit::set_mask(std::size_t school, std::int64_t ping_index, PingMask mask, double threshold_db) {
  std::vector<SchoolMasks::InPing>& pings = writable(school).masks.pings;
  auto at = std::lower_bound(pings.begin(), pings.end(), ping_index,
                             [](const auto& a, std::int64_t wanted) { return a.ping_index < wanted; });
  const bool there = at != pings.end() && at->ping_index == ping_index;
  if (mask.empty()) {
    if (there) pings.erase(at);
    return;
  }
  if (!there) at = pings.insert(at, {ping_index, {}, kUnknown});
  at->mask = std::move(mask);
  at->threshold_db = std::fmin(at->threshold_db, threshold_db);  // of two growths the lower; NaN counts as none
}

void Edit::set_pings(std::size_t school, std::vector<SchoolMasks::InPing> pings) {
  writable(school).masks.pings = std::move(pings);
}

void Edit::reduce(std::size_t school) {
  StateSchool& reduced = writable(school);
  reduced_.push_back(reduced.number);
  auto& found = reduced.masks.found;
  if (!found) found = std::make_shared<const std::vector<SchoolMasks::InPing>>(reduced.masks.pings);
}

void Edit::take(std::int64_t ping_index, const PingMask& voxels, std::size_t owner, bool whole) {
  for (std::size_t i = 0; i < state_.schools.size(); ++i) {
    const PingMask& there = mask(i, ping_index);
    if (i == owner || overlap(there, voxels) == 0) continue;
    const bool detected = !state_.schools[i]->by_hand;
    PingMask left = left_beside(there, voxels, whole && detected);
    if (detected) reduce(i);
    set_mask(i, ping_index, std::move(left));
  }
}

void Edit::take_ends(ReachEnds gone, std::size_t into) {
  ReachEnds& ends = writable(into).masks.reach;
  if (gone.first) ends.first = std::min(*gone.first, ends.first.value_or(*gone.first));
  if (gone.last) ends.last = std::max(*gone.last, ends.last.value_or(*gone.last));
}

void Edit::part(std::size_t from, const std::vector<SchoolMasks::InPing>& apart) {
  for (std::size_t i = 0; i < state_.schools.size(); ++i) {
    const auto found = masks(i).found;
    if (!found || !same_fish(*found, apart)) continue;
    if (i != from && !same_fish(*found, masks(from).pings)) continue;
    writable(i).masks.found = std::make_shared<const std::vector<SchoolMasks::InPing>>(without(*found, apart));
  }
}

void Edit::give_found(std::size_t from, std::size_t to) {
  writable(to).masks.found = std::exchange(writable(from).masks.found, nullptr);
}

void Edit::note(DiagnosticCode code, std::string text) {
  state_.notes.push_back({code, "", -1, ping_, std::move(text)});
}

void Edit::note_carried(const SchoolKey& then, const SchoolKey& now) {
  const auto index = [&](const SchoolKey& key) { return ping_at(context_, key.ping_time).value_or(-1); };
  std::string text = fmt::format("choice {} ({}): channel {}, sample {} lies in no school any more", act_.n,
                                 command_name(act_.command), then.channel, then.sample);
  text +=
      fmt::format("; what was there is that of channel {}, sample {} of ping {}", now.channel, now.sample, index(now));
  state_.notes.push_back({DiagnosticCode::decision_carried, "", -1, index(then), std::move(text)});
}

void Edit::add_event(const EventCommand& event) {
  const auto at = std::upper_bound(state_.events.begin(), state_.events.end(), event,
                                   [](const EventCommand& a, const EventCommand& b) { return a.time < b.time; });
  state_.events.insert(at, event);
}

Result<void> Edit::remove_event(const EventCommand& event) {
  const auto found = std::find(state_.events.begin(), state_.events.end(), event);
  if (found == state_.events.end()) {
    return fail(ErrorCode::bad_parameter, fmt::format("there is no mark {} at {}", event.kind, iso_time(event.time)));
  }
  state_.events.erase(found);
  return {};
}

void Edit::call_good(const GoodPingsCommand& good) {
  std::vector<BadPingsCommand> left;
  for (const BadPingsCommand& bad : state_.bad_pings) {
    if (good.last < bad.first || good.first > bad.last) {
      left.push_back(bad);
      continue;
    }
    if (bad.first < good.first) left.push_back({bad.first, good.first - 1});
    if (bad.last > good.last) left.push_back({good.last + 1, bad.last});
  }
  state_.bad_pings = std::move(left);
}

JournalState Edit::done() {
  std::erase_if(state_.schools, [&](const std::shared_ptr<const StateSchool>& school) {
    const auto pings = static_cast<int>(school->masks.pings.size());
    if (pings == 0) return true;
    const bool reduced = std::find(reduced_.begin(), reduced_.end(), school->number) != reduced_.end();
    return reduced && !school->by_hand && pings < context_.least_pings;
  });
  return std::move(state_);
}

}  // namespace sonar
