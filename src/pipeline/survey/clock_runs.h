// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "io/nav_series.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// [file] clock runs (io/nav_series.h) that pings lie in.
using ClockRunsOfFiles = std::map<std::uint32_t, std::set<std::uint16_t>>;

/// What navigation was recorded under the clocks of an observation's pings. Borrows from the survey.
class SaidToPings {
 public:
  SaidToPings(const SurveyFiles& survey, const std::vector<std::uint32_t>& files, const ClockRunsOfFiles& runs);
  [[nodiscard]] std::span<const NavSeries* const> series() const { return series_; }
  [[nodiscard]] std::uint32_t file_of(std::size_t series) const { return file_of_series_[series]; }

 private:
  void add(const NavSeries& series, const std::set<std::uint16_t>& runs);

  std::deque<NavSeries> parts_;  ///< grows without moving
  std::vector<const NavSeries*> series_;
  std::vector<std::uint32_t> file_of_series_;
};

}  // namespace sonar
