// SPDX-License-Identifier: Apache-2.0
#include "school/detect.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/check.h"
#include "base/units.h"
#include "model/school.h"
#include "school/candidates.h"
#include "school/edges.h"
#include "school/nadir_ring.h"
#include "school/noise_reach.h"
#include "school/open_floor.h"
#include "school/reverberation.h"
#include "school/seabed_contact.h"
#include "school/settle_members.h"
#include "school/side_lobes.h"
#include "school/wave_front.h"

namespace sonar {
namespace {

using Runs = std::vector<Run>;

IndexBox box_of_runs(const Runs& runs, int beams) {
  PingMask mask;
  mask.runs = runs;
  return box_of(mask, beams);
}

class PingDetector {
 public:
  PingDetector(View3<const std::int16_t> sv, View3<const std::int16_t> unfiltered, View3<const SampleFlags> flags,
               const Sector& sector, const Background& background, const DetectParams& params, const Seabed& seabed,
               const PingMask* taken)
      : sv_(sv),
        unfiltered_(unfiltered),
        flags_(flags),
        sector_(sector),
        background_(background),
        params_(params),
        seabed_(seabed),
        taken_(taken),
        water_(water_levels(sv, flags, background, params)),
        thresholder_(sv, flags, background, water_, taken),
        claimed_(sv.shape()) {}

  std::vector<Detection> run() {
    const Runs candidates = thresholder_.candidates(floor_db(), params_.background_margin_db + kMedianOfMean_db);
    std::vector<std::pair<double, Runs>> components;
    for (Runs& part : connected_parts(candidates, sv_.shape(), params_.connectivity)) {
      if (!worth_a_look(part)) continue;
      const double reference_db = reference(part);
      components.emplace_back(reference_db, std::move(part));
    }
    // strongest first: where two reach for the same voxel it is the skirt of the stronger
    std::stable_sort(components.begin(), components.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [reference_db, component] : components) refine(component, reference_db);
    std::sort(found_.begin(), found_.end(),
              [](const Detection& a, const Detection& b) { return a.mask.runs.front() < b.mask.runs.front(); });
    return std::move(found_);
  }

 private:
  [[nodiscard]] double floor_db() const { return params_.floor_db + kMedianOfMean_db; }

  /// The heart that stands above the candidates' threshold may be much smaller than the school.
  [[nodiscard]] bool worth_a_look(const Runs& runs) const {
    int voxels = 0;
    for (const Run& run : runs) voxels += run.count;
    return voxels >= params_.min_samples;
  }

  [[nodiscard]] bool large_enough(const Runs& runs) const {
    if (runs.empty()) return false;
    const IndexBox box = box_of_runs(runs, sv_.shape().beams);
    const double range_m = box.samples() * sector_.range().spacing_m;
    return box.fans() >= params_.min_fans && box.beams() >= params_.min_beams && box.samples() >= params_.min_samples &&
           range_m >= params_.min_range_m;
  }

  /// The percentile of the values within the tolerance of itself: what the candidate threshold let in does not count.
  [[nodiscard]] double reference(const Runs& runs) const {
    PingMask mask;
    mask.runs = runs;
    for (const Run& run : runs) mask.confidence.resize(mask.confidence.size() + static_cast<std::size_t>(run.count), 1);
    const std::int16_t first = percentile(sv_, mask, params_.reference_percentile / 100.0);
    if (first == kNoData) return -1000.0;
    const double lowest = first - counts_from_db(params_.tolerance_db);
    std::vector<std::int16_t> values;
    for (const Run& run : runs) {
      const auto counts = sv_.row(run.row);
      for (int s = run.first_sample; s < run.end(); ++s) {
        const std::int16_t count = counts[static_cast<std::size_t>(s)];
        if (count >= lowest) values.push_back(count);
      }
    }
    const double rank = std::ceil(params_.reference_percentile / 100.0 * static_cast<double>(values.size()));
    const auto k = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
    std::nth_element(values.begin(), values.begin() + k, values.end());
    return db_from_counts(values[static_cast<std::size_t>(k)]);
  }

  /// Finds the component's own school, then steps down: what hangs together and holds no school yet may be one.
  void refine(const Runs& component, double reference_db) {
    const IndexBox box = box_of_runs(component, sv_.shape().beams)
                             .enlarged(params_.search_fans, params_.search_beams, params_.search_samples)
                             .clipped(sv_.shape());
    const double own_level_db = reference_db - params_.tolerance_db - params_.link_db;
    // a stronger neighbour's skirt may reach this far down: then the school is what stands out of it
    for (double level_db = own_level_db; level_db <= reference_db - params_.min_prominence_db;
         level_db += params_.step_db) {
      if (search(component, box, level_db)) break;
    }
    const double lowest_db = lowest(component);
    for (double level_db = own_level_db - params_.step_db; level_db > lowest_db - params_.step_db;
         level_db -= params_.step_db) {
      search(component, box, level_db);
    }
  }

  bool search(const Runs& component, const IndexBox& box, double level_db) {
    bool found = false;
    for (const Runs& part : connected_parts(thresholder_.above(box, level_db, params_.background_rest_db), sv_.shape(),
                                            params_.connectivity)) {
      if (large_enough(part) && share_a_voxel(part, component)) found = consider(part, level_db) || found;
    }
    return found;
  }

  [[nodiscard]] double lowest(const Runs& runs) const {
    int count = kMaxCount;
    for (const Run& run : runs) {
      const auto counts = sv_.row(run.row);
      for (int s = run.first_sample; s < run.end(); ++s) {
        count = std::min(count, int{counts[static_cast<std::size_t>(s)]});
      }
    }
    return db_from_counts(count);
  }

  /// Takes a part for a school where it holds none yet and stands out; whether it was taken.
  bool consider(const Runs& part, double level_db) {
    for (const Run& run : part) {
      const auto claimed = claimed_.view().row(run.row);
      for (int s = run.first_sample; s < run.end(); ++s) {
        if (claimed[static_cast<std::size_t>(s)] != 0) return false;
      }
    }
    const double reference_db = reference(part);
    if (reference_db < std::max(level_db + params_.min_prominence_db, floor_db())) return false;
    // A weak school beside a stronger one stands no deeper below its own top than where the two part.
    const double depth_db = std::min(params_.tolerance_db, reference_db - level_db);
    std::vector<MemberSettler::Settled> schools = settled(part, reference_db, depth_db);
    // The filtered data show edges more evenly than one beam does.
    if (schools.size() == 1) {
      const PingMask filtered = by_filtered(part, reference_db, depth_db).mask;
      if (is_wave_front(filtered, box_of(filtered, sv_.shape().beams), sector_, params_)) schools.clear();
    }
    for (MemberSettler::Settled& school : schools) {
      PingMask free = free_of_seabed(std::move(school.mask), sv_, flags_, params_, seabed_.open);
      Detection detection = describe_mask(std::move(free), flags_, sector_);
      detection.reference_db = school.reference_db;
      detection.threshold_db = school.threshold_db;
      if (believable(detection)) found_.push_back(std::move(detection));
    }
    for (const Run& run : part) {
      const auto claimed = claimed_.view().row(run.row).subspan(static_cast<std::size_t>(run.first_sample),
                                                                static_cast<std::size_t>(run.count));
      std::fill(claimed.begin(), claimed.end(), std::uint8_t{1});
    }
    return true;
  }

  std::vector<MemberSettler::Settled> settled(const Runs& part, double reference_db, double depth_db) {
    if (params_.member_samples == 0) return {by_filtered(part, reference_db, depth_db)};
    // Most pings hold no school.
    if (!settler_) settler_.emplace(sv_, unfiltered_, flags_, background_, water_, params_, taken_);
    return settler_->settle(
        part, depth_db, [this](const Runs& runs) { return large_enough(runs); }, claimed_.view());
  }

  [[nodiscard]] MemberSettler::Settled by_filtered(const Runs& part, double reference_db, double depth_db) const {
    const MemberTable table = MemberTable::one_sided(reference_db, depth_db);
    PingMask mask;
    for (const Run& run : part) {
      const auto counts = sv_.row(run.row);
      bool open = false;
      for (int s = run.first_sample; s < run.end(); ++s) {
        const std::int16_t count = counts[static_cast<std::size_t>(s)];
        const bool inside = table(count) != 0;
        if (inside) {
          if (!open) mask.runs.push_back({run.row, s, 0});
          ++mask.runs.back().count;
          mask.confidence.push_back(table(count));
        }
        open = inside;
      }
    }
    return {std::move(mask), reference_db, reference_db - depth_db};
  }

  [[nodiscard]] bool believable(const Detection& detection) const {
    if (detection.mask.empty() || !large_enough(detection.mask.runs)) return false;
    if (!(detection.volume_m3 > 0.0)) return false;
    std::size_t faulty = 0;
    for (const Run& run : detection.mask.runs) {
      const auto flags = flags_.row(run.row);
      for (int s = run.first_sample; s < run.end(); ++s) {
        if (any(flags[static_cast<std::size_t>(s)] & kFault)) ++faulty;
      }
    }
    const auto voxels = static_cast<double>(detection.mask.voxels());
    if (static_cast<double>(faulty) > params_.max_flagged_members * voxels) return false;
    const MaskEdges edges = mask_edges(detection.mask, flags_, sector_);
    if (edges.boundary_fraction > params_.max_boundary_faces) return false;
    if (edges.seabed_fraction > max_seabed_faces(detection.mask)) return false;
    if (edges.seabed_fraction > 0.0 && rises_to_seabed(detection.mask, sv_, flags_, params_, seabed_.open))
      return false;
    return !is_shell(detection) && !is_open_floor(detection, sector_, sv_, flags_, params_) &&
           !is_wave_front(detection.mask, detection.box, sector_, params_) &&
           !is_side_lobe(detection.mask, detection.box, sector_, sv_, unfiltered_, flags_, params_) &&
           !is_nadir_ring(detection.mask, detection.box, seabed_, sector_, sv_, flags_, background_, params_);
  }

  /// Of what stands out of the seabed's flank all faces may lie at what is left of that.
  [[nodiscard]] double max_seabed_faces(const PingMask& mask) const {
    if (seabed_.open.empty()) return params_.max_seabed_faces;
    double freed = 0.0;
    for (const Run& run : mask.runs) {
      if (!seabed_.open[static_cast<std::size_t>(run.row)].empty()) freed += run.count;
    }
    const double share = freed / static_cast<double>(mask.voxels());
    return params_.max_seabed_faces + (1.0 - params_.max_seabed_faces) * share;
  }

  /// A wall at constant range: all beams, thin, and flat.
  [[nodiscard]] bool is_shell(const Detection& detection) const {
    const double spacing_m = sector_.range().spacing_m;
    const double mean_run_m =
        static_cast<double>(detection.mask.voxels()) / static_cast<double>(detection.mask.runs.size()) * spacing_m;
    return detection.box.beams() >= params_.shell_share * sector_.beams() &&
           mean_run_m < params_.max_shell_thickness_m &&
           detection.box.samples() * spacing_m < params_.shell_bend * params_.max_shell_thickness_m;
  }

  View3<const std::int16_t> sv_;
  View3<const std::int16_t> unfiltered_;
  View3<const SampleFlags> flags_;
  const Sector& sector_;
  const Background& background_;
  const DetectParams& params_;
  const Seabed& seabed_;
  const PingMask* taken_;
  WaterLevels water_;
  Thresholder thresholder_;
  std::optional<MemberSettler> settler_;
  Array3<std::uint8_t> claimed_;  ///< voxels of components that have had their school
  std::vector<Detection> found_;
};

}  // namespace

std::vector<Detection> detect(View3<const std::int16_t> sv, View3<const std::int16_t> unfiltered,
                              View3<const SampleFlags> flags, const Sector& sector, const Background& background,
                              const DetectParams& params, const Seabed& seabed, const PingMask* taken) {
  SONAR_CHECK(seabed.open.empty() || seabed.open.size() == sv.shape().rows());
  SONAR_CHECK(sv.shape() == flags.shape() && sv.shape() == unfiltered.shape());
  SONAR_CHECK(sv.shape().fans == sector.fans() && sv.shape().beams == sector.beams() &&
              sv.shape().samples == sector.range().count);
  return PingDetector(sv, unfiltered, flags, sector, background, params, seabed, taken).run();
}

WaterLevels water_levels(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& noise,
                         const DetectParams& params) {
  if (noise.water != nullptr) return *noise.water;
  WaterLevels water;
  water.reverberation = reverberation_counts(sv, flags, noise, params);
  if (params.noise_sigmas > 0.0) water.noise_reach = noise_reach(sv, flags, noise, water.reverberation, params);
  return water;
}

Detection describe_mask(PingMask mask, View3<const SampleFlags> flags, const Sector& sector) {
  Detection d;
  d.box = box_of(mask, sector.beams());
  const MaskShape shape = shape_of(mask, sector);
  d.centre = shape.centre;
  d.covariance = shape.covariance;
  d.volume_m3 = shape.volume_m3;
  d.edge_flags = mask_edges(mask, flags, sector).flags;
  d.mask = std::move(mask);
  return d;
}

}  // namespace sonar
