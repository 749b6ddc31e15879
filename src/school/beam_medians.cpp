// SPDX-License-Identifier: Apache-2.0
#include "school/beam_medians.h"

#include <algorithm>
#include <cstddef>

#include "base/units.h"

namespace sonar {

void beam_medians(std::span<const std::int16_t> sv, std::span<const SampleFlags> flags,
                  std::span<const std::int16_t> filtered, int first, int end, int half,
                  std::vector<std::int16_t>& out) {
  const int samples = static_cast<int>(sv.size());
  std::vector<std::int16_t> window;  // sorted
  window.reserve(static_cast<std::size_t>(2 * half + 1));
  const auto sound = [&](int s) {
    const auto i = static_cast<std::size_t>(s);
    return s >= 0 && s < samples && sv[i] != kNoData && !any(flags[i] & kFault);
  };
  const auto add = [&](int s) {
    if (!sound(s)) return;
    const std::int16_t value = sv[static_cast<std::size_t>(s)];
    window.insert(std::upper_bound(window.begin(), window.end(), value), value);
  };
  const auto take = [&](int s) {
    if (!sound(s)) return;
    window.erase(std::lower_bound(window.begin(), window.end(), sv[static_cast<std::size_t>(s)]));
  };
  for (int s = first - half; s < first + half; ++s) add(s);
  out.clear();
  for (int s = first; s < end; ++s) {
    add(s + half);
    const bool enough = static_cast<int>(window.size()) > half;
    out.push_back(enough ? window[window.size() / 2] : filtered[static_cast<std::size_t>(s)]);
    take(s - half);
  }
}

}  // namespace sonar
