// SPDX-License-Identifier: Apache-2.0
#include "school/judge/size.h"

namespace sonar {

std::optional<Reason> judge_size(const PingEcho& echo, const Detection& detection, const SizeParams& params) {
  const IndexBox& box = detection.box;
  if (box.fans() < params.min_fans) return Reason{"size", double(box.fans()), double(params.min_fans), "fans"};
  if (box.beams() < params.min_beams) return Reason{"size", double(box.beams()), double(params.min_beams), "beams"};
  const double range_m = box.samples() * echo.sector.range().spacing_m;
  if (range_m < params.min_range_m) return Reason{"size", range_m, params.min_range_m, "m along range"};
  return std::nullopt;
}

}  // namespace sonar
