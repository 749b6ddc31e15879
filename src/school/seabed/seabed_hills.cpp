// SPDX-License-Identifier: Apache-2.0
#include "school/seabed/seabed_hills.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "base/units.h"

namespace sonar {
namespace {

class HillFinder {
 public:
  HillFinder(const SeabedWater& water, const std::vector<SeabedEcho>& echoes, const SeabedPlane& plane,
             double strength_db, const std::vector<double>& vertical_width_deg)
      : water_(water),
        sector_(water.sector),
        params_(water.params),
        plane_(plane),
        strength_db_(strength_db),
        width_deg_(vertical_width_deg),
        echoes_(echoes),
        begin_(water.sv.shape().rows() + 1, 0) {
    for (const SeabedEcho& echo : echoes) ++begin_[static_cast<std::size_t>(echo.row) + 1];
    for (std::size_t row = 1; row < begin_.size(); ++row) begin_[row] += begin_[row - 1];
  }

  void find(std::vector<std::int32_t>& first_sample) const {
    const std::vector<std::int32_t> of_plane = first_sample;
    std::vector<const SeabedEcho*> hills;
    for (int beam = 0; beam < sector_.beams(); ++beam) climb(beam, of_plane, hills);
    for (const SeabedEcho* hill : hills) flag(*hill, first_sample);
  }

 private:
  [[nodiscard]] std::span<const SeabedEcho> echoes_of(int row) const {
    const std::size_t first = begin_[static_cast<std::size_t>(row)];
    return std::span(echoes_).subspan(first, begin_[static_cast<std::size_t>(row) + 1] - first);
  }
  [[nodiscard]] int row_at(int height, int beam) const {
    const int top = sector_.fans() - 1;
    const bool rising = sector_.elevation_rad(0) <= sector_.elevation_rad(top);
    return (rising ? height : top - height) * sector_.beams() + beam;
  }
  static double away_m(const SeabedEcho& echo) { return std::hypot(echo.place.x, echo.place.y); }

  /// One azimuth from the lowest beam up.
  void climb(int beam, const std::vector<std::int32_t>& of_plane, std::vector<const SeabedEcho*>& hills) const {
    int empty = 0;           // beams since the seabed was seen
    double seabed_m = -1.0;  // how far away it was seen; < 0 not yet: then a beam that lacks the plane tells
    for (int height = 0; height < sector_.fans(); ++height) {
      const int row = row_at(height, beam);
      const int plane_begin = of_plane[static_cast<std::size_t>(row)];
      const SeabedEcho* hill = strongest_before(row, plane_begin, seabed_m);
      const double seen_m = plane_seen_at_m(row, plane_begin, hill);
      ++empty;
      if (seen_m >= 0.0) {
        const Point<Sonar> u = beam_axis(sector_, row);
        seabed_m = std::max(seabed_m, seen_m * std::hypot(u.x, u.y));
        empty = 0;
      } else if (hill != nullptr && (seabed_m >= 0.0 || should_see_plane(row))) {
        hills.push_back(hill);
        seabed_m = std::max(seabed_m, away_m(*hill));
        empty = 0;
      }
      // Beams that see no seabed look over it, beyond the record's end, and so do all above them.
      if (seabed_m >= 0.0 && empty > SeabedParams::hill_gap_beams) return;
    }
  }

  /// The strongest echo before the plane that does not lie nearer than the seabed under it.
  [[nodiscard]] const SeabedEcho* strongest_before(int row, int plane_begin, double seabed_m) const {
    const SeabedEcho* strongest = nullptr;
    for (const SeabedEcho& echo : echoes_of(row)) {
      if (echo.peak_sample >= plane_begin || away_m(echo) < seabed_m - params_.hill_step_m) continue;
      if (strongest == nullptr || echo.peak_db > strongest->peak_db) strongest = &echo;
    }
    return strongest;
  }

  /// Whether the plane would be loud in the beam, and well before its end.
  [[nodiscard]] bool should_see_plane(int row) const {
    const Point<Sonar> u = beam_axis(sector_, row);
    const double range_m = plane_.range(u);
    const int last = water_.sv.shape().samples - 1;
    if (!(range_m <= SeabedParams::reach_share * sector_.range().range_m(last))) return false;
    const int limit = loud_limit(water_, row)(std::max(0, static_cast<int>(sector_.range().sample_at(range_m))));
    return strength_db_ + plane_.lambert_db(u, range_m) >= db_from_counts(limit) + SeabedParams::hill_behind_db;
  }

  /// Range at which the beam hears the seabed loudest where it expects the plane: about as loud as it should and, behind
  /// another echo, as one of its own; < 0 where it does not.
  [[nodiscard]] double plane_seen_at_m(int row, int plane_begin, const SeabedEcho* before) const {
    const Point<Sonar> u = beam_axis(sector_, row);
    const double range_m = plane_.range(u);
    const int samples = water_.sv.shape().samples;
    if (!(range_m <= sector_.range().range_m(samples - 1))) return -1.0;
    const double off_m = std::max(params_.inlier_m, params_.inlier_share * range_m) / std::max(u.z, 0.05);
    const int to = std::min(samples, static_cast<int>(sector_.range().sample_at(range_m + off_m)) + 1);
    const auto counts = water_.sv.row(row);
    const double least_db = strength_db_ + plane_.lambert_db(u, range_m) - SeabedParams::hill_behind_db;
    const int from = before == nullptr ? plane_begin : before->peak_sample;
    int quietest = kMaxCount;  // since the other echo
    int loudest = static_cast<int>(std::lround(counts_from_db(least_db))) - 1;
    int at = -1;
    for (int s = std::max(0, from); s < to; ++s) {
      const int count = counts[static_cast<std::size_t>(s)];
      quietest = std::min(quietest, count);
      const bool own = before == nullptr || count >= quietest + counts_from_db(SeabedParams::hill_dip_db);
      if (s < plane_begin || !own || count <= loudest) continue;
      loudest = count;
      at = s;
    }
    return at < 0 ? -1.0 : sector_.range().range_m(at);
  }

  /// The hill's own beam from its echo on, and the beams beside it as far as they hear it.
  void flag(const SeabedEcho& hill, std::vector<std::int32_t>& first_sample) const {
    const int margin = static_cast<int>(std::ceil(params_.margin_m / sector_.range().spacing_m));
    const int begin = std::max(0, hill.first_sample - margin);
    const int fan = hill.row / sector_.beams();
    const int beam = hill.row % sector_.beams();
    for (int f = 0; f < sector_.fans(); ++f) {
      if (!hears(f, hill)) continue;
      for (int b = std::max(0, beam - 1); b <= std::min(sector_.beams() - 1, beam + 1); ++b) {
        if (f != fan && b != beam) continue;
        std::int32_t& first = first_sample[static_cast<std::size_t>(f * sector_.beams() + b)];
        first = std::min(first, begin);
      }
    }
  }

  [[nodiscard]] bool hears(int fan, const SeabedEcho& hill) const {
    constexpr double kPerWidth_db = 4.0 * 6.02;  // a Gaussian beam, both ways
    const auto row = static_cast<std::size_t>(hill.row);
    const double width_rad = rad_from_deg(row < width_deg_.size() ? width_deg_[row] : SeabedParams::unknown_width_deg);
    const double off = (sector_.elevation_rad(fan) - sector_.elevation_rad(hill.row / sector_.beams())) / width_rad;
    return std::abs(off) <= SeabedParams::edge_widths &&
           hill.peak_db - kPerWidth_db * off * off >= SeabedParams::onset_db;
  }

  const SeabedWater& water_;
  const Sector& sector_;
  const SeabedParams& params_;
  const SeabedPlane& plane_;
  double strength_db_;
  const std::vector<double>& width_deg_;
  const std::vector<SeabedEcho>& echoes_;
  std::vector<std::size_t> begin_;  ///< [row] first of its echoes
};

}  // namespace

void find_hills(const SeabedWater& water, const std::vector<SeabedEcho>& echoes, const SeabedPlane& plane,
                double strength_db, const std::vector<double>& vertical_width_deg,
                std::vector<std::int32_t>& first_sample) {
  HillFinder(water, echoes, plane, strength_db, vertical_width_deg).find(first_sample);
}

}  // namespace sonar
