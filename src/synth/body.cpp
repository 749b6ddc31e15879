// SPDX-License-Identifier: Apache-2.0
#include "synth/body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "synth/random.h"

namespace sonar::synth {
namespace {

constexpr double kScatterersWanted = 16000.0;
constexpr double kFinestCell_m = 0.4;
constexpr double kCoarsestCell_m = 1.5;

/// Smooth noise in -1..1: a random value at every lattice point, blended with a curve that is flat at both ends.
class SmoothNoise {
 public:
  explicit SmoothNoise(std::uint64_t seed)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)} {}

  [[nodiscard]] double at(double x, double y, double z, std::uint32_t octave) const {
    const double fx = std::floor(x);
    const double fy = std::floor(y);
    const double fz = std::floor(z);
    const double wx = blend(x - fx);
    const double wy = blend(y - fy);
    const double wz = blend(z - fz);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const bool ox = (corner & 1) != 0;
      const bool oy = (corner & 2) != 0;
      const bool oz = (corner & 4) != 0;
      const double weight = (ox ? wx : 1.0 - wx) * (oy ? wy : 1.0 - wy) * (oz ? wz : 1.0 - wz);
      sum += weight * value(fx + (ox ? 1 : 0), fy + (oy ? 1 : 0), fz + (oz ? 1 : 0), octave);
    }
    return sum;
  }

 private:
  static double blend(double t) { return t * t * (3.0 - 2.0 * t); }
  [[nodiscard]] double value(double x, double y, double z, std::uint32_t octave) const {
    const auto word = [](double v) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(v)); };
    const auto block =
        philox({word(x), word(y), word(z), octave | static_cast<std::uint32_t>(Purpose::ragged) << 24U}, key_);
    return 2.0 * (static_cast<double>(block[0]) + 0.5) / 4294967296.0 - 1.0;
  }
  std::array<std::uint32_t, 2> key_;
};

/// sv of a body at places given in its own axes.
class Interior {
 public:
  explicit Interior(const BodyShape& shape) : shape_(shape), noise_(shape.seed), sv_(linear_from_db(shape.sv_db)) {}

  /// 0 outside and in vacuoles.
  [[nodiscard]] double sv(double along, double across, double up) const {
    const double x = 2.0 * along / shape_.length_m;
    const double y = 2.0 * across / shape_.width_m;
    const double z = 2.0 * up / shape_.height_m;
    const double radius = std::sqrt(x * x + y * y + z * z);
    if (radius > 1.0 + shape_.raggedness) return 0.0;
    if (shape_.raggedness > 0.0 && radius > 1.0 + shape_.raggedness * boundary(along, across, up)) return 0.0;
    if (shape_.raggedness <= 0.0 && radius > 1.0) return 0.0;
    double excess_db = 0.0;
    for (const Lump& lump : shape_.lumps) {
      const double dx = (x - lump.along) / lump.radius;
      const double dy = (y - lump.across) / lump.radius;
      const double dz = (z - lump.up) / lump.radius;
      const double d2 = dx * dx + dy * dy + dz * dz;
      if (std::isinf(lump.excess_db)) {
        if (d2 < 1.0) return 0.0;
      } else {
        excess_db = std::max(excess_db, lump.excess_db * std::exp(-d2 / 2.0));
      }
    }
    return excess_db > 0.0 ? sv_ * linear_from_db(excess_db) : sv_;
  }

 private:
  [[nodiscard]] double boundary(double along, double across, double up) const {
    const double s = shape_.ragged_scale_m;
    return 0.7 * noise_.at(along / s, across / s, up / s, 0) +
           0.3 * noise_.at(2.0 * along / s, 2.0 * across / s, 2.0 * up / s, 1);
  }
  const BodyShape& shape_;
  SmoothNoise noise_;
  double sv_;
};

/// Full extent of a range of places.
struct Extent {
  double least = 0.0;
  double most = 0.0;
  void add(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
  [[nodiscard]] double size() const { return most - least; }
};

int cells_each_way(double half_axis_m, double raggedness, double cell_m) {
  return static_cast<int>(std::ceil(half_axis_m * (1.0 + raggedness) / cell_m));
}

}  // namespace

Point<Enu> Body::centre_at(double seconds) const {
  const double parted = seconds > splits_at_s ? seconds - splits_at_s : 0.0;
  return centre_m + velocity_mps * seconds + split_velocity_mps * parted;
}

Point<Enu> Body::velocity_at(double seconds) const {
  return seconds > splits_at_s ? velocity_mps + split_velocity_mps : velocity_mps;
}

int Body::id_at(double seconds) const {
  return seconds > splits_at_s && id_after_split > 0 ? id_after_split : school_id;
}

Scatterers scatterers(const BodyShape& shape) {
  const double ellipsoid_m3 = std::numbers::pi / 6.0 * shape.length_m * shape.width_m * shape.height_m;
  const double cell = std::clamp(std::cbrt(ellipsoid_m3 / kScatterersWanted), kFinestCell_m, kCoarsestCell_m);
  const Interior interior(shape);
  RandomStream random(shape.seed, Purpose::body);
  Scatterers s;
  s.cell_m3 = cell * cell * cell;
  const double axis = rad_from_deg(shape.axis_deg);
  const double sin_axis = std::sin(axis);
  const double cos_axis = std::cos(axis);
  const int nx = cells_each_way(shape.length_m / 2.0, shape.raggedness, cell);
  const int ny = cells_each_way(shape.width_m / 2.0, shape.raggedness, cell);
  const int nz = cells_each_way(shape.height_m / 2.0, shape.raggedness, cell);
  Extent along_extent;
  Extent across_extent;
  Extent up_extent;
  for (int k = -nz; k < nz; ++k) {
    for (int j = -ny; j < ny; ++j) {
      for (int i = -nx; i < nx; ++i) {
        const double along = (i + random.uniform()) * cell;
        const double across = (j + random.uniform()) * cell;
        const double up = (k + random.uniform()) * cell;
        const double sv = interior.sv(along, across, up);
        if (sv <= 0.0) continue;
        s.points.push_back(
            {{along * sin_axis + across * cos_axis, along * cos_axis - across * sin_axis, up}, sv * s.cell_m3});
        s.backscatter_m2 += sv * s.cell_m3;
        along_extent.add(along);
        across_extent.add(across);
        up_extent.add(up);
        s.reach_m = std::max(s.reach_m, std::sqrt(along * along + across * across + up * up));
      }
    }
  }
  s.volume_m3 = s.cell_m3 * static_cast<double>(s.points.size());
  s.length_m = along_extent.size();
  s.width_m = across_extent.size();
  s.height_m = up_extent.size();
  return s;
}

}  // namespace sonar::synth
