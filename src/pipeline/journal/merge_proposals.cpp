// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/merge_proposals.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "pipeline/journal/continued.h"
#include "school/mask_shape.h"
#include "school/track/motion.h"

namespace sonar {
namespace {

using InPing = SchoolMasks::InPing;

constexpr std::ptrdiff_t kMotionPings = 8;  ///< that tell where a school was going

/// The mask and its neighbours over faces. Samples beyond the sector's ends do no harm: no mask has them.
PingMask with_neighbours(const PingMask& mask, const Sector& sector) {
  const int beams = sector.beams();
  const int rows = sector.fans() * beams;
  std::vector<Run> runs;
  for (const Run& run : mask.runs) {
    runs.push_back({run.row, run.first_sample - 1, run.count + 2});
    if (run.row % beams > 0) runs.push_back({run.row - 1, run.first_sample, run.count});
    if (run.row % beams < beams - 1) runs.push_back({run.row + 1, run.first_sample, run.count});
    if (run.row >= beams) runs.push_back({run.row - beams, run.first_sample, run.count});
    if (run.row + beams < rows) runs.push_back({run.row + beams, run.first_sample, run.count});
  }
  std::sort(runs.begin(), runs.end());
  PingMask wide;
  for (const Run& run : runs) {
    if (wide.runs.empty() || wide.runs.back().row != run.row || wide.runs.back().end() < run.first_sample) {
      wide.runs.push_back(run);
      continue;
    }
    Run& last = wide.runs.back();
    last.count = std::max(last.end(), run.end()) - last.first_sample;
  }
  std::size_t voxels = 0;
  for (const Run& run : wide.runs) voxels += static_cast<std::size_t>(run.count);
  wide.confidence.assign(voxels, 255);
  return wide;
}

/// The first ping in which they touch.
std::optional<std::int64_t> touching_ping(const SchoolMasks& a, const SchoolMasks& b, const Sector& sector) {
  auto other = b.pings.begin();
  for (const InPing& there : a.pings) {
    while (other != b.pings.end() && other->ping_index < there.ping_index) ++other;
    if (other == b.pings.end()) break;
    if (other->ping_index != there.ping_index) continue;
    const bool a_smaller = there.mask.voxels() <= other->mask.voxels();
    const PingMask& small = a_smaller ? there.mask : other->mask;
    const PingMask& large = a_smaller ? other->mask : there.mask;
    const std::size_t touching = overlap(large, with_neighbours(small, sector));
    const double least = kTouchingShare * static_cast<double>(small.voxels());
    if (touching > 0 && static_cast<double>(touching) >= least) return there.ping_index;
  }
  return std::nullopt;
}

/// A mask as the tracker sees it: where it lies, and how well that is known.
struct Seen {
  Point<Enu> place;
  Covariance3 spread{};
};

class Continuing {
 public:
  Continuing(const CommandContext& context, const ProposalLimits& limits) : context_(context), limits_(limits) {}

  /// Whether the tracker would have taken the beginning of `after` for `before`, had both been found in turn.
  [[nodiscard]] bool operator()(const SchoolMasks& before, const SchoolMasks& after) const {
    const std::int64_t end = before.pings.back().ping_index;
    const std::int64_t begin = after.pings.front().ping_index;
    const TrackParams& track = limits_.track;
    if (begin <= end || begin - end - 1 > track.max_lost_pings || seconds(end, begin) > track.max_lost_s) return false;
    const PingFrame origin(limits_.placement(end), limits_.placement(end).transducer);
    const auto first =
        std::max(before.pings.begin(), before.pings.end() - std::min(kMotionPings, std::ssize(before.pings)));
    const Seen at_first = seen(*first, end);
    Motion motion(at_first.place, at_first.spread, track.initial_speed_mps);
    for (auto ping = first + 1; ping != before.pings.end(); ++ping) {
      motion.predict(seconds((ping - 1)->ping_index, ping->ping_index), track.acceleration_mps2);
      const Seen there = seen(*ping, end);
      motion.update(there.place, there.spread);
    }
    motion.predict(seconds(end, begin), track.acceleration_mps2);
    const Seen there = seen(after.pings.front(), end);
    return motion.distance2(there.place, there.spread) <= track.gate_sigmas * track.gate_sigmas;
  }

 private:
  [[nodiscard]] double seconds(std::int64_t from, std::int64_t to) const {
    const TimeNs ns = context_.times[static_cast<std::size_t>(to)] - context_.times[static_cast<std::size_t>(from)];
    return static_cast<double>(ns) / static_cast<double>(kSecondNs);
  }
  [[nodiscard]] Seen seen(const InPing& there, std::int64_t origin) const {
    const MaskShape shape = shape_of(there.mask, *context_.sector);
    const PingFrame frame(limits_.placement(there.ping_index), limits_.placement(origin).transducer);
    return {frame.to_world(shape.centre),
            centre_covariance(shape.centre, shape.covariance, frame.heading_rad(), limits_.track.position_share,
                              limits_.track.min_position_m, TrackParams::censored_m, 0)};
  }

  const CommandContext& context_;
  const ProposalLimits& limits_;
};

int whole_of(const std::vector<int>& continues, int school) {
  while (continues[static_cast<std::size_t>(school)] >= 0) school = continues[static_cast<std::size_t>(school)];
  return school;
}

const InPing* mask_of(const JournalState& state, std::int64_t number, std::int64_t ping_index) {
  for (const auto& school : state.schools) {
    if (school->number == number && school->masks.decided.status != "rejected")
      return in_ping(school->masks, ping_index);
  }
  return nullptr;
}

}  // namespace

std::vector<MergeProposal> merge_proposals(const JournalState& state, const CommandContext& context,
                                           const ProposalLimits& limits, const std::set<std::int64_t>& of) {
  std::vector<const SchoolMasks*> all;
  for (const auto& school : state.schools) all.push_back(&school->masks);
  const std::vector<int> continues = continued(all);
  const Continuing goes_on(context, limits);
  const auto asked = [&](const StateSchool& school) { return of.empty() || of.contains(school.number); };
  const auto counts = [](const StateSchool& school) {
    return !school.masks.pings.empty() && school.masks.decided.status != "rejected";
  };
  std::vector<MergeProposal> proposals;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (limits.stopped && limits.stopped()) break;
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const StateSchool* a = state.schools[i].get();
      const StateSchool* b = state.schools[j].get();
      if ((!asked(*a) && !asked(*b)) || !counts(*a) || !counts(*b)) continue;
      if (whole_of(continues, static_cast<int>(i)) == whole_of(continues, static_cast<int>(j))) continue;
      if (b->masks.pings.front().ping_index < a->masks.pings.front().ping_index) std::swap(a, b);
      if (const auto ping = touching_ping(a->masks, b->masks, *context.sector)) {
        proposals.push_back({a->number, b->number, *ping, *ping});
      } else if (goes_on(a->masks, b->masks)) {
        proposals.push_back(
            {a->number, b->number, a->masks.pings.back().ping_index, b->masks.pings.front().ping_index});
      }
    }
  }
  std::sort(proposals.begin(), proposals.end(), [](const MergeProposal& x, const MergeProposal& y) {
    return std::tie(x.first, x.other) < std::tie(y.first, y.other);
  });
  return proposals;
}

bool still_holds(const MergeProposal& proposal, const JournalState& told, const JournalState& now) {
  const auto same = [&](std::int64_t number, std::int64_t ping_index) {
    const InPing* before = mask_of(told, number, ping_index);
    const InPing* after = mask_of(now, number, ping_index);
    return before != nullptr && after != nullptr && before->mask == after->mask;
  };
  return same(proposal.first, proposal.first_ping) && same(proposal.other, proposal.other_ping);
}

}  // namespace sonar
