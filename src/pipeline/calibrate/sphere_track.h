// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "base/array.h"
#include "base/result.h"
#include "base/work.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"
#include "signal/calibrate.h"
#include "signal/elastic_sphere.h"
#include "signal/pattern_form.h"

namespace sonar {

/// What a sphere run is read with.
struct SphereRunParams {
  CalibrationSphere sphere;
  WaterAround water;           ///< around the sphere
  double range_from_m = 10.0;  ///< the sphere lies between these
  double range_to_m = 1e9;
  [[nodiscard]] double diameter_mm() const { return sphere.diameter_m * 1e3; }
};

/// One observation's beams as a sphere is looked for in them, [row]: fan * beams + beam.
struct SphereBeams {
  std::vector<ChannelCalibration> calibration;  ///< as the raw file and the recipe have it, no calibration table
  std::vector<bool> sound;                      ///< it has all that the sonar equation needs
  std::vector<double> ts_db;                    ///< of the sphere in this beam's pulse
  std::vector<FittedBeam> stated;               ///< level_db: 2 (gain + sa correction)
};
[[nodiscard]] SphereBeams sphere_beams(const ObservationFiles& observation, const CalibrationParams& calibration,
                                       const SphereRunParams& params);

/// The sphere in one ping.
struct SphereAt {
  std::size_t ping = 0;
  int row = 0;  ///< its strongest beam
  double range_m = 0.0;
};
/// One beam's level of the sphere: the echo's sum over the nominal pulse's length, by the point-target equation without the
/// gain, less the sphere's target strength.
struct SphereLevel {
  std::size_t ping = 0;
  int row = 0;
  double level_db = 0.0;
  double se_db = 0.0;        ///< by the noise around it
  double off_samples = 0.0;  ///< of the sample nearest to the echo's centre ...
  double share_db = 0.0;     ///< ... and what it has of the sum
};
struct SphereTrack {
  std::vector<SphereAt> at;         ///< rising pings
  std::vector<SphereLevel> levels;  ///< of all beams around it
};

/// Finds what may be the sphere through the pings of an observation: of all echoes that are as short as the pulse, as narrow
/// as a beam and about as strong as the sphere, the chain that changes its range and direction least; then the same of those
/// that are left. Fish come and go, drift and differ in strength, but one may stay for long.
/// returns  likeliest first, one at least
/// errors   io, format, cancelled
/// threads  pings are read in parallel; the result does not depend on it
[[nodiscard]] Result<std::vector<SphereTrack>> find_targets(const SurveyFiles& survey,
                                                            const ObservationFiles& observation,
                                                            const SphereBeams& beams,
                                                            const CalibrationParams& calibration,
                                                            const SphereRunParams& params, Work& work);

}  // namespace sonar
