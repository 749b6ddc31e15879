// SPDX-License-Identifier: Apache-2.0
// Commands on whole schools.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "pipeline/commands/edit.h"
#include "school/grow/mask_edit.h"

namespace sonar {
namespace {

using InPing = SchoolMasks::InPing;

/// A mask in two: what goes into the new school, and what stays.
struct Halves {
  PingMask apart;
  PingMask rest;
};

/// Each piece goes where it lies more upon what the neighbouring ping gave.
Halves follow(const PingMask& mask, const Halves& neighbour, const Shape3& shape) {
  Halves halves;
  for (const PingMask& part : parts(mask, shape, Connectivity::faces)) {
    const bool apart = overlap(part, neighbour.apart) > overlap(part, neighbour.rest);
    PingMask& side = apart ? halves.apart : halves.rest;
    side = unite(side, part);
  }
  return halves;
}

Shape3 shape_of(const CommandContext& context) {
  return {context.grid->fans(), context.grid->beams(), context.sector->range().count};
}

/// [ping of the school] its halves: the clicked ping's first, then outwards. Where a side has nothing in a ping, the
/// last one that had something is looked at.
Result<std::vector<Halves>> halves_of(const SchoolMasks& school, std::size_t clicked, const VoxelIndex& seed,
                                      const Shape3& shape) {
  std::vector<Halves> halves(school.pings.size());
  const auto pieces = parts(school.pings[clicked].mask, shape, Connectivity::faces);
  if (pieces.size() < 2) return fail(ErrorCode::bad_parameter, "the school is in one piece in this ping");
  bool hit = false;
  for (const PingMask& part : pieces) {
    const bool apart = contains(part, seed.row, seed.sample);
    hit = hit || apart;
    PingMask& side = apart ? halves[clicked].apart : halves[clicked].rest;
    side = unite(side, part);
  }
  if (!hit) return fail(ErrorCode::bad_parameter, "the seed is not in the school");
  Halves last = halves[clicked];
  const auto step = [&](std::size_t i) {
    halves[i] = follow(school.pings[i].mask, last, shape);
    if (!halves[i].apart.empty()) last.apart = halves[i].apart;
    if (!halves[i].rest.empty()) last.rest = halves[i].rest;
  };
  for (std::size_t i = clicked + 1; i < halves.size(); ++i) step(i);
  last = halves[clicked];
  for (std::size_t i = clicked; i-- > 0;) step(i);
  return halves;
}

/// Whether humans took more of a detected school after the cut than before it.
bool taken_later(const SchoolMasks& school, std::int64_t cut) {
  if (!school.found) return false;
  std::size_t before = 0;
  std::size_t after = 0;
  for (const InPing& found : *school.found) {
    const auto* left = in_ping(school, found.ping_index);
    const std::size_t kept = left == nullptr ? 0 : overlap(found.mask, left->mask);
    (found.ping_index < cut ? before : after) += found.mask.voxels() - kept;
  }
  return after > before;
}

Result<void> split_in_space(Edit& edit, std::size_t school, const SeedKey& seed) {
  const SchoolMasks before = edit.masks(school);
  const auto* there = in_ping(before, edit.ping());
  if (there == nullptr) return fail(ErrorCode::bad_parameter, "the school is not in this ping");
  const std::vector<int> rows = edit.context().grid->row_of_channel();
  const auto channel = static_cast<std::size_t>(seed.channel);
  if (channel >= rows.size())
    return fail(ErrorCode::bad_parameter, fmt::format("there is no channel {}", seed.channel));
  const auto halves = halves_of(before, static_cast<std::size_t>(there - before.pings.data()),
                                {rows[channel], seed.sample}, shape_of(edit.context()));
  if (!halves) return pass_on(halves);
  SchoolMasks apart;
  std::vector<InPing> rest;
  for (std::size_t i = 0; i < halves->size(); ++i) {
    const InPing& old = before.pings[i];
    const Halves& now = (*halves)[i];
    if (!now.apart.empty()) apart.pings.push_back({old.ping_index, now.apart, old.threshold_db});
    if (!now.rest.empty()) rest.push_back({old.ping_index, now.rest, old.threshold_db});
  }
  apart.decided = before.decided;
  apart.reach = before.reach;
  edit.set_pings(school, std::move(rest));
  edit.touch(school);
  const std::size_t added = edit.add(std::move(apart));
  edit.touch(added);
  edit.part(school, std::vector<InPing>(edit.masks(added).pings));
  return {};
}

Result<void> split_in_time(Edit& edit, std::size_t school) {
  std::vector<InPing> before = edit.masks(school).pings;
  const auto cut =
      std::find_if(before.begin(), before.end(), [&](const InPing& there) { return there.ping_index >= edit.ping(); });
  if (cut == before.begin() || cut == before.end()) {
    return fail(ErrorCode::bad_parameter, "the school has no pings on both sides of the cut");
  }
  const bool later_taken = taken_later(edit.masks(school), edit.ping());
  SchoolMasks later;
  later.decided = edit.masks(school).decided;
  later.reach = edit.masks(school).reach;
  later.pings.assign(std::make_move_iterator(cut), std::make_move_iterator(before.end()));
  before.erase(cut, before.end());
  edit.set_pings(school, std::move(before));
  edit.touch(school);
  const std::size_t added = edit.add(std::move(later));
  edit.touch(added);
  // What was taken is a part of the half beside it.
  if (later_taken) edit.give_found(school, added);
  edit.part(later_taken ? added : school, std::vector<InPing>(edit.masks(later_taken ? school : added).pings));
  return {};
}

}  // namespace

Result<void> carry_out(Edit& edit, const MergeCommand& command) {
  std::vector<std::size_t> schools;
  for (const SchoolKey& key : command.schools) {
    const auto found = edit.find(key);
    if (!found) return pass_on(found);
    if (std::find(schools.begin(), schools.end(), *found) == schools.end()) schools.push_back(*found);
  }
  if (schools.size() < 2) return fail(ErrorCode::bad_parameter, "all voxels name the same school");
  const std::size_t into = schools.front();
  edit.touch(into);
  for (std::size_t i = 1; i < schools.size(); ++i) {
    for (const InPing& there : edit.masks(schools[i]).pings) {
      edit.set_mask(into, there.ping_index, unite(edit.mask(into, there.ping_index), there.mask), there.threshold_db);
    }
    edit.take_ends(edit.masks(schools[i]).reach, into);
    edit.remove(schools[i]);
  }
  return {};
}

Result<void> carry_out(Edit& edit, const SplitCommand& command) {
  const auto school = edit.find(command.school);
  if (!school) return pass_on(school);
  return command.seed ? split_in_space(edit, *school, *command.seed) : split_in_time(edit, *school);
}

namespace {

/// Of a school what lies in pings of some times.
std::vector<InPing> piece_of(const Edit& edit, std::size_t school, TimeNs first, TimeNs last) {
  std::vector<InPing> piece;
  for (const InPing& there : edit.masks(school).pings) {
    const TimeNs time = edit.context().times[static_cast<std::size_t>(there.ping_index)];
    if (first <= time && time <= last) piece.push_back(there);
  }
  return piece;
}

/// A school of its own, of which no more is known than of the one that it comes from.
std::size_t add_piece(Edit& edit, std::size_t from, const std::vector<InPing>& piece) {
  SchoolMasks apart;
  apart.decided = edit.masks(from).decided;
  apart.reach = edit.masks(from).reach;
  apart.pings = piece;
  return edit.add(std::move(apart));
}

}  // namespace

Result<void> carry_out(Edit& edit, const HandOverCommand& command) {
  const auto from = edit.find(command.school);
  if (!from) return pass_on(from);
  const std::vector<InPing> piece = piece_of(edit, *from, command.first, command.last);
  if (piece.empty()) return fail(ErrorCode::bad_parameter, "the school is in none of these pings");
  const bool all = piece.size() == edit.masks(*from).pings.size();
  if (all && !command.to) return fail(ErrorCode::bad_parameter, "the school is in no other pings");
  std::size_t to = 0;
  if (command.to) {
    const auto found = edit.find(*command.to);
    if (!found) return pass_on(found);
    if (*found == *from) return fail(ErrorCode::bad_parameter, "both voxels name the same school");
    to = *found;
    for (const InPing& there : piece) {
      edit.set_mask(to, there.ping_index, unite(edit.mask(to, there.ping_index), there.mask), there.threshold_db);
    }
    ReachEnds ends = edit.masks(*from).reach;
    if (ends.first != piece.front().ping_index) ends.first.reset();
    if (ends.last != piece.back().ping_index) ends.last.reset();
    edit.take_ends(ends, to);
  } else {
    to = add_piece(edit, *from, piece);
  }
  for (const InPing& there : piece) edit.set_mask(*from, there.ping_index, {});
  edit.touch(*from);
  edit.touch(to);
  // All of a school makes it a part of the other, as merging does.
  if (!all) edit.part(*from, piece);
  return {};
}

Result<void> carry_out(Edit& edit, const DeleteCommand& command) {
  const auto school = edit.find(command.school);
  if (!school) return pass_on(school);
  edit.remove(*school);
  return {};
}

Result<void> carry_out(Edit& edit, const DetectCommand& command) {
  edit.number_detected(command.schools);
  return {};
}

}  // namespace sonar
