// SPDX-License-Identifier: Apache-2.0
#include "render/cpu/sample_columns.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/sample_columns.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void Interleave(const std::int16_t* const columns[4], std::size_t count, std::int16_t* out) {
  const hn::ScalableTag<std::int16_t> d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    hn::StoreInterleaved4(hn::LoadU(d, columns[0] + i), hn::LoadU(d, columns[1] + i), hn::LoadU(d, columns[2] + i),
                          hn::LoadU(d, columns[3] + i), d, out + 4 * i);
  }
  for (; i < count; ++i) {
    for (std::size_t c = 0; c < 4; ++c) out[4 * i + c] = columns[c][i];
  }
}

}  // namespace
}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sonar {
namespace {

HWY_EXPORT(Interleave);

}  // namespace

void lay_columns(const Array3<std::int16_t>& sv, std::vector<std::int16_t>& out) {
  const Shape3 shape = sv.shape();
  const auto samples = static_cast<std::size_t>(shape.samples);
  out.resize(static_cast<std::size_t>(shape.fans - 1) * static_cast<std::size_t>(shape.beams - 1) * samples * 4);
  std::int16_t* to = out.data();
  for (int f = 0; f + 1 < shape.fans; ++f) {
    for (int b = 0; b + 1 < shape.beams; ++b, to += 4 * samples) {
      const std::int16_t* const columns[4] = {sv.row(f, b).data(), sv.row(f, b + 1).data(), sv.row(f + 1, b).data(),
                                              sv.row(f + 1, b + 1).data()};
      HWY_DYNAMIC_DISPATCH(Interleave)(columns, samples, to);
    }
  }
}

}  // namespace sonar
#endif  // HWY_ONCE
