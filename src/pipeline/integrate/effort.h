// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geo/frames.h"
#include "model/transect.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// One elementary distance sampling unit (EDSU) of a transect, or one stretch off effort.
struct EffortUnit {
  std::string stratum;
  std::string transect;
  EffortType type = EffortType::transect;
  std::int64_t edsu = 0;                ///< 1.. along the transect; 0 off effort
  double from_m = 0.0;                  ///< sailed on the transect before
  double sailed_m = 0.0;                ///< from each of its pings to the next
  std::vector<TimeNs> times;            ///< of its pings
  std::vector<Geographic> transducers;  ///< of them, as recorded
};

/// An observation of the sonar that is integrated, and the unit that each of its pings belongs to.
struct ObservationEffort {
  std::size_t observation = 0;    ///< in SurveyFiles::observations
  std::vector<std::size_t> unit;  ///< [ping]
};

struct Effort {
  std::vector<EffortUnit> units;  ///< in the order in which they begin
  std::vector<ObservationEffort> observations;
  std::vector<std::string> left_out;       ///< observations of other sounders, or without a grid
  std::vector<std::string> without_pings;  ///< transects that no ping of the observations belongs to
};

/// Cuts what was sailed into units of equal distance along each transect. Distance is that between the positions of
/// successive pings on the ellipsoid, gaps in them reckoned over; from one observation to the next nothing was sailed but
/// over a cut that only its length made. The sonar is that of the first observation with a grid.
/// transects  empty = every observation is one, with those that go on over such cuts; else pings in none of them, or in a
///            period off effort, are off effort
/// edsu_m     > 0
/// threads    pure
[[nodiscard]] Effort sailed_effort(const SurveyFiles& survey, std::span<const Transect> transects, double edsu_m);

}  // namespace sonar
