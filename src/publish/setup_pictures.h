// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/calibrate/setup_report.h"
#include "pipeline/calibrate/sphere_calibration.h"
#include "view/charts/leg_chart.h"
#include "view/charts/sphere_chart.h"

namespace sonar {

// What is known of a sonar's setup, as pictures have it: a sphere run, and the schools' speeds on course legs.

/// Angles off the axis are between the fitted direction of the sphere in a ping and that of the beam; residuals are of the
/// levels that the fit used.
[[nodiscard]] SphereChartData sphere_chart_data(const SphereCalibration& made, const SphereRunParams& params);
/// Of what the calibration is made, as the chart has it below its title.
[[nodiscard]] std::string sphere_words(const SphereCalibration& made, const Units& units = {});
/// errors  as sphere_chart() and write_picture()
[[nodiscard]] Result<void> write_sphere_picture(const SphereChartData& data, const SphereLook& look,
                                                const std::filesystem::path& file);

[[nodiscard]] LegChartData leg_chart_data(const SetupReport& report);
/// What is proposed, or why nothing is, in lines.
[[nodiscard]] std::vector<std::string> proposal_lines(const SetupReport& report);
/// errors  as leg_chart() and write_picture()
[[nodiscard]] Result<void> write_leg_picture(const LegChartData& data, const std::filesystem::path& file);

}  // namespace sonar
