// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "model/biomass.h"
#include "model/integration.h"
#include "pipeline/biomass/school_numbers.h"

namespace sonar {

/// What strata are made of; all may be empty.
struct StrataInput {
  std::span<const EffortRow> effort;    ///< which stratum a school lies in, by its middle ping
  std::span<const StratumRow> strata;   ///< of echo integration
  std::map<std::string, double> areas;  ///< nmi2 by stratum
};

/// Numbers and biomass by stratum, and for the survey as the last row: of the schools that were seen, and where strata tell a
/// NASC of schools, over each square nautical mile and over the areas. Fish per nmi2 = NASC / (4 pi sigma_bs), where sigma_bs
/// is the echo of the stratum's schools over their numbers; of a species the NASC is its share of the echo.
/// source  Simmonds & MacLennan 2005, Fisheries Acoustics, 2nd ed., section 5.4
[[nodiscard]] std::vector<BiomassStratumRow> biomass_strata(std::span<const NumberedSchool> schools,
                                                            const FishChoice& fish, const StrataInput& input);

}  // namespace sonar
