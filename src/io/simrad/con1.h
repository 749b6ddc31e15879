// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/sounder.h"

namespace sonar::simrad {

/// Lists of CON1's BeamArrays, one value a beam in channel order; empty where a list is missing or not all numbers.
struct Con1 {
  bool readable = false;  ///< some element BeamArrays was found
  std::vector<double> steering_rx_x;
  std::vector<double> steering_rx_y;
  std::vector<double> frequency_tx;
  std::vector<double> frequency_rx;
};

/// Lenient: lists as attributes of BeamArrays or as its children `<parameter name= value=>`; what could be read of
/// broken XML is used.
[[nodiscard]] Con1 parse_con1(std::string_view xml);

struct Con1Outcome {
  bool used = false;            ///< the angles of CON1 are in the configuration now
  double largest_change = 0.0;  ///< of an angle against CON0, degrees
  std::string problem;          ///< why they are not used; empty where CON1 has none or they are
};

/// Puts CON1's angles in the place of CON0's where there is exactly one of each per beam.
Con1Outcome apply_con1(const Con1& con1, SounderConfig& config);

}  // namespace sonar::simrad
