// SPDX-License-Identifier: Apache-2.0
#include "school/side_lobes.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kStep = 4;  ///< samples between two looks: the filter is longer than that

/// What the beams of a mask's fans hear at its ranges, whatever is there.
class FanLevels {
 public:
  /// seabed  whether it counts, as louder than anything
  FanLevels(const IndexBox& box, View3<const std::int16_t> sv, View3<const SampleFlags> flags,
            const DetectParams& params, bool seabed)
      : box_(box), steps_((box.samples() - 1) / kStep + 1) {
    std::vector<std::int16_t> values;
    for (int fan = box.first_fan; fan <= box.last_fan; ++fan) {
      for (int step = 0; step < steps_; ++step) {
        const auto sample = static_cast<std::size_t>(box.first_sample + step * kStep);
        values.clear();
        for (int beam = 0; beam < sv.shape().beams; ++beam) {
          const std::int16_t count = sv.row(fan, beam)[sample];
          const SampleFlags flag = flags.row(fan, beam)[sample];
          if (seabed && any(flag & SampleFlags::seabed)) {
            values.push_back(kMaxCount);
          } else if (count != kNoData && !any(flag & kNeverMember)) {
            values.push_back(count);
          }
        }
        levels_.push_back(quantile(values, sv.shape().beams, params));
      }
    }
  }
  /// The quantile over a fan's open beams; kNoData where too few are.
  [[nodiscard]] int at(int fan, int sample) const {
    const int step = (sample - box_.first_sample) / kStep;
    return levels_[static_cast<std::size_t>((fan - box_.first_fan) * steps_ + step)];
  }

 private:
  static std::int16_t quantile(std::vector<std::int16_t>& values, int beams, const DetectParams& params) {
    if (static_cast<double>(values.size()) < params.side_lobe_known_share * beams || values.empty()) return kNoData;
    const auto last = static_cast<double>(values.size() - 1);
    const auto rank = values.begin() + static_cast<std::ptrdiff_t>(params.side_lobe_share * last);
    std::nth_element(values.begin(), rank, values.end());
    return *rank;
  }

  IndexBox box_;
  int steps_;
  std::vector<std::int16_t> levels_;
};

/// The strongest echo in so many fans of a beam that is the seabed's, or the surface's, at a sample; kNoData = none.
struct Strongest {
  View3<const std::int16_t> counts;
  View3<const SampleFlags> flags;
  SampleFlags what = SampleFlags::none;

  [[nodiscard]] int at(int first_fan, int last_fan, int beam, std::size_t sample) const {
    int most = kNoData;
    for (int fan = std::max(first_fan, 0); fan <= std::min(last_fan, counts.shape().fans - 1); ++fan) {
      if (any(flags.row(fan, beam)[sample] & what)) most = std::max<int>(most, counts.row(fan, beam)[sample]);
    }
    return most;
  }
};

/// Whether a box has part in an outermost fan of the sector, beyond which lies what that fan shows further off.
bool borders_on(const IndexBox& box, bool top, SampleFlags what, const Sector& sector, View3<const SampleFlags> flags) {
  const int last = sector.fans() - 1;
  const int fan = (sector.elevation_rad(0) < sector.elevation_rad(last)) == top ? last : 0;
  if (fan < box.first_fan || fan > box.last_fan) return false;
  for (int beam = box.first_beam; beam <= box.last_beam; ++beam) {
    const auto row = flags.row(fan, beam);
    if (std::any_of(row.begin(), row.end(), [what](SampleFlags f) { return any(f & what); })) return true;
  }
  return false;
}

/// Median of what is known of a mask's looks, dB; otherwise where that is too small a share of them.
double median_db(std::vector<int>& counts, std::size_t looks, double known_share, double otherwise) {
  if (static_cast<double>(counts.size()) < known_share * static_cast<double>(looks) || counts.empty()) return otherwise;
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  return db_from_counts(*middle);
}

/// Calls for every so-manyth voxel of a mask; how many.
template <class Visit>
std::size_t look(const PingMask& mask, Visit&& visit) {
  std::size_t looks = 0;
  for (const Run& run : mask.runs) {
    for (int sample = run.first_sample; sample < run.end(); sample += kStep, ++looks) visit(run.row, sample);
  }
  return looks;
}

}  // namespace

bool is_side_lobe(const PingMask& mask, const IndexBox& box, const Sector& sector, View3<const std::int16_t> sv,
                  View3<const std::int16_t> unfiltered, View3<const SampleFlags> flags, const DetectParams& params) {
  const double rise_db = params.side_lobe_rise_db;
  if (!(rise_db > 0.0)) return false;
  const int beams = sv.shape().beams;
  // A school may fill a narrow sector from side to side.
  if (beams < params.floor_beams) return false;
  const auto stands_out = [&](const FanLevels& levels) {
    std::vector<int> above;
    const std::size_t looks = look(mask, [&](int row, int sample) {
      const int level = levels.at(row / beams, sample);
      if (level != kNoData) above.push_back(sv.row(row)[static_cast<std::size_t>(sample)] - level);
    });
    return median_db(above, looks, params.side_lobe_known_share, rise_db) >= rise_db;
  };
  // Where the sector ends above the seabed, that sets in at other ranges in other beams.
  if (borders_on(box, false, SampleFlags::seabed, sector, flags) &&
      !stands_out(FanLevels(box, sv, flags, params, true))) {
    return true;
  }
  if (stands_out(FanLevels(box, sv, flags, params, false))) return false;
  if (borders_on(box, true, SampleFlags::surface, sector, flags)) return true;
  const auto far_below = [&](const Strongest& strongest, int first_fan, int last_fan) {
    std::vector<int> below;
    const std::size_t looks = look(mask, [&](int row, int sample) {
      const auto s = static_cast<std::size_t>(sample);
      const int most = strongest.at(first_fan, last_fan, row % beams, s);
      if (most != kNoData) below.push_back(most - sv.row(row)[s]);
    });
    return median_db(below, looks, params.side_lobe_known_share, 0.0) >= params.side_lobe_below_db;
  };
  if (far_below({sv, flags, SampleFlags::seabed}, 0, sv.shape().fans - 1)) return true;
  // The surface shuts the topmost fan from close by on, whatever lies far below: only lobes beside the main one count.
  // It is shut before the filter, which gives nothing there.
  const int reach = params.side_lobe_fans;
  return far_below({unfiltered, flags, SampleFlags::surface}, box.first_fan - reach, box.last_fan + reach);
}

}  // namespace sonar
