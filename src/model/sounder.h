// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sonar {

/// Family of sounder, told from CON0's sounder name.
enum class SounderKind { ek60, me70, ms70, omni, unknown };

/// One transceiver block of CON0. Angles in degrees, dB as stored.
struct BeamConfig {
  std::string channel_id;
  std::int32_t beam_type = 0;
  double frequency_hz = 0.0;
  double gain_db = 0.0;
  double equivalent_beam_angle_db = 0.0;
  double width_alongship_deg = 0.0;    ///< MS70: vertical
  double width_athwartship_deg = 0.0;  ///< MS70: horizontal
  double sensitivity_alongship = 0.0;
  double sensitivity_athwartship = 0.0;
  double offset_alongship_deg = 0.0;
  double offset_athwartship_deg = 0.0;
  std::array<double, 3> position_m{};     ///< x, y, z
  std::array<double, 3> direction_deg{};  ///< MS70: elevation, azimuth from abeam (positive to the bow), 0
  std::array<double, 5> pulse_length_s{};
  std::array<double, 5> gain_table_db{};
  std::array<double, 5> sa_correction_table_db{};
};

/// What CON0 and CON1 say.
struct SounderConfig {
  std::string survey_name;
  std::string transect_name;
  std::string sounder_name;
  std::string version;
  SounderKind kind = SounderKind::unknown;
  double sound_speed_average_mps = 0.0;
  double sound_speed_transducer_mps = 0.0;
  std::array<double, 3> mru_offset_m{};
  std::array<double, 3> mru_angles_deg{};
  std::array<double, 3> gps_offset_m{};  ///< antenna, vessel frame: x bow, y starboard, z down
  std::vector<BeamConfig> beams;         ///< [channel]
  std::string con1_xml;                  ///< as recorded; empty where there was none
};

/// "Simrad MS70"; as the file calls it where the family is not known.
[[nodiscard]] std::string model_of(const SounderConfig& config);
/// The same, with the name that the recorder gives it where that is another: "Simrad MS70 (MBS)".
[[nodiscard]] std::string model_and_name(const SounderConfig& config);

}  // namespace sonar
