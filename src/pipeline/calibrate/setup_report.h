// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "io/ping_navigation.h"
#include "model/product.h"
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

/// Takes the schools of products, one product after the other, and reports. Rejected schools are left out.
class SetupSeen {
 public:
  /// where  names the product
  /// errors  mismatch: it is of another recipe than those before; format: its recipe is none
  [[nodiscard]] Result<void> take(const ObservationProduct& product, const std::string& where);
  /// errors  not_found: no product with a grid was taken, or as check_setup(). where  names what the products are of
  [[nodiscard]] Result<SetupReport> report(const std::string& where) const;

 private:
  std::vector<SeenSpeed> speeds_;
  std::vector<double> sound_speeds_mps_;
  std::optional<NavigationParams> navigation_;
  SummariseParams summarise_;
  std::string recipe_hash_;
};

/// From the products of a work folder alone; rejected schools are left out.
/// errors  not_found: no products, or as check_setup(); mismatch: products of different recipes; io, format; cancelled
[[nodiscard]] Result<SetupReport> setup_report(const std::filesystem::path& out, Work& work);

/// For people: a line for each leg, then what is proposed and what cannot be told.
[[nodiscard]] std::string setup_text(const SetupReport& report);
[[nodiscard]] std::string setup_json_text(const SetupReport& report);

}  // namespace sonar
