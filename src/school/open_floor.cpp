// SPDX-License-Identifier: Apache-2.0
#include "school/open_floor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

struct Water {
  const Sector& sector;
  View3<const std::int16_t> sv;
  View3<const SampleFlags> flags;
  const DetectParams& params;
};

/// Share of a fan's sound beams that reach a level from a sample on.
double share_loud_at_end(const Water& water, int fan, int from, double level_db) {
  const double level = counts_from_db(level_db);
  int sound = 0;
  int loud = 0;
  for (int beam = 0; beam < water.sector.beams(); ++beam) {
    const auto counts = water.sv.row(fan * water.sector.beams() + beam).subspan(static_cast<std::size_t>(from));
    const auto flags = water.flags.row(fan * water.sector.beams() + beam).subspan(static_cast<std::size_t>(from));
    bool any_sound = false;
    bool any_loud = false;
    for (std::size_t s = 0; s < counts.size(); ++s) {
      if (any(flags[s] & (kFault | SampleFlags::surface))) continue;
      any_sound = true;
      any_loud = any_loud || counts[s] >= level;
    }
    sound += any_sound ? 1 : 0;
    loud += any_loud ? 1 : 0;
  }
  return sound > 0 ? static_cast<double>(loud) / sound : 0.0;
}

/// Whether most sound beams of a fan and of each below it reach a level from a sample on.
bool loud_down_from(const Water& water, int fan, int from, double level_db) {
  const int top = water.sector.fans() - 1;
  const int down = water.sector.elevation_rad(0) <= water.sector.elevation_rad(top) ? -1 : 1;
  for (; fan >= 0 && fan <= top; fan += down) {
    if (share_loud_at_end(water, fan, from, level_db) < water.params.cut_off_share) return false;
  }
  return true;
}

/// Reaches the record's end in a fan of which most beams are as loud there, and so are those of all fans below it: faulty
/// beams may cut the seabed to pieces, but there is no water under it, as there is under a wide school.
bool is_cut_off(const Water& water, const Detection& detection) {
  const int samples = water.sv.shape().samples;
  const int cut_off =
      std::max(water.params.record_end_samples, static_cast<int>(water.params.record_end_share * samples));
  const int end = std::max(0, samples - cut_off);
  // A faint school's threshold may lie in the noise, which all beams reach.
  const double loud_db = std::max(detection.threshold_db, detection.reference_db - water.params.min_prominence_db);
  int judged = -1;
  for (const Run& run : detection.mask.runs) {
    const int fan = run.row / water.sector.beams();
    if (run.end() < end || fan == judged) continue;
    judged = fan;
    if (loud_down_from(water, fan, end, loud_db)) return true;
  }
  return false;
}

bool lowest_fan_is_flat(const Water& water, const PingMask& mask) {
  const int top = water.sector.fans() - 1;
  const int lowest_fan = water.sector.elevation_rad(0) <= water.sector.elevation_rad(top) ? 0 : top;
  std::vector<double> sum(static_cast<std::size_t>(water.sector.beams()), 0.0);
  std::vector<double> count(sum.size(), 0.0);
  for (const Run& run : mask.runs) {
    if (run.row / water.sector.beams() != lowest_fan) continue;
    const auto beam = static_cast<std::size_t>(run.row % water.sector.beams());
    const int middle = run.first_sample + run.count / 2;
    sum[beam] += run.count * water.sector.range().range_m(middle);
    count[beam] += run.count;
  }
  std::vector<double> ranges_m;
  for (std::size_t beam = 0; beam < sum.size(); ++beam) {
    if (count[beam] > 0.0) ranges_m.push_back(sum[beam] / count[beam]);
  }
  const double wanted = water.params.shell_share * water.sector.beams();
  if (ranges_m.empty() || static_cast<double>(ranges_m.size()) < wanted) return false;
  std::sort(ranges_m.begin(), ranges_m.end());
  const double middle_m = ranges_m[ranges_m.size() / 2];
  const auto near = std::count_if(ranges_m.begin(), ranges_m.end(), [&](double r) {
    return std::abs(r - middle_m) <= water.params.floor_flat_share * middle_m;
  });
  return static_cast<double>(near) >= wanted;
}

}  // namespace

bool is_open_floor(const Detection& detection, const Sector& sector, View3<const std::int16_t> sv,
                   View3<const SampleFlags> flags, const DetectParams& params) {
  if (sector.beams() < params.floor_beams) return false;
  const Water water{sector, sv, flags, params};
  return is_cut_off(water, detection) ||
         (detection.box.beams() >= params.shell_share * sector.beams() &&
          detection.reference_db >= params.floor_echo_db && lowest_fan_is_flat(water, detection.mask));
}

}  // namespace sonar
