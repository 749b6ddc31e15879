// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/hash.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// What of a configuration geometry, calibration and navigation depend on; names of survey and transect are not in it.
[[nodiscard]] Hash128 identity(const SounderConfig& config);

/// Pings of one sounder over all files, each instant once, in the order of the files.
struct SounderSequence {
  Sounder sounder;
  std::vector<SurveyPing> pings;
};

/// Sorts the survey's pings by sounder, MS70 first. Channels of one instant that lie in several places make one ping
/// (survey.further_parts); what another file has as well is dropped, with a note in survey.diagnostics.
[[nodiscard]] std::vector<SounderSequence> sequences_of(SurveyFiles& survey);

/// Cuts a sequence at gaps, at the longest duration, and where grid, settings or the direction of time change.
/// Returned observations have pings, continues_cut and diagnostics; the rest is for complete_observation().
[[nodiscard]] std::vector<ObservationFiles> cut_sequence(const SurveyFiles& survey, const SounderSequence& sequence,
                                                         const SurveyParams& params);

/// Fills in configuration, grid, range, settings and navigation.
void complete_observation(const SurveyFiles& survey, ObservationFiles& observation, const SurveyParams& params,
                          const NavigationParams& navigation);

}  // namespace sonar
