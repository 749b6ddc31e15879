// SPDX-License-Identifier: Apache-2.0
#include "render/gl/ray_block.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "render/ray_rules.h"

namespace sonar {
namespace {

float f(double value) { return static_cast<float>(value); }

/// Into the fan frame.
Vec4 turned(const Point<Sonar>& p, double middle_rad, double w) {
  const double c = std::cos(middle_rad);
  const double s = std::sin(middle_rad);
  return {f(p.x * c + p.y * s), f(-p.x * s + p.y * c), f(p.z), f(w)};
}

/// fract(0.618... n) in doubles: a float would lose it in long series.
double jitter_offset(std::uint32_t frame) {
  const double offset = 0.61803399 * frame;
  return frame == 0 ? -1.0 : offset - std::floor(offset);
}

void fill_camera(const RayBlockSource& s, RayBlock& out) {
  const CameraBasis camera = basis(s.view.camera, s.view.size);
  const double middle = s.axes.middle_rad;
  out.right = turned(camera.right, middle, camera.tan_half_fov);
  out.up = turned(camera.up, middle, s.quality.step_samples * s.axes.spacing_m);
  out.forward = turned(camera.forward, middle, s.surface_z_m);
  const bool moves = moves_samples(s.view.mode, s.view.masks.data_too);
  out.eye = turned(camera.eye, middle, jitter_offset(moves ? s.quality.jitter_frame : 0));
  out.light = turned(light_direction(camera), middle, static_cast<double>(s.view.lighting.full_gradient_db_per_m));
  const Lighting& l = s.view.lighting;
  out.lighting = {l.ambient, l.diffuse, l.specular, f(kDbPerCount)};
  const DepthCue& cue = s.view.cue;
  const Rgba8& c = cue.background;
  out.ground = {f(c.r / 255.0), f(c.g / 255.0), f(c.b / 255.0), f(DepthCue::kPalest)};
  const PixelPoint shift = pixel_shift(s.quality.jitter_frame);
  out.frame = {f(shift.x), f(shift.y), f(cue.nearest_m), cue.on() ? f(1.0 / (cue.farthest_m - cue.nearest_m)) : 0.0F};
  const auto sky = sky_rays(s.quality.jitter_frame);
  for (std::size_t i = 0; i < sky.size(); ++i) out.sky[i] = {sky[i][0], sky[i][1], sky[i][2], 0.0F};
  out.picture = {s.view.size.width, s.view.size.height, s.quality.divisor, 0};
}

void fill_grid(const RayBlockSource& s, RayBlock& out) {
  const GridAxes& a = s.axes;
  const double h = s.quality.step_samples * a.spacing_m;
  const double narrowest = std::max(1e-6, std::min(a.least_beam_rad, a.least_fan_rad));
  out.sides = {f(std::sin(a.half_width_rad)), f(std::cos(a.half_width_rad)), f(a.nearest_m), f(a.farthest_m)};
  out.cones = {f(std::abs(std::sin(a.first_elevation_rad))), f(std::abs(std::sin(a.last_elevation_rad))),
               f(2.0 * h / narrowest), s.view.lighting.occlusion_m};
  out.angle = {f(a.beam_of.first), f(a.beam_of.per_unit), f(a.fan_of.first), f(a.fan_of.per_unit)};
  if (a.even_beams) {
    out.angle[0] = f(-a.half_width_rad);
    out.angle[1] = f((a.beams - 1) / (2.0 * a.half_width_rad));
  }
  if (a.even_fans) {
    out.angle[2] = f(a.first_elevation_rad);
    out.angle[3] = f((a.fans - 1) / (a.last_elevation_rad - a.first_elevation_rad));
  }
  out.range = {f(a.first_m), f(1.0 / a.spacing_m), f(a.spacing_m), f(counts_from_db(s.view.first_hit_db))};
  out.cells = {s.cells[0], s.cells[1], s.cells[2], 0};
  out.size = {a.samples, a.beams, a.fans, 0};
}

void fill_folds(const RayBlockSource& s, RayBlock& out) {
  const FoldPlan& p = s.plan;
  const auto stride = [&](std::size_t axis) { return static_cast<float>(std::max(1, p.length[axis] - 1)); };
  out.texel = {1.0F / static_cast<float>(p.texture[0]), 1.0F / static_cast<float>(p.texture[1]),
               1.0F / static_cast<float>(p.texture[2]), 0.0F};
  out.stride = {stride(0), stride(1), stride(2), static_cast<float>(p.channels)};
  out.stack = {static_cast<float>(p.pitch(1)), static_cast<float>(p.pitch(2)), static_cast<float>(p.border(1)),
               static_cast<float>(p.border(2))};
  out.pieces = {p.pieces[0], p.pieces[1], p.pieces[2], p.slots[0]};
}

}  // namespace

RayBlock ray_block(const RayBlockSource& source) {
  RayBlock out{};
  fill_camera(source, out);
  fill_grid(source, out);
  fill_folds(source, out);
  out.table = {source.table.per_count, source.table.first, static_cast<float>(source.table.size() - 1),
               f(source.counts_per_unit)};
  const MaskStyle& m = source.view.masks;
  out.mask = {m.fuzzy_above, m.core_at, std::clamp(m.fuzzy_opacity, 0.0F, 1.0F),
              std::max(0.0F, m.core_extinction_per_m)};
  return out;
}

}  // namespace sonar
