// SPDX-License-Identifier: Apache-2.0
#include "school/detect/detect.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/check.h"
#include "base/units.h"
#include "model/school.h"
#include "school/detect/settle_members.h"
#include "school/detect/thresholder.h"
#include "school/evidence/seeds.h"
#include "school/grow/grow.h"
#include "school/judge/judges.h"
#include "school/measure/edges.h"

namespace sonar {
namespace {

using Runs = std::vector<Run>;

constexpr double kReferenceShare = 0.9;       ///< of a candidate lies below its reference
constexpr double kLink_db = 3.0;              ///< parts joined by echo this far below the threshold are one school
constexpr double kStep_db = 3.0;              ///< in which weaker schools beside a strong one are sought
constexpr double kSearchAboveWater_db = 1.5;  ///< where members are sought

IndexBox box_of_runs(const Runs& runs, int beams) {
  PingMask mask;
  mask.runs = runs;
  return box_of(mask, beams);
}

class PingDetector {
 public:
  PingDetector(const PingEcho& echo, const DetectParams& params, const PingMask* taken)
      : echo_(echo),
        params_(params),
        taken_(taken),
        thresholder_(echo.sv, echo.flags, echo.background, &echo.water, taken),
        claimed_(echo.sv.shape()) {}

  std::vector<Detection> run(std::vector<RefusedDetection>* refused) {
    const Runs seeds = seed_runs(echo_.water, echo_.sv.shape());
    std::vector<std::pair<double, Runs>> components;
    for (Runs& part : connected_parts(seeds, echo_.sv.shape(), Connectivity::faces)) {
      const double reference_db = reference(part);
      components.emplace_back(reference_db, std::move(part));
    }
    // strongest first: where two reach for the same voxel it is the skirt of the stronger
    std::stable_sort(components.begin(), components.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [reference_db, component] : components) {
      refusal_.reset();
      if (!refine(component, reference_db) && refused != nullptr) tell_refusal(component, reference_db, *refused);
    }
    std::sort(found_.begin(), found_.end(),
              [](const Detection& a, const Detection& b) { return a.mask.runs.front() < b.mask.runs.front(); });
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::optional<Reason> size_of(const Runs& runs) const {
    Detection part;
    part.box = box_of_runs(runs, echo_.sv.shape().beams);
    return ask(kSizeJudge, params_, echo_, part);
  }
  [[nodiscard]] bool large_enough(const Runs& runs) const { return !runs.empty() && !size_of(runs); }

  /// Remembers why the largest part of a component was refused.
  void refuse(const Runs& part, const Reason& reason) {
    std::int64_t voxels = 0;
    for (const Run& run : part) voxels += run.count;
    if (refusal_ && refusal_->voxels >= voxels) return;
    refusal_ = {voxels, part, reason};
  }

  /// Faint echo is what the false-alarm rate leaves out, and is not told; nor is what went with a school.
  void tell_refusal(const Runs& component, double reference_db, std::vector<RefusedDetection>& refused) const {
    PingMask whole{component, {}};
    const double evidence = evidence_of(whole, echo_.water);
    if (evidence < clear_evidence(params_) || !refusal_) return;
    PingMask mask{refusal_->part, {}};
    std::size_t voxels = 0;
    for (const Run& run : mask.runs) voxels += static_cast<std::size_t>(run.count);
    mask.confidence.assign(voxels, 255);
    Detection detection = describe_mask(std::move(mask), echo_.flags, echo_.sector);
    detection.reference_db = reference_db;
    detection.evidence = evidence;
    detection.loudest = loudest(detection.mask.runs);
    refused.push_back({std::move(detection), refusal_->reason});
  }

  /// The percentile of the values within the tolerance of itself: what the seeds' blocks let in does not count.
  [[nodiscard]] double reference(const Runs& runs) const {
    std::vector<std::int16_t> values;
    for (const Run& run : runs) {
      const auto counts = echo_.sv.row(run.row);
      for (int s = run.first_sample; s < run.end(); ++s) {
        const std::int16_t count = counts[static_cast<std::size_t>(s)];
        if (count != kNoData) values.push_back(count);
      }
    }
    if (values.empty()) return -1000.0;
    const auto high = [&] {
      const double rank = std::ceil(kReferenceShare * static_cast<double>(values.size()));
      const auto k = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
      std::nth_element(values.begin(), values.begin() + k, values.end());
      return values[static_cast<std::size_t>(k)];
    };
    const double lowest = high() - counts_from_db(params_.tolerance_db);
    std::erase_if(values, [lowest](std::int16_t value) { return value < lowest; });
    return db_from_counts(high());
  }

  /// Finds the component's own school, then steps down: what hangs together and holds no school yet may be one.
  /// out  whether it found one, or the component belongs to one that was found before
  bool refine(const Runs& component, double reference_db) {
    held_ = false;
    const IndexBox box = box_of_runs(component, echo_.sv.shape().beams)
                             .enlarged(SearchReach::fans, SearchReach::beams, SearchReach::samples)
                             .clipped(echo_.sv.shape());
    const double own_level_db = reference_db - params_.tolerance_db - kLink_db;
    // a stronger neighbour's skirt may reach this far down: then the school is what rises above it
    for (double level_db = own_level_db; level_db <= reference_db - kLeastProminence_db; level_db += kStep_db) {
      if (search(component, box, level_db)) break;
    }
    const double lowest_db = lowest(component);
    for (double level_db = own_level_db - kStep_db; level_db > lowest_db - kStep_db; level_db -= kStep_db) {
      search(component, box, level_db);
    }
    return held_;
  }

  bool search(const Runs& component, const IndexBox& box, double level_db) {
    bool found = false;
    for (const Runs& part : connected_parts(thresholder_.above(box, level_db, kSearchAboveWater_db), echo_.sv.shape(),
                                            Connectivity::faces)) {
      if (!share_a_voxel(part, component)) continue;
      if (const auto reason = size_of(part)) {
        refuse(part, *reason);
      } else {
        found = consider(part, level_db) || found;
      }
    }
    return found;
  }

  [[nodiscard]] double lowest(const Runs& runs) const {
    int count = kMaxCount;
    for (const Run& run : runs) {
      const auto counts = echo_.sv.row(run.row);
      for (int s = run.first_sample; s < run.end(); ++s) {
        const int here = counts[static_cast<std::size_t>(s)];
        if (here != kNoData) count = std::min(count, here);
      }
    }
    return db_from_counts(count);
  }

  /// Takes a part for a school where it holds none yet and lies above the background; whether it was taken.
  bool consider(const Runs& part, double level_db) {
    for (const Run& run : part) {
      const auto claimed = claimed_.view().row(run.row);
      for (int s = run.first_sample; s < run.end(); ++s) {
        if (claimed[static_cast<std::size_t>(s)] == 0) continue;
        held_ = true;
        return false;
      }
    }
    const double reference_db = reference(part);
    Detection found;
    found.reference_db = reference_db;
    found.threshold_db = level_db;
    if (const auto reason = ask(kProminenceJudge, params_, echo_, found)) {
      refuse(part, *reason);
      return false;
    }
    // A weak school beside a stronger one stands no deeper below its own top than where the two part.
    const double depth_db = std::min(params_.tolerance_db, reference_db - level_db);
    // Most pings hold no school.
    if (!settler_) {
      settler_.emplace(echo_.sv, echo_.unfiltered, echo_.flags, echo_.background, echo_.water, params_.tolerance_db,
                       echo_.peaked, taken_);
    }
    std::vector<MemberSettler::Settled> schools = settler_->settle(
        part, depth_db, [this](const Runs& runs) { return large_enough(runs); }, claimed_.view());
    for (MemberSettler::Settled& school : schools) {
      Detection detection = describe_mask(std::move(school.mask), echo_.flags, echo_.sector);
      detection.reference_db = school.reference_db;
      detection.threshold_db = school.threshold_db;
      detection.evidence = evidence_of(detection.mask, echo_.water);
      take(std::move(detection));
    }
    for (const Run& run : part) {
      const auto claimed = claimed_.view().row(run.row).subspan(static_cast<std::size_t>(run.first_sample),
                                                                static_cast<std::size_t>(run.count));
      std::fill(claimed.begin(), claimed.end(), std::uint8_t{1});
    }
    return true;
  }

  [[nodiscard]] Run loudest(const Runs& runs) const {
    Run at{runs.front().row, runs.front().first_sample, 1};
    int most = kNoData;
    for (const Run& run : runs) {
      const auto counts = echo_.sv.row(run.row);
      for (int s = run.first_sample; s < run.end(); ++s) {
        if (counts[static_cast<std::size_t>(s)] <= most) continue;
        most = counts[static_cast<std::size_t>(s)];
        at = {run.row, s, 1};
      }
    }
    return at;
  }

  void take(Detection detection) {
    if (detection.mask.empty() || !(detection.volume_m3 > 0.0)) return;
    if (const auto reason = ask(kSizeJudge, params_, echo_, detection)) {
      refuse(detection.mask.runs, *reason);
    } else if (detection.evidence >= kLeastEvidence) {
      held_ = true;
      detection.loudest = loudest(detection.mask.runs);
      detection.pieces =
          echo_pieces(echo_, thresholder_, detection.box, detection.reference_db, detection.threshold_db);
      found_.push_back(std::move(detection));
    }
  }

  const PingEcho& echo_;
  const DetectParams& params_;
  const PingMask* taken_;
  Thresholder thresholder_;
  std::optional<MemberSettler> settler_;
  Array3<std::uint8_t> claimed_;  ///< voxels of components that have had their school
  std::vector<Detection> found_;
  struct Refusal {
    std::int64_t voxels = 0;
    Runs part;
    Reason reason;
  };
  std::optional<Refusal> refusal_;  ///< of the component in hand
  bool held_ = false;               ///< it has its school, or is another's
};

}  // namespace

std::vector<Detection> detect(const PingEcho& echo, const DetectParams& params, const PingMask* taken,
                              std::vector<RefusedDetection>* refused) {
  SONAR_CHECK(echo.sv.shape() == echo.flags.shape() && echo.sv.shape() == echo.unfiltered.shape());
  return PingDetector(echo, params, taken).run(refused);
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
