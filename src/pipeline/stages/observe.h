// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/commands/command.h"
#include "pipeline/journal/school_numbers.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// Which results each stage's code gives; a number is raised when its results change. Products of different versions
/// are not merged.
inline constexpr std::string_view kStageVersions =
    "decode 3, flags 4, calibrate 1, background 4, median 1, seabed 7, detect 16, track 11, propagate 5, measure 22, "
    "summarise 9";

/// Inclusive range of ping indices.
struct PingSelection {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

struct ObserveMemory;

/// What an observation is processed with, beside its files.
struct ObserveOptions {
  std::optional<PingSelection> pings;  ///< empty = all
  ReadJournal journal;                 ///< effective lines of the whole survey; those of other times are passed over
  std::string program_version;
  const EarlierSchools* earlier = nullptr;  ///< what was known of schools of these pings; null = number from 1
  ObserveMemory* memory = nullptr;          ///< of the same observation with fewer pings; null = nothing is kept
};

/// Sounder and version as they stand in products.
[[nodiscard]] std::string source_of(const ObservationFiles& observation);
/// Datagram times of an observation's pings, the lasting keys.
[[nodiscard]] std::vector<TimeNs> datagram_times(const SurveyFiles& survey, const ObservationFiles& observation);

/// Key of everything that an observation's product depends on but the numbers that schools had before; equal key, equal
/// product up to school numbers.
[[nodiscard]] std::string observation_key(const SurveyFiles& survey, const ObservationFiles& observation,
                                          const Recipe& recipe, const ObserveOptions& options);

/// One observation from raw files to its product: detected or replayed schools, tracked, measured, summarised.
/// Damaged pings are marked bad and noted. Without a grid: track and notes only.
/// errors   cancelled; io, not_found: the system did not let a ping be read, and may do so the next time
/// memory   a few pings per thread, masks and rows; no volume outlives its ping
[[nodiscard]] Result<ObservationProduct> observe(const SurveyFiles& survey, const ObservationFiles& observation,
                                                 const Recipe& recipe, const ObserveOptions& options, Work& work);

/// The same masks and decisions with every number worked out anew under this recipe's calibration, or that of the
/// journal's last `calibrate`.
/// before   the product whose masks are kept; must be of the same pings
/// errors   mismatch: other pings or another grid; io, not_found as observe(); cancelled
[[nodiscard]] Result<ObservationProduct> remeasure(const SurveyFiles& survey, const ObservationFiles& observation,
                                                   const ObservationProduct& before, const Recipe& recipe,
                                                   const ObserveOptions& options, Work& work);

/// What is known of an observation before anything in it is measured: its name, title, pings and grid.
[[nodiscard]] ObservationProduct observation_head(const ObservationFiles& observation,
                                                  const CalibrationParams& calibration = {});
/// Product without schools: what stands in every product whatever is found.
[[nodiscard]] ObservationProduct empty_product(const SurveyFiles& survey, const ObservationFiles& observation,
                                               const Recipe& recipe, const ObserveOptions& options);

}  // namespace sonar
