// SPDX-License-Identifier: Apache-2.0
#include "school/judge/size.h"

#include <vector>

#include "base/median.h"
#include "school/judge/confirmation.h"

namespace sonar {
namespace {

std::optional<Reason> judge_extents(int fans, int beams, int samples, const Sector& sector,
                                    const DetectParams& params) {
  if (fans < params.min_fans) return Reason{"size", double(fans), double(params.min_fans), "fans"};
  if (beams < params.min_beams) return Reason{"size", double(beams), double(params.min_beams), "beams"};
  const double range_m = samples * sector.range().spacing_m;
  if (range_m < params.min_range_m) return Reason{"size", range_m, params.min_range_m, "m along range"};
  return std::nullopt;
}

}  // namespace

std::optional<Reason> judge_size(const PingEcho& echo, const Detection& detection, const DetectParams& params) {
  const IndexBox& box = detection.box;
  return judge_extents(box.fans(), box.beams(), box.samples(), echo.sector, params);
}

std::optional<Reason> judge_size(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings,
                                 const Sector& sector, const DetectParams& params) {
  std::vector<int> fans;
  std::vector<int> beams;
  std::vector<int> samples;
  for (const TrackedDetection& seen : tracked) {
    const IndexBox box = box_of(mask_of(seen, *ping_of(pings, seen.ping_index)), sector.beams());
    fans.push_back(box.fans());
    beams.push_back(box.beams());
    samples.push_back(box.samples());
  }
  return judge_extents(middle_of(std::move(fans)), middle_of(std::move(beams)), middle_of(std::move(samples)), sector,
                       params);
}

}  // namespace sonar
