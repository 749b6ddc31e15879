// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/beam_grid.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// What `sonarx info` tells of one file.
struct FileInfo {
  std::string path;
  std::string format;
  std::string sounder;
  std::uint64_t size = 0;
  std::map<std::string, std::int64_t> datagrams;
  std::int64_t channels = 0;
  std::int64_t pings = 0;
  std::int64_t min_samples = 0;
  std::int64_t max_samples = 0;
  std::optional<TimeNs> first_time;  ///< of the pings; where there are none, of the datagrams
  std::optional<TimeNs> last_time;
  std::optional<Geographic> first_position;
  std::optional<Geographic> last_position;
  Talkers talkers;
  double gps_minus_clock_s = 0.0;  ///< NaN = unknown
  std::optional<std::int64_t> power_count_sum;
  Diagnostics notes;
  bool readable = true;
};

/// Least and greatest of a setting over the beams; empty = no beam tells.
struct SettingRange {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();
  void take(double value);
  [[nodiscard]] bool empty() const { return !(least <= greatest); }
};

/// What the beams of an observation were set to.
struct InstrumentInfo {
  std::string model;           ///< model_of()
  std::string model_and_name;  ///< model_and_name()
  std::int64_t beams = 0;
  SettingRange frequency_hz;
  SettingRange pulse_length_s;
  SettingRange transmit_power_w;
  SettingRange gain_db;
  SettingRange width_alongship_deg;    ///< in fans: vertical
  SettingRange width_athwartship_deg;  ///< in fans: horizontal
};

struct SurveyInfo {
  struct Observation {
    std::string name;
    InstrumentInfo instrument;
    std::vector<std::string> files;
    std::string sounder;
    std::int64_t pings = 0;
    TimeNs first_time = 0;
    TimeNs last_time = 0;
    std::optional<BeamGrid> grid;
    bool continues_cut = false;
    Talkers talkers;
    Diagnostics notes;
  };
  std::vector<FileInfo> files;
  std::vector<Observation> observations;
  bool from_ends = false;  ///< see SurveyFiles::from_ends: what was counted is not told

  /// False if any file could not be read at all.
  [[nodiscard]] bool all_readable() const;
};

/// Gathers what `info` tells. with_checksum reads every sample of every file.
/// errors  cancelled; io while summing
[[nodiscard]] Result<SurveyInfo> survey_info(const SurveyFiles& survey, const NavigationParams& navigation,
                                             bool with_checksum, Work& work);

/// The object of INTERFACES section 2, indented by two, newline at the end.
[[nodiscard]] std::string info_json(const SurveyInfo& info);
/// The same for people.
[[nodiscard]] std::string info_text(const SurveyInfo& info);

}  // namespace sonar
