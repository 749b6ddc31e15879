// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/beam_figures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "model/beam_angles.h"

namespace sonar {
namespace {

double first_known(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

/// dB of a small relative error.
double db_of_share(double share) { return 10.0 * std::numbers::log10e * share; }

/// Standard error of the angle that is used; NaN = not told.
double psi_se_db(PsiSource source, const BeamCalibration& user, double along_deg, double athwart_deg) {
  switch (source) {
    case PsiSource::stated:
      return kUnknown;
    case PsiSource::table:
      return std::isfinite(user.psi_db) ? user.psi_db_se : kUnknown;
    case PsiSource::from_widths:
      return db_of_share(std::hypot(user.width_along_deg_se / along_deg, user.width_athwart_deg_se / athwart_deg));
  }
  return kUnknown;
}

/// What is not told adds nothing; NaN where nothing is told.
double joint_se_db(double gain_se, double sa_se, double extra_se, double psi_se) {
  double sum = 0.0;
  bool told = false;
  for (const double part : {2.0 * gain_se, 2.0 * sa_se, extra_se, psi_se}) {
    if (!std::isfinite(part)) continue;
    sum += part * part;
    told = true;
  }
  return told ? std::sqrt(sum) : kUnknown;
}

}  // namespace

UserCalibration::UserCalibration(std::vector<BeamCalibration> beams) : beams_(std::move(beams)) {
  std::sort(beams_.begin(), beams_.end(),
            [](const BeamCalibration& a, const BeamCalibration& b) { return a.channel < b.channel; });
}

const BeamCalibration* UserCalibration::of(int channel) const {
  const auto found = std::lower_bound(beams_.begin(), beams_.end(), channel,
                                      [](const BeamCalibration& beam, int wanted) { return beam.channel < wanted; });
  return found != beams_.end() && found->channel == channel ? &*found : nullptr;
}

double psi_db_of(const BeamConfig& beam, const CalibrationParams& params, const BeamCalibration* user) {
  const BeamCalibration told = user != nullptr ? *user : BeamCalibration{};
  switch (params.psi) {
    case PsiSource::stated:
      break;
    case PsiSource::table:
      return first_known(told.psi_db, beam.equivalent_beam_angle_db);
    case PsiSource::from_widths:
      return psi_from_widths_db(first_known(told.width_along_deg, beam.width_alongship_deg),
                                first_known(told.width_athwart_deg, beam.width_athwartship_deg));
  }
  return beam.equivalent_beam_angle_db;
}

BeamGrid calibrated_grid(const BeamGrid& grid, const CalibrationParams& params) {
  BeamGrid calibrated = grid;
  const UserCalibration users(params.beams);
  for (std::size_t row = 0; row < grid.channel.size(); ++row) {
    const BeamCalibration* user = users.of(grid.channel[row]);
    if (user == nullptr) continue;
    calibrated.vertical_width_deg[row] = first_known(user->width_along_deg, grid.vertical_width_deg[row]);
    calibrated.horizontal_width_deg[row] = first_known(user->width_athwart_deg, grid.horizontal_width_deg[row]);
  }
  return calibrated;
}

BeamFigures beam_figures(const SounderConfig& config, const BeamGrid& grid, const CalibrationParams& params) {
  const UserCalibration users(params.beams);
  const std::vector<double> of_widths_db = psi_from_widths_db(grid);
  BeamFigures figures;
  for (std::size_t row = 0; row < grid.channel.size(); ++row) {
    const BeamCalibration* user = users.of(grid.channel[row]);
    const BeamConfig& beam = config.beams[static_cast<std::size_t>(grid.channel[row])];
    const double used_db = psi_db_of(beam, params, user);
    const bool by_widths = params.psi == PsiSource::from_widths;
    figures.psi_used_db.push_back(used_db);
    figures.psi_error_db.push_back((by_widths ? beam.equivalent_beam_angle_db : of_widths_db[row]) - used_db);
    const BeamCalibration told = user != nullptr ? *user : BeamCalibration{};
    figures.calibration_se_db.push_back(
        joint_se_db(told.gain_db_se, told.sa_correction_db_se, told.extra_factor_db_se,
                    psi_se_db(params.psi, told, grid.vertical_width_deg[row], grid.horizontal_width_deg[row])));
  }
  return figures;
}

GridRecord grid_record(const ObservationFiles& observation, const CalibrationParams& params) {
  GridRecord record{calibrated_grid(*observation.grid, params),
                    observation.sample_count,
                    observation.range,
                    observation.sound_speed_mps,
                    {}};
  record.psi_used_db = beam_figures(observation.config, record.grid, params).psi_used_db;
  return record;
}

}  // namespace sonar
