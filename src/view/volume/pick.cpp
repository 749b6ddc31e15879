// SPDX-License-Identifier: Apache-2.0
#include "view/volume/pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "view/slices/filled_sample.h"

namespace sonar {
namespace {

/// Below this much of a ray's light nothing is seen.
constexpr double kLeastOpacity = 1.0 / 255.0;

struct Corner {
  int fan, beam, sample;
  double weight;
};

/// The eight centres round a place; empty outside the beam centres.
std::optional<std::array<Corner, 8>> corners(const Shape3& shape, const SectorIndex& at) {
  const auto inside = [](double index, int count) { return index >= 0.0 && index <= count - 1; };
  if (!inside(at.fan, shape.fans) || !inside(at.beam, shape.beams) || !inside(at.sample, shape.samples)) {
    return std::nullopt;
  }
  const auto lower = [](double index, int count) {
    return std::clamp(static_cast<int>(index), 0, std::max(0, count - 2));
  };
  const int f = lower(at.fan, shape.fans);
  const int b = lower(at.beam, shape.beams);
  const int s = lower(at.sample, shape.samples);
  const std::array<double, 3> t{at.fan - f, at.beam - b, at.sample - s};
  std::array<Corner, 8> out{};
  for (unsigned i = 0; i < 8; ++i) {
    const std::array<unsigned, 3> up{(i >> 2U) & 1U, (i >> 1U) & 1U, i & 1U};
    double weight = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      weight *= up[axis] != 0U ? t[axis] : 1.0 - t[axis];
    }
    out[i] = {std::min(f + static_cast<int>(up[0]), shape.fans - 1),
              std::min(b + static_cast<int>(up[1]), shape.beams - 1),
              std::min(s + static_cast<int>(up[2]), shape.samples - 1), weight};
  }
  return out;
}

/// Interpolated as the renderers do it: missing samples take the mean of their neighbours, and count as missing.
struct Field {
  double sv_db = 0.0;
  double known = 0.0;  ///< share of the corners, by weight; sv_db means nothing where it is 0
};

Field field_at(const VolumeData& volume, const std::array<Corner, 8>& around) {
  Field out;
  for (const Corner& c : around) {
    if (c.weight <= 0.0) continue;
    out.sv_db += c.weight * db_from_counts(filled_sample(volume.sv, c.fan, c.beam, c.sample));
    out.known += volume.sv(c.fan, c.beam, c.sample) != kNoData ? c.weight : 0.0;
  }
  return out;
}

double extinction_at(const OpticalTable& table, double sv_db) {
  const auto entries = static_cast<double>(table.rgb_extinction.size() - 1);
  const double at = std::clamp((sv_db - table.first_db) / (table.last_db - table.first_db), 0.0, 1.0) * entries;
  const auto below = std::min(static_cast<std::size_t>(at), table.rgb_extinction.size() - 2);
  const double t = at - static_cast<double>(below);
  return (1.0 - t) * table.rgb_extinction[below][3] + t * table.rgb_extinction[below + 1][3];
}

/// Confidences of a mask's voxels by (row, sample), found by bisection.
double confidence_at(const PingMask& mask, const std::vector<std::size_t>& first_voxel, int row, int sample) {
  const auto after = std::upper_bound(mask.runs.begin(), mask.runs.end(), std::pair{row, sample},
                                      [](const auto& place, const Run& run) {
                                        return place < std::pair{run.row, run.first_sample};
                                      });
  if (after == mask.runs.begin()) return 0.0;
  const auto run = after - 1;
  if (run->row != row || sample >= run->end()) return 0.0;
  const auto index = static_cast<std::size_t>(run - mask.runs.begin());
  return mask.confidence[first_voxel[index] + static_cast<std::size_t>(sample - run->first_sample)] / 255.0;
}

std::vector<std::size_t> first_voxels(const PingMask& mask) {
  std::vector<std::size_t> out;
  std::size_t next = 0;
  for (const Run& run : mask.runs) {
    out.push_back(next);
    next += static_cast<std::size_t>(run.count);
  }
  return out;
}

class Walk {
 public:
  Walk(const VolumeData& volume, const OpticalTable& table, std::span<const MaskLayer> masks, const VolumeView& view)
      : volume_(volume), table_(table), masks_(masks), view_(view) {
    for (const MaskLayer& layer : masks)
      voxels_.push_back(layer.mask ? first_voxels(*layer.mask) : std::vector<std::size_t>{});
  }

  std::optional<Picked> along(const Ray& ray, double last_m) {
    const auto span = range_span(ray);
    if (!span) return std::nullopt;
    const double step = 0.5 * volume_.sector.range().spacing_m;
    const double end = std::min(span->second, last_m);
    for (double t = std::max(0.0, span->first) + 0.5 * step; t < end; t += step) {
      if (!sample(ray, t, step)) break;
    }
    return result();
  }

 private:
  /// Where the ray is inside the sphere of the last sample.
  [[nodiscard]] std::optional<std::pair<double, double>> range_span(const Ray& ray) const {
    const RangeAxis& range = volume_.sector.range();
    const double far_m = range.range_m(range.count - 1);
    const Point<Sonar>& o = ray.origin;
    const double along = -(o.x * ray.direction.x + o.y * ray.direction.y + o.z * ray.direction.z);
    const double square = far_m * far_m - (o.x * o.x + o.y * o.y + o.z * o.z - along * along);
    if (!(square > 0.0) || along + std::sqrt(square) <= 0.0) return std::nullopt;
    return std::pair{along - std::sqrt(square), along + std::sqrt(square)};
  }

  /// False where the walk may end.
  bool sample(const Ray& ray, double t, double step) {
    const Point<Sonar> p = ray.origin + ray.direction * t;
    if (p.z < volume_.surface_z_m) return true;
    const auto around = corners(volume_.sv.shape(), volume_.sector.index_of(p));
    if (!around) return true;
    if (!mask_ && meets_mask(*around)) {
      mask_ = hit_mask(p, t, *around);
      return view_.masks.data_too && view_.mode == RayMode::maximum;
    }
    if (!view_.masks.data_too) return true;
    const Field field = field_at(volume_, *around);
    return field.known <= 0.0 || data(p, t, step, field, *around);
  }

  bool data(const Point<Sonar>& p, double t, double step, const Field& field, const std::array<Corner, 8>& around) {
    const double extinction = field.known * extinction_at(table_, field.sv_db);
    const bool counts = field.known >= 0.5;
    if (ends_at_surface(view_.mode) && counts && field.sv_db >= view_.first_hit_db) {
      data_ = hit(p, t, around);
      transmittance_ = 0.0;
      gathered_.push_back({1.0, *data_});
      return false;
    }
    if (view_.mode == RayMode::maximum) {
      if (counts && extinction > 0.0 && field.sv_db > largest_) {
        largest_ = field.sv_db;
        data_ = hit(p, t, around);
      }
      return true;
    }
    if (!accumulates(view_.mode) || extinction <= 0.0) return true;
    transmittance_ *= std::exp(-extinction * step);
    gathered_.push_back({1.0 - transmittance_, hit(p, t, around)});
    return transmittance_ > 0.01;
  }

  bool meets_mask(const std::array<Corner, 8>& around) {
    const double surface = std::max(static_cast<double>(view_.masks.fuzzy_above), 0.5 / 255.0);
    std::array<Owner, 8> owners;
    std::transform(around.begin(), around.end(), owners.begin(), [this](const Corner& c) { return owner(c); });
    met_ = -1;
    for (const Owner& one : owners) {
      if (one.mask < 0 || (met_ >= 0 && one.mask >= met_)) continue;
      double confidence = 0.0;
      for (std::size_t i = 0; i < owners.size(); ++i) {
        if (owners[i].mask == one.mask) confidence += around[i].weight * owners[i].confidence;
      }
      if (confidence >= surface) met_ = one.mask;
    }
    return met_ >= 0;
  }

  struct Owner {
    int mask = -1;
    double confidence = 0.0;
  };
  /// A voxel of several masks is that one's whose confidence there is largest, as it is drawn.
  [[nodiscard]] Owner owner(const Corner& c) const {
    const int row = c.fan * volume_.sv.shape().beams + c.beam;
    Owner out;
    for (std::size_t i = 0; i < masks_.size(); ++i) {
      if (!masks_[i].mask) continue;
      const double confidence = confidence_at(*masks_[i].mask, voxels_[i], row, c.sample);
      if (confidence > out.confidence) out = {static_cast<int>(i), confidence};
    }
    return out;
  }

  /// A mask's surface lies between members and others; what was pointed at is the member.
  [[nodiscard]] Picked hit_mask(const Point<Sonar>& p, double t, const std::array<Corner, 8>& around) const {
    const Corner* best = nullptr;
    for (const Corner& c : around) {
      if (owner(c).mask == met_ && (best == nullptr || c.weight > best->weight)) best = &c;
    }
    if (best == nullptr) best = &around.front();
    return picked(*best, p, t, met_);
  }

  [[nodiscard]] Picked hit(const Point<Sonar>& p, double t, const std::array<Corner, 8>& around) const {
    const Corner* best = nullptr;
    for (const Corner& c : around) {
      const bool known = volume_.sv(c.fan, c.beam, c.sample) != kNoData;
      if (known && (best == nullptr || c.weight > best->weight)) best = &c;
    }
    if (best == nullptr)
      best = &*std::max_element(around.begin(), around.end(), [](auto& a, auto& b) { return a.weight < b.weight; });
    return picked(*best, p, t, -1);
  }

  [[nodiscard]] Picked picked(const Corner& at, const Point<Sonar>& p, double t, int mask) const {
    const std::int16_t count = volume_.sv(at.fan, at.beam, at.sample);
    const double sv = count == kNoData ? std::numeric_limits<double>::quiet_NaN() : db_from_counts(count);
    return {at.fan, at.beam, at.sample, p, t, sv, mask};
  }

  /// A mask's surface is met where the data before it has not hidden it.
  [[nodiscard]] std::optional<Picked> result() const {
    std::optional<Picked> seen = data_;
    if (accumulates(view_.mode) && !gathered_.empty() && gathered_.back().opacity >= kLeastOpacity) {
      const double half = 0.5 * gathered_.back().opacity;
      seen = std::find_if(gathered_.begin(), gathered_.end(), [&](const Gathered& g) { return g.opacity >= half; })->at;
    }
    if (mask_ && (!seen || mask_->distance_m <= seen->distance_m || accumulates(view_.mode))) {
      const bool hidden = seen && accumulates(view_.mode) && 1.0 - transmittance_ > 0.5;
      return hidden ? seen : mask_;
    }
    return seen;
  }

  struct Gathered {
    double opacity;
    Picked at;
  };

  const VolumeData& volume_;
  const OpticalTable& table_;
  std::span<const MaskLayer> masks_;
  const VolumeView& view_;
  std::vector<std::vector<std::size_t>> voxels_;  ///< [mask][run] -> first voxel
  std::vector<Gathered> gathered_;
  std::optional<Picked> data_;
  std::optional<Picked> mask_;
  double transmittance_ = 1.0;
  double largest_ = -std::numeric_limits<double>::infinity();
  int met_ = -1;
};

}  // namespace

std::optional<Picked> pick(const VolumeData& volume, const OpticalTable& table, std::span<const MaskLayer> masks,
                           const VolumeView& view, PixelPoint pixel) {
  if (volume.sv.shape().size() == 0 || table.rgb_extinction.size() < 2) return std::nullopt;
  double last_m = std::numeric_limits<double>::infinity();
  const int x = static_cast<int>(std::floor(pixel.x));
  const int y = static_cast<int>(std::floor(pixel.y));
  const bool within = x >= 0 && y >= 0 && x < view.size.width && y < view.size.height;
  if (view.opaque_m && within && view.opaque_m->size() == view.size.count()) {
    last_m = (*view.opaque_m)[static_cast<std::size_t>(y) * static_cast<std::size_t>(view.size.width) +
                              static_cast<std::size_t>(x)];
  }
  return Walk(volume, table, masks, view).along(basis(view.camera, view.size).ray(pixel), last_m);
}

}  // namespace sonar
