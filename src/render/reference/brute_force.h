// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "base/work.h"
#include "render/volume_renderer.h"

namespace sonar {

/// The plain truth of a picture: every ray of every pixel is walked through the whole sphere in steps of
/// step_samples * spacing_m; every sample is turned to (fan, beam, sample) by doubles and library trigonometry and
/// interpolated; nothing is skipped, nothing ends early. For tests and benchmarks; minutes, not milliseconds.
[[nodiscard]] RayImage brute_force(const VolumeData& volume, const OpticalTable& table,
                                   std::span<const MaskLayer> masks, const VolumeView& view, double step_samples,
                                   Work& work);

}  // namespace sonar
