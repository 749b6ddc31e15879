// SPDX-License-Identifier: Apache-2.0
#include "render/reference/brute_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/units.h"
#include "render/filled_volume.h"
#include "render/ray_rules.h"
#include "render/transfer_table.h"

namespace sonar {
namespace {

using P = Point<Sonar>;
using Rgb = std::array<double, 3>;

double dot(const P& a, const P& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
P cross(const P& a, const P& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
P unit(const P& p) { return p * (1.0 / norm(p)); }

struct Scene {
  const VolumeData& volume;
  const OpticalTable& table;
  std::span<const MaskLayer> masks;
  const VolumeView& view;
  FilledVolume filled;
  std::vector<Array3<float>> confidence;  ///< [layer], 0..1
  CameraBasis camera;
  P light;
  double step_m;
};

/// Trilinear in index space; linear continuation outside.
template <class T>
double interpolated(const Array3<T>& a, const SectorIndex& at) {
  const Shape3 n = a.shape();
  const int f = std::clamp(static_cast<int>(std::floor(at.fan)), 0, n.fans - 2);
  const int b = std::clamp(static_cast<int>(std::floor(at.beam)), 0, n.beams - 2);
  const int s = std::clamp(static_cast<int>(std::floor(at.sample)), 0, n.samples - 2);
  const double u = at.fan - f;
  const double v = at.beam - b;
  const double w = at.sample - s;
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double weight = ((i & 4) != 0 ? u : 1.0 - u) * ((i & 2) != 0 ? v : 1.0 - v) * ((i & 1) != 0 ? w : 1.0 - w);
    sum += weight * static_cast<double>(a(f + (i >> 2), b + ((i >> 1) & 1), s + (i & 1)));
  }
  return sum;
}

double sv_db(const Scene& scene, const P& p) {
  return db_from_counts(interpolated(scene.filled.sv, scene.volume.sector.index_of(p)));
}

template <class Field>
P gradient(const Field& field, const P& p) {
  const double e = 1e-4;
  return P{field(p + P{e, 0, 0}) - field(p - P{e, 0, 0}), field(p + P{0, e, 0}) - field(p - P{0, e, 0}),
           field(p + P{0, 0, e}) - field(p - P{0, 0, e})} *
         (0.5 / e);
}

/// Index of a place of the volume drawn; none outside.
std::optional<SectorIndex> inside(const Scene& scene, const P& p) {
  if (p.z < scene.volume.surface_z_m) return std::nullopt;
  const Shape3 n = scene.filled.sv.shape();
  const SectorIndex at = scene.volume.sector.index_of(p);
  const bool in = at.fan >= 0 && at.fan <= n.fans - 1 && at.beam >= 0 && at.beam <= n.beams - 1 && at.sample >= 0 &&
                  at.sample <= n.samples - 1;
  return in ? std::optional(at) : std::nullopt;
}

/// What has come together along a ray so far.
struct Ray1 {
  Ray ray;
  double depth_per_m;  ///< along the camera's forward
  const DepthCue& cue;
  Rgb rgb{};
  double left = 1.0;               ///< transmittance
  std::optional<double> before_m;  ///< the last place, where it was inside and below the level of first hit
  double largest_db = -1e9;
  double largest_m = 0.0;
  std::vector<bool> surface_met;

  void lay(const Rgb& colour, double opacity, double t_m) {
    const double pale = cue.pale(t_m * depth_per_m);
    const Rgb ground{cue.background.r / 255.0, cue.background.g / 255.0, cue.background.b / 255.0};
    for (std::size_t c = 0; c < 3; ++c) rgb[c] += left * opacity * ((1.0 - pale) * colour[c] + pale * ground[c]);
    left *= 1.0 - opacity;
  }
};

/// Surfaces are laid at once; what the cores add to emission and extinction is returned, as emission and extinction.
std::array<double, 4> meet_masks(const Scene& scene, Ray1& r, double t_m, const P& p, const SectorIndex& at) {
  std::array<double, 4> sum{};
  const MaskStyle& style = scene.view.masks;
  for (std::size_t k = 0; k < scene.masks.size(); ++k) {
    const double f = interpolated(scene.confidence[k], at);
    const auto& c = scene.masks[k].rgb;
    const Rgb rgb{c[0], c[1], c[2]};
    if (!r.surface_met[k] && f >= std::max(static_cast<double>(style.fuzzy_above), 0.5 / 255.0)) {
      r.surface_met[k] = true;
      const auto field = [&](const P& q) { return interpolated(scene.confidence[k], scene.volume.sector.index_of(q)); };
      const P g = gradient(field, p) * 1e6;  // a surface is lit in full
      r.lay(scene.view.lighting.on ? lit(rgb, g, scene.light, r.ray.direction, scene.view.lighting) : rgb,
            static_cast<double>(style.fuzzy_opacity), t_m);
    }
    if (f >= static_cast<double>(style.core_at)) {
      const auto e = static_cast<double>(style.core_extinction_per_m);
      sum = {sum[0] + e * rgb[0], sum[1] + e * rgb[1], sum[2] + e * rgb[2], sum[3] + e};
    }
  }
  return sum;
}

P sv_gradient(const Scene& scene, const P& p) {
  return gradient([&](const P& q) { return sv_db(scene, q); }, p);
}

Rgb shaded(const Scene& scene, const Ray1& r, const Rgb& rgb, const P& p) {
  if (!scene.view.lighting.on) return rgb;
  return lit(rgb, sv_gradient(scene, p), scene.light, r.ray.direction, scene.view.lighting);
}

bool reaches_level(const Scene& scene, const P& p) {
  const auto at = inside(scene, p);
  if (!at || db_from_counts(interpolated(scene.filled.sv, *at)) < scene.view.first_hit_db) return false;
  return scene.filled.complete() || interpolated(scene.filled.known, *at) >= 0.5;
}

/// Ambient light that reaches a surface: 8 rings of 16 rays in place of kSkyRays, 32 steps in place of kSkySteps.
double sky(const Scene& scene, const P& p, const P& normal) {
  constexpr int kRings = 8;
  constexpr int kRound = 16;
  constexpr int kSteps = 32;
  const auto reach = static_cast<double>(scene.view.lighting.occlusion_m);
  const P one = unit(cross(normal, std::abs(normal.z) < 0.7 ? P{0, 0, 1} : P{1, 0, 0}));
  const P two = cross(normal, one);
  double sum = 0.0;
  for (int i = 0; i < kRings * kRound; ++i) {
    const double sine2 = (i % kRings + 0.5) / kRings;
    const double azimuth = 2.0 * std::numbers::pi * (i / kRings + 0.5 * (i % 2)) / kRound;
    const P out = one * (std::sqrt(sine2) * std::cos(azimuth)) + two * (std::sqrt(sine2) * std::sin(azimuth)) +
                  normal * std::sqrt(1.0 - sine2);
    int step = 1;
    while (step <= kSteps && !reaches_level(scene, p + out * (reach * step / kSteps))) ++step;
    sum += step > kSteps ? 1.0 : (step - 0.5) / kSteps;
  }
  return sum / (kRings * kRound);
}

/// The first place of level `first_hit_db` between the last sample and this one.
void hit(const Scene& scene, Ray1& r, double t_m) {
  double low = r.before_m.value_or(t_m);
  double high = t_m;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (sv_db(scene, r.ray.origin + r.ray.direction * middle) >= scene.view.first_hit_db ? high : low) = middle;
  }
  const P p = r.ray.origin + r.ray.direction * high;
  const auto o = optics_at(scene.table, sv_db(scene, p));
  const Lighting& lighting = scene.view.lighting;
  Rgb rgb{o[0], o[1], o[2]};
  if (lighting.on) {
    const P g = sv_gradient(scene, p);
    const double open = lighting.occlusion_m > 0.0F && norm(g) > 0.0 ? sky(scene, p, unit(g * -1.0)) : 1.0;
    rgb = lit(rgb, g, scene.light, r.ray.direction, lighting, open);
  }
  r.lay(rgb, 1.0, high);
}

void take_sample(const Scene& scene, Ray1& r, double t_m, double length_m) {
  const P p = r.ray.origin + r.ray.direction * t_m;
  const auto at = inside(scene, p);
  if (!at) {
    r.before_m.reset();
    return;
  }
  std::array<double, 4> sum = meet_masks(scene, r, t_m, p, *at);
  const double share = scene.filled.complete() ? 1.0 : interpolated(scene.filled.known, *at);
  if (scene.view.masks.data_too && share > 0.0) {
    const double db = db_from_counts(interpolated(scene.filled.sv, *at));
    const bool counts = share >= 0.5;
    if (ends_at_surface(scene.view.mode) && counts && db >= scene.view.first_hit_db) {
      hit(scene, r, t_m);
      return;
    }
    if (accumulates(scene.view.mode)) {
      const auto o = optics_at(scene.table, db);
      const Rgb rgb = o[3] > 0.0 ? shaded(scene, r, {o[0], o[1], o[2]}, p) : Rgb{};
      const double e = share * o[3];
      sum = {sum[0] + e * rgb[0], sum[1] + e * rgb[1], sum[2] + e * rgb[2], sum[3] + e};
    } else if (counts && scene.view.mode == RayMode::maximum && db > r.largest_db) {
      r.largest_db = db;
      r.largest_m = t_m;
    }
    r.before_m = counts ? std::optional(t_m) : std::nullopt;
  }
  if (sum[3] > 0.0) {
    r.lay({sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]}, -std::expm1(-sum[3] * length_m), t_m);
  }
}

std::array<float, 4> ray_colour(const Scene& scene, const Ray& ray, double end_m) {
  Ray1 r{ray, dot(ray.direction, scene.camera.forward), scene.view.cue, {}, 1.0, {}, -1e9,
         0.0, std::vector<bool>(scene.masks.size())};
  const double middle = -dot(ray.origin, ray.direction);
  const P nearest = ray.origin + ray.direction * middle;
  const double far_m = scene.volume.sector.range().range_m(scene.filled.sv.shape().samples - 1);
  const double half = std::sqrt(std::max(0.0, far_m * far_m - dot(nearest, nearest)));
  const double first = std::max(0.0, middle - half);
  const double last = std::min(middle + half, end_m);
  for (std::int64_t i = 0; first + (static_cast<double>(i) + 0.5) * scene.step_m < last && r.left > 0.0; ++i) {
    take_sample(scene, r, first + (static_cast<double>(i) + 0.5) * scene.step_m, scene.step_m);
  }
  if (scene.view.mode == RayMode::maximum && r.largest_db > -1e9) {
    const auto o = optics_at(scene.table, r.largest_db);
    if (o[3] > 0.0) r.lay({o[0], o[1], o[2]}, 1.0, r.largest_m);
  }
  const auto f = [](double v) { return static_cast<float>(v); };
  return {f(r.rgb[0]), f(r.rgb[1]), f(r.rgb[2]), f(1.0 - r.left)};
}

Array3<float> confidence_of(const PingMask& mask, Shape3 shape) {
  Array3<float> out(shape, 0.0F);
  std::size_t voxel = 0;
  for (const Run& run : mask.runs) {
    for (int s = run.first_sample; s < run.end(); ++s) {
      out.view().row(run.row)[static_cast<std::size_t>(s)] = static_cast<float>(mask.confidence[voxel++]) / 255.0F;
    }
  }
  return out;
}

/// [layer] A voxel of several schools is that one's whose confidence there is largest.
std::vector<Array3<float>> confidences(std::span<const MaskLayer> masks, Shape3 shape) {
  std::vector<Array3<float>> out;
  for (const MaskLayer& layer : masks) out.push_back(confidence_of(*layer.mask, shape));
  for (std::size_t i = 0; i < shape.size(); ++i) {
    std::size_t owner = 0;
    for (std::size_t k = 1; k < out.size(); ++k) {
      if (out[k].all()[i] > out[owner].all()[i]) owner = k;
    }
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (k != owner) out[k].all()[i] = 0.0F;
    }
  }
  return out;
}

}  // namespace

RayImage brute_force(const VolumeData& volume, const OpticalTable& table, std::span<const MaskLayer> masks,
                     const VolumeView& view, double step_samples, Work& work) {
  const CameraBasis camera = basis(view.camera, view.size);
  const Scene scene{volume,
                    table,
                    masks,
                    view,
                    filled_volume(volume.sv),
                    confidences(masks, volume.sv.shape()),
                    camera,
                    light_direction(camera),
                    step_samples * volume.sector.range().spacing_m};
  RayImage out{view.size, std::vector<std::array<float, 4>>(view.size.count()), {}};
  work.for_each(view.size.height, [&](std::int64_t y) {
    for (int x = 0; x < view.size.width; ++x) {
      const auto i = static_cast<std::size_t>(y * view.size.width + x);
      const double end_m = view.opaque_m ? static_cast<double>((*view.opaque_m)[i]) : 1e9;
      out.rgba[i] = ray_colour(scene, camera.ray({x + 0.5, static_cast<double>(y) + 0.5}), end_m);
    }
  });
  return out;
}

}  // namespace sonar
