// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "model/school.h"

namespace sonar {

/// [answer of A][answer of B] -> units; answer 0 = yes, 1 = no.
using AnswerCounts = std::array<std::array<std::int64_t, 2>, 2>;

/// How well two readers' answers agree. NaN = cannot be told.
struct Kappa {
  AnswerCounts counts{};
  std::int64_t units = 0;
  double agreed_fraction = kUnknown;      ///< share of units with equal answers
  double agreed_yes_fraction = kUnknown;  ///< 2 yes-yes / (yes of A + yes of B): what both have, whatever neither has
  /// Unknown where a reader gave one answer only: it would be 0, or 0/0, whatever the other said.
  double kappa = kUnknown;
  double kappa_se = kUnknown;  ///< large-sample standard error; units are taken as independent
};

/// Cohen's kappa, (p_o - p_e) / (1 - p_e) with p_e from both readers' shares of each answer. Swapping the readers changes
/// nothing.
/// source  Cohen 1960, Educ. Psychol. Meas. 20: 37-46; standard error: Fleiss, Cohen & Everitt 1969, Psychol. Bull. 72:
///         323-327; agreed_yes_fraction: positive agreement, Cicchetti & Feinstein 1990, J. Clin. Epidemiol. 43: 551-558
[[nodiscard]] Kappa cohen_kappa(const AnswerCounts& counts);

}  // namespace sonar
