// SPDX-License-Identifier: Apache-2.0
#include "synth/seabed_response.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>

#include "base/units.h"

namespace sonar::synth {
namespace {

constexpr double kPulse_m = kSoundSpeed_mps * kPulseLength_s / 2.0;
constexpr double kStep_m = 0.5;  ///< along the seabed
constexpr int kSides = 2;        ///< bearings to each side of a beam's axis
constexpr double kSide = 0.8;    ///< between them, of the pattern's standard deviation

/// A piece of the seabed as the sonar sees it: between two ranges, at one angle.
struct Patch {
  double near_m = 0.0;
  double far_m = 0.0;
  double elevation_rad = 0.0;
  double lambert_m = 0.0;  ///< its length times the square of the sine of the grazing angle
};

/// The patches along one bearing that no nearer one hides, by Lambert's law.
std::vector<Patch> lit_patches(const Terrain& terrain, const Point<Enu>& ship, double transducer_m, double bearing_rad,
                               double reach_m) {
  std::vector<Patch> patches;
  double highest_rad = -std::numbers::pi;  // elevation of what hides the rest
  double below = std::max(1.0, terrain.depth_m(ship) - transducer_m);
  for (double x = 0.0; x < reach_m; x += kStep_m) {
    const double far_x = x + kStep_m;
    const Point<Enu> place{ship.x + far_x * std::sin(bearing_rad), ship.y + far_x * std::cos(bearing_rad), 0.0};
    const double far_below = std::max(1.0, terrain.depth_m(place) - transducer_m);
    const double near_m = std::hypot(x, below);
    const double far_m = std::hypot(far_x, far_below);
    const double elevation = -std::atan2((below + far_below) / 2.0, x + kStep_m / 2.0);
    const double length = std::hypot(kStep_m, far_below - below);
    // From the sonar: across the patch, of its length.
    const double across = (far_x * below - x * far_below) / (near_m + far_m) * 2.0;
    const double sine = across / length;
    if (elevation > highest_rad && sine > 0.0) {
      patches.push_back({std::min(near_m, far_m), std::max(near_m, far_m), elevation, length * sine * sine});
    }
    highest_rad = std::max(highest_rad, elevation);
    below = far_below;
  }
  return patches;
}

/// How much of a beam's horizontal pattern one of the bearings stands for.
double side_weight(BeamPattern pattern, int side) {
  const auto value = [&](int s) { return pattern_value(pattern, PatternPart::horizontal, s * kSide); };
  double all = 0.0;
  for (int s = -kSides; s <= kSides; ++s) all += value(s);
  return value(side) / all;
}

/// Adds a patch to the samples that it lies in: the patch is as wide as range times bearing, the volume range squared
/// times solid angle, so that one range is left.
void add(const Patch& patch, double density, const RangeAxis& axis, std::vector<double>& sv) {
  const double first = axis.sample_at(patch.near_m) + 0.5;
  const double last = axis.sample_at(patch.far_m) + 0.5;
  const double per_sample =
      density * patch.lambert_m / (axis.spacing_m * (patch.near_m + patch.far_m) / 2.0) / std::max(last - first, 1e-9);
  const int end = std::min(static_cast<int>(std::ceil(last)), static_cast<int>(sv.size()));
  for (int s = std::max(0, static_cast<int>(std::floor(first))); s < end; ++s) {
    const double overlap = std::min(last, s + 1.0) - std::max(first, static_cast<double>(s));
    sv[static_cast<std::size_t>(s)] += per_sample * std::max(0.0, overlap);
  }
}

}  // namespace

Seabed::Seabed(const Layout& layout, const Scene& scene, const Point<Enu>& ship, double heading_rad)
    : layout_(layout), strength_(scene.water.seabed_db > -200.0 ? linear_from_db(scene.water.seabed_db) : 0.0) {
  const Terrain terrain(scene);
  depth_m_ = terrain.depth_m(ship);
  for (const RowBeam& beam : layout.rows) {
    Row& row = rows_.emplace_back();
    row.first = row.last = row.limit = beam.count;
  }
  if (strength_ <= 0.0) return;
  if (terrain.is_plane()) {
    see_plane(scene, heading_rad);
  } else {
    see_relief(scene, terrain, ship, heading_rad);
  }
}

int Seabed::sample_of(double range_m, int count) const {
  const double sample = layout_.range.sample_at(range_m);
  return sample < count ? std::max(0, static_cast<int>(std::ceil(sample))) : count;
}

void Seabed::see_plane(const Scene& scene, double heading_rad) {
  const Water& w = scene.water;
  const double below_m = std::max(1.0, depth_m_ - scene.ship.transducer_depth_m);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const RowBeam& beam = layout_.rows[r];
    Row& row = rows_[r];
    const double bearing = heading_rad + beam.azimuth_rad;
    const double slope = w.seabed_slope_east * std::sin(bearing) + w.seabed_slope_north * std::cos(bearing);
    row.slope_rad = std::atan(slope);
    row.distance_m = below_m * std::cos(row.slope_rad);
    // A ray that points `down` below the horizon meets the plane at distance / sin(down - slope).
    const auto meets = [&](double down) {
      const double grazing = std::min(down - row.slope_rad, std::numbers::pi / 2.0);
      return grazing > 0.0 ? sample_of(row.distance_m / std::sin(grazing), beam.count) : beam.count;
    };
    const double reach = pattern_reach(layout_.pattern, PatternPart::vertical) * beam.sigma_v_rad;
    row.first = meets(-beam.elevation_rad + reach);
    row.last = std::max(row.first, meets(-beam.elevation_rad - reach));
    const double edge =
        std::min(-beam.elevation_rad + beam.vertical_width_rad / 2.0 - row.slope_rad, std::numbers::pi / 2.0);
    if (edge > 0.0) row.limit = sample_of(row.distance_m / std::sin(edge) - kPulse_m, beam.count);
  }
}

void Seabed::see_relief(const Scene& scene, const Terrain& terrain, const Point<Enu>& ship, double heading_rad) {
  const double end_m = layout_.range.range_m(layout_.shape.samples);
  std::map<long, std::vector<Patch>> by_bearing;  // the fans share theirs
  std::vector<double> sv;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const RowBeam& beam = layout_.rows[r];
    Row& row = rows_[r];
    sv.assign(static_cast<std::size_t>(beam.count), 0.0);
    const double middle_rad = heading_rad + beam.azimuth_rad;
    for (int side = -kSides; side <= kSides; ++side) {
      const double bearing_rad = middle_rad + side * kSide * beam.sigma_h_rad;
      const auto [seen, fresh] = by_bearing.try_emplace(std::lround(bearing_rad * 1e6));
      if (fresh) seen->second = lit_patches(terrain, ship, scene.ship.transducer_depth_m, bearing_rad, end_m);
      const double share = side_weight(layout_.pattern, side);
      for (const Patch& patch : seen->second) {
        const double density = vertical_density(layout_.pattern, beam, patch.elevation_rad);
        if (density <= 0.0) continue;
        add(patch, strength_ * share * density, layout_.range, sv);
        if (std::abs(patch.elevation_rad - beam.elevation_rad) <= beam.vertical_width_rad / 2.0) {
          row.limit = std::min(row.limit, sample_of(patch.near_m - kPulse_m, beam.count));
        }
      }
    }
    const auto lit = [](double v) { return v > 0.0; };
    row.first = static_cast<int>(std::find_if(sv.begin(), sv.end(), lit) - sv.begin());
    row.last = std::max(row.first, static_cast<int>(sv.rend() - std::find_if(sv.rbegin(), sv.rend(), lit)));
    row.sv.assign(sv.begin() + row.first, sv.begin() + row.last);
  }
}

double Seabed::plane_sv(const Row& plane, const RowBeam& beam, int sample) const {
  const double range_m = layout_.range.range_m(sample);
  if (range_m <= plane.distance_m) return 0.0;
  const double sine = plane.distance_m / range_m;  // of the grazing angle; Lambert's law squares it
  const double down = std::asin(sine) + plane.slope_rad;
  return strength_ * sine * sine * vertical_density(layout_.pattern, beam, -down) /
         (range_m * std::max(0.1, std::cos(down)));
}

double Seabed::sv(int row, int sample) const {
  const Row& seen = rows_[static_cast<std::size_t>(row)];
  if (sample < seen.first || sample >= seen.last) return 0.0;
  if (!seen.sv.empty()) return static_cast<double>(seen.sv[static_cast<std::size_t>(sample - seen.first)]);
  return plane_sv(seen, layout_.rows[static_cast<std::size_t>(row)], sample);
}

}  // namespace sonar::synth
