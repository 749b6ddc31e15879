// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "synth/random.h"

namespace sonar::synth {

/// 256 log2(power): the count of a power in W, rounded and kept within what data may hold.
[[nodiscard]] std::int16_t count_of_power(double power_w);

/// One beam's received power: a complex Gaussian of the expected power in every sample, as echoes of many scatterers
/// are, so that the power is exponential about its expected value.
/// expected_w   [sample], W, positive
/// correlation  of the amplitude from one sample to the next, 0..1
/// out          [sample], counts re 1 W; same length
void speckled_counts(std::span<const float> expected_w, double correlation, RandomStream random,
                     std::span<std::int16_t> out);

/// The same without speckle.
void expected_counts(std::span<const float> expected_w, std::span<std::int16_t> out);

}  // namespace sonar::synth
