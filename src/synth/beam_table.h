// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/sounder.h"

namespace sonar::synth {

/// One beam of the synthetic sonar, with everything that calibrates it.
struct Beam {
  double elevation_deg = 0.0;  ///< positive up
  double azimuth_deg = 0.0;    ///< from abeam (straight to port), positive towards the bow
  double frequency_hz = 0.0;
  double vertical_width_deg = 0.0;    ///< one-way, -3 dB, full
  double horizontal_width_deg = 0.0;  ///< one-way, -3 dB, full, along the arc
  double gain_db = 0.0;
  double psi_db = 0.0;  ///< equivalent two-way beam angle, dB re 1 sr
  double sa_correction_db = 0.0;
  double power_w = 0.0;
  double absorption_db_per_m = 0.0;
  int count = 0;  ///< samples recorded
};

/// The pulse and sampling of a real MS70 ping.
inline constexpr double kSoundSpeed_mps = 1474.99;
inline constexpr double kSampleInterval_s = 0.000512;
inline constexpr double kPulseLength_s = 0.002048;

/// The 20 fans x 25 beams of a real MS70 ping, in channel order: deepest fan first, most aft beam first.
/// source  beam table of G.O. Sars, cruise 2009116, 2009-11-13 08:11:49 UTC
[[nodiscard]] std::vector<Beam> ms70_beams();

/// Reads a user's table: CSV with a header that names the columns channel, elevation_deg, azimuth_deg, frequency_hz,
/// vertical_width_deg, horizontal_width_deg, gain_db, psi_db, sa_correction_db, power_w, absorption_db_per_m, count,
/// in any order; channels 0, 1, ... each once.
/// errors  format: a column is missing or a value is no number; bad_parameter: a value out of range
/// file    stands in messages
[[nodiscard]] Result<std::vector<Beam>> parse_beam_table(const std::string& text, const std::string& file);
/// errors  also not_found, io
[[nodiscard]] Result<std::vector<Beam>> read_beam_table(const std::filesystem::path& path);

/// What CON0 and CON1 say of these beams.
[[nodiscard]] SounderConfig sounder_config(const std::vector<Beam>& beams, const std::string& survey_name);

}  // namespace sonar::synth
