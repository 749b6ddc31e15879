// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/product.h"
#include "synth/sonar.h"
#include "synth/truth.h"

namespace sonar::synth {

/// What is known of one observation, gathered ping by ping in order.
class ObservationTruth {
 public:
  explicit ObservationTruth(std::string name) { product_.observation = std::move(name); }
  void add(const Scene& scene, int ping, SyntheticPing made);

 private:
  friend class SurveyTruth;
  ObservationProduct product_;
  std::vector<BodyTruth> bodies_;
};

/// Writes truth/obs-NNNN.nc as observations come, and the tables at the end.
class SurveyTruth {
 public:
  SurveyTruth(std::filesystem::path folder, std::string title, std::string program_version);
  /// errors  io, no_space
  Result<void> add(ObservationTruth observation, const SyntheticSonar& sonar);
  /// errors  io, no_space
  Result<void> finish();
  [[nodiscard]] std::int64_t schools() const { return static_cast<std::int64_t>(schools_.size()); }

 private:
  std::filesystem::path folder_;
  std::string title_;
  std::string program_version_;
  std::vector<SchoolRow> schools_;
  std::vector<SchoolPingRow> school_pings_;
  std::vector<BodyTruth> bodies_;
};

}  // namespace sonar::synth
