// SPDX-License-Identifier: Apache-2.0
#include "io/nav_series.h"

#include <algorithm>

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

void add_sentence(std::vector<NavSeries>& series, const NmeaSentence& sentence, TimeNs time) {
  if (sentence.talker.empty()) return;
  const auto printable = [](char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z'); };
  if (!std::all_of(sentence.talker.begin(), sentence.talker.end(), printable)) return;
  if (const auto fix = nmea_fix(sentence)) {
    add(series, NavQuantity::position, sentence, {time, fix->latitude_deg, fix->longitude_deg});
  }
  if (const auto heading = nmea_heading(sentence)) add(series, NavQuantity::heading, sentence, {time, *heading, 0.0});
  if (const auto v = nmea_velocity(sentence)) {
    add(series, NavQuantity::velocity, sentence, {time, v->speed_mps, v->course_deg});
  }
  if (const auto log = nmea_log(sentence)) add(series, NavQuantity::log, sentence, {time, *log, 0.0});
  if (const auto gps = nmea_time(sentence, time)) {
    add(series, NavQuantity::clock, sentence, {time, static_cast<double>(*gps - time) * 1e-9, 0.0});
  }
}

}  // namespace sonar
