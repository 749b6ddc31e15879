// SPDX-License-Identifier: Apache-2.0
#include "io/nav_series.h"

#include <algorithm>
#include <limits>

namespace sonar {
namespace {

// A hostile file may invent talkers without end; a ship has a dozen.
constexpr std::size_t kMaxSeries = 256;

void add(std::vector<NavSeries>& series, NavQuantity quantity, const NmeaSentence& sentence, NavSample sample) {
  auto it = std::find_if(series.begin(), series.end(), [&](const NavSeries& s) {
    return s.quantity == quantity && s.talker == sentence.talker && s.sentence == sentence.type;
  });
  if (it == series.end()) {
    if (series.size() >= kMaxSeries) return;
    series.push_back({quantity, std::string(sentence.talker), std::string(sentence.type), {}});
    it = series.end() - 1;
  }
  it->samples.push_back(sample);
}

}  // namespace

void add_sentence(std::vector<NavSeries>& series, const NmeaSentence& sentence, TimeNs time, std::uint16_t clock_run) {
  if (sentence.talker.empty()) return;
  const auto printable = [](char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z'); };
  if (!std::all_of(sentence.talker.begin(), sentence.talker.end(), printable)) return;
  if (const auto fix = nmea_fix(sentence)) {
    add(series, NavQuantity::position, sentence, {time, fix->latitude_deg, fix->longitude_deg, clock_run});
  }
  if (const auto heading = nmea_heading(sentence))
    add(series, NavQuantity::heading, sentence, {time, *heading, 0.0, clock_run});
  if (const auto v = nmea_velocity(sentence)) {
    add(series, NavQuantity::velocity, sentence, {time, v->speed_mps, v->course_deg, clock_run});
  }
  if (const auto log = nmea_log(sentence)) add(series, NavQuantity::log, sentence, {time, *log, 0.0, clock_run});
  if (const auto gps = nmea_time(sentence, time)) {
    add(series, NavQuantity::clock, sentence, {time, static_cast<double>(*gps - time) * 1e-9, 0.0, clock_run});
  }
}

void ClockRuns::begin_ping(TimeNs time, std::vector<NavSeries>& series) {
  if (last_ && time < *last_ && run_ < std::numeric_limits<std::uint16_t>::max()) {
    ++run_;
    samples_at_last_.resize(series.size(), 0);
    for (std::size_t i = 0; i < series.size(); ++i) {
      auto& samples = series[i].samples;
      const auto since = samples.begin() + static_cast<std::ptrdiff_t>(samples_at_last_[i]);
      auto it = std::find_if(since, samples.end(), [&](const NavSample& sample) { return sample.time < *last_; });
      for (; it != samples.end(); ++it) it->clock_run = run_;
    }
  }
  last_ = time;
  samples_at_last_.clear();
  for (const NavSeries& one : series) samples_at_last_.push_back(one.samples.size());
}

}  // namespace sonar
