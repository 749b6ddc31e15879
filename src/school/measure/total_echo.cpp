// SPDX-License-Identifier: Apache-2.0
#include "school/measure/total_echo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/middle.h"
#include "base/units.h"
#include "school/detect/noise_level.h"
#include "school/fading.h"
#include "school/runs.h"

namespace sonar {
namespace {

/// Beyond half its width a two-way beam has 12 dB less than the edge of the mask, which lies about as far below the top.
constexpr double kBeyond_m = 3.0;
constexpr int kShells = 3;                ///< the water is heard from so many times as far off along range
constexpr std::size_t kEnoughInRow = 10;  ///< voxels that tell what a beam hears of the water
constexpr double kOthers = 2.0;  ///< times the mask's threshold, which what lies round a mask is below but for fading

struct Reach {
  int fans = 1;
  int beams = 1;
  int samples = 1;
  double alike = 1.0;  ///< voxels that fade as one
};

int half_width(double width, double spacing) {
  const double cells = 0.5 * width / spacing;
  return std::isfinite(cells) ? std::clamp(static_cast<int>(std::ceil(cells - 0.1)), 1, 5) : 1;
}

Reach reach_of(const MeasureInput& ping, const PingMask& mask) {
  const int row = mask.runs[mask.runs.size() / 2].row;
  const int beams = ping.sector->beams();
  const double vertical = ping.grid->vertical_width_deg[static_cast<std::size_t>(row)];
  const double horizontal = ping.grid->horizontal_width_deg[static_cast<std::size_t>(row)];
  const double fan_deg = spacing_deg(ping.grid->elevation_deg, row / beams);
  const double beam_deg = spacing_deg(ping.grid->azimuth_deg, row % beams);
  const double sample_m = ping.sector->range().spacing_m;
  return {half_width(vertical, fan_deg), half_width(horizontal, beam_deg),
          std::max(1, static_cast<int>(std::ceil(kBeyond_m / sample_m))),
          voxels_alike(*ping.grid, sample_m, ping.pulse_m, row)};
}

/// Which voxels of a box round a mask are members, lie round them, or tell the water.
class Surroundings {
 public:
  enum Zone : std::uint8_t { kOutside, kWater, kRound, kMembers };

  Surroundings(const MeasureInput& ping, const PingMask& mask) : reach_(reach_of(ping, mask)), shape_(ping.sv.shape()) {
    const Reach wide{2 * reach_.fans, 2 * reach_.beams, kShells * reach_.samples, 1.0};
    box_ = box_of(mask, shape_.beams).enlarged(wide.fans, wide.beams, wide.samples).clipped(shape_);
    zones_ = Array3<std::uint8_t>({box_.fans(), box_.beams(), box_.samples()});
    mark(mask, wide, kWater);
    mark(mask, reach_, kRound);
    mark(mask, {0, 0, 0, 1.0}, kMembers);
  }

  [[nodiscard]] double alike() const { return reach_.alike; }

  /// visit(row, sample, zone) for every voxel that is in one.
  template <class Visit>
  void each(const Visit& visit) const {
    for (int f = 0; f < box_.fans(); ++f) {
      for (int b = 0; b < box_.beams(); ++b) {
        const auto zones = zones_.view().row(f * box_.beams() + b);
        const int row = (box_.first_fan + f) * shape_.beams + box_.first_beam + b;
        for (std::size_t s = 0; s < zones.size(); ++s) {
          if (zones[s] != kOutside) visit(row, box_.first_sample + static_cast<int>(s), Zone{zones[s]});
        }
      }
    }
  }

 private:
  void mark(const PingMask& mask, const Reach& reach, Zone zone) {
    for (const Run& run : mask.runs) {
      const int fan = run.row / shape_.beams - box_.first_fan;
      const int beam = run.row % shape_.beams - box_.first_beam;
      const int first = std::max(0, run.first_sample - reach.samples - box_.first_sample);
      const int end = std::min(box_.samples(), run.end() + reach.samples - box_.first_sample);
      for (int f = std::max(0, fan - reach.fans); f <= std::min(box_.fans() - 1, fan + reach.fans); ++f) {
        for (int b = std::max(0, beam - reach.beams); b <= std::min(box_.beams() - 1, beam + reach.beams); ++b) {
          const auto row = zones_.view().row(f * box_.beams() + b);
          std::fill(row.begin() + first, row.begin() + end, static_cast<std::uint8_t>(zone));
        }
      }
    }
  }

  Reach reach_;
  Shape3 shape_;
  IndexBox box_;
  Array3<std::uint8_t> zones_;
};

/// Sums over voxels, each by its volume: what was heard stands for what was not.
struct Sum {
  double echo_m2 = 0.0;
  double heard_m3 = 0.0;
  double whole_m3 = 0.0;
  double square = 0.0;
  std::size_t heard = 0;

  /// Exponential echo of mean m has the variance m^2, and 2 m^2 as mean square.
  void add(double raw, double noise, double volume_m3) {
    echo_m2 += (raw - noise) * volume_m3;
    heard_m3 += volume_m3;
    square += 0.5 * raw * raw * volume_m3 * volume_m3;
    ++heard;
  }
  Sum& operator+=(const Sum& other) {
    echo_m2 += other.echo_m2;
    heard_m3 += other.heard_m3;
    whole_m3 += other.whole_m3;
    square += other.square;
    heard += other.heard;
    return *this;
  }
  [[nodiscard]] double sv() const { return echo_m2 / heard_m3; }
};

/// By row and zone: what the school may count of its surroundings.
std::map<int, std::array<Sum, 4>> sums_of(const MeasureInput& ping, const Surroundings& surroundings,
                                          const EchoClaims* claims) {
  const Sector& sector = *ping.sector;
  std::map<int, std::array<Sum, 4>> rows;
  std::array<Sum, 4>* sums = nullptr;
  int row_at = -1;
  double solid_angle = 0.0;
  RowBackground noise(ping.background, 0);
  surroundings.each([&](int row, int sample, Surroundings::Zone zone) {
    const auto i = static_cast<std::size_t>(sample);
    if (row != row_at) {
      row_at = row;
      noise = RowBackground(ping.background, row);
      solid_angle = sector.solid_angle_sr(row / sector.beams(), row % sector.beams());
      sums = &rows[row];
    }
    const SampleFlags flags = ping.flags.row(row)[i];
    if (any(flags & kNeverMember)) return;
    if (zone != Surroundings::kMembers && sample >= ping.seabed_heard(row)) return;
    const int claimed = claims == nullptr ? 0 : claims->count.view().row(row)[i];
    if (zone != Surroundings::kMembers && claimed == EchoClaims::kMember) return;
    if (zone == Surroundings::kWater && claimed > 0) return;
    const double share = zone == Surroundings::kRound && claimed > 1 ? 1.0 / claimed : 1.0;
    const double volume = share * solid_angle * sector.shell_m3_per_sr(sample);
    Sum& sum = (*sums)[zone];
    sum.whole_m3 += volume;
    const std::int16_t count = ping.sv.row(row)[i];
    if (any(flags & kFault) || count == kNoData) return;
    sum.add(linear_from_count(count), noise(sample), volume);
  });
  return rows;
}

}  // namespace

EchoClaims echo_claims(const MeasureInput& ping, std::span<const PingMask* const> masks) {
  EchoClaims claims{Array3<std::uint8_t>(ping.sv.shape())};
  for (const PingMask* mask : masks) {
    Surroundings(ping, *mask).each([&](int row, int sample, Surroundings::Zone zone) {
      std::uint8_t& count = claims.count.view().row(row)[static_cast<std::size_t>(sample)];
      if (zone == Surroundings::kMembers) {
        count = EchoClaims::kMember;
      } else if (zone == Surroundings::kRound && count < EchoClaims::kMember - 1) {
        ++count;
      }
    });
  }
  return claims;
}

TotalEcho total_echo(const MeasureInput& ping, const PingMask& mask, const EchoClaims* claims) {
  SONAR_CHECK(ping.sector != nullptr && ping.grid != nullptr && !mask.empty());
  const Surroundings surroundings(ping, mask);
  const std::map<int, std::array<Sum, 4>> rows = sums_of(ping, surroundings, claims);
  Sum members;
  Sum water;
  std::vector<double> levels;
  for (const auto& [row, zones] : rows) {
    members += zones[Surroundings::kMembers];
    const Sum& of_row = zones[Surroundings::kWater];
    if (of_row.heard < kEnoughInRow) continue;
    water += of_row;
    levels.push_back(of_row.sv());
  }
  if (members.heard == 0 || !(members.heard_m3 > 0.0)) return {};
  // A loud neighbour fills few of the beams that hear the water: their median is the water's.
  const double level = levels.empty() ? 0.0 : middle_of(std::move(levels));
  Sum round;
  const double most = std::isnan(ping.threshold_db) ? INFINITY : kOthers * linear_from_db(ping.threshold_db);
  for (const auto& [row, zones] : rows) {
    const Sum& of_row = zones[Surroundings::kRound];
    if (of_row.heard_m3 > 0.0 && of_row.sv() - level <= most) round += of_row;
  }
  TotalEcho out{0.0, 0.0};
  double variance = 0.0;
  double whole_m3 = 0.0;
  for (const Sum* sum : {&members, &round}) {
    if (!(sum->heard_m3 > 0.0)) continue;
    const double stands_for = sum->whole_m3 / sum->heard_m3;
    out.backscatter_m2 += (sum->sv() - level) * sum->whole_m3;
    variance += sum->square * stands_for * stands_for;
    whole_m3 += sum->whole_m3;
  }
  if (water.heard_m3 > 0.0) variance += water.square * std::pow(whole_m3 / water.heard_m3, 2);
  out.se_m2 = std::sqrt(surroundings.alike() * variance);
  return out;
}

}  // namespace sonar
