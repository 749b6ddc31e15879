// SPDX-License-Identifier: Apache-2.0
// The median's network on planes of beams; included once per target.
#if defined(SONAR_SIGNAL_MEDIAN_STRIP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SONAR_SIGNAL_MEDIAN_STRIP_INL_H_
#undef SONAR_SIGNAL_MEDIAN_STRIP_INL_H_
#else
#define SONAR_SIGNAL_MEDIAN_STRIP_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "signal/median_strip.h"
#include "signal/merge_network.h"

// NOLINTBEGIN(misc-definitions-in-headers): one a target, each in a namespace of its own
HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE

// One lane gains nothing, and vectors of unknown size make no arrays: the histogram does it.
bool HasNetwork() { return false; }
void MedianChunk(const MaskedBox&, int, int, int, View3<std::int16_t>) {}

#else

bool HasNetwork() { return true; }

namespace hn = hwy::HWY_NAMESPACE;
// 256 bits at most: wider ones do no more minima a cycle, and the networks need registers more than width.
using Lanes = hn::CappedTag<std::int16_t, 16>;
using LaneVec = hn::Vec<Lanes>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Lanes()));

/// Where a program's inputs lie: two sorted lists, each one vector after the other.
template <int FirstCount>
struct TwoLists {
  const std::int16_t* first;
  const std::int16_t* second;
  template <int I>
  HWY_INLINE LaneVec load() const {
    return hn::Load(Lanes(), I < FirstCount ? first + I * kLanes : second + (I - FirstCount) * kLanes);
  }
};

/// The 3 x 3 beams round each lane of a slice.
struct NineBeams {
  const std::int16_t* centre;
  std::ptrdiff_t fan_stride;
  template <int I>
  HWY_INLINE LaneVec load() const {
    return hn::LoadU(Lanes(), centre + (I % 3 - 1) * fan_stride + (I / 3 - 1));
  }
};

template <class Program, std::size_t I, class Inputs>
HWY_INLINE void step(LaneVec* values, const Inputs& inputs, std::int16_t* HWY_RESTRICT out) {
  constexpr MergeStep s = kSteps<Program>[I];
  if constexpr (s.kind == MergeStep::Kind::load) {
    values[s.value] = inputs.template load<s.a>();
  } else if constexpr (s.kind == MergeStep::Kind::minimum) {
    values[s.value] = hn::Min(values[s.a], values[s.b]);
  } else if constexpr (s.kind == MergeStep::Kind::maximum) {
    values[s.value] = hn::Max(values[s.a], values[s.b]);
  } else {
    hn::Store(values[s.a], Lanes(), out + s.b * kLanes);
  }
}

// Compilers limit how many terms one fold may have.
constexpr std::size_t kStepsTogether = 128;

template <class Program, std::size_t First, class Inputs, std::size_t... I>
HWY_INLINE void run_piece(LaneVec* values, const Inputs& inputs, std::int16_t* HWY_RESTRICT out,
                          std::index_sequence<I...>) {
  (step<Program, First + I>(values, inputs, out), ...);
}

template <class Program, class Inputs, std::size_t... Piece>
HWY_INLINE void run_pieces(const Inputs& inputs, std::int16_t* HWY_RESTRICT out, std::index_sequence<Piece...>) {
  constexpr std::size_t kAll = kSize<Program>.steps;
  LaneVec values[kSize<Program>.values];
  (run_piece<Program, Piece * kStepsTogether>(
       values, inputs, out, std::make_index_sequence<std::min(kStepsTogether, kAll - Piece * kStepsTogether)>()),
   ...);
}

/// Runs a program on one vector of lanes.
template <class Program, class Inputs>
HWY_NOINLINE void run(const Inputs inputs, std::int16_t* HWY_RESTRICT out) {
  constexpr std::size_t kPieces = (kSize<Program>.steps + kStepsTogether - 1) / kStepsTogether;
  run_pieces<Program>(inputs, out, std::make_index_sequence<kPieces>());
}

template <int M, int N, int First = 0, int Count = M + N>
HWY_INLINE void merge(const std::int16_t* a, const std::int16_t* b, std::int16_t* out) {
  run<MergeOf<M, N, First, Count> >(TwoLists<M>{a, b}, out);
}

/// Sorted lists of one block of eight slices. What is needed in the block's own tile only is apart from what is needed
/// when it has become the left end of a window, so that the long-lived part stays small.
struct ShortLived {
  alignas(64) std::int16_t single[4][9 * kLanes];  ///< slices 0 2 4 6
  alignas(64) std::int16_t pair[2][18 * kLanes];   ///< slices 01 45
  alignas(64) std::int16_t quad[36 * kLanes];      ///< slices 0123
};
struct LongLived {
  alignas(64) std::int16_t single[4][9 * kLanes];  ///< slices 1 3 5 7
  alignas(64) std::int16_t pair[2][18 * kLanes];   ///< slices 23 67
  alignas(64) std::int16_t quad[36 * kLanes];      ///< slices 4567
  alignas(64) std::int16_t all[72 * kLanes];
};

void build_block(const std::int16_t* centre, std::ptrdiff_t plane, std::ptrdiff_t fan_stride, bool need_all,
                 ShortLived& now, LongLived& late) {
  // The next block's slices lie a plane apart, which no processor guesses.
  for (int i = 8; i < 16; ++i) {
    for (int fan = -1; fan <= 1; ++fan) hwy::Prefetch(centre + i * plane + fan * fan_stride);
  }
  for (int i = 0; i < 4; ++i) {
    run<SortOfNine>(NineBeams{centre + (2 * i) * plane, fan_stride}, now.single[i]);
    run<SortOfNine>(NineBeams{centre + (2 * i + 1) * plane, fan_stride}, late.single[i]);
    merge<9, 9>(now.single[i], late.single[i], i % 2 == 0 ? now.pair[i / 2] : late.pair[i / 2]);
  }
  merge<18, 18>(now.pair[0], late.pair[0], now.quad);
  merge<18, 18>(now.pair[1], late.pair[1], late.quad);
  if (need_all) merge<36, 36>(now.quad, late.quad, late.all);
}

/// Two outputs from what they share, ten candidates, and one slice each.
HWY_INLINE void finish_pair(const std::int16_t* half, const std::int16_t* pair, const std::int16_t* left,
                            const std::int16_t* right, std::int16_t* out) {
  alignas(64) std::int16_t ten[10 * kLanes];
  merge<28, 18, 18, 10>(half, pair, ten);
  run<MiddleOf<10, 9> >(TwoLists<10>{ten, left}, out);
  run<MiddleOf<10, 9> >(TwoLists<10>{ten, right}, out + kLanes);
}

/// Eight medians from the blocks under their windows.
/// core    the blocks between `left` and the newest: none, one or two (kernel lengths 7, 15, 23)
void compute_tile(const LongLived& left, const LongLived* const* core, int core_blocks, const ShortLived& right,
                  std::int16_t* out) {
  alignas(64) std::int16_t shared[64 * kLanes];
  alignas(64) std::int16_t left_half[28 * kLanes];
  alignas(64) std::int16_t right_half[28 * kLanes];
  const std::int16_t* left_source = left_half;
  const std::int16_t* right_source = right_half;
  if (core_blocks == 0) {
    left_source = left.quad + 4 * kLanes;  // of 36 values, 27 to come, the middle 28 are ranks 4 .. 31
    right_source = right.quad + 4 * kLanes;
  } else {
    const std::int16_t* middle = core[0]->all + 4 * kLanes;  // of 72, 63 to come: ranks 4 .. 67
    if (core_blocks == 2) {
      merge<72, 72, 40, 64>(core[0]->all, core[1]->all, shared);  // of 144, 63 to come: ranks 40 .. 103
      middle = shared;
    }
    merge<64, 36, 36, 28>(middle, left.quad, left_half);  // of 100, 27 to come: ranks 36 .. 63
    merge<64, 36, 36, 28>(middle, right.quad, right_half);
  }
  finish_pair(left_source, left.pair[0], left.single[0], right.single[0], out);
  finish_pair(left_source, right.pair[0], left.single[1], right.single[1], out + 2 * kLanes);
  finish_pair(right_source, left.pair[1], left.single[2], right.single[2], out + 4 * kLanes);
  finish_pair(right_source, right.pair[1], left.single[3], right.single[3], out + 6 * kLanes);
}

/// Transposes 8 x 8 counts.
HWY_INLINE void transpose_8x8(const std::int16_t* const from[8], std::int16_t* to, std::ptrdiff_t to_stride) {
  const hn::FixedTag<std::int16_t, 8> d16;
  const hn::FixedTag<std::int32_t, 4> d32;
  const hn::FixedTag<std::int64_t, 2> d64;
  using V16 = hn::Vec<decltype(d16)>;
  using V32 = hn::Vec<decltype(d32)>;
  V16 row[8];
  for (int i = 0; i < 8; ++i) row[i] = hn::LoadU(d16, from[i]);
  V32 pairs[8];
  for (int i = 0; i < 4; ++i) {
    pairs[2 * i] = hn::BitCast(d32, hn::InterleaveLower(d16, row[2 * i], row[2 * i + 1]));
    pairs[2 * i + 1] = hn::BitCast(d32, hn::InterleaveUpper(d16, row[2 * i], row[2 * i + 1]));
  }
  for (int half = 0; half < 2; ++half) {
    const auto low_a = hn::BitCast(d64, hn::InterleaveLower(d32, pairs[half], pairs[half + 2]));
    const auto high_a = hn::BitCast(d64, hn::InterleaveUpper(d32, pairs[half], pairs[half + 2]));
    const auto low_b = hn::BitCast(d64, hn::InterleaveLower(d32, pairs[half + 4], pairs[half + 6]));
    const auto high_b = hn::BitCast(d64, hn::InterleaveUpper(d32, pairs[half + 4], pairs[half + 6]));
    std::int16_t* at = to + 4 * half * to_stride;
    hn::StoreU(hn::BitCast(d16, hn::InterleaveLower(d64, low_a, low_b)), d16, at);
    hn::StoreU(hn::BitCast(d16, hn::InterleaveUpper(d64, low_a, low_b)), d16, at + to_stride);
    hn::StoreU(hn::BitCast(d16, hn::InterleaveLower(d64, high_a, high_b)), d16, at + 2 * to_stride);
    hn::StoreU(hn::BitCast(d16, hn::InterleaveUpper(d64, high_a, high_b)), d16, at + 3 * to_stride);
  }
}

/// Planes of slices first .. first + count - 1 (a multiple of 8; may begin before sample 0, in the rows' margins).
void fill_planes(const MaskedBox& masked, const std::vector<std::ptrdiff_t>& row_of_lane, int plane, int first,
                 int count, std::int16_t* planes) {
  for (int p = 0; p < plane; p += 8) {
    const std::int16_t* from[8];
    const std::int16_t* next[8];
    for (int i = 0; i < 8; ++i) {
      from[i] = masked.counts.data() + row_of_lane[static_cast<std::size_t>(p + i)] + first;
      next[i] = masked.counts.data() + row_of_lane[static_cast<std::size_t>(std::min(p + 8 + i, plane - 1))] + first;
    }
    for (int slice = 0; slice < count; slice += 8) {
      if (slice % 32 == 0) {  // a cache line of each row that comes next
        for (const auto* row : next) hwy::Prefetch(row + slice);
      }
      transpose_8x8(from, planes + static_cast<std::ptrdiff_t>(slice) * plane + p, plane);
      for (const auto*& row : from) row += 8;
    }
  }
}

/// Eight medians of each lane into the lanes' rows.
void store_tile(const std::int16_t* tile, std::int16_t* const* rows, int sample, int samples) {
  const hn::FixedTag<std::int16_t, 8> d;
  alignas(64) std::int16_t block[8 * 8];
  for (int lane = 0; lane < kLanes; lane += 8) {
    const std::int16_t* from[8];
    for (int i = 0; i < 8; ++i) from[i] = tile + i * kLanes + lane;
    transpose_8x8(from, block, 8);
    for (int i = 0; i < 8; ++i) {
      if (rows[lane + i] == nullptr) continue;
      if (samples - sample >= 8) {
        hn::StoreU(hn::Load(d, block + 8 * i), d, rows[lane + i] + sample);
      } else {
        std::copy_n(block + 8 * i, samples - sample, rows[lane + i] + sample);
      }
    }
  }
}

/// Tiles first_tile .. end_tile - 1 of the whole box.
void MedianChunk(const MaskedBox& masked, int kernel_samples, int first_tile, int end_tile, View3<std::int16_t> out) {
  const Shape3 shape = masked.shape();
  const PlaneLayout layout(shape, kLanes);
  const int blocks_before = (kernel_samples + 1) / 8;  // a tile's newest block is this many after its left one
  const int blocks = end_tile - first_tile + blocks_before;
  const int first_slice = 8 * first_tile - 4 * blocks_before;
  static thread_local PlaneMemory memory;
  std::int16_t* planes = memory.at_least(static_cast<std::size_t>(blocks) * 8 * static_cast<std::size_t>(layout.plane));
  std::vector<std::ptrdiff_t> row_of_lane(static_cast<std::size_t>(layout.plane));
  for (int p = 0; p < layout.plane; ++p) {
    const auto place = layout.place(p);
    row_of_lane[static_cast<std::size_t>(p)] = masked.row(place.fan, place.beam) - masked.counts.data();
  }
  fill_planes(masked, row_of_lane, layout.plane, first_slice, 8 * blocks, planes);

  static thread_local ShortLived now;
  static thread_local LongLived ring[4];
  alignas(64) std::int16_t tile[8 * kLanes];
  for (int strip = 0; strip < layout.strips; ++strip) {
    const int lane = layout.first_output + strip * kLanes;
    std::int16_t* rows[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      const auto place = layout.place(lane + i);
      rows[i] = place.output ? out.row(masked.box.fan_begin + place.fan, masked.box.beam_begin + place.beam).data() +
                                   masked.box.sample_begin
                             : nullptr;
    }
    for (int block = 0; block < blocks; ++block) {
      build_block(planes + static_cast<std::ptrdiff_t>(8 * block) * layout.plane + lane, layout.plane,
                  layout.fan_stride, blocks_before > 1, now, ring[block % 4]);
      const int left = block - blocks_before;
      if (left < 0) continue;
      const LongLived* core[2] = {&ring[(left + 1) % 4], &ring[(left + 2) % 4]};
      compute_tile(ring[left % 4], core, blocks_before - 1, now, tile);
      store_tile(tile, rows, 8 * (first_tile + left), shape.samples);
    }
  }
}

#endif

}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
// NOLINTEND(misc-definitions-in-headers)

#endif  // SONAR_SIGNAL_MEDIAN_STRIP_INL_H_
