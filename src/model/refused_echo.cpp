// SPDX-License-Identifier: Apache-2.0
#include "model/refused_echo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sonar {
namespace {

/// "1 fan", "3 fans": units of counts are plurals.
std::string counted(double figure, std::string unit) {
  if (figure == 1.0 && unit.ends_with('s')) unit.pop_back();
  return fmt::format("{:.3g} {}", figure, unit);
}

/// What was looked at, and what it should have been. A judge that is not known here has its figure and its unit.
std::string measured(const RefusedEcho& echo) {
  const double figure = echo.figure;
  const double limit = echo.limit;
  if (echo.judge == "confirmation" && echo.limit_unit == "pings") {
    return fmt::format("seen in {}, {:.3g} at least", counted(figure, "pings"), limit);
  }
  if (echo.judge == "confirmation" && echo.limit_unit == "evidence over all pings") {
    return fmt::format("evidence of {:.3g} in all sightings together, {:.3g} at least", figure, limit);
  }
  if (echo.judge == "level") return fmt::format("its Sv is {:.3g} dB, {:.3g} at least", figure, limit);
  if (echo.judge == "surface" && echo.limit_unit == "m deep at most") {
    return fmt::format("hangs from the surface down to {:.3g} m, as bubbles do to {:.3g} m", figure, limit);
  }
  if (echo.judge == "ship" && echo.limit_unit == "share of the ship's way") {
    return fmt::format("goes where the ship goes: drifts by {:.3g} of the ship's way, {:.3g} at least", figure, limit);
  }
  if (echo.judge == "prominence" && echo.limit_unit == "dB") {
    return fmt::format("rises {:.3g} dB above a stronger echo beside it, {:.3g} at least", figure, limit);
  }
  if (std::isnan(limit)) return counted(figure, echo.limit_unit);
  return fmt::format("{}, {:.3g} {}", counted(figure, echo.limit_unit), limit,
                     figure <= limit ? "at least" : "at most");
}

}  // namespace

std::string why_no_school(const RefusedEcho& echo) {
  if (std::isnan(echo.figure)) return fmt::format("no school (judge {})", echo.judge);
  return fmt::format("no school: {} (judge {})", measured(echo), echo.judge);
}

std::vector<RefusedSightings> refused_sightings(std::span<const RefusedEcho> rows) {
  std::map<std::int64_t, RefusedSightings> echoes;
  for (const RefusedEcho& row : rows) {
    const auto [at, first] = echoes.try_emplace(row.echo_id, RefusedSightings{&row, row.ping_index, row.ping_index, 0});
    RefusedSightings& echo = at->second;
    if (row.level_db > echo.loudest->level_db) echo.loudest = &row;
    echo.first_ping = std::min(echo.first_ping, row.ping_index);
    echo.last_ping = std::max(echo.last_ping, row.ping_index);
    ++echo.pings;
  }
  std::vector<RefusedSightings> sightings;
  for (const auto& [id, echo] : echoes) sightings.push_back(echo);
  return sightings;
}

}  // namespace sonar
