// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "synth/array/params.h"

namespace sonar::synth::array {

/// Weights of n equally spaced elements, the largest 1.
/// side_lobe_db  what Taylor and Dolph are made for, negative
/// source        Taylor: Carrara, Goodman, Majewski, Spotlight SAR (1995), appendix D, nbar = 4. Dolph-Chebyshev: by
///               the discrete Fourier transform of the Chebyshev polynomial (Harris 1978, section V.G)
[[nodiscard]] std::vector<double> shading_weights(Shading shading, int n, double side_lobe_db);

}  // namespace sonar::synth::array
