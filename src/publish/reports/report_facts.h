// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/school.h"
#include "publish/picture_source.h"

namespace sonar {

/// A school of the survey as a report's table has it. NaN = unknown.
struct ReportSchool {
  std::int64_t survey_school = 0;  ///< 0 = none yet
  std::string name;                ///< "obs-0001/3", of the first row where it has several
  std::size_t observation = 0;     ///< index among the observations
  std::int64_t school_id = 0;      ///< there
  TimeNs first_time = 0;
  double latitude = kUnknown;  ///< of the row with most pings, as all of the following
  double longitude = kUnknown;
  double depth_m = kUnknown;
  double length_m = kUnknown;
  double sv_mean_db = kUnknown;
  double backscatter_m2 = kUnknown;  ///< of the school as totals count it
  double depth_se_m = kUnknown;      ///< standard errors, where the run told them
  double length_se_m = kUnknown;
  double sv_mean_se_db = kUnknown;
  double backscatter_se_m2 = kUnknown;  ///< by fading; that of a school of several rows is not known
  std::int64_t pings = 0;               ///< of all rows
  std::string status;
  std::string species;
};

/// What a report says of a survey.
struct ReportFacts {
  std::string title;                                       ///< of the survey; says SYNTHETIC where it is
  std::vector<std::pair<std::string, std::string>> lines;  ///< name and value
  std::vector<ReportSchool> schools;                       ///< that count, the strongest first
  std::vector<std::pair<std::string, std::size_t>> by_status;
  std::vector<std::pair<std::string, std::size_t>> by_species;  ///< the most frequent first; none where none is named
  std::size_t rejected = 0;
  std::size_t observations = 0;
  std::size_t searched = 0;  ///< observations whose schools were looked for
};

[[nodiscard]] ReportFacts report_facts(std::span<const DrawnObservation> observations, const Recipe& recipe);

}  // namespace sonar
