// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibrate/sphere_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/middle.h"
#include "base/number_text.h"
#include "base/units.h"
#include "io/atomic_file.h"
#include "io/csv_table.h"
#include "pipeline/survey/calibration_json.h"

namespace sonar {
namespace {

/// What a sphere run can tell; the others of a table's columns it leaves out.
constexpr std::array<std::string_view, 10> kColumns = {
    "gain_db",    "sa_correction_db",    "psi_db",    "width_along_deg",    "width_athwart_deg",
    "gain_db_se", "sa_correction_db_se", "psi_db_se", "width_along_deg_se", "width_athwart_deg_se"};

/// "0-4, 20, 22-24"
std::string spans(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += text.empty() ? "" : ", ";
    text += last == i ? fmt::format("{}", numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[last]);
    i = last + 1;
  }
  return text;
}

/// What of a fan's beams was crossed; changes are medians.
struct FanLine {
  std::vector<int> left;  ///< beams that were not
  int crossed = 0;
  double gain_change_db = 0.0, most_change_db = 0.0, sa_change_db = 0.0, psi_change_db = 0.0;
  double largest_se_db = 0.0;  ///< of a gain
};

FanLine fan_line(const SphereCalibration& made, int fan) {
  FanLine line;
  std::vector<double> gain_db;
  std::vector<double> sa_db;
  std::vector<double> psi_db;
  for (const CalibratedBeam& b : made.beams) {
    if (b.fan != fan) continue;
    if (!b.crossed) {
      if (!b.near_null) line.left.push_back(b.beam);
      continue;
    }
    ++line.crossed;
    const double change = b.after.gain_db - b.before.gain_db;
    gain_db.push_back(change);
    if (std::abs(change) > std::abs(line.most_change_db)) line.most_change_db = change;
    sa_db.push_back(b.after.sa_correction_db - b.before.sa_correction_db);
    psi_db.push_back(b.after.psi_db - b.before.psi_db);
    line.largest_se_db = std::max(line.largest_se_db, b.after.gain_db_se);
  }
  if (line.crossed == 0) return line;
  line.gain_change_db = middle_of(gain_db);
  line.sa_change_db = middle_of(sa_db);
  line.psi_change_db = middle_of(psi_db);
  return line;
}

std::string fan_lines(const SphereCalibration& made) {
  std::string text =
      "\n fan  elevation  frequency  sphere TS  beams  median gain change (most)  sa change  psi change  largest gain "
      "se\n";
  std::string left;
  const int fans = made.beams.back().fan + 1;
  for (int fan = 0; fan < fans; ++fan) {
    const FanLine line = fan_line(made, fan);
    const auto beam =
        std::find_if(made.beams.begin(), made.beams.end(), [fan](const CalibratedBeam& b) { return b.fan == fan; });
    if (line.crossed == 0) continue;
    text += fmt::format(
        "{:4} {:6.1f} deg {:6.1f} kHz {:7.2f} dB {:6} {:+16.2f} ({:+.2f}) dB {:+7.2f} dB {:+8.2f} dB {:14.3f} dB\n",
        fan, beam->elevation_deg, beam->frequency_hz / 1e3, beam->ts_db, line.crossed, line.gain_change_db,
        line.most_change_db, line.sa_change_db, line.psi_change_db, line.largest_se_db);
    if (!line.left.empty()) left += fmt::format("; fan {}: {}", fan, spans(line.left));
  }
  std::vector<int> whole;
  for (int fan = 0; fan < fans; ++fan) {
    const FanLine line = fan_line(made, fan);
    if (line.crossed == 0 && !line.left.empty()) whole.push_back(fan);
  }
  if (!whole.empty()) left += fmt::format("; all of fan {}", spans(whole));
  if (!left.empty()) text += "\nnot crossed, as they were: " + left.substr(2) + "\n";
  return text;
}

std::string beam_lines(const SphereCalibration& made) {
  std::string text =
      "\nchannel fan beam hits      gain              sa               psi               along             athwart"
      "         residual\n";
  for (const CalibratedBeam& b : made.beams) {
    if (!b.crossed) continue;
    const BeamCalibration& a = b.after;
    text += fmt::format(
        "{:7} {:3} {:4} {:4} {:7.2f} +- {:.2f} dB {:6.2f} +- {:.2f} dB {:7.2f} +- {:.2f} dB {:6.2f} +- {:.2f} deg "
        "{:6.2f} "
        "+- {:.2f} deg {:.2f} dB\n",
        a.channel, b.fan, b.beam, b.hits, a.gain_db, a.gain_db_se, a.sa_correction_db, a.sa_correction_db_se, a.psi_db,
        a.psi_db_se, a.width_along_deg, a.width_along_deg_se, a.width_athwart_deg, a.width_athwart_deg_se,
        residual_rms_db(made, b));
  }
  return text;
}

/// Near a null of the series a sphere is no measure.
std::string fans_near_null(const SphereCalibration& made) {
  std::vector<int> fans;
  for (const CalibratedBeam& b : made.beams) {
    if (b.near_null && (fans.empty() || fans.back() != b.fan)) fans.push_back(b.fan);
  }
  if (fans.empty()) return "";
  return fmt::format(
      "crossed, but as they were: beams of fan {}, at whose frequency this sphere's TS depends too much on "
      "the sound speed or the pulse (another sphere is needed)\n",
      spans(fans));
}

/// By channel.
std::vector<BeamCalibration> lines_of(const SphereCalibration& made) {
  std::vector<BeamCalibration> lines;
  for (const CalibratedBeam& beam : made.beams) {
    if (beam.crossed) lines.push_back(beam.after);
  }
  std::sort(lines.begin(), lines.end(),
            [](const BeamCalibration& a, const BeamCalibration& b) { return a.channel < b.channel; });
  return lines;
}

}  // namespace

double residual_rms_db(const SphereCalibration& made, const CalibratedBeam& beam) {
  double sum = 0.0;
  int n = 0;
  for (const std::size_t i : beam.levels) {
    const double residual = made.fit.residual_db[i];
    if (!std::isfinite(residual)) continue;
    sum += residual * residual;
    ++n;
  }
  return n > 0 ? std::sqrt(sum / n) : kUnknown;
}

double off_axis_deg(const SphereCalibration& made, std::size_t level) {
  const FaceDirection& a = made.fit.directions[static_cast<std::size_t>(made.levels[level].ping)];
  const FaceDirection& b = made.fit.beams[static_cast<std::size_t>(made.levels[level].beam)].centre;
  const auto off_face = [](const FaceDirection& d) {
    return std::sqrt(std::max(0.0, 1.0 - d.across * d.across - d.up * d.up));
  };
  // By the chord: the arc's cosine tells small angles badly.
  const double chord = std::hypot(a.across - b.across, a.up - b.up, off_face(a) - off_face(b));
  return deg_from_rad(2.0 * std::asin(std::min(1.0, 0.5 * chord)));
}

std::string sphere_text(const SphereRunParams& params) {
  return fmt::format("{}, {:.1f} mm", params.sphere.material.text, params.diameter_mm());
}

std::string crossed_text(const SphereCalibration& made) {
  return fmt::format("{} of {} beams crossed; residuals {:.3f} dB, of which the form of the pattern {:.3f} dB",
                     made.crossed(), made.beams.size(), made.fit.residual_rms_db, made.fit.form_se_db);
}

Result<void> write_calibration(const SphereCalibration& made, const std::filesystem::path& file) {
  return write_file(file, calibration_csv(made));
}

CalibrationParams taken_calibration(const SphereCalibration& made, CalibrationParams over) {
  over.beams = lines_of(made);
  over.psi = PsiSource::table;
  return over;
}

std::string calibration_csv(const SphereCalibration& made) {
  std::string text = "channel";
  for (const std::string_view column : kColumns) text += fmt::format(",{}", column);
  text += '\n';
  for (BeamCalibration& after : lines_of(made)) {
    text += fmt::format("{}", after.channel);
    for (const std::string_view column : kColumns) {
      columns(
          [&](const char* name, double& value, double, double) {
            if (column == name) text += ',' + shortest(value);
          },
          after);
    }
    text += '\n';
  }
  return text;
}

std::string calibration_text(const SphereCalibration& made, const SphereRunParams& params, bool every_beam) {
  std::string text = fmt::format(
      "sphere: {}; water around it {:.1f} m/s, {:.1f} kg/m3\n"
      "found in {} of {} pings at {:.1f} to {:.1f} m, used in {}\n{}\n",
      sphere_text(params), params.water.sound_speed_mps, params.water.density_kg_per_m3, made.found, made.pings,
      made.range_from_m, made.range_to_m, made.used, crossed_text(made));
  text += fan_lines(made);
  if (every_beam) text += beam_lines(made);
  text += fans_near_null(made);
  for (const std::string& name : made.left_out) {
    text +=
        fmt::format("left out: {}, which has no fans of beams, or others than {}\n", name, made.observations.front());
  }
  return text;
}

std::string calibration_json_text(const SphereCalibration& made, const SphereRunParams& params) {
  const SphereMaterial& m = params.sphere.material;
  nlohmann::json json{
      {"sphere",
       {{"material", m.name},
        {"source", m.source},
        {"diameter_mm", params.diameter_mm()},
        {"density_kg_per_m3", m.density_kg_per_m3},
        {"longitudinal_mps", m.longitudinal_mps},
        {"transverse_mps", m.transverse_mps}}},
      {"water",
       {{"sound_speed_mps", params.water.sound_speed_mps}, {"density_kg_per_m3", params.water.density_kg_per_m3}}},
      {"observations", made.observations},
      {"left_out", made.left_out},
      {"pings", made.pings},
      {"pings_found", made.found},
      {"pings_used", made.used},
      {"range_m", {made.range_from_m, made.range_to_m}},
      {"residual_rms_db", made.fit.residual_rms_db},
      {"form_se_db", made.fit.form_se_db},
      {"form", made.fit.shape.k},
      {"beams_crossed", made.crossed()}};
  for (const CalibratedBeam& b : made.beams) {
    nlohmann::json beam{{"channel", b.before.channel},
                        {"fan", b.fan},
                        {"beam", b.beam},
                        {"elevation_deg", b.elevation_deg},
                        {"azimuth_deg", b.azimuth_deg},
                        {"frequency_hz", b.frequency_hz},
                        {"sphere_ts_db", b.ts_db},
                        {"sphere_ts_per_mps_db", b.ts_per_mps_db},
                        {"hits", b.hits},
                        {"crossed", b.crossed},
                        {"near_null", b.near_null},
                        {"before", beams_to_json({b.before})[0]}};
    if (b.crossed) {
      beam["after"] = beams_to_json({b.after})[0];
      beam["residual_rms_db"] = residual_rms_db(made, b);
      beam["off_across_deg"] = b.off_across_deg;
      beam["off_up_deg"] = b.off_up_deg;
    }
    json["beams"].push_back(std::move(beam));
  }
  return json.dump(2) + "\n";
}

}  // namespace sonar
