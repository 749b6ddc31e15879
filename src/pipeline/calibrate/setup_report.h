// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "base/work.h"
#include "school/measure/setup_check.h"

namespace sonar {

/// A survey's setup check with what its recipe says now and what would null the schools' mean speeds.
struct SetupReport {
  SetupCheck check;
  double mounting_azimuth_deg = 0.0;
  double proposed_mounting_azimuth_deg = kUnknown;  ///< this and the next two: where the drift is known
  double sound_speed_mps = 0.0;                     ///< middle of the observations'
  double proposed_sound_speed_mps = kUnknown;
  double proposed_sound_speed_se_mps = kUnknown;
};

/// From the products of a work folder alone; rejected schools are left out.
/// errors  not_found: no products, or as check_setup(); mismatch: products of different recipes; io, format; cancelled
[[nodiscard]] Result<SetupReport> setup_report(const std::filesystem::path& out, Work& work);

/// For people: a line for each leg, then what is proposed and what cannot be told.
[[nodiscard]] std::string setup_text(const SetupReport& report);
[[nodiscard]] std::string setup_json_text(const SetupReport& report);

}  // namespace sonar
