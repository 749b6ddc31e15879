// SPDX-License-Identifier: Apache-2.0
// A packet of rays on its way through the volume; included once per target.
#if defined(SONAR_RENDER_CPU_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SONAR_RENDER_CPU_PACKET_INL_H_
#undef SONAR_RENDER_CPU_PACKET_INL_H_
#else
#define SONAR_RENDER_CPU_PACKET_INL_H_
#endif

#include <bit>
#include <type_traits>

#include "base/units.h"
#include "render/cpu/masks-inl.h"
#include "render/cpu/sky-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {

/// State of the rays. kPlain leaves out what only some pictures need: other modes, light, gaps, masks.
template <bool kPlain>
class Packet {
 public:
  Packet(const TraceJob& job, const Rays& ray, V eye_u, V phase, V from, V last)
      : grid_(job.grid),
        optics_(job.optics),
        view_(job.view),
        job_(job),
        ray_(ray),
        phase_(phase),
        from_(from),
        to_(from),
        first_(from),
        last_(last),
        step_(set(job.view.step_m)),
        per_step_(set(1.0F / job.view.step_m)),
        masks_(from, job.view.masks) {
    rgb_ = {zero(), zero(), zero()};
    left_ = set(1.0F);
    if constexpr (!kPlain) {
      largest_ = set(kNothing);
      largest_u_ = zero();
      const auto& ahead = job.view.forward;
      const V depth_per_u =
          hn::MulAdd(ray.dx, set(ahead[0]), hn::MulAdd(ray.dy, set(ahead[1]), hn::Mul(ray.dz, set(ahead[2]))));
      pale_per_u_ = hn::Mul(depth_per_u, set(job.view.per_m));
      pale_from_ = hn::MulAdd(eye_u, pale_per_u_, set(job.view.nearest_m * job.view.per_m));
      before_ = set(-1.0F);
      before_u_ = zero();
    }
  }

  void run(RayCounts& counts) {
    for (;;) {
      const M alive = hn::And(hn::Lt(hn::Add(from_, set(1e-4F)), last_), hn::Gt(left_, set(0.01F)));
      if (!any(alive)) return;
      const M ended = hn::And(alive, hn::Ge(hn::Add(from_, set(1e-4F)), to_));
      if (any(ended)) {
        if constexpr (!kPlain) meet_rest(ended, to_);
        next_piece(grid_, ray_, ended, last_, from_, to_);
        met_sector_ = hn::Or(met_sector_, hn::And(ended, hn::Lt(from_, last_)));
        if constexpr (!kPlain) {
          before_ = hn::IfThenElse(ended, set(-1.0F), before_);
          masks_.pass(ended, from_, none());
        }
        continue;
      }
      advance(alive, counts);
    }
  }

  /// Rays that met the sector.
  M met_sector() const { return met_sector_; }

  void store(std::array<float, 4>* const* out, std::uint32_t lanes) {
    if constexpr (!kPlain) {
      meet_rest(hn::Gt(left_, set(0.01F)), to_);
      if (view_.mode == RayMode::maximum) show_largest();
    }
    // Rays that ended early are opaque: what they had not yet seen is taken to look like what they had.
    const M opaque = hn::Le(left_, set(0.01F));
    const V scale = hn::IfThenElse(opaque, hn::Div(set(1.0F), hn::Sub(set(1.0F), left_)), set(1.0F));
    HWY_ALIGN float value[4][hn::MaxLanes(D())];
    hn::Store(hn::Mul(rgb_.r, scale), D(), value[0]);
    hn::Store(hn::Mul(rgb_.g, scale), D(), value[1]);
    hn::Store(hn::Mul(rgb_.b, scale), D(), value[2]);
    hn::Store(hn::IfThenElse(opaque, set(1.0F), hn::Sub(set(1.0F), left_)), D(), value[3]);
    for (std::size_t i = 0; i < hn::Lanes(D()); ++i) {
      if ((lanes >> i & 1U) != 0) *out[i] = {value[0][i], value[1][i], value[2][i], value[3][i]};
    }
  }

 private:
  static constexpr float kNothing = -40000.0F;  ///< counts below all there are

  /// One step for some: leaps and segments where any lane needs one, samples once half of the lanes are ready.
  HWY_INLINE void advance(M alive, RayCounts& counts) {
    const V multiple = hn::Mul(hn::Add(hn::Floor(hn::MulAdd(from_, per_step_, set(2e-3F))), set(1.0F)), step_);
    // Far out, after tens of thousands of steps, the next multiple may round to where the ray is.
    const V next = hn::IfThenElse(hn::Gt(multiple, from_), multiple, hn::Add(from_, step_));
    const V end = hn::Min(next, to_);
    const V length = hn::Sub(end, from_);
    const V u = hn::MulAdd(phase_, length, from_);
    const Place p = place_at(grid_, ray_, u);
    const W cell = cell_of(grid_, p);
    W word = hn::GatherIndex(I(), job_.cells, cell);
    if constexpr (!kPlain) {
      if (view_.mode == RayMode::maximum) word = lower_than_met(word);
    }
    const M empty = hn::And(alive, is_set<kEmptyBit>(word));
    const M across = hn::Le(hn::Abs(u), hn::Mul(set(kAlongBeams), p.r));
    const M thin = hn::AndNot(empty, hn::And(hn::And(alive, across), is_set<kThinBit>(word)));
    const M moving = hn::Or(empty, thin);
    M ready = alive;
    // Rays at their end stay there, since theirs is the piece's, and opaque ones may go on unseen: so where none moves the
    // next place waits neither for this cell's word nor for this sample's opacity.
    V stop = end;
    if (any(moving)) {
      move(empty, thin, cell, word, p, u, end, counts);
      ready = hn::AndNot(moving, alive);
      if (!any(ready) || 2 * hn::CountTrue(D(), ready) < hn::CountTrue(D(), alive)) return;
      stop = hn::IfThenElse(ready, end, from_);
    }
    counts.samples += static_cast<std::int64_t>(hn::CountTrue(D(), ready));
    sample(ready, p, word, u, length);
    from_ = stop;
    shorten(ready, p, u);
  }

  HWY_NOINLINE void move(M empty, M thin, W cell, W word, const Place& p, V u, V end, RayCounts& counts) {
    counts.leaps += static_cast<std::int64_t>(hn::CountTrue(D(), empty));
    const W distance = hn::Max(hn::Sub(hn::And(word, seti(kCellDistance)), seti(1)), seti(0));
    if constexpr (!kPlain) meet_rest(hn::Or(empty, thin), u);
    const V exit = block_exit(grid_, ray_, p, distance, u, to_);
    const V step = set(view_.step_m);
    const V per_step = set(1.0F / view_.step_m);
    // The first sample beyond an empty block; the nearest end of an interval behind a thin cell.
    const V after = hn::Mul(hn::Ceil(hn::Sub(hn::Mul(exit, per_step), phase_)), step);
    const V beyond = hn::IfThenElse(hn::Ge(exit, to_), to_, hn::Min(hn::Max(after, end), to_));
    from_ = hn::IfThenElse(empty, beyond, from_);
    if constexpr (!kPlain) {
      // The last place of a cell without gaps that is not walked is below every level that matters.
      const M passed = hn::Or(empty, thin);
      const V below = hn::IfThenElse(is_set<kGapsBit>(word), set(-1.0F), set(1.0F));
      before_ = hn::IfThenElse(passed, below, before_);
      before_u_ = hn::IfThenElse(passed, hn::Min(exit, to_), before_u_);
      if (view_.masked) masks_.pass(passed, hn::Min(exit, to_), none());
    }
    if (any(thin)) {
      counts.segments += static_cast<std::int64_t>(hn::CountTrue(D(), thin));
      const V nearest = hn::Mul(hn::Round(hn::Mul(exit, per_step)), step);
      const V stop = hn::IfThenElse(hn::Ge(exit, to_), to_, hn::Min(hn::Max(nearest, end), to_));
      segment(thin, cell, from_, stop);
      from_ = hn::IfThenElse(thin, stop, from_);
    }
    step_ = hn::IfThenElse(hn::Or(empty, thin), step, step_);
    per_step_ = hn::IfThenElse(hn::Or(empty, thin), per_step, per_step_);
  }

  void segment(M lanes, W cell, V from, V stop) {
    V mean[4];
    rows_at(reinterpret_cast<const float*>(job_.means), cell, mean);
    const V extinction = mean[3];
    const V opacity = opacity_of(hn::IfThenElseZero(lanes, hn::Mul(extinction, hn::Sub(stop, from))));
    Rgb emission{mean[0], mean[1], mean[2]};
    if constexpr (!kPlain) fade(emission, extinction, hn::Mul(set(0.5F), hn::Add(from, stop)));
    V share = hn::Mul(hn::Mul(opacity, left_), inverse(hn::Max(extinction, set(1e-12F))));
    share = hn::IfThenElseZero(lanes, share);
    rgb_.r = hn::MulAdd(share, emission.r, rgb_.r);
    rgb_.g = hn::MulAdd(share, emission.g, rgb_.g);
    rgb_.b = hn::MulAdd(share, emission.b, rgb_.b);
    left_ = hn::IfThenElse(lanes, hn::NegMulAdd(opacity, left_, left_), left_);
  }

  HWY_INLINE void sample(M lanes, const Place& p, W word, V u, V length) {
    if constexpr (kPlain) {
      const V value = value_at(grid_, p);
      const Seen seen = seen_at(value);
      if (!any(hn::Gt(seen.extinction, zero()))) return;
      lay(hn::IfThenElseZero(lanes, opacity_of(hn::Mul(seen.extinction, length))), unpacked(seen.rgb10), u);
    } else {
      sample_any(lanes, p, word, u, length);
    }
  }

  HWY_NOINLINE void sample_any(M lanes, const Place& p, W word, V u, V length) {
    const W voxel = voxel_of(grid_, p);
    Rgb emission{zero(), zero(), zero()};
    V extinction = zero();
    const Heard heard = view_.data ? heard_at(lanes, p, voxel, word) : Heard{zero(), zero(), none()};
    M hits = none();
    V until = u;
    if (ends_at_surface(view_.mode)) {
      hits = hn::And(heard.counts, hn::Ge(heard.value, set(view_.first_hit_count)));
      if (any(hits)) until = hn::IfThenElse(hits, level_before(u), u);
      before_ = hn::IfThenElse(heard.counts, set(1.0F), hn::IfThenElse(lanes, set(-1.0F), before_));
      before_u_ = hn::IfThenElse(lanes, u, before_u_);
    }
    if (view_.masked) {
      const M here = hn::And(lanes, is_set<kMaskBit>(word));
      const M near = hn::Or(here, hn::And(lanes, masks_.near()));
      if (any(near)) meet_masks(near, until, true, length, emission, extinction);
      masks_.pass(lanes, u, here);
    }
    if (any(hits)) {
      lay_sum(hits, emission, extinction, length, u);
      hit(hits, until);
    }
    if (view_.data) meet_data(lanes, p, voxel, heard, u, emission, extinction);
    lay_sum(lanes, emission, extinction, length, u);
  }

  /// Over a length round u.
  void lay_sum(M lanes, const Rgb& emission, V extinction, V length, V u) {
    if (!any(hn::And(lanes, hn::Gt(extinction, zero())))) return;
    const V per = hn::Div(set(1.0F), hn::Max(extinction, set(1e-12F)));
    lay(hn::IfThenElseZero(lanes, opacity_of(hn::Mul(extinction, length))),
        {hn::Mul(emission.r, per), hn::Mul(emission.g, per), hn::Mul(emission.b, per)}, u);
  }

  struct Heard {
    V value, share;
    M counts;  ///< enough is known
  };
  Heard heard_at(M lanes, const Place& p, W voxel, W word) const {
    V share = set(1.0F);
    if (grid_.known != nullptr && any(hn::And(lanes, is_set<kGapsBit>(word)))) share = share_of(grid_, voxel, p);
    return {value_at(grid_, p), share, hn::And(lanes, hn::Ge(share, set(0.5F)))};
  }

  void meet_data(M lanes, const Place& p, W voxel, const Heard& heard, V u, Rgb& emission, V& extinction) {
    const V value = heard.value;
    if (view_.mode == RayMode::maximum) {
      const M larger = hn::And(heard.counts, hn::Gt(value, largest_));
      largest_ = hn::IfThenElse(larger, value, largest_);
      largest_u_ = hn::IfThenElse(larger, u, largest_u_);
    }
    if (!accumulates(view_.mode)) return;
    const Seen seen = seen_at(value);
    const V own = hn::IfThenElseZero(lanes, hn::Mul(heard.share, seen.extinction));
    if (!any(hn::Gt(own, zero()))) return;
    Rgb rgb = unpacked(seen.rgb10);
    if (view_.lighting.on) {
      const Slope slope = slope_of(corners_of(grid_, voxel), p);
      light(view_, ray_, gradient_of(grid_, p, slope), static_cast<float>(kDbPerCount), rgb, set(1.0F));
    }
    emission.r = hn::MulAdd(own, rgb.r, emission.r);
    emission.g = hn::MulAdd(own, rgb.g, emission.g);
    emission.b = hn::MulAdd(own, rgb.b, emission.b);
    extinction = hn::Add(extinction, own);
  }

  /// Where the level is reached between the last sample and the one at u.
  V level_before(V u) const {
    V low = hn::IfThenElse(hn::Gt(before_, zero()), before_u_, u);
    V high = u;
    for (int i = 0; i < 10; ++i) {
      const V middle = hn::Mul(set(0.5F), hn::Add(low, high));
      const Place p = place_at(grid_, ray_, middle);
      const M above = hn::Ge(value_at(grid_, p), set(view_.first_hit_count));
      high = hn::IfThenElse(above, middle, high);
      low = hn::IfThenElse(above, low, middle);
    }
    return high;
  }

  /// Ends the rays of `lanes` at a surface.
  void hit(M lanes, V u) {
    const Place p = place_at(grid_, ray_, u);
    const Corners corners = corners_of(grid_, voxel_of(grid_, p));
    Rgb rgb = unpacked(seen_at(value_of(corners, p)).rgb10);
    if (view_.lighting.on) {
      const Gradient g = gradient_of(grid_, p, slope_of(corners, p));
      const V sky = view_.lighting.occlusion_m > 0.0F ? sky_over(grid_, view_, p, g) : set(1.0F);
      light(view_, ray_, g, static_cast<float>(kDbPerCount), rgb, sky);
    }
    lay(hn::IfThenElseZero(lanes, set(1.0F)), rgb, u);
  }

  void meet_masks(M lanes, V u, bool at_sample, V length, Rgb& emission, V& extinction) {
    masks_.meet(job_, ray_, lanes, u, at_sample, length, emission, extinction,
                [this](V opacity, const Rgb& rgb, V at) { lay(opacity, rgb, at); });
  }

  /// What is left of masks behind the last sample, up to u.
  void meet_rest(M passed, V u) {
    if (!view_.masked) return;
    const M lanes = hn::And(passed, masks_.near());
    if (!any(lanes)) return;
    Rgb emission{zero(), zero(), zero()};
    V extinction = zero();
    meet_masks(lanes, u, false, set(1.0F), emission, extinction);
    lay_sum(lanes, emission, extinction, set(1.0F), u);
    masks_.pass(lanes, u, none());
  }

  /// Cells that cannot raise a ray's maximum are empty to it; masks there count all the same.
  W lower_than_met(W word) const {
    const M lower = hn::Le(hn::ConvertTo(D(), hn::ShiftRight<16>(word)), largest_);
    const M idle = hn::AndNot(hn::Or(is_set<kEmptyBit>(word), is_set<kMaskBit>(word)), lower);
    return hn::IfThenElse(hn::RebindMask(I(), idle), hn::Or(word, seti(1 | 1 << kEmptyBit)), word);
  }

  /// The peak between samples.
  void climb() {
    const M met = hn::Gt(largest_, set(kNothing));
    V reach = set(view_.step_m);
    for (int i = 0; i < kClimbs; ++i) {
      reach = hn::Mul(reach, set(0.5F));
      const V middle = largest_u_;
      for (const float side : {-1.0F, 1.0F}) {
        const V u = hn::Clamp(hn::MulAdd(reach, set(side), middle), first_, last_);
        const Place p = place_at(grid_, ray_, u);
        const V value = value_at(grid_, p);
        const M larger = hn::And(hn::And(met, is_known(grid_, p)), hn::Gt(value, largest_));
        largest_ = hn::IfThenElse(larger, value, largest_);
        largest_u_ = hn::IfThenElse(larger, u, largest_u_);
      }
    }
  }

  void show_largest() {
    climb();
    const Seen seen = seen_at(largest_);
    const M shown = hn::And(hn::Gt(largest_, set(kNothing)), hn::Gt(seen.extinction, zero()));
    lay(hn::IfThenElseZero(shown, set(1.0F)), unpacked(seen.rgb10), largest_u_);
  }

  struct Seen {
    V extinction;
    W rgb10;
  };
  /// What the transfer table shows at a value, in counts.
  Seen seen_at(V value) const {
    const V at = hn::MulAdd(value, set(optics_.per_count), set(optics_.first));
    V extinction;
    V colour;
    pairs_at(optics_.entries, nearest_int(hn::Clamp(at, zero(), set(optics_.last_entry))), extinction, colour);
    return {extinction, hn::BitCast(I(), colour)};
  }

  /// Colours times `weight`, mixed with the background by their depth.
  void fade(Rgb& rgb, V weight, V u) const {
    if (view_.palest <= 0.0F) return;
    const V part = hn::Clamp(hn::MulSub(u, pale_per_u_, pale_from_), zero(), set(1.0F));
    const V pale = hn::Mul(part, set(view_.palest));
    const auto mixed = [&](V own, float ground) { return lerp(own, hn::Mul(weight, set(ground)), pale); };
    rgb = {mixed(rgb.r, view_.ground[0]), mixed(rgb.g, view_.ground[1]), mixed(rgb.b, view_.ground[2])};
  }

  void lay(V opacity, Rgb rgb, V u) {
    if constexpr (!kPlain) fade(rgb, set(1.0F), u);
    const V share = hn::Mul(opacity, left_);
    rgb_.r = hn::MulAdd(share, rgb.r, rgb_.r);
    rgb_.g = hn::MulAdd(share, rgb.g, rgb_.g);
    rgb_.b = hn::MulAdd(share, rgb.b, rgb_.b);
    left_ = hn::Sub(left_, share);
  }

  /// Steps fit the narrow cells near the transducer, and rays along the beams.
  void shorten(M lanes, const Place& p, V u) {
    const V across =
        hn::Mul(set(0.5F), hn::Min(hn::Mul(p.r, set(grid_.least_fan_rad)), hn::Mul(p.rho, set(grid_.least_beam_rad))));
    const V full = set(view_.step_m);
    const M along = hn::Gt(hn::Abs(u), hn::Mul(set(kAlongBeams), p.r));
    const V narrow = hn::IfThenElse(along, hn::Min(across, hn::Mul(full, set(0.75F))), across);
    if (!any(hn::And(lanes, hn::Or(hn::Lt(narrow, full), hn::Lt(step_, full))))) return;
    V part = set(1.0F);
    for (const float p2 : {0.5F, 0.25F, 0.125F}) {
      part = hn::IfThenElse(hn::Lt(narrow, hn::Mul(full, set(2.0F * p2))), set(p2), part);
    }
    step_ = hn::IfThenElse(lanes, hn::Mul(full, part), step_);
    per_step_ = hn::IfThenElse(lanes, hn::Mul(set(1.0F / view_.step_m), inverse(part)), per_step_);
  }

  const TraceGrid& grid_;
  const TraceOptics& optics_;
  const TraceView& view_;
  const TraceJob& job_;
  Rays ray_;
  V phase_, from_, to_, first_, last_, step_, per_step_;
  V left_;
  M met_sector_ = none();
  Rgb rgb_;
  V largest_, largest_u_, before_, before_u_;
  V pale_per_u_, pale_from_;
  std::conditional_t<kPlain, NoMasks, MasksMet> masks_;
};

}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SONAR_RENDER_CPU_PACKET_INL_H_
