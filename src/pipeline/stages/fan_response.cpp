// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/fan_response.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "base/units.h"
#include "pipeline/stages/voxel_statistics.h"
#include "school/runs.h"

namespace sonar {
namespace {

constexpr std::size_t kLeastPings = 4;  ///< of which quartiles are told

constexpr std::uint8_t kSure = 255;

double db_or_unknown(double linear) { return linear > 0.0 ? db_from_linear(linear) : kUnknown; }

void add_run(const Run& run, PingMask& mask) {
  mask.runs.push_back(run);
  mask.confidence.insert(mask.confidence.end(), static_cast<std::size_t>(run.count), kSure);
}

/// The mask's runs, fan by fan; a mask's runs are sorted by row.
std::map<int, PingMask> by_fan(const PingMask& mask, int beams) {
  std::map<int, PingMask> fans;
  for (const Run& run : mask.runs) add_run(run, fans[run.row / beams]);
  return fans;
}

/// Marks what of a fan's rows is taken; [beam][sample].
class Taken {
 public:
  explicit Taken(const Sector& sector) : beams_(sector.beams()), samples_(sector.range().count) {
    taken_.resize(static_cast<std::size_t>(beams_) * static_cast<std::size_t>(samples_));
  }
  void take(int beam, int first, int end) {
    if (beam < 0 || beam >= beams_) return;
    const std::size_t row = static_cast<std::size_t>(beam) * static_cast<std::size_t>(samples_);
    for (int s = std::max(0, first); s < std::min(samples_, end); ++s) taken_[row + static_cast<std::size_t>(s)] = true;
  }
  [[nodiscard]] bool operator()(int beam, int sample) const {
    return taken_[static_cast<std::size_t>(beam) * static_cast<std::size_t>(samples_) +
                  static_cast<std::size_t>(sample)];
  }

 private:
  int beams_;
  int samples_;
  std::vector<bool> taken_;
};

/// The free samples of a row, first .. end - 1, as runs.
void add_free(int row, int first, int end, const Taken& taken, std::span<const std::int16_t> counts,
              std::span<const SampleFlags> flags, int beams, PingMask& out) {
  const auto free = [&](int s) {
    const auto i = static_cast<std::size_t>(s);
    return !taken(row % beams, s) && counts[i] != kNoData && !any(flags[i] & kNotFiltered);
  };
  for (int s = first; s < end; ++s) {
    if (!free(s)) continue;
    int stop = s + 1;
    while (stop < end && free(stop)) ++stop;
    add_run({row, s, stop - s}, out);
    s = stop;
  }
}

}  // namespace

std::vector<HeardFan> heard_fans(const PingMask& mask, const StagedPing& ping, const Sector& sector) {
  std::vector<HeardFan> out;
  for (const auto& [fan, in_fan] : by_fan(mask, sector.beams())) {
    const EchoStatistics echo = echo_of(in_fan, ping, sector);
    if (echo.heard == 0) continue;
    out.push_back({fan, echo.heard, echo.heard_m3, echo.mean_sv_per_m});
  }
  return out;
}

PingMask water_round(const PingMask& school, std::span<const PingMask* const> schools, const StagedPing& ping,
                     const Sector& sector, const WaterRound& reach) {
  const double spacing_m = sector.range().spacing_m;
  const int further = static_cast<int>(std::lround(reach.range_m / spacing_m));
  const int gap = static_cast<int>(std::lround(reach.gap_m / spacing_m));
  const int beams = sector.beams();
  PingMask out;
  for (const auto& [fan, in_fan] : by_fan(school, beams)) {
    Taken taken(sector);
    const auto take = [&](const PingMask& mask) {
      for (const Run& run : mask.runs) {
        if (run.row / beams != fan) continue;
        for (int beam = run.row % beams - reach.gap_beams; beam <= run.row % beams + reach.gap_beams; ++beam) {
          taken.take(beam, run.first_sample - gap, run.end() + gap);
        }
      }
    };
    take(in_fan);
    for (const PingMask* other : schools) take(*other);
    const Shape3 shape{sector.fans(), beams, sector.range().count};
    const IndexBox box = box_of(in_fan, beams).enlarged(0, reach.beams, further).clipped(shape);
    for (int beam = box.first_beam; beam <= box.last_beam; ++beam) {
      const int row = fan * beams + beam;
      // The flags of filtered Sv tell of the seabed's beam-edge echo as well.
      add_free(row, box.first_sample, box.last_sample + 1, taken, ping.sv.counts.view().row(row),
               ping.filtered->flags.view().row(row), beams, out);
    }
  }
  return out;
}

std::vector<FanResponse> fan_response(std::span<const std::vector<HeardFan>> pings) {
  std::map<int, std::vector<HeardFan>> fans;
  for (const auto& ping : pings) {
    for (const HeardFan& echo : ping) fans[echo.fan].push_back(echo);
  }
  std::vector<FanResponse> out;
  for (const auto& [fan, echoes] : fans) {
    FanResponse& one = out.emplace_back();
    one.fan = fan;
    double sum = 0.0;
    std::vector<double> means;
    for (const HeardFan& echo : echoes) {
      ++one.pings;
      one.samples += echo.samples;
      one.volume_m3 += echo.volume_m3;
      sum += echo.mean_sv_per_m * echo.volume_m3;
      means.push_back(echo.mean_sv_per_m);
    }
    one.sv_mean_db = one.volume_m3 > 0.0 ? db_or_unknown(sum / one.volume_m3) : kUnknown;
    if (means.size() < kLeastPings) continue;
    std::sort(means.begin(), means.end());
    const auto rank = [&](double share) {
      return means[static_cast<std::size_t>(std::ceil(share * static_cast<double>(means.size()))) - 1];
    };
    one.sv_p25_db = db_or_unknown(rank(0.25));
    one.sv_p75_db = db_or_unknown(rank(0.75));
  }
  return out;
}

}  // namespace sonar
