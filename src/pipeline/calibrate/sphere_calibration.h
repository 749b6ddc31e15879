// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "pipeline/calibrate/sphere_track.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"
#include "signal/beam_pattern_fit.h"

namespace sonar {

/// A sphere run as a human names it.
struct SphereChoice {
  std::string sphere = "wc38.1";  ///< as named_sphere() takes it
  double range_from_m = 10.0;     ///< the sphere lies between these
  double range_to_m = 1e9;
  std::optional<WaterProperties> water = {};  ///< measured around the sphere; empty = the sound speed of the raw files
};

/// A sphere by the number of its material and its diameter, for fields that a human sets.
struct SphereSize {
  std::size_t material = 0;  ///< < kSphereMaterialCount
  double diameter_mm = 0.0;
};
inline constexpr std::size_t kSphereMaterialCount = kSphereMaterials.size();
/// errors  as named_sphere()
[[nodiscard]] Result<SphereSize> sphere_size(std::string_view name);
/// "wc38.1": as named_sphere() takes it.
[[nodiscard]] std::string sphere_name(const SphereSize& size);
/// What a material is, with its figures and their source, in a line.
[[nodiscard]] std::string material_text(std::size_t material);

/// What is meant by it. Without measured water the sound speed is that of the first observation with fans of beams (of the
/// recipe's water where there is none), and the density that of the recipe's water.
/// errors  usage: "sphere ...", "range ...", "water ...": no such sphere, ranges that do not rise, water that is none
[[nodiscard]] Result<SphereRunParams> sphere_run_params(const SphereChoice& choice, const WaterProperties& recipe_water,
                                                        const SurveyFiles& survey);

/// One beam before and after.
struct CalibratedBeam {
  int fan = 0;
  int beam = 0;
  double elevation_deg = 0.0;
  double azimuth_deg = 0.0;  ///< clockwise from the bow
  double frequency_hz = 0.0;
  double ts_db = 0.0;           ///< of the sphere in this beam's pulse
  double ts_per_mps_db = 0.0;   ///< how that changes with the sound speed of the water, at most, dB for 1 m/s
  int hits = 0;                 ///< pings with the sphere inside its -6 dB contour
  bool near_null = false;       ///< crossed, but at this frequency the sphere's TS is not known well enough
  bool crossed = false;         ///< hits on all sides: `after` is known
  double off_across_deg = 0.0;  ///< where the beam looks beside where it should, along the ship and up
  double off_up_deg = 0.0;
  BeamCalibration before;           ///< as the raw file has it
  BeamCalibration after;            ///< with standard errors; nothing known where it was not crossed
  std::vector<std::size_t> levels;  ///< in SphereCalibration::levels
};

/// What a sphere run tells of a sonar.
struct SphereCalibration {
  std::vector<std::string> observations;  ///< whose pings were used
  std::vector<std::string> left_out;      ///< with other beams or settings than the first, or without a grid
  std::int64_t pings = 0;                 ///< read
  std::int64_t found = 0;                 ///< with the sphere
  std::int64_t used = 0;                  ///< in which enough beams heard it alone
  double range_from_m = 0.0;              ///< of the sphere
  double range_to_m = 0.0;
  std::vector<CalibratedBeam> beams;  ///< [row]
  std::vector<HeardLevel> levels;     ///< what was fitted
  PatternFit fit;
  [[nodiscard]] std::size_t crossed() const;
};

/// Finds the sphere in the pings of a survey and fits the beams that it crossed. Gain: of the point-target equation at the
/// top of the received pulse; sa correction: 10 log10(integral over the echo / (its top x nominal pulse length)) / 2; psi:
/// the integral of the fitted pattern; widths: -3 dB of the one-way beam whose square the pattern is. The direction of the
/// sphere is not in the files (no split-beam angles): neighbouring beams tell it. Ranges and absorption are those of the
/// recipe and the raw files; a calibration table in the recipe is not looked at.
/// errors   unsupported: no observation with fans of beams; mismatch: no sphere found, or it crossed no beam; io, format,
///          cancelled
/// threads  pings are read in parallel; the result does not depend on it
[[nodiscard]] Result<SphereCalibration> calibrate_by_sphere(const SurveyFiles& survey,
                                                            const CalibrationParams& calibration,
                                                            const SphereRunParams& params, Work& work);

}  // namespace sonar
