// SPDX-License-Identifier: Apache-2.0
#include "school/grow/propagate_paper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/units.h"
#include "school/grow/grow.h"

namespace sonar {
namespace {

constexpr std::size_t kCountOffset = 32768;

double opacity_of(std::span<const float> opacity, std::int16_t count) {
  return static_cast<double>(opacity[static_cast<std::size_t>(count + static_cast<int>(kCountOffset))]);
}

/// Centre of gravity in fans, beams and samples, weighted by the mask's values; rounded to a voxel.
VoxelIndex centre_voxel(const PingMask& mask, int beams) {
  double weight = 0.0;
  double fan = 0.0;
  double beam = 0.0;
  double sample = 0.0;
  std::size_t i = 0;
  for (const Run& run : mask.runs) {
    const int at_fan = run.row / beams;
    const int at_beam = run.row % beams;
    for (int s = run.first_sample; s < run.end(); ++s, ++i) {
      const double w = mask.confidence[i];
      weight += w;
      fan += w * at_fan;
      beam += w * at_beam;
      sample += w * s;
    }
  }
  const auto rounded = [&](double sum) { return static_cast<std::int32_t>(std::floor(sum / weight + 0.5)); };
  return {rounded(fan) * beams + rounded(beam), rounded(sample)};
}

/// The part of the volume that is not cropped away: the smallest box round samples that are neither near field nor
/// surface.
IndexBox usable_box(View3<const SampleFlags> flags) {
  const Shape3 shape = flags.shape();
  constexpr SampleFlags kCropped = SampleFlags::near_field | SampleFlags::surface;
  IndexBox box{shape.fans, -1, shape.beams, -1, shape.samples, -1};
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const auto f = flags.row(row);
    const auto usable = [&](SampleFlags flag) { return !any(flag & kCropped); };
    const auto first = std::find_if(f.begin(), f.end(), usable);
    if (first == f.end()) continue;
    const auto last = std::find_if(f.rbegin(), f.rend(), usable);
    box.first_fan = std::min(box.first_fan, row / shape.beams);
    box.last_fan = std::max(box.last_fan, row / shape.beams);
    box.first_beam = std::min(box.first_beam, row % shape.beams);
    box.last_beam = std::max(box.last_beam, row % shape.beams);
    box.first_sample = std::min(box.first_sample, static_cast<int>(first - f.begin()));
    box.last_sample = std::max(box.last_sample, shape.samples - 1 - static_cast<int>(last - f.rbegin()));
  }
  return box;
}

struct Rule {
  std::vector<float> opacity;
  PaperRange range;
  MemberTable members;
  double threshold_db;
};

double lowest_member_db(const MemberTable& members) {
  for (int count = kMinCount; count <= kMaxCount; ++count) {
    if (members(static_cast<std::int16_t>(count)) != 0) return db_from_counts(count);
  }
  return 0.0;
}

/// Follows one direction; returns why it ended, or nothing where the reach ended it.
std::string follow(const PingProvider& pings, std::int64_t clicked, int step, const PingMask& selection,
                   PingReach reach, const Rule& rule, const PaperPropagationParams& p, int beams,
                   const PropagationObserver& on_step, Propagation& result) {
  PingMask previous = selection;
  for (std::int64_t i = clicked + step; i >= reach.first && i <= reach.last; i += step) {
    const auto stop = [&](std::string_view why) { return fmt::format("stopped at ping {}: {}", i, why); };
    const Result<FilteredPing> ping = pings(i);
    if (!ping) return stop(ping.error().text);
    if (ping->bad) {
      if (on_step && !on_step(i, PingMask{})) {
        result.stopped_at = i;
        break;
      }
      continue;
    }
    const View3<const std::int16_t> sv = ping->volume->counts.view();
    const View3<const SampleFlags> flags = ping->volume->flags.view();
    const IndexBox box = box_of(previous, beams).enlarged(p.enlarge_fans, p.enlarge_beams, p.enlarge_samples);
    const IndexBox usable = usable_box(flags);
    if (usable.empty() || sv.shape().beams != beams) return stop("the ping has no usable volume");
    if (!usable.contains(box)) {
      return stop(
          fmt::format("the bounding volume (fans {}..{}, beams {}..{}, samples {}..{}) leaves the usable volume "
                      "(fans {}..{}, beams {}..{}, samples {}..{})",
                      box.first_fan, box.last_fan, box.first_beam, box.last_beam, box.first_sample, box.last_sample,
                      usable.first_fan, usable.last_fan, usable.first_beam, usable.last_beam, usable.first_sample,
                      usable.last_sample));
    }
    const VoxelIndex seed = centre_voxel(previous, beams);
    GrowLimits limits;
    limits.connectivity = p.connectivity;
    limits.box = box;
    limits.taken = &ping->taken;
    PingMask mask = grow(sv, flags, rule.members, std::span(&seed, 1), limits);
    if (mask.empty()) {
      const std::int16_t count = sv.row(seed.row)[static_cast<std::size_t>(seed.sample)];
      return stop(
          fmt::format("the centre's voxel (fan {}, beam {}, sample {}) has opacity {:.3f}, out of {:.3f} +- {:.3f}",
                      seed.row / beams, seed.row % beams, seed.sample, opacity_of(rule.opacity, count),
                      rule.range.centre_opacity, rule.range.tolerance));
    }
    previous = mask;
    result.pings.push_back({i, std::move(mask), rule.threshold_db});
    if (on_step && !on_step(i, previous)) {
      result.stopped_at = i;
      break;
    }
  }
  return {};
}

}  // namespace

PaperRange paper_range(View3<const std::int16_t> sv, const PingMask& selection, std::span<const float> opacity) {
  double lowest = 2.0;
  double highest = -1.0;
  for (const Run& run : selection.runs) {
    const auto counts = sv.row(run.row);
    for (int s = run.first_sample; s < run.end(); ++s) {
      const double value = opacity_of(opacity, counts[static_cast<std::size_t>(s)]);
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  if (highest < lowest) return {};
  return {(lowest + highest) / 2, (highest - lowest) / 2};
}

Result<Propagation> propagate_paper(const PingProvider& pings, std::int64_t clicked, const PingMask& selection,
                                    PingReach reach, const TransferFunction& growth_curve,
                                    const PaperPropagationParams& params, const PropagationObserver& on_step) {
  if (selection.empty()) return fail(ErrorCode::bad_parameter, "an empty selection cannot be propagated");
  const Result<FilteredPing> ping = pings(clicked);
  if (!ping) return pass_on(ping);
  const View3<const std::int16_t> sv = ping->volume->counts.view();
  std::vector<float> opacity = growth_curve.table_i16();
  const PaperRange range = paper_range(sv, selection, opacity);
  MemberTable members = MemberTable::by_opacity(opacity, range.centre_opacity, range.tolerance);
  const double threshold_db = lowest_member_db(members);
  const Rule rule{std::move(opacity), range, std::move(members), threshold_db};
  Propagation result;
  const int beams = sv.shape().beams;
  result.note_backward = follow(pings, clicked, -1, selection, reach, rule, params, beams, on_step, result);
  std::reverse(result.pings.begin(), result.pings.end());
  result.pings.push_back({clicked, selection, threshold_db});
  if (result.stopped_at) return result;
  result.note_forward = follow(pings, clicked, 1, selection, reach, rule, params, beams, on_step, result);
  return result;
}

}  // namespace sonar
