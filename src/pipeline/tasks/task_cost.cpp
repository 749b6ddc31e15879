// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/task_cost.h"

namespace sonar {
namespace {

constexpr double kMega = 1e6;
// Measured over surveys of 5 to 2 250 pings of 0.3 to 5 million voxels.
constexpr double kStart_s = 0.3;
constexpr double kPerVoxel_s = 28e-9;
constexpr double kBase_mb = 60.0;
constexpr double kKeptStages_mb = 200.0;  ///< the Engine's budget
constexpr double kPerPing_mb = 0.1;       ///< echoes and tracks of an observation
constexpr double kBytesPerVoxel = 7.0;    ///< of a ping's stages
constexpr double kPingsAtOnce = 14.0;     ///< a group that is detected together
constexpr double kPingsPerThread = 8.0;

double voxels_of(const ObservationFiles& observation) {
  if (!observation.grid) return 0.0;
  return static_cast<double>(observation.grid->fans()) * observation.grid->beams() * observation.range.count;
}

}  // namespace

TaskCost task_cost(const SurveyFiles& survey, const ObservationFiles& observation, int threads) {
  const double voxels = voxels_of(observation);
  const auto pings = static_cast<double>(observation.pings.size());
  TaskCost cost;
  for (const SurveyPing& ping : observation.pings) {
    for (const SurveyPing& part : survey.parts(ping)) {
      const PingEntry& entry = survey.entry(part);
      cost.read_mb += static_cast<double>(entry.end - entry.offset) / kMega;
    }
  }
  cost.cpu_s = kStart_s + pings * voxels * kPerVoxel_s;
  cost.memory_mb = kBase_mb + kKeptStages_mb + pings * kPerPing_mb +
                   voxels * kBytesPerVoxel * (kPingsAtOnce + kPingsPerThread * threads) / kMega;
  return cost;
}

}  // namespace sonar
