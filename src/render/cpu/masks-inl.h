// SPDX-License-Identifier: Apache-2.0
// The schools' masks round a place; included once per target.
#if defined(SONAR_RENDER_CPU_MASKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SONAR_RENDER_CPU_MASKS_INL_H_
#undef SONAR_RENDER_CPU_MASKS_INL_H_
#else
#define SONAR_RENDER_CPU_MASKS_INL_H_
#endif

#include <algorithm>

#include "render/cpu/field-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {

inline constexpr std::int32_t kNoLayer = 256;

/// The voxels round a place: [fan][beam] layer << 8 | confidence of two neighbouring samples in each word.
struct MaskCorners {
  Place place;
  W word[4];
};

HWY_INLINE MaskCorners mask_corners(const TraceGrid& grid, const Rays& ray, V u) {
  MaskCorners out;
  out.place = place_at(grid, ray, u);
  gather_columns(grid, grid.masks, voxel_of(grid, out.place), out.word);
  return out;
}

/// The lowest layer above one that touches the voxels of some lane.
HWY_INLINE std::int32_t next_layer(M lanes, const MaskCorners& at, std::int32_t above) {
  W least = seti(kNoLayer);
  const auto take = [&](W layer) {
    least = hn::Min(least, hn::IfThenElse(hn::Gt(layer, seti(above)), layer, seti(kNoLayer)));
  };
  for (const W word : at.word) {
    take(hn::And(hn::ShiftRight<8>(word), seti(0xFF)));
    take(hn::And(hn::ShiftRight<24>(word), seti(0xFF)));
  }
  return hn::GetLane(hn::MinOfLanes(I(), hn::IfThenElse(hn::RebindMask(I(), lanes), least, seti(kNoLayer))));
}

/// Confidence of one layer's own voxels, 0..255.
HWY_INLINE Corners confidence_of(const MaskCorners& at, std::int32_t layer) {
  const auto own = [layer](W half) {
    const auto of_layer = hn::Eq(hn::ShiftRight<8>(half), seti(layer));
    return hn::ConvertTo(D(), hn::IfThenElseZero(of_layer, hn::And(half, seti(0xFF))));
  };
  Corners out;
  for (int i = 0; i < 4; ++i) {
    out.first[i] = own(hn::And(at.word[i], seti(0xFFFF)));
    out.second[i] = own(hn::And(hn::ShiftRight<16>(at.word[i]), seti(0xFFFF)));
  }
  return out;
}

HWY_INLINE V confidence_at(const MaskCorners& at, std::int32_t layer) {
  return value_of(confidence_of(at, layer), at.place);
}

/// Where between two places a layer's confidence reaches a level, or falls below it where it does not rise.
HWY_NOINLINE V mask_crossing(const TraceGrid& grid, const Rays& ray, std::int32_t layer, V low, V high, float level,
                             M rises) {
  for (int i = 0; i < kMaskHalvings; ++i) {
    const V middle = hn::Mul(set(0.5F), hn::Add(low, high));
    const M reached = hn::Ge(confidence_at(mask_corners(grid, ray, middle), layer), set(level));
    const M later = hn::Xor(reached, rises);
    low = hn::IfThenElse(later, middle, low);
    high = hn::IfThenElse(later, high, middle);
  }
  return high;
}

/// Slope of a layer where its surface is at `u`; ray_rules.h tells where it is taken.
HWY_INLINE Gradient mask_slope(const TraceGrid& grid, const Rays& ray, std::int32_t layer, V u, V step, float level) {
  const MaskCorners behind = mask_corners(grid, ray, hn::MulAdd(set(0.5F), step, u));
  const M deep = hn::Ge(confidence_at(behind, layer), set(level));
  const MaskCorners at = mask_corners(grid, ray, hn::IfThenElse(deep, hn::MulAdd(set(0.5F), step, u), u));
  return gradient_of(grid, at.place, slope_of(confidence_of(at, layer), at.place));
}

/// What a packet's rays have met of the masks so far.
class MasksMet {
 public:
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): as many of surfaces_ as there are masks
  MasksMet(V from, int layers) : to_(from), near_(none()) {
    for (int i = 0; i <= layers; ++i) surfaces_[i] = 0;
  }
  /// Rays whose last sample lay in a cell with masks: between it and the next place may be more of these.
  M near() const { return near_; }
  /// All up to u has been met.
  /// here  rays whose sample at u lies in a cell with masks
  void pass(M lanes, V u, M here) {
    to_ = hn::IfThenElse(lanes, u, to_);
    near_ = hn::Or(here, hn::AndNot(lanes, near_));
  }

  /// Up to u: all layers that touch the voxels round both ends, the lowest number first. What their cores add is told as if
  /// it lay evenly in `length`; lay(opacity, colour, place) takes surfaces.
  /// at_sample  surfaces count where a sample, or the end of a ray at one, has reached them
  template <class Lay>
  HWY_NOINLINE void meet(const TraceJob& job, const Rays& ray, M lanes, V u, bool at_sample, V length, Rgb& emission,
                         V& extinction, const Lay& lay) {
    const TraceView& view = job.view;
    const V per_length = hn::Div(set(view.core_extinction), hn::Max(length, set(1e-6F)));  // 0 of rays that stand still
    const MaskCorners before = mask_corners(job.grid, ray, to_);
    const MaskCorners here = mask_corners(job.grid, ray, u);
    const auto next = [&](std::int32_t above) {
      return std::min(next_layer(lanes, before, above), next_layer(lanes, here, above));
    };
    for (std::int32_t layer = next(0); layer < kNoLayer; layer = next(layer)) {
      const Piece piece{layer, u, confidence_at(before, layer), confidence_at(here, layer)};
      const auto& c = view.mask_rgb[layer - 1];
      const Rgb colour{set(c[0]), set(c[1]), set(c[2])};
      if (at_sample) meet_surface(job, ray, lanes, piece, colour, lay);
      if (view.core_extinction <= 0.0F) continue;
      const V own = hn::Mul(in_core(job, ray, lanes, piece), per_length);
      emission.r = hn::MulAdd(own, colour.r, emission.r);
      emission.g = hn::MulAdd(own, colour.g, emission.g);
      emission.b = hn::MulAdd(own, colour.b, emission.b);
      extinction = hn::Add(extinction, own);
    }
  }

 private:
  /// Of a layer, up to u.
  struct Piece {
    std::int32_t layer;
    V u;
    V first, last;  ///< confidence at both ends
  };

  template <class Lay>
  void meet_surface(const TraceJob& job, const Rays& ray, M lanes, const Piece& piece, Rgb rgb, const Lay& lay) {
    const float level = job.view.fuzzy_at;
    const M reached = hn::And(lanes, hn::Ge(piece.last, set(level)));
    const std::uint32_t fresh = bits(reached) & ~surfaces_[piece.layer];
    if (fresh == 0) return;
    surfaces_[piece.layer] |= fresh;
    const M rises = hn::Lt(piece.first, set(level));
    const V at = hn::IfThenElse(rises, mask_crossing(job.grid, ray, piece.layer, to_, piece.u, level, rises), to_);
    if (job.view.lighting.on) {
      const Gradient slope = mask_slope(job.grid, ray, piece.layer, at, set(job.view.step_m), level);
      light(job.view, ray, slope, 1e6F, rgb, set(1.0F));
    }
    lay(hn::IfThenElseZero(mask_of(fresh), set(job.view.fuzzy_opacity)), rgb, at);
  }

  /// Metres that lie in a layer's core.
  V in_core(const TraceJob& job, const Rays& ray, M lanes, const Piece& piece) const {
    const float level = job.view.core_at;
    const M begins = hn::And(lanes, hn::Ge(piece.first, set(level)));
    const M ends = hn::And(lanes, hn::Ge(piece.last, set(level)));
    V from = to_;
    V to = piece.u;
    if (any(hn::Xor(begins, ends))) {
      const V at = mask_crossing(job.grid, ray, piece.layer, from, to, level, ends);
      from = hn::IfThenElse(hn::AndNot(begins, ends), at, from);
      to = hn::IfThenElse(hn::AndNot(ends, begins), at, to);
    }
    return hn::IfThenElseZero(hn::Or(begins, ends), hn::Sub(to, from));
  }

  V to_;
  M near_;
  std::uint32_t surfaces_[kNoLayer];  ///< [layer] a bit a ray that has met it
};

/// Where there are none.
struct NoMasks {
  NoMasks(V, int) {}
};

}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SONAR_RENDER_CPU_MASKS_INL_H_
