// SPDX-License-Identifier: Apache-2.0
#include "school/track/steady_masks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/units.h"
#include "school/grow/grow.h"
#include "school/runs.h"
#include "school/track/looks.h"

namespace sonar {
namespace {

constexpr int kPiece = EchoPieces::kSamples;
/// The strongest echo that a school would show without fading lies so far above this share of its mask's: told by two
/// simulators, whose truth knows it.
constexpr double kReferenceShare = 0.95;
constexpr double kReferenceAbove_db = 1.7;

/// Mean of each piece and of those beside it along range.
void smooth(Array3<float>& sv) {
  std::vector<float> line;
  for (int row = 0; row < static_cast<int>(sv.shape().rows()); ++row) {
    const auto values = sv.view().row(row);
    line.assign(values.begin(), values.end());
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (std::isnan(line[i])) continue;
      float sum = 0.0F;
      float number = 0.0F;
      for (std::size_t k = i == 0 ? 0 : i - 1; k < std::min(line.size(), i + 2); ++k) {
        if (std::isnan(line[k])) continue;
        sum += line[k];
        number += 1.0F;
      }
      values[i] = sum / number;
    }
  }
}

/// What a mask's echo is measured by, m^-1; 0 where it has none.
double reference_sv(const MeanEcho& mean, const PingMask& mask, int beams) {
  std::vector<float> within;
  for (const Run& run : mask.runs) {
    for (int s = run.first_sample; s < run.end(); s += kPiece) {
      const float own = mean.own_at(run.row / beams, run.row % beams, s);
      if (!std::isnan(own)) within.push_back(own);
    }
  }
  if (within.empty()) return 0.0;
  const auto rank = static_cast<std::ptrdiff_t>(kReferenceShare * static_cast<double>(within.size() - 1));
  std::nth_element(within.begin(), within.begin() + rank, within.end());
  return static_cast<double>(within[static_cast<std::size_t>(rank)]) * linear_from_db(kReferenceAbove_db);
}

/// Runs of the pieces that are as loud as that and as the background.
std::vector<Run> runs_above(const MeanEcho& mean, double least_sv, int beams) {
  std::vector<Run> runs;
  for (int f = 0; f < mean.box.fans(); ++f) {
    for (int b = 0; b < mean.box.beams(); ++b) {
      const int row = (mean.box.first_fan + f) * beams + mean.box.first_beam + b;
      for (int i = 0; i < mean.own_sv.shape().samples; ++i) {
        const float own = mean.own_sv(f, b, i);
        if (!(static_cast<double>(own) >= least_sv && own >= mean.water_sv(f, b, i))) continue;
        const int first = mean.box.first_sample + i * kPiece;
        const int count = std::min(kPiece, mean.box.last_sample + 1 - first);
        if (!runs.empty() && runs.back().row == row && runs.back().end() == first) {
          runs.back().count += count;
        } else {
          runs.push_back({row, first, count});
        }
      }
    }
  }
  return runs;
}

/// A mask of runs that are alike confident.
PingMask plain(std::vector<Run> runs) {
  PingMask mask{std::move(runs), {}};
  std::size_t voxels = 0;
  for (const Run& run : mask.runs) voxels += static_cast<std::size_t>(run.count);
  mask.confidence.assign(voxels, 255);
  return mask;
}

/// Of the runs those that hang together with a mask.
std::vector<Run> beside_mask(const std::vector<Run>& runs, const PingMask& mask, const Shape3& shape) {
  const Components parts = label_runs(runs, shape, Connectivity::faces);
  const std::vector<int> first = index_rows(mask.runs, shape.rows());
  std::vector<bool> holds(static_cast<std::size_t>(parts.count), false);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto row = static_cast<std::size_t>(runs[i].row);
    const auto meets = [&](const Run& other) {
      return other.first_sample < runs[i].end() && runs[i].first_sample < other.end();
    };
    if (std::any_of(mask.runs.begin() + first[row], mask.runs.begin() + first[row + 1], meets)) {
      holds[static_cast<std::size_t>(parts.label[i])] = true;
    }
  }
  std::vector<Run> kept;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (holds[static_cast<std::size_t>(parts.label[i])]) kept.push_back(runs[i]);
  }
  return kept;
}

void set_confidence(PingMask& mask, const MeanEcho& mean, double reference_db, double tolerance_db, int beams) {
  const MemberTable table = MemberTable::one_sided(reference_db, tolerance_db);
  auto confidence = mask.confidence.begin();
  for (const Run& run : mask.runs) {
    for (int s = run.first_sample; s < run.end(); ++s) {
      const double own_db = db_from_linear(static_cast<double>(mean.own_at(run.row / beams, run.row % beams, s)));
      const double counts = std::clamp(counts_from_db(own_db), double{kMinCount}, double{kMaxCount});
      *confidence++ = std::max<std::uint8_t>(1, table(static_cast<std::int16_t>(std::lround(counts))));
    }
  }
}

class Steadying {
 public:
  Steadying(std::vector<SchoolTrack>& schools, std::span<const DetectedPing> pings, const Sector& sector,
            double tolerance_db)
      : schools_(schools), pings_(pings), sector_(sector), tolerance_db_(tolerance_db) {
    for (std::size_t k = 0; k < schools.size(); ++k) {
      for (std::size_t i = 0; i < schools[k].pings.size(); ++i)
        of_ping_[schools[k].pings[i].ping_index].push_back({k, i});
    }
  }

  void run() {
    for (std::size_t k = 0; k < schools_.size(); ++k) {
      const std::vector<Look> looks = looks_of(schools_[k], pings_, sector_);
      const auto velocity = velocity_mps(looks);
      if (!velocity) continue;
      for (std::size_t i = 0; i < looks.size(); ++i) {
        const std::vector<Neighbour> neighbours = neighbours_of(looks, i);
        if (looks[i].pieces.empty() || neighbours.empty()) continue;
        MeanEcho mean = mean_echo(looks[i], neighbours, *velocity, sector_);
        smooth(mean.own_sv);
        settle(k, i, looks[i].mask, mean);
      }
    }
  }

 private:
  void settle(std::size_t school, std::size_t sighting, const PingMask& mask, const MeanEcho& mean) {
    const int beams = sector_.beams();
    const double reference = reference_sv(mean, mask, beams);
    if (!(reference > 0.0)) return;
    const double least_sv = reference * linear_from_db(-tolerance_db_);
    TrackedDetection& seen = schools_[school].pings[sighting];
    const PingMask free = subtract(plain(runs_above(mean, least_sv, beams)), of_others(school, seen.ping_index));
    PingMask kept = plain(beside_mask(free.runs, mask, {sector_.fans(), beams, sector_.range().count}));
    if (kept.empty()) return;
    set_confidence(kept, mean, db_from_linear(reference), tolerance_db_, beams);
    seen.part = std::move(kept);
    seen.threshold_db = db_from_linear(least_sv);
  }

  [[nodiscard]] PingMask of_others(std::size_t school, std::int64_t ping_index) const {
    PingMask others;
    for (const auto& [k, i] : of_ping_.at(ping_index)) {
      if (k != school) others = unite(others, mask_of(schools_[k].pings[i], *ping_of(pings_, ping_index)));
    }
    return others;
  }

  std::vector<SchoolTrack>& schools_;
  std::span<const DetectedPing> pings_;
  const Sector& sector_;
  double tolerance_db_;
  std::map<std::int64_t, std::vector<std::pair<std::size_t, std::size_t>>> of_ping_;  ///< (school, its sighting)
};

}  // namespace

void steady_masks(std::vector<SchoolTrack>& schools, std::span<const DetectedPing> pings, const Sector& sector,
                  double tolerance_db) {
  Steadying(schools, pings, sector, tolerance_db).run();
}

}  // namespace sonar
