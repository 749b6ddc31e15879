// SPDX-License-Identifier: Apache-2.0
#include "io/nav_track.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Speed out of two fixes: far enough apart that a metre of error does not count, near enough that the ship went
// straight.
constexpr TimeNs kLongBaseline = 10 * kSecondNs;
constexpr TimeNs kShortBaseline = 2 * kSecondNs;
// Sentences are stamped when they arrive, often several at once: nothing is told by shorter times.
constexpr TimeNs kLeastStep = kSecondNs;
constexpr double kMetresPerDegree = 111'320.0;

/// Order of preference among kinds of sentence: for headings it comes before frequency, a magnetic compass never
/// outvotes a gyro; else it settles equal counts.
int preference(std::string_view sentence) {
  constexpr std::array<std::string_view, 9> order{"ZDA", "HDT", "THS", "HDG", "GGA", "RMC", "GLL", "VTG", "VLW"};
  return static_cast<int>(std::find(order.begin(), order.end(), sentence) - order.begin());
}

/// Where an instant lies among the samples, and which of its neighbours may be used.
struct Bracket {
  enum class Kind { none, hold, between } kind = Kind::none;
  std::size_t i = 0;      ///< the sample held, or the one before
  double fraction = 0.0;  ///< of the way to i + 1
};

Bracket bracket(const std::vector<NavSample>& s, TimeNs time, TimeNs limit) {
  const auto after =
      std::upper_bound(s.begin(), s.end(), time, [](TimeNs t, const NavSample& x) { return t < x.time; });
  const auto next = static_cast<std::size_t>(after - s.begin());
  const bool has_before = next > 0;
  const bool has_after = next < s.size();
  if (has_before && has_after && s[next].time - s[next - 1].time <= 2 * limit) {
    const auto gap = static_cast<double>(s[next].time - s[next - 1].time);
    return {Bracket::Kind::between, next - 1, static_cast<double>(time - s[next - 1].time) / gap};
  }
  const bool before_near = has_before && time - s[next - 1].time <= limit;
  const bool after_near = has_after && s[next].time - time <= limit;
  if (before_near && (!after_near || time - s[next - 1].time <= s[next].time - time)) {
    return {Bracket::Kind::hold, next - 1, 0.0};
  }
  if (after_near) return {Bracket::Kind::hold, next, 0.0};
  return {};
}

Geographic fix(const NavSample& sample) { return {sample.first, sample.second}; }

Geographic along(const NavSample& from, const NavSample& to, double fraction) {
  if (from.first == to.first && from.second == to.second) return fix(from);
  const GeodesicStep step = geodesic(fix(from), fix(to));
  return destination(fix(from), step.distance_m * fraction, step.bearing_deg);
}

/// Beyond sample i: on from it as the ship came (or went, before the first).
Geographic onward(const std::vector<NavSample>& s, std::size_t i, TimeNs time, TimeNs limit) {
  const bool forward = time >= s[i].time;
  const std::ptrdiff_t step = forward ? -1 : 1;
  std::size_t other = i;
  const auto apart = [&](std::size_t j) { return std::abs(s[i].time - s[j].time); };
  while (apart(other) < kLongBaseline) {
    const std::size_t next = other + static_cast<std::size_t>(step);
    if (next >= s.size() || apart(next) > std::max(limit, kLongBaseline)) break;
    other = next;
  }
  if (apart(other) < kShortBaseline) return fix(s[i]);
  const double fraction = 1.0 + static_cast<double>(std::abs(time - s[i].time)) / static_cast<double>(apart(other));
  return along(s[other], s[i], fraction);
}

/// Near enough for a limit that is itself a guess, and much quicker than a geodesic.
double rough_distance_m(const NavSample& a, const NavSample& b) {
  const double north = b.first - a.first;
  const double east = wrap_180(b.second - a.second) * std::cos(rad_from_deg((a.first + b.first) / 2.0));
  return std::hypot(north, east) * kMetresPerDegree;
}

}  // namespace

std::vector<NavSample> drop_jumps(NavTrack& track, double max_speed_mps, TimeNs longest) {
  const std::vector<NavSample>& s = track.samples;
  const auto reached = [&](std::size_t from, std::size_t to) {
    const TimeNs apart = std::max(s[to].time - s[from].time, kLeastStep);
    return rough_distance_m(s[from], s[to]) <= max_speed_mps * static_cast<double>(apart) * 1e-9;
  };
  std::vector<std::size_t> begins{0};  // of stretches without a jump inside
  for (std::size_t i = 1; i < s.size(); ++i) {
    if (!reached(i - 1, i)) begins.push_back(i);
  }
  if (begins.size() < 3) return {};
  begins.push_back(s.size());
  const auto count = [&](std::size_t stretch) { return begins[stretch + 1] - begins[stretch]; };
  NavTrack kept{track.talker, track.sentence, {}};
  std::vector<NavSample> dropped;
  const auto move = [&](std::size_t stretch, std::vector<NavSample>& to) {
    to.insert(to.end(), s.begin() + static_cast<std::ptrdiff_t>(begins[stretch]),
              s.begin() + static_cast<std::ptrdiff_t>(begins[stretch + 1]));
  };
  std::size_t fixes_before = 0;  // of the stretch kept last, with what it goes on as
  for (std::size_t k = 0; k + 1 < begins.size(); ++k) {
    // The stretch after k .. m - 1 that the ship reaches from the last fix kept, if there is one.
    std::size_t back = 0;
    for (std::size_t m = k + 1; !kept.samples.empty() && m + 1 < begins.size() && back == 0; ++m) {
      const std::size_t fixes = begins[m] - begins[k];
      if (fixes > 1 && s[begins[m]].time - s[begins[k] - 1].time > longest) break;
      if (reached(begins[k] - 1, begins[m]) && fixes < fixes_before + count(m)) back = m;
    }
    if (back == 0) {
      move(k, kept.samples);
      fixes_before = count(k);
      continue;
    }
    for (std::size_t m = k; m < back; ++m) move(m, dropped);
    move(back, kept.samples);
    fixes_before += count(back);
    k = back;
  }
  track = std::move(kept);
  return dropped;
}

NavTrack choose_track(std::span<const NavSeries* const> series, NavQuantity quantity, std::string_view wanted_talker) {
  struct Talker {
    std::size_t count = 0;
    std::map<std::string, std::size_t> sentences;
  };
  std::map<std::string, Talker> talkers;
  int best_heading = std::numeric_limits<int>::max();
  const auto wanted = [&](const NavSeries& s) {
    return s.quantity == quantity && !s.samples.empty() && (wanted_talker.empty() || s.talker == wanted_talker);
  };
  for (const NavSeries* s : series) {
    if (wanted(*s)) best_heading = std::min(best_heading, preference(s->sentence));
  }
  for (const NavSeries* s : series) {
    if (!wanted(*s) || (quantity == NavQuantity::heading && preference(s->sentence) != best_heading)) continue;
    talkers[s->talker].count += s->samples.size();
    talkers[s->talker].sentences[s->sentence] += s->samples.size();
  }
  NavTrack track;
  std::size_t most = 0;
  for (const auto& [name, talker] : talkers) {
    if (talker.count <= most) continue;
    most = talker.count;
    track.talker = name;
    std::size_t most_of_kind = 0;
    for (const auto& [sentence, count] : talker.sentences) {
      const bool better =
          count > most_of_kind || (count == most_of_kind && preference(sentence) < preference(track.sentence));
      if (!better) continue;
      most_of_kind = count;
      track.sentence = sentence;
    }
  }
  for (const NavSeries* s : series) {
    if (s->quantity != quantity || s->talker != track.talker || s->sentence != track.sentence) continue;
    track.samples.insert(track.samples.end(), s->samples.begin(), s->samples.end());
  }
  auto& samples = track.samples;
  std::stable_sort(samples.begin(), samples.end(),
                   [](const NavSample& a, const NavSample& b) { return a.time < b.time; });
  samples.erase(std::unique(samples.begin(), samples.end(),
                            [](const NavSample& a, const NavSample& b) { return a.time == b.time; }),
                samples.end());
  return track;
}

Geographic position_at(const NavTrack& track, TimeNs time, TimeNs limit) {
  const auto& s = track.samples;
  const Bracket b = bracket(s, time, limit);
  if (b.kind == Bracket::Kind::none) return {kNaN, kNaN};
  if (b.kind == Bracket::Kind::between) return along(s[b.i], s[b.i + 1], b.fraction);
  return s[b.i].time == time ? fix(s[b.i]) : onward(s, b.i, time, limit);
}

double value_at(const NavTrack& track, TimeNs time, TimeNs limit) {
  const auto& s = track.samples;
  const Bracket b = bracket(s, time, limit);
  if (b.kind == Bracket::Kind::none) return kNaN;
  if (b.kind == Bracket::Kind::hold) return s[b.i].first;
  return s[b.i].first + (s[b.i + 1].first - s[b.i].first) * b.fraction;
}

double angle_at(const NavTrack& track, TimeNs time, TimeNs limit, AngleOf which) {
  const auto& s = track.samples;
  const auto value = [&](std::size_t i) { return which == AngleOf::first ? s[i].first : s[i].second; };
  const Bracket b = bracket(s, time, limit);
  if (b.kind == Bracket::Kind::none) return kNaN;
  if (b.kind == Bracket::Kind::hold) return value(b.i);
  return wrap_360(value(b.i) + wrap_180(value(b.i + 1) - value(b.i)) * b.fraction);
}

}  // namespace sonar
