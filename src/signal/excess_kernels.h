// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace sonar {

// Vector kernels on levels and what lies above them, counts with kNoData, chosen at run time for the processor; the same bits
// from each. All spans of one call are of one length.

/// out = values, none where marked.
void copy_unmarked(std::span<const std::int16_t> values, std::span<const std::uint8_t> marks,
                   std::span<std::int16_t> out);

/// out = level - the louder of water and noise, within +/- 30000; none where there is no level, or neither of these is known
/// (kMinCount).
void excess_over(std::span<const std::int16_t> level, std::span<const std::int16_t> water,
                 std::span<const std::int16_t> noise, std::span<std::int16_t> out);

/// out = excess within +/- clip; none where there is none or where it is marked.
void clip_excess(std::span<const std::int16_t> excess, std::span<const std::int16_t> clip,
                 std::span<const std::uint8_t> marks, std::span<std::int16_t> out);

/// excess -= step * steps, where there is any.
void take_off_steps(std::span<const std::int8_t> steps, std::int16_t step, std::span<std::int16_t> excess);

/// whitened = (excess - middle) * scale and number = 1; both 0 where there is no excess or scale is 0. scale >= 0
void whiten(std::span<const std::int16_t> excess, std::span<const float> middle, std::span<const float> scale,
            std::span<float> whitened, std::span<float> number);

/// out = sum / sqrt(number) within +/- 32000; none where there is no excess or number is 0.
void over_root(std::span<const std::int16_t> excess, std::span<const float> sum, std::span<const float> number,
               std::span<std::int16_t> out);

/// out = sum / number in steps, within +/- 127, halves away from 0; 0 where number < least. least > 0
void rounded_steps(std::span<const float> sum, std::span<const float> number, float least, std::int16_t step,
                   std::span<std::int8_t> out);

}  // namespace sonar
