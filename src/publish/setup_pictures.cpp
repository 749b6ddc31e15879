// SPDX-License-Identifier: Apache-2.0
#include "publish/setup_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "pipeline/calibrate/sphere_report.h"
#include "publish/picture_output.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{1500, 1000};

SphereChartBeam chart_beam(const SphereCalibration& made, const CalibratedBeam& beam) {
  SphereChartBeam out;
  out.channel = beam.before.channel;
  out.fan = beam.fan;
  out.beam = beam.beam;
  out.frequency_khz = beam.frequency_hz / 1e3;
  out.hits = beam.hits;
  if (beam.near_null) out.state = SphereChartBeam::State::near_null;
  if (!beam.crossed) return out;
  const BeamCalibration& before = beam.before;
  const BeamCalibration& after = beam.after;
  out.state = SphereChartBeam::State::crossed;
  out.rms_db = residual_rms_db(made, beam);
  out.figures = {{{before.gain_db, after.gain_db, after.gain_db_se},
                  {before.sa_correction_db, after.sa_correction_db, after.sa_correction_db_se},
                  {before.psi_db, after.psi_db, after.psi_db_se},
                  {before.width_along_deg, after.width_along_deg, after.width_along_deg_se},
                  {before.width_athwart_deg, after.width_athwart_deg, after.width_athwart_deg_se}}};
  return out;
}

}  // namespace

std::string sphere_words(const SphereCalibration& made, const Units& units) {
  const Unit unit = units.length();
  return fmt::format("used in {} of {} at {:.1f} to {}; residuals {:.3f} dB", made.used,
                     count_of(static_cast<std::size_t>(made.pings), "ping"), unit.of(made.range_from_m),
                     quantity_text(made.range_to_m, 1, unit), made.fit.residual_rms_db);
}

SphereChartData sphere_chart_data(const SphereCalibration& made, const SphereRunParams& params) {
  SphereChartData out;
  out.title = fmt::format("{}: sphere of {}", made.observations.front(), sphere_text(params));
  out.words = sphere_words(made);
  for (const CalibratedBeam& beam : made.beams) {
    out.fans = std::max(out.fans, beam.fan + 1);
    out.beams_a_fan = std::max(out.beams_a_fan, beam.beam + 1);
    out.beams.push_back(chart_beam(made, beam));
  }
  for (std::size_t i = 0; i < made.levels.size(); ++i) {
    if (!std::isfinite(made.fit.residual_db[i])) continue;
    const auto beam = static_cast<std::size_t>(made.levels[i].beam);
    out.residuals.push_back({beam, off_axis_deg(made, i), made.fit.residual_db[i]});
  }
  return out;
}

Result<void> write_sphere_picture(const SphereChartData& data, const SphereLook& look,
                                  const std::filesystem::path& file) {
  const auto made = sphere_chart(data, {look, {}}, kSize, light_theme(kSize));
  if (!made) return pass_on(made);
  return write_picture(made->frame, file);
}

LegChartData leg_chart_data(const SetupReport& report) {
  LegChartData out;
  out.title = fmt::format("Setup check: {} on {}", count_of(report.check.schools, "school"),
                          count_of(report.check.legs.size(), "course leg"));
  for (const CourseLeg& leg : report.check.legs) {
    out.legs.push_back({clock_text(leg.first_time, true), leg.course_deg, leg.ship_mps, leg.schools, leg.along_mps,
                        leg.along_se_mps, leg.cross_mps, leg.cross_se_mps});
  }
  out.words = proposal_lines(report);
  return out;
}

std::vector<std::string> proposal_lines(const SetupReport& report) {
  const SetupCheck& c = report.check;
  const std::string bearings =
      fmt::format("bearings too large by {:+.2f} \u00B1 {:.2f}\u00B0", c.bearing_error_deg, c.bearing_error_se_deg);
  const std::string ranges = fmt::format("ranges too long by {:+.2f} \u00B1 {:.2f} %", 100.0 * (c.range_scale - 1.0),
                                         100.0 * c.range_scale_se);
  if (!c.drift_known) {
    return {"Nothing is proposed: on one course a current looks as a wrong setup does.",
            fmt::format("If nothing drifted: {}, {}.", bearings, ranges)};
  }
  return {fmt::format("Mounting angle {:.2f} -> {:.2f} \u00B1 {:.2f}\u00B0 ({})", report.mounting_azimuth_deg,
                      report.proposed_mounting_azimuth_deg, c.bearing_error_se_deg, bearings),
          fmt::format("Sound speed {:.1f} -> {:.1f} \u00B1 {:.1f} m/s ({})", report.sound_speed_mps,
                      report.proposed_sound_speed_mps, report.proposed_sound_speed_se_mps, ranges)};
}

Result<void> write_leg_picture(const LegChartData& data, const std::filesystem::path& file) {
  const auto made = leg_chart(data, kSize, light_theme(kSize));
  if (!made) return pass_on(made);
  return write_picture(made->frame, file);
}

}  // namespace sonar
