// SPDX-License-Identifier: Apache-2.0
#include "model/ts_relation.h"

#include "base/units.h"

namespace sonar {

double TsRelation::sigma_bs_m2(double length_cm, double depth_m) const {
  return linear_from_db(m_db * std::log10(length_cm) + b_db + d_db * std::log10(1.0 + depth_m / 10.0));
}

}  // namespace sonar
