// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/index_cache.h"
#include "pipeline/survey/survey.h"
#include "view/timelines/echogram_pyramid.h"

namespace sonar {

/// Where the echogram of an observation is kept between runs, and under what key: everything that it is made from.
struct EchogramEntry {
  std::filesystem::path path;  ///< empty = nowhere
  std::string key;
};

/// recipe_hash  of the recipe that the pings are staged by
/// filtered     of median-filtered Sv
/// hidden       flags that are left out
[[nodiscard]] EchogramEntry echogram_entry(const IndexCache& cache, const SurveyFiles& survey,
                                           const ObservationFiles& observation, const std::string& recipe_hash,
                                           bool filtered, SampleFlags hidden, const EchogramRange& range);

/// The echogram from a level on (see EchogramPyramid::coarser); finer levels are not read. Empty where none is kept, or
/// it is stale or damaged.
[[nodiscard]] std::optional<EchogramPyramid> kept_echogram(const EchogramEntry& entry, int level);

/// Keeps all levels. Failure is no error: what is not kept is made again.
void keep_echogram(const EchogramEntry& entry, const EchogramPyramid& echogram);

/// The level from which a picture needs an echogram: each pixel still has four of its columns or more.
/// pings  over the whole width of the picture
[[nodiscard]] int echogram_level(std::size_t pings, int width_px);

}  // namespace sonar
