// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/integration.h"
#include "pipeline/integrate/effort.h"
#include "pipeline/integrate/unit_sums.h"
#include "school/integrate/cells.h"

namespace sonar {

/// The three tables of echo integration.
struct IntegrationTables {
  std::vector<EffortRow> effort;
  std::vector<NascRow> nasc;
  std::vector<StratumRow> strata;
};

/// sums  of each of the units
/// threads  pure
[[nodiscard]] IntegrationTables integration_tables(std::span<const EffortUnit> units, std::span<const UnitSums> sums,
                                                   const CellLayout& layout);

/// What of the survey's NASC was given back for extinction; empty where nothing was corrected.
[[nodiscard]] std::string extinction_text(const IntegrationTables& tables);

}  // namespace sonar
