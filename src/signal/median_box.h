// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"

namespace sonar {

// The usable part of a ping, cut out and masked: what the fast medians work on. Internal to this room.

/// Half-open bounds of the samples that are neither near field nor surface nor "no data".
struct SampleBox {
  int fan_begin = 0, fan_end = 0;
  int beam_begin = 0, beam_end = 0;
  int sample_begin = 0, sample_end = 0;

  [[nodiscard]] bool empty() const { return fan_end <= fan_begin; }
  [[nodiscard]] Shape3 shape() const { return {fan_end - fan_begin, beam_end - beam_begin, sample_end - sample_begin}; }
};

[[nodiscard]] SampleBox usable_box(View3<const std::int16_t> sv, View3<const SampleFlags> flags);

/// The box's counts, left-out samples replaced by the checkerboard of -32767 and +32767. Each row goes on beyond both of
/// its ends by `margin` samples that repeat its first and last.
struct MaskedBox {
  SampleBox box;
  int margin = 0;
  std::vector<std::int16_t> counts;        ///< [fan][beam][margin + sample + margin] of the box; kept between pings
  std::vector<std::uint8_t> any_left_out;  ///< [fan][beam]: 1 where the row holds a replaced sample

  void cut(View3<const std::int16_t> sv, View3<const SampleFlags> flags, int margin_samples);
  [[nodiscard]] Shape3 shape() const { return box.shape(); }
  /// Samples of one row; its margins lie before and behind.
  [[nodiscard]] const std::int16_t* row(int fan, int beam) const {
    const auto length = static_cast<std::size_t>(shape().samples + 2 * margin);
    const auto index = static_cast<std::size_t>(fan * shape().beams + beam);
    return counts.data() + index * length + static_cast<std::size_t>(margin);
  }
};

/// True for the two values that stand for a left-out sample.
[[nodiscard]] constexpr bool is_left_out(std::int16_t count) { return count == 32767 || count == -32767; }

}  // namespace sonar
