// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "geo/sector.h"
#include "pipeline/stages/fan_response.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/charts/frequency_chart.h"

namespace sonar {

/// What fans heard of one school and of the water round it, ping by ping.
struct SchoolFans {
  std::vector<std::vector<HeardFan>> school;
  std::vector<std::vector<HeardFan>> water;
  /// Takes what a ping adds.
  /// masks  all of the ping, the school's among them
  void add(const PingMask& mask, std::span<const PingMask* const> masks, const StagedPing& ping, const Sector& sector);
  void add(const SchoolFans& more);
};

/// errors  not_found: fans that do not each send at a frequency of their own
[[nodiscard]] Result<void> require_fan_frequencies(const std::string& observation, std::span<const double> frequency_hz,
                                                   int fans);

/// The two lines of a school in a chart; without the water where it is not asked for.
/// frequency_hz  [fan]
[[nodiscard]] std::vector<FrequencySeries> frequency_series(const SchoolFans& fans, const std::string& name,
                                                            Rgba8 colour, const Theme& theme,
                                                            std::span<const double> frequency_hz, bool water);

/// Schools of an observation over the frequencies of its fans: those that the options choose, or the one with most echo.
/// errors  not_found: no raw files, no schools, or fans without frequencies of their own; as DrawnObservation::ping()
[[nodiscard]] Result<FrameDescription> frequency_frame(DrawnObservation& observation, const PictureOptions& options,
                                                       Work& work);

}  // namespace sonar
