// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/clock_runs.h"

#include <algorithm>
#include <iterator>

namespace sonar {

SaidToPings::SaidToPings(const SurveyFiles& survey, const std::vector<std::uint32_t>& files,
                         const ClockRunsOfFiles& runs) {
  for (const std::uint32_t file : files) {
    for (const NavSeries& one : survey.files[file].index.navigation) add(one, runs.at(file));
    file_of_series_.resize(series_.size(), file);
  }
}

void SaidToPings::add(const NavSeries& series, const std::set<std::uint16_t>& runs) {
  const auto said_then = [&](const NavSample& sample) { return runs.contains(sample.clock_run); };
  if (std::all_of(series.samples.begin(), series.samples.end(), said_then)) {
    series_.push_back(&series);
    return;
  }
  NavSeries& part = parts_.emplace_back(NavSeries{series.quantity, series.talker, series.sentence, {}});
  std::copy_if(series.samples.begin(), series.samples.end(), std::back_inserter(part.samples), said_then);
  series_.push_back(&part);
}

}  // namespace sonar
