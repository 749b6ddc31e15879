// SPDX-License-Identifier: Apache-2.0
#include "model/sounder.h"

#include <fmt/format.h>

namespace sonar {

std::string model_of(const SounderConfig& config) {
  switch (config.kind) {
    case SounderKind::ek60:
      return "Simrad EK60";
    case SounderKind::me70:
      return "Simrad ME70";
    case SounderKind::ms70:
      return "Simrad MS70";
    default:
      return config.sounder_name;
  }
}

std::string model_and_name(const SounderConfig& config) {
  const std::string model = model_of(config);
  const bool told = model.find(config.sounder_name) != std::string::npos;
  return told ? model : fmt::format("{} ({})", model, config.sounder_name);
}

}  // namespace sonar
