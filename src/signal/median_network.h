// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "base/work.h"
#include "signal/median_box.h"

namespace sonar {

/// Samples that a MaskedBox's rows must go on beyond their ends for the network.
inline constexpr int kNetworkMargin = 48;

/// True for the kernel lengths (with 3 fans and 3 beams) that the network is built for, on a processor that it runs on.
[[nodiscard]] bool network_takes(int kernel_samples);

/// Median over 3 fans x 3 beams x 7, 15 or 23 samples by merging sorted lists, many beams at once.
/// Along range outputs come in tiles of eight. What all eight windows share is merged once, then what four share, then
/// two; ranks that can no longer become the median are dropped at each step. A slice's nine values are sorted, then
/// merged to lists of 18, 36 and 72 in blocks of eight slices that three tiles share.
/// in      masked, with a margin of kNetworkMargin; left-out samples count as the numbers that stand there
/// out     the whole ping's array; the box's part of it is written
/// source  merges: Batcher 1968
void median_network(const MaskedBox& masked, int kernel_samples, Work* work, View3<std::int16_t> out);

/// Sets samples to kNoData where more than half of their kernel of 3 x 3 x kernel_samples is left out.
void drop_unknown(const MaskedBox& masked, int kernel_samples, View3<std::int16_t> out);

}  // namespace sonar
