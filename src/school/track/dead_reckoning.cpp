// SPDX-License-Identifier: Apache-2.0
#include "school/track/dead_reckoning.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {
namespace {

double seconds_between(const PingNavigation& a, const PingNavigation& b) {
  return static_cast<double>(b.time - a.time) / static_cast<double>(kSecondNs);
}

/// Indices of pings that tell something.
template <class Knows>
std::vector<std::size_t> those(std::span<const PingNavigation> pings, Knows knows) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < pings.size(); ++i) {
    if (knows(pings[i])) indices.push_back(i);
  }
  return indices;
}

/// The known pings before and after one, and how far in time it is on the way between them; the same twice at the ends.
struct Between {
  std::size_t before = 0;
  std::size_t after = 0;
  double share = 0.0;
};

Between between(std::span<const PingNavigation> pings, const std::vector<std::size_t>& known, std::size_t i) {
  const auto next = std::lower_bound(known.begin(), known.end(), i);
  if (next == known.end()) return {known.back(), known.back(), 0.0};
  if (next == known.begin() || *next == i) return {*next, *next, 0.0};
  Between found{*(next - 1), *next, 0.0};
  const double whole = seconds_between(pings[found.before], pings[found.after]);
  if (whole > 0.0) found.share = seconds_between(pings[found.before], pings[i]) / whole;
  return found;
}

/// Degrees at every ping out of those that know an angle; 0 where none does.
template <class Angle>
std::vector<double> filled_angles(std::span<const PingNavigation> pings, Angle angle_deg) {
  const auto known = those(pings, [&](const PingNavigation& p) { return std::isfinite(angle_deg(p)); });
  std::vector<double> filled(pings.size(), 0.0);
  for (std::size_t i = 0; i < pings.size() && !known.empty(); ++i) {
    const Between at = between(pings, known, i);
    const double from = angle_deg(pings[at.before]);
    filled[i] = wrap_360(from + at.share * wrap_180(angle_deg(pings[at.after]) - from));
  }
  return filled;
}

/// Over ground, m/s to the east and north, at every ping; at rest where nobody tells.
std::vector<Point<Enu>> velocities(std::span<const PingNavigation> pings) {
  const auto way_deg = [](const PingNavigation& p) {
    return std::isfinite(p.course_deg) ? p.course_deg : p.heading_deg;
  };
  const auto known = those(pings, [&](const PingNavigation& p) {
    return std::isfinite(p.speed_mps) && (p.speed_mps == 0.0 || std::isfinite(way_deg(p)));
  });
  const auto velocity = [&](std::size_t i) {
    if (pings[i].speed_mps == 0.0) return Point<Enu>{};
    const double way = rad_from_deg(way_deg(pings[i]));
    return Point<Enu>{pings[i].speed_mps * std::sin(way), pings[i].speed_mps * std::cos(way), 0.0};
  };
  std::vector<Point<Enu>> filled(pings.size());
  for (std::size_t i = 0; i < pings.size() && !known.empty(); ++i) {
    const Between at = between(pings, known, i);
    filled[i] = velocity(at.before) * (1.0 - at.share) + velocity(at.after) * at.share;
  }
  return filled;
}

/// Way made good since the first ping, metres east and north.
std::vector<Point<Enu>> ways(std::span<const PingNavigation> pings) {
  const std::vector<Point<Enu>> v = velocities(pings);
  std::vector<Point<Enu>> way(pings.size());
  for (std::size_t i = 1; i < pings.size(); ++i) {
    way[i] = way[i - 1] + (v[i - 1] + v[i]) * (seconds_between(pings[i - 1], pings[i]) / 2.0);
  }
  return way;
}

}  // namespace

DeadReckoning dead_reckoning(std::span<const PingNavigation> pings) {
  const auto has_fix = [](const PingNavigation& p) { return p.has_position(); };
  const auto has_heading = [](const PingNavigation& p) { return std::isfinite(p.heading_deg); };
  const bool by_course = std::none_of(pings.begin(), pings.end(), has_heading);
  const std::vector<double> heading_deg =
      filled_angles(pings, [&](const PingNavigation& p) { return by_course ? p.course_deg : p.heading_deg; });
  const std::vector<std::size_t> fixes = those(pings, has_fix);
  DeadReckoning reckoned;
  for (const PingNavigation& ping : pings) {
    reckoned.pings.push_back(ping.placement());
    if (!has_heading(ping)) ++reckoned.without_heading;
  }
  reckoned.without_position = static_cast<std::int64_t>(pings.size() - fixes.size());
  const std::vector<Point<Enu>> way =
      reckoned.without_position > 0 ? ways(pings) : std::vector<Point<Enu>>(pings.size());
  for (std::size_t i = 0; i < pings.size(); ++i) {
    reckoned.pings[i].heading_rad = rad_from_deg(heading_deg[i]);
    if (has_fix(pings[i])) continue;
    if (fixes.empty()) {
      reckoned.pings[i].transducer = to_geographic(way[i], Geographic{0.0, 0.0});
      continue;
    }
    const Between at = between(pings, fixes, i);
    const Geographic& from = pings[at.before].transducer;
    const Point<Enu> misclosure = to_enu(pings[at.after].transducer, from) - (way[at.after] - way[at.before]);
    reckoned.pings[i].transducer = to_geographic(way[i] - way[at.before] + misclosure * at.share, from);
  }
  return reckoned;
}

}  // namespace sonar
