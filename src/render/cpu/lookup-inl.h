// SPDX-License-Identifier: Apache-2.0
// Looking up what lies together in memory, for all lanes at once; included once per target.
#if defined(SONAR_RENDER_CPU_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SONAR_RENDER_CPU_LOOKUP_INL_H_
#undef SONAR_RENDER_CPU_LOOKUP_INL_H_
#else
#define SONAR_RENDER_CPU_LOOKUP_INL_H_
#endif

#include "render/cpu/lanes-inl.h"

// A gather of AVX2 is made of some forty small operations, whatever it reads. Where a lane wants more than one word of
// the same place, a plain load a lane and a transposition are fewer.
#undef SONAR_PLAIN_LOADS
#if HWY_TARGET == HWY_AVX2
#define SONAR_PLAIN_LOADS 1
#else
#define SONAR_PLAIN_LOADS 0
#endif

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {

#if SONAR_PLAIN_LOADS

/// Byte addresses of rows of `size` bytes, one a lane.
struct Addresses {
  const char* base;
  HWY_ALIGN std::int32_t index[8];
  template <std::size_t size>
  HWY_INLINE const char* at(std::size_t lane) const {
    return base + static_cast<std::ptrdiff_t>(index[lane]) * static_cast<std::ptrdiff_t>(size);
  }
};

HWY_INLINE Addresses addresses(const void* base, W index) {
  Addresses out;
  out.base = static_cast<const char*>(base);
  hn::Store(index, I(), out.index);
  return out;
}

/// 16 bytes each of two lanes, the second in the upper half.
template <std::size_t size>
HWY_INLINE __m256i two_rows(const Addresses& a, std::size_t lane) {
  const __m128i low = _mm_loadu_si128(reinterpret_cast<const __m128i*>(a.at<size>(lane)));
  const __m128i high = _mm_loadu_si128(reinterpret_cast<const __m128i*>(a.at<size>(lane + 4)));
  return _mm256_inserti128_si256(_mm256_castsi128_si256(low), high, 1);
}

/// From four vectors of (lane i, lane i + 4) rows of four.
HWY_INLINE void transpose(const __m256 rows[4], V out[4]) {
  const __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(rows[0], rows[1]));
  const __m256d b = _mm256_castps_pd(_mm256_unpackhi_ps(rows[0], rows[1]));
  const __m256d c = _mm256_castps_pd(_mm256_unpacklo_ps(rows[2], rows[3]));
  const __m256d d = _mm256_castps_pd(_mm256_unpackhi_ps(rows[2], rows[3]));
  out[0] = V{_mm256_castpd_ps(_mm256_unpacklo_pd(a, c))};
  out[1] = V{_mm256_castpd_ps(_mm256_unpackhi_pd(a, c))};
  out[2] = V{_mm256_castpd_ps(_mm256_unpacklo_pd(b, d))};
  out[3] = V{_mm256_castpd_ps(_mm256_unpackhi_pd(b, d))};
}

/// The four numbers of each lane's row.
HWY_INLINE void rows_at(const float* base, W index, V out[4]) {
  const Addresses a = addresses(base, index);
  __m256 rows[4];
  for (std::size_t i = 0; i < 4; ++i) rows[i] = _mm256_castsi256_ps(two_rows<16>(a, i));
  transpose(rows, out);
}

/// The two numbers of each lane's pair.
HWY_INLINE void pairs_at(const float* base, W index, V& first, V& second) {
  const Addresses a = addresses(base, index);
  const auto two = [&a](std::size_t lane) {
    const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(a.at<8>(lane)));
    return _mm_loadh_pi(_mm_castsi128_ps(low), reinterpret_cast<const __m64*>(a.at<8>(lane + 1)));
  };
  const __m256 even = _mm256_insertf128_ps(_mm256_castps128_ps256(two(0)), two(4), 1);
  const __m256 odd = _mm256_insertf128_ps(_mm256_castps128_ps256(two(2)), two(6), 1);
  first = V{_mm256_shuffle_ps(even, odd, 0x88)};
  second = V{_mm256_shuffle_ps(even, odd, 0xDD)};
}

inline constexpr float kColumnParts = 32767.0F;

/// The four columns of 16-bit samples round each lane's place, interpolated along range; kColumnParts times too large.
/// columns  [place][column]; the next place lies behind each
HWY_INLINE void columns_at(const std::int16_t* columns, W place, V fraction, V out[4]) {
  const Addresses a = addresses(columns, place);
  // Two weights a lane, 15 bits each: a product of pairs adds both samples.
  const W second = nearest_int(hn::Mul(fraction, set(kColumnParts)));
  const W weights = hn::Add(hn::Sub(hn::ShiftLeft<16>(second), second), seti(32767));
  const __m256i together = _mm256_setr_epi8(0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15,  //
                                            0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15);
  const auto row = [&](std::size_t lane, __m256i weight) {
    const __m256i samples = _mm256_shuffle_epi8(two_rows<8>(a, lane), together);
    return _mm256_cvtepi32_ps(_mm256_madd_epi16(samples, weight));
  };
  const __m256 rows[4] = {
      row(0, _mm256_shuffle_epi32(weights.raw, 0x00)), row(1, _mm256_shuffle_epi32(weights.raw, 0x55)),
      row(2, _mm256_shuffle_epi32(weights.raw, 0xAA)), row(3, _mm256_shuffle_epi32(weights.raw, 0xFF))};
  transpose(rows, out);
}

#else

HWY_INLINE void rows_at(const float* base, W index, V out[4]) {
  const W at = hn::ShiftLeft<2>(index);
  for (int i = 0; i < 4; ++i) out[i] = hn::GatherIndex(D(), base + i, at);
}

HWY_INLINE void pairs_at(const float* base, W index, V& first, V& second) {
  const W at = hn::ShiftLeft<1>(index);
  first = hn::GatherIndex(D(), base, at);
  second = hn::GatherIndex(D(), base + 1, at);
}

#endif

}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SONAR_RENDER_CPU_LOOKUP_INL_H_
