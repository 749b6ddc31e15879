// SPDX-License-Identifier: Apache-2.0
#include "school/grow/propagate_tracked.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/units.h"
#include "model/school.h"
#include "school/mask_shape.h"
#include "school/measure/edges.h"
#include "school/track/motion.h"
#include "school/track/moved_mask.h"

namespace sonar {
namespace {

/// Neighbouring runs that meet or overlap become one.
std::vector<Run> united(std::vector<Run> runs) {
  std::sort(runs.begin(), runs.end());
  std::vector<Run> out;
  for (const Run& run : runs) {
    if (!out.empty() && out.back().row == run.row && run.first_sample <= out.back().end()) {
      out.back().count = std::max(out.back().end(), run.end()) - out.back().first_sample;
    } else {
      out.push_back(run);
    }
  }
  return out;
}

/// The parts of runs, sorted and apart, that lie in others.
std::vector<Run> common(const std::vector<Run>& a, const std::vector<Run>& b) {
  std::vector<Run> out;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const int first = std::max(a[i].first_sample, b[j].first_sample);
    const int end = std::min(a[i].end(), b[j].end());
    if (a[i].row == b[j].row && first < end) out.push_back({a[i].row, first, end - first});
    const bool a_ends_first = a[i].row != b[j].row ? a[i].row < b[j].row : a[i].end() < b[j].end();
    if (a_ends_first) {
      ++i;
    } else {
      ++j;
    }
  }
  return out;
}

/// What the members of a selection's later pings have to stand above.
Above stands_above(const FilteredPing& ping, const PingMask& selection, double margin_db) {
  if (!ping.above_background) return Above::noise;
  std::size_t standing = 0;
  for (const Run& run : common(selection.runs, ping.above_background(margin_db, Above::water))) {
    standing += static_cast<std::size_t>(run.count);
  }
  return 2 * standing >= selection.voxels() ? Above::water : Above::noise;
}

/// The school where it was last seen.
struct Sighting {
  PingMask mask;
  PingFrame frame;
  TimeNs time = 0;
  double volume_m3 = 0.0;
  bool cut = false;
};

struct Found {
  PingMask mask;
  double reference_db = 0.0;
  double threshold_db = 0.0;
};

class Follower {
 public:
  Follower(const Sector& sector, const TrackedPropagationParams& params, const Geographic& origin, Above above,
           const PropagationObserver& on_step)
      : sector_(sector), params_(params), origin_(origin), above_(above), on_step_(on_step) {}

  /// Follows one direction; returns why it ended, or nothing where the reach ended it.
  std::string follow(const PingProvider& pings, std::int64_t clicked, int step, const FilteredPing& start,
                     const PingMask& selection, PingReach reach, double reference_db, Propagation& result) const {
    const PingFrame frame(start.placement, origin_);
    const MaskShape shape = shape_of(selection, sector_);
    Sighting last{selection, frame, start.time, shape.volume_m3, false};
    Motion motion(frame.to_world(shape.centre), centre_spread(shape, frame, 0), params_.initial_speed_mps);
    TimeNs predicted_at = start.time;
    int lost = 0;
    for (std::int64_t i = clicked + step; i >= reach.first && i <= reach.last; i += step) {
      const Result<FilteredPing> ping = pings(i);
      if (!ping) return fmt::format("stopped at ping {}: {}", i, ping.error().text);
      if (!fits(*ping)) return fmt::format("stopped at ping {}: another grid", i);
      if (ping->bad) {
        if (on_step_ && !on_step_(i, PingMask{})) {
          result.stopped_at = i;
          break;
        }
        continue;
      }
      motion.predict(elapsed(predicted_at, ping->time), params_.acceleration_mps2);
      predicted_at = ping->time;
      const PingFrame here(ping->placement, origin_);
      std::string why;
      std::optional<Found> found = find(*ping, here, last, motion, reference_db, why);
      if (!found) {
        if (++lost > params_.max_lost_pings) return fmt::format("stopped at ping {}: {}", i, why);
      } else {
        lost = 0;
        reference_db = found->reference_db;
        accept(*ping, here, *found, motion, last);
        result.pings.push_back({i, std::move(found->mask), found->threshold_db});
      }
      if (on_step_ && !on_step_(i, found ? last.mask : PingMask{})) {
        result.stopped_at = i;
        break;
      }
    }
    return {};
  }

 private:
  [[nodiscard]] bool fits(const FilteredPing& ping) const {
    const Shape3 shape{sector_.fans(), sector_.beams(), sector_.range().count};
    return ping.volume != nullptr && ping.volume->counts.shape() == shape && ping.volume->flags.shape() == shape;
  }

  /// Time runs forwards in both directions: backwards the school's velocity is seen reversed.
  static double elapsed(TimeNs a, TimeNs b) {
    return std::abs(static_cast<double>(b - a) / static_cast<double>(kSecondNs));
  }

  [[nodiscard]] Covariance3 centre_spread(const MaskShape& shape, const PingFrame& frame, std::int32_t edges) const {
    return centre_covariance(shape.centre, shape.covariance, frame.heading_rad(), params_.position_share,
                             params_.min_position_m, params_.censored_m, edges);
  }

  std::optional<Found> find(const FilteredPing& ping, const PingFrame& here, const Sighting& last, const Motion& motion,
                            double reference_db, std::string& why) const {
    const double dt = elapsed(last.time, ping.time);
    const std::vector<MovedPoint> moved =
        moved_mask(last.mask, sector_, last.frame, here, motion.velocity() * dt, params_.seed_samples);
    if (moved.empty()) {
      why = "the school has left the sector";
      return std::nullopt;
    }
    const std::vector<VoxelIndex> seeds = seeds_at(moved);
    PingMask gate;
    gate.runs = gate_round(seeds, dt);
    if (ping.above_background && params_.margin_db > 0.0) {
      gate.runs = common(gate.runs, ping.above_background(params_.margin_db, above_));
    }
    double tolerance_db = params_.tolerance_db;
    const double largest = params_.max_growth * (last.cut ? params_.cut_growth : 1.0);
    for (int attempt = 0; attempt < params_.tries; ++attempt, tolerance_db *= params_.tighter) {
      Found found = grow_twice(ping, seeds, gate, reference_db, tolerance_db);
      if (found.mask.empty()) {
        why = fmt::format("no voxel of the moved school reaches {:.1f} dB and is above the background",
                          reference_db - tolerance_db);
        return std::nullopt;
      }
      const double volume = shape_of(found.mask, sector_).volume_m3;
      const bool cut = (mask_edges(found.mask, ping.volume->flags.view(), sector_).flags & kTouchesEdge) != 0;
      if (volume <= largest * (cut ? params_.cut_growth : 1.0) * last.volume_m3) return found;
    }
    why = fmt::format("the school would grow more than {} times from one ping to the next", params_.max_growth);
    return std::nullopt;
  }

  /// Grows at the last reference, then at the school's own.
  [[nodiscard]] Found grow_twice(const FilteredPing& ping, const std::vector<VoxelIndex>& seeds, const PingMask& gate,
                                 double reference_db, double tolerance_db) const {
    GrowLimits limits;
    limits.connectivity = params_.connectivity;
    limits.taken = &ping.taken;
    limits.inside = &gate;
    const View3<const std::int16_t> sv = ping.volume->counts.view();
    const View3<const SampleFlags> flags = ping.volume->flags.view();
    PingMask mask = grow(sv, flags, MemberTable::one_sided(reference_db, tolerance_db), seeds, limits);
    if (mask.empty()) return {};
    const double own_db = db_from_counts(percentile(sv, mask, params_.reference_percentile / 100.0));
    const double step_db = params_.max_reference_step_db;
    const double next_db = std::clamp(own_db, reference_db - step_db, reference_db + step_db);
    PingMask again = grow(sv, flags, MemberTable::one_sided(next_db, tolerance_db), seeds, limits);
    if (again.empty()) return {std::move(mask), reference_db, reference_db - tolerance_db};
    return {std::move(again), next_db, next_db - tolerance_db};
  }

  [[nodiscard]] std::vector<VoxelIndex> seeds_at(const std::vector<MovedPoint>& moved) const {
    std::vector<VoxelIndex> seeds;
    for (const MovedPoint& point : moved) {
      const int fan = std::clamp(static_cast<int>(std::lround(point.index.fan)), 0, sector_.fans() - 1);
      const int beam = std::clamp(static_cast<int>(std::lround(point.index.beam)), 0, sector_.beams() - 1);
      const int sample = std::clamp(static_cast<int>(std::lround(point.index.sample)), 0, sector_.range().count - 1);
      seeds.push_back({fan * sector_.beams() + beam, sample});
    }
    std::sort(seeds.begin(), seeds.end());
    seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
    return seeds;
  }

  /// The water within reach of the moved mask, which counts as whole between its first and last sample of each row.
  [[nodiscard]] std::vector<Run> gate_round(const std::vector<VoxelIndex>& moved, double seconds) const {
    const double reach_m = params_.gate_m + params_.gate_speed_mps * seconds;
    const int samples = static_cast<int>(std::ceil(reach_m / sector_.range().spacing_m));
    std::vector<Run> runs;
    for (std::size_t i = 0; i < moved.size();) {  // sorted by row
      const int row = moved[i].row;
      const int first = moved[i].sample;
      int last = first;
      for (; i < moved.size() && moved[i].row == row; ++i) last = moved[i].sample;
      widen(row, std::max(0, first - samples), std::min(sector_.range().count, last + samples + 1),
            reach_m / std::max(sector_.range().range_m(first), 1.0), runs);
    }
    return united(std::move(runs));
  }

  void widen(int row, int first, int end, double reach_rad, std::vector<Run>& runs) const {
    const int fan = row / sector_.beams();
    const int beam = row % sector_.beams();
    const int fans = std::max(params_.gate_fans, cells(reach_rad, sector_.elevation_bounds(fan)));
    const int beams = std::max(params_.gate_beams, cells(reach_rad, sector_.azimuth_bounds(beam)));
    for (int f = std::max(0, fan - fans); f <= std::min(sector_.fans() - 1, fan + fans); ++f) {
      for (int b = std::max(0, beam - beams); b <= std::min(sector_.beams() - 1, beam + beams); ++b) {
        runs.push_back({f * sector_.beams() + b, first, end - first});
      }
    }
  }

  static int cells(double angle_rad, const AngleBounds& cell) {
    return static_cast<int>(std::min(std::ceil(angle_rad / (cell.upper - cell.lower)), 1000.0));
  }

  void accept(const FilteredPing& ping, const PingFrame& here, const Found& found, Motion& motion,
              Sighting& last) const {
    const std::int32_t edges = mask_edges(found.mask, ping.volume->flags.view(), sector_).flags;
    const MaskShape shape = shape_of(found.mask, sector_);
    motion.update(here.to_world(shape.centre), centre_spread(shape, here, edges));
    last = {found.mask, here, ping.time, shape.volume_m3, (edges & kTouchesEdge) != 0};
  }

  const Sector& sector_;
  const TrackedPropagationParams& params_;
  Geographic origin_;
  Above above_;
  const PropagationObserver& on_step_;
};

}  // namespace

Result<Propagation> propagate_tracked(const PingProvider& pings, const Sector& sector, std::int64_t clicked,
                                      const PingMask& selection, PingReach reach,
                                      const TrackedPropagationParams& params, const PropagationObserver& on_step) {
  if (selection.empty()) return fail(ErrorCode::bad_parameter, "an empty selection cannot be propagated");
  const Result<FilteredPing> start = pings(clicked);
  if (!start) return pass_on(start);
  const View3<const std::int16_t> sv = start->volume->counts.view();
  const double reference_db = db_from_counts(percentile(sv, selection, params.reference_percentile / 100.0));
  const Above above = stands_above(*start, selection, params.margin_db);
  const Follower follower(sector, params, start->placement.transducer, above, on_step);
  Propagation result;
  result.note_backward = follower.follow(pings, clicked, -1, *start, selection, reach, reference_db, result);
  std::reverse(result.pings.begin(), result.pings.end());
  result.pings.push_back({clicked, selection, reference_db - params.tolerance_db});
  if (result.stopped_at) return result;
  result.note_forward = follower.follow(pings, clicked, 1, *start, selection, reach, reference_db, result);
  return result;
}

}  // namespace sonar
