// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "school/detect/detection.h"
#include "school/judge/judge_params.h"
#include "school/judge/ping_echo.h"
#include "school/judge/reason.h"

namespace sonar {

/// Judge `size`: single fish, impulses and other sounders' pulses fill one beam, or are shorter along range than a
/// school. The figure is the first extent that is too small.
[[nodiscard]] std::optional<Reason> judge_size(const PingEcho& echo, const Detection& detection,
                                               const SizeParams& params);

}  // namespace sonar
