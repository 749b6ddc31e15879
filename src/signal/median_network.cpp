// SPDX-License-Identifier: Apache-2.0
#include "signal/median_network.h"

#include <algorithm>
#include <vector>

#include "base/check.h"
#include "signal/median_strip.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/median_network.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "signal/median_strip-inl.h"

#if HWY_ONCE
namespace sonar {

namespace {

HWY_EXPORT(MedianChunk);
HWY_EXPORT(HasNetwork);

constexpr int kTilesPerChunk = 56;  // about 450 slices: a chunk's planes stay in the second-level cache

}  // namespace

bool network_takes(int kernel_samples) {
  return (kernel_samples == 7 || kernel_samples == 15 || kernel_samples == 23) && HWY_DYNAMIC_DISPATCH(HasNetwork)();
}

void median_network(const MaskedBox& masked, int kernel_samples, Work* work, View3<std::int16_t> out) {
  SONAR_CHECK(network_takes(kernel_samples) && masked.margin >= kNetworkMargin);
  const int tiles = (masked.shape().samples + 7) / 8;
  const int chunks = (tiles + kTilesPerChunk - 1) / kTilesPerChunk;
  const auto run = [&](std::int64_t chunk) {
    const int first = static_cast<int>(chunk * tiles / chunks);
    const int end = static_cast<int>((chunk + 1) * tiles / chunks);
    HWY_DYNAMIC_DISPATCH(MedianChunk)(masked, kernel_samples, first, end, out);
  };
  if (work != nullptr && chunks > 1) {
    work->for_each(chunks, run);
  } else {
    for (int chunk = 0; chunk < chunks; ++chunk) run(chunk);
  }
}

}  // namespace sonar
#endif  // HWY_ONCE
