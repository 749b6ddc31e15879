// SPDX-License-Identifier: Apache-2.0
#include "io/ping_navigation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "base/units.h"
#include "geo/geodesic.h"
#include "io/nav_track.h"

namespace sonar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Speed is worked out of positions this far before and after.
constexpr TimeNs kHalfBaseline = 10 * kSecondNs;
constexpr double kLargestArm_m = 500.0;
// A ship that makes less way than this lies as it likes.
constexpr double kLeastWay_mps = 1.0;

TimeNs ns_of(double seconds) { return static_cast<TimeNs>(std::llround(seconds * 1e9)); }

struct Tracks {
  NavTrack position;
  NavTrack heading;
  NavTrack velocity;
  NavTrack log;
  NavTrack clock;
};

Tracks choose(std::span<const NavSeries* const> series, const NavigationParams& p) {
  return {choose_track(series, NavQuantity::position, p.position_talker),
          choose_track(series, NavQuantity::heading, p.heading_talker),
          choose_track(series, NavQuantity::velocity, p.speed_talker),
          choose_track(series, NavQuantity::log, p.log_talker),
          choose_track(series, NavQuantity::clock, p.clock_talker)};
}

/// A talker that was asked for and said nothing.
void note_silent_talkers(const Tracks& tracks, const NavigationParams& p, Diagnostics& notes) {
  const auto note = [&](const std::string& wanted, const NavTrack& track, const char* what) {
    if (wanted.empty() || !track.samples.empty()) return;
    notes.push_back({DiagnosticCode::no_talker, "", -1, -1,
                     fmt::format("the recipe asks for talker {}, which sent no {}", wanted, what)});
  };
  note(p.position_talker, tracks.position, "position");
  note(p.heading_talker, tracks.heading, "heading");
  note(p.speed_talker, tracks.velocity, "speed");
  note(p.log_talker, tracks.log, "log");
  note(p.clock_talker, tracks.clock, "time");
}

/// Positions that stayed the antenna's because nobody knows which way the ship lay.
void note_unmoved(std::span<const PingNavigation> pings, const Point<Vessel>& arm, Diagnostics& notes) {
  if (arm == Point<Vessel>{}) return;
  const auto unmoved = [](const PingNavigation& p) { return p.has_position() && std::isnan(p.heading_deg); };
  const auto count = std::count_if(pings.begin(), pings.end(), unmoved);
  if (count == 0) return;
  const auto first = std::find_if(pings.begin(), pings.end(), unmoved) - pings.begin();
  notes.push_back(
      {DiagnosticCode::no_heading, "", -1, first,
       fmt::format("without a heading the positions of {} pings are the antenna's, not the transducer's", count)});
}

bool usable(const std::array<double, 3>& place) {
  return std::all_of(place.begin(), place.end(), [](double v) { return std::abs(v) <= kLargestArm_m; });
}

/// Antenna to transducer in the vessel's frame; empty where CON0's numbers are impossible.
std::optional<Point<Vessel>> lever_arm(const SounderConfig& config, const NavigationParams& params) {
  if (params.lever_arm == LeverArmSource::none) return Point<Vessel>{};
  if (params.lever_arm == LeverArmSource::settings) {
    return Point<Vessel>{params.lever_arm_x_m, params.lever_arm_y_m, params.lever_arm_z_m};
  }
  const std::array<double, 3> transducer =
      config.beams.empty() ? std::array<double, 3>{} : config.beams.front().position_m;
  const std::array<double, 3>& antenna = config.gps_offset_m;
  if (!usable(transducer) || !usable(antenna)) return std::nullopt;
  return Point<Vessel>{transducer[0] - antenna[0], transducer[1] - antenna[1], transducer[2] - antenna[2]};
}

/// Speed and course out of the positions round an instant.
void velocity_from_positions(const NavTrack& positions, TimeNs time, TimeNs limit, PingNavigation& ping) {
  TimeNs from_time = time - kHalfBaseline;
  TimeNs to_time = time + kHalfBaseline;
  Geographic from = position_at(positions, from_time, 0);
  Geographic to = position_at(positions, to_time, 0);
  if (std::isnan(from.latitude_deg)) from = position_at(positions, from_time, limit);
  if (std::isnan(to.latitude_deg)) to = position_at(positions, to_time, limit);
  if (std::isnan(from.latitude_deg)) from = position_at(positions, from_time = time, limit);
  if (std::isnan(to.latitude_deg)) to = position_at(positions, to_time = time, limit);
  if (std::isnan(from.latitude_deg) || std::isnan(to.latitude_deg) || from_time == to_time) return;
  const GeodesicStep step = geodesic(from, to);
  ping.speed_mps = step.distance_m / (static_cast<double>(to_time - from_time) * 1e-9);
  if (step.distance_m > 0.0) ping.course_deg = step.bearing_deg;
}

void move_to_transducer(PingNavigation& ping, const Point<Vessel>& arm) {
  if (!ping.has_position() || std::isnan(ping.heading_deg)) return;
  if (arm == Point<Vessel>{}) return;
  const Point<Sonar> level_arm = level(arm, rad_from_deg(ping.roll_deg), rad_from_deg(ping.pitch_deg));
  ping.transducer = to_geographic(to_enu(level_arm, rad_from_deg(ping.heading_deg)), ping.transducer);
}

/// Where the antenna was and how the ship lay.
PingNavigation place(const PingMotion& motion, const Tracks& tracks, const NavigationParams& params) {
  const TimeNs limit = ns_of(params.fix_limit_s);
  PingNavigation ping;
  ping.time = motion.time + ns_of(params.time_offset_s);
  ping.roll_deg = motion.roll_deg;
  ping.pitch_deg = motion.pitch_deg;
  ping.heave_m = params.heave == HeaveSign::up ? -motion.heave_m : motion.heave_m;
  ping.transducer_depth_m = motion.transducer_depth_m != 0.0 ? motion.transducer_depth_m : params.transducer_depth_m;
  if (params.heave != HeaveSign::off) ping.transducer_depth_m += ping.heave_m;
  ping.transducer = position_at(tracks.position, ping.time, limit);
  ping.heading_deg = angle_at(tracks.heading, ping.time, limit, AngleOf::first);
  if (std::isnan(ping.heading_deg) && motion.heading_deg != 0.0) ping.heading_deg = wrap_360(motion.heading_deg);
  if (tracks.velocity.samples.empty()) {
    velocity_from_positions(tracks.position, ping.time, limit, ping);
  } else {
    ping.speed_mps = value_at(tracks.velocity, ping.time, limit);
    ping.course_deg = angle_at(tracks.velocity, ping.time, limit, AngleOf::second);
  }
  ping.distance_nmi = value_at(tracks.log, ping.time, ns_of(params.log_limit_s));
  ping.gps_minus_clock_s = value_at(tracks.clock, motion.time, limit);
  return ping;
}

/// Course for heading where the ship makes way; over the shorter arc between two such pings no farther apart than twice
/// the limit. True where any ping got one.
bool head_by_course(std::vector<PingNavigation>& pings, TimeNs limit, Diagnostics& notes) {
  const auto makes_way = [](const PingNavigation& p) {
    return p.speed_mps > kLeastWay_mps && !std::isnan(p.course_deg);
  };
  std::size_t headed = 0;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < pings.size(); ++i) {
    if (!makes_way(pings[i])) continue;
    pings[i].heading_deg = wrap_360(pings[i].course_deg);
    ++headed;
    const TimeNs apart = last ? pings[i].time - pings[*last].time : 0;
    if (last && apart <= 2 * limit) {
      const double from = pings[*last].heading_deg;
      const double turn = wrap_180(pings[i].heading_deg - from);
      for (std::size_t j = *last + 1; j < i; ++j) {
        const auto since = static_cast<double>(pings[j].time - pings[*last].time);
        pings[j].heading_deg = wrap_360(from + turn * since / static_cast<double>(apart));
        ++headed;
      }
    }
    last = i;
  }
  if (!last) return false;
  const auto first = std::find_if(pings.begin(), pings.end(), makes_way) - pings.begin();
  notes.push_back({DiagnosticCode::heading_from_course, "", -1, first,
                   fmt::format("no heading was recorded; the course over ground is used instead in {} of {} pings",
                               headed, pings.size())});
  return true;
}

/// Fixes left out as jumps, as far as they concern these pings.
void note_jumps(std::span<const NavSample> jumps, std::span<const NavSeries* const> series,
                const NavigationParams& params, Navigation& result) {
  const std::vector<PingNavigation>& pings = result.pings;
  if (pings.empty()) return;
  const TimeNs limit = ns_of(params.fix_limit_s);
  const auto concerns = [&](const NavSample& jump) {
    return jump.time >= pings.front().time - limit && jump.time <= pings.back().time + limit;
  };
  const auto count = std::count_if(jumps.begin(), jumps.end(), concerns);
  if (count == 0) return;
  const NavSample& jump = *std::find_if(jumps.begin(), jumps.end(), concerns);
  for (std::size_t i = 0; i < series.size() && !result.first_jump; ++i) {
    const auto& samples = series[i]->samples;
    const bool here = series[i]->quantity == NavQuantity::position &&
                      std::find(samples.begin(), samples.end(), jump) != samples.end();
    if (here) result.first_jump = i;
  }
  const auto after =
      std::find_if(pings.begin(), pings.end(), [&](const PingNavigation& p) { return p.time >= jump.time; });
  result.diagnostics.push_back(
      {DiagnosticCode::position_jump, "", -1, after == pings.end() ? std::ssize(pings) - 1 : after - pings.begin(),
       fmt::format("{} fixes left out, the first of {}: faster than {:g} m/s from those before and to those after",
                   count, iso_time(jump.time), params.max_speed_mps)});
}

double median_of(const NavTrack& track) {
  if (track.samples.empty()) return kNaN;
  std::vector<double> values;
  for (const NavSample& sample : track.samples) values.push_back(sample.first);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Talkers talkers_of(const Tracks& tracks, std::span<const PingNavigation> pings) {
  Talkers talkers;
  if (!tracks.position.talker.empty()) talkers["position"] = tracks.position.talker;
  if (!tracks.heading.talker.empty()) talkers["heading"] = tracks.heading.talker;
  if (!tracks.velocity.talker.empty()) talkers["speed"] = tracks.velocity.talker;
  if (!tracks.log.talker.empty()) talkers["log"] = tracks.log.talker;
  if (!tracks.clock.talker.empty()) talkers["clock"] = tracks.clock.talker;
  const auto any = [&](auto known) { return std::any_of(pings.begin(), pings.end(), known); };
  if (tracks.heading.talker.empty() && any([](const PingNavigation& p) { return !std::isnan(p.heading_deg); })) {
    talkers["heading"] = "RAW0";
  }
  if (tracks.velocity.talker.empty() && any([](const PingNavigation& p) { return !std::isnan(p.speed_mps); })) {
    talkers["speed"] = "positions";
  }
  return talkers;
}

template <class Lacks>
void note_lack(std::span<const PingNavigation> pings, Lacks lacks, DiagnosticCode code, std::string_view what,
               Diagnostics& notes) {
  const auto count = std::count_if(pings.begin(), pings.end(), lacks);
  if (count == 0) return;
  const auto first = std::find_if(pings.begin(), pings.end(), lacks) - pings.begin();
  notes.push_back({code, "", -1, first, fmt::format("{} of {} pings have no {}", count, pings.size(), what)});
}

}  // namespace

PingMotion ping_attitude(const PingEntry& entry) {
  return {entry.time,
          static_cast<double>(entry.roll_deg),
          static_cast<double>(entry.pitch_deg),
          static_cast<double>(entry.heave_m),
          static_cast<double>(entry.heading_deg),
          static_cast<double>(entry.transducer_depth_m)};
}

Navigation navigate(std::span<const NavSeries* const> series, std::span<const PingMotion> pings,
                    const SounderConfig& config, const NavigationParams& params) {
  Tracks tracks = choose(series, params);
  const TimeNs limit = ns_of(params.fix_limit_s);
  const auto jumps = drop_jumps(tracks.position, params.max_speed_mps, 2 * limit);
  Navigation result;
  const auto arm = lever_arm(config, params);
  if (!arm) {
    result.diagnostics.push_back({DiagnosticCode::bad_lever_arm, "", -1, -1,
                                  fmt::format("an offset of CON0 is farther than {} m", kLargestArm_m)});
  }
  result.pings.reserve(pings.size());
  for (const PingMotion& ping : pings) result.pings.push_back(place(ping, tracks, params));
  result.talkers = talkers_of(tracks, result.pings);
  // Sources are never mixed: where a heading is known of any ping, none is made up.
  if (params.heading_from_course && result.talkers.count("heading") == 0 &&
      head_by_course(result.pings, limit, result.diagnostics)) {
    result.talkers["heading"] = "course";
  }
  for (PingNavigation& ping : result.pings) move_to_transducer(ping, arm.value_or(Point<Vessel>{}));
  note_jumps(jumps, series, params, result);
  result.gps_minus_clock_s = median_of(tracks.clock);
  note_lack(
      result.pings, [](const PingNavigation& p) { return !p.has_position(); }, DiagnosticCode::no_position, "position",
      result.diagnostics);
  note_lack(
      result.pings, [](const PingNavigation& p) { return std::isnan(p.heading_deg); }, DiagnosticCode::no_heading,
      "heading", result.diagnostics);
  note_silent_talkers(tracks, params, result.diagnostics);
  note_unmoved(result.pings, arm.value_or(Point<Vessel>{}), result.diagnostics);
  return result;
}

std::optional<std::pair<NavSample, NavSample>> first_and_last_fix(std::span<const NavSeries* const> series,
                                                                  const NavigationParams& params) {
  const NavTrack track = choose_track(series, NavQuantity::position, params.position_talker);
  if (track.samples.empty()) return std::nullopt;
  return std::pair(track.samples.front(), track.samples.back());
}

}  // namespace sonar
