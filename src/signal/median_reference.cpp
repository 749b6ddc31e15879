// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "signal/median.h"

// Written from the definition in median.h alone, sharing nothing with the fast ways.

namespace sonar {

namespace {

struct Bounds {
  int first;
  int last;
  void include(int i) {
    first = std::min(first, i);
    last = std::max(last, i);
  }
};

struct Plain {
  View3<const std::int16_t> sv;
  View3<const SampleFlags> flags;
  Bounds fans{};
  Bounds beams{};
  Bounds samples{};

  [[nodiscard]] bool outside_water(int f, int b, int s) const {
    return sv(f, b, s) == kNoData || any(flags(f, b, s) & (SampleFlags::near_field | SampleFlags::surface));
  }
  [[nodiscard]] bool left_out(int f, int b, int s) const {
    return sv(f, b, s) == kNoData || any(flags(f, b, s) & kNotFiltered);
  }
};

std::int16_t median_at(const Plain& p, int f, int b, int s, int half_fans, int half_beams, int half_samples,
                       std::vector<std::int16_t>& window) {
  window.clear();
  std::size_t left_out = 0;
  for (int df = -half_fans; df <= half_fans; ++df) {
    for (int db = -half_beams; db <= half_beams; ++db) {
      for (int ds = -half_samples; ds <= half_samples; ++ds) {
        const int ff = std::clamp(f + df, p.fans.first, p.fans.last);
        const int bb = std::clamp(b + db, p.beams.first, p.beams.last);
        const int ss = std::clamp(s + ds, p.samples.first, p.samples.last);
        if (p.left_out(ff, bb, ss)) {
          ++left_out;
          const std::int16_t infinity = (ff + bb + ss) % 2 == 0 ? -32767 : 32767;
          window.push_back(infinity);
        } else {
          window.push_back(p.sv(ff, bb, ss));
        }
      }
    }
  }
  if (2 * left_out > window.size()) return kNoData;
  const auto middle = window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2);
  std::nth_element(window.begin(), middle, window.end());
  return *middle == 32767 || *middle == -32767 ? kNoData : *middle;
}

}  // namespace

Array3<std::int16_t> median_reference(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                      const MedianParams& params) {
  SONAR_CHECK(sv.shape() == flags.shape());
  const Shape3 shape = sv.shape();
  Array3<std::int16_t> out(shape, kNoData);
  Plain p{sv, flags, {shape.fans, -1}, {shape.beams, -1}, {shape.samples, -1}};
  const auto each = [&](auto&& body) {
    for (int f = 0; f < shape.fans; ++f) {
      for (int b = 0; b < shape.beams; ++b) {
        for (int s = 0; s < shape.samples; ++s) body(f, b, s);
      }
    }
  };
  each([&](int f, int b, int s) {
    if (p.outside_water(f, b, s)) return;
    p.fans.include(f);
    p.beams.include(b);
    p.samples.include(s);
  });
  std::vector<std::int16_t> window;
  each([&](int f, int b, int s) {
    const bool inside = f >= p.fans.first && f <= p.fans.last && b >= p.beams.first && b <= p.beams.last &&
                        s >= p.samples.first && s <= p.samples.last;
    if (any(flags(f, b, s) & kNeverMember)) return;
    if (!params.enabled) {
      out(f, b, s) = sv(f, b, s);
    } else if (inside) {
      out(f, b, s) =
          median_at(p, f, b, s, params.kernel_fans / 2, params.kernel_beams / 2, params.kernel_samples / 2, window);
    }
  });
  return out;
}

}  // namespace sonar
