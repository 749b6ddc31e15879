// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibrate/sphere_track.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/units.h"
#include "pipeline/stages/load_volume.h"
#include "pipeline/survey/calibration.h"
#include "signal/point_echo.h"

namespace sonar {
namespace {

/// An echo may be so much weaker than the sphere on a beam's axis: between beams, and stated gains may err.
constexpr double kWeaker_db = 10.0;
constexpr double kStronger_db = 10.0;
/// The strongest beam hears the sphere so much under its top on the average, give or take.
constexpr double kExpected_db = -1.5;
constexpr double kSpread_db = 4.0;
constexpr int kMostInPing = 40;
/// Beside a point's echo, along range, it is quiet by so much.
constexpr double kQuiet_db = 10.0;
constexpr double kPulsesInWindow = 1.25;  ///< on either side of the centre: the received pulse is twice the sent one
constexpr double kWorstLevel_db = 4.0;    ///< noise more than this tells nothing of a beam
constexpr double kAround_widths = 2.0;

double square(double x) { return x * x; }

/// Samples, not more than there are: what a file tells of its pulse may be anything.
int half_window(const ObservationFiles& o) {
  const double samples = std::max(2.0, std::ceil(kPulsesInWindow * o.pulse_length_s / o.sample_interval_s));
  return static_cast<int>(std::min(samples, static_cast<double>(o.range.count)));
}

/// Whether a file tells a frequency and a pulse that a sounder may have: how long the sphere's series are, and over what
/// band they are averaged, follows from them.
bool is_of_a_sounder(const ChannelCalibration& c) {
  constexpr double kLeastCycles = 4.0;  // of a pulse
  return c.frequency_hz >= 1e3 && c.frequency_hz <= 2e6 && c.pulse_length_s <= 0.1 &&
         c.pulse_length_s * c.frequency_hz >= kLeastCycles;
}

double spreading_db(const ChannelCalibration& c, double range_m) {
  return 40.0 * std::log10(range_m) + 2.0 * c.absorption_db_per_m * range_m;
}

/// An echo that may be the sphere's.
struct Candidate {
  int row = 0;
  int sample = 0;
  double over_ts_db = 0.0;  ///< its Sp less the sphere's
};

/// Looks into pings.
class Finder {
 public:
  Finder(const ObservationFiles& observation, const SphereBeams& beams, const SphereRunParams& params)
      : observation_(observation), beams_(beams), half_(half_window(observation)) {
    const RangeAxis& axis = observation.range;
    const double least_m = std::max(params.range_from_m, axis.spacing_m * (half_ + 1));
    first_ = std::clamp(static_cast<int>(std::ceil(axis.sample_at(least_m))), half_, axis.count);
    const double last = std::min(params.range_to_m, axis.range_m(axis.count));
    last_ =
        std::clamp(static_cast<int>(std::floor(axis.sample_at(last))), first_, std::max(first_, axis.count - half_));
    const Shape3 shape{observation.grid->fans(), observation.grid->beams(), axis.count};
    least_ = Array3<std::int16_t>(shape, std::numeric_limits<std::int16_t>::max());
    for (std::size_t row = 0; row < beams.sound.size(); ++row) {
      if (!beams.sound[row]) continue;
      const auto counts = least_.view().row(static_cast<int>(row));
      for (int s = first_; s < last_; ++s) counts[static_cast<std::size_t>(s)] = least_count(row, s);
    }
  }

  [[nodiscard]] std::vector<Candidate> look(const PowerVolume& ping) const {
    std::vector<Candidate> peaks;
    const Shape3 shape = least_.view().shape();
    for (int row = 0; row < shape.fans * shape.beams; ++row) {
      if (!beams_.sound[static_cast<std::size_t>(row)]) continue;
      const auto power = ping.volume.counts.view().row(row);
      const auto least = std::as_const(least_).view().row(row);
      for (auto s = static_cast<std::size_t>(first_); s < static_cast<std::size_t>(last_); ++s) {
        if (power[s] < least[s] || power[s] < power[s - 1] || power[s] < power[s + 1]) continue;
        peaks.push_back({row, static_cast<int>(s), db_from_counts(power[s] - least[s]) - kWeaker_db});
      }
    }
    std::stable_sort(peaks.begin(), peaks.end(),
                     [](const Candidate& a, const Candidate& b) { return a.over_ts_db > b.over_ts_db; });
    return points_among(peaks, ping);
  }

  [[nodiscard]] int half() const { return half_; }

 private:
  std::int16_t least_count(std::size_t row, int sample) const {
    const ChannelCalibration& c = beams_.calibration[row];
    const double range_m = observation_.range.range_m(sample);
    const double power_db = beams_.ts_db[row] - kWeaker_db - spreading_db(c, range_m) - sp_constant_db(c);
    return static_cast<std::int16_t>(std::clamp(counts_from_db(power_db), -32766.0, 32766.0));
  }

  /// Short along range, and the strongest of all around.
  std::vector<Candidate> points_among(const std::vector<Candidate>& peaks, const PowerVolume& ping) const {
    const int beams = observation_.grid->beams();
    constexpr int kBesideBeams = 3;
    std::vector<Candidate> strongest;
    std::vector<Candidate> points;
    constexpr std::size_t kMostLookedAt = 2000;
    for (const Candidate& peak : peaks) {
      if (strongest.size() >= kMostLookedAt || points.size() >= kMostInPing) break;
      const bool beside = std::any_of(strongest.begin(), strongest.end(), [&](const Candidate& s) {
        return std::abs(s.row / beams - peak.row / beams) <= kBesideBeams &&
               std::abs(s.row % beams - peak.row % beams) <= kBesideBeams &&
               std::abs(s.sample - peak.sample) <= 2 * half_;
      });
      if (beside) continue;
      strongest.push_back(peak);
      if (peak.over_ts_db > kStronger_db) continue;
      const auto row = ping.volume.counts.view().row(peak.row);
      const PointEcho echo = point_echo(row, peak.sample, half_);
      const double top_w = linear_from_count(row[static_cast<std::size_t>(peak.sample)]);
      if (echo.sum_w > 0.0 && echo.noise_w < top_w * linear_from_db(-kQuiet_db)) points.push_back(peak);
    }
    return points;
  }

  const ObservationFiles& observation_;
  const SphereBeams& beams_;
  int half_;
  int first_ = 0;
  int last_ = 0;
  Array3<std::int16_t> least_;
};

/// The chain through the pings.
class Chain {
 public:
  Chain(const ObservationFiles& observation, const SphereBeams& beams) : observation_(observation), beams_(beams) {}

  /// returns  one candidate in some pings
  std::vector<std::pair<std::size_t, Candidate>> through(const std::vector<std::vector<Candidate>>& pings,
                                                         const Work& work) const {
    constexpr double kGain = 6.0;  // for a ping in which the sphere is; a chance echo costs more than that to get to
    constexpr std::size_t kLongestGap = 10;
    struct Node {
      double cost;
      std::size_t ping, index;
      std::ptrdiff_t before;
    };
    std::vector<Node> nodes;
    std::vector<std::size_t> first_of;
    std::ptrdiff_t best = -1;
    for (std::size_t p = 0; p < pings.size() && !work.cancelled(); ++p) {
      first_of.push_back(nodes.size());
      const std::size_t from = p > kLongestGap ? first_of[p - kLongestGap] : 0;
      const std::size_t to = nodes.size();
      for (std::size_t c = 0; c < pings[p].size(); ++c) {
        const double own = square((pings[p][c].over_ts_db - kExpected_db) / kSpread_db) - kGain;
        Node node{own, p, c, -1};
        for (std::size_t n = from; n < to; ++n) {
          if (nodes[n].cost + own >= node.cost) continue;  // a step costs something
          const double gap = static_cast<double>(p - nodes[n].ping);
          const double cost = nodes[n].cost + own + step(pings[nodes[n].ping][nodes[n].index], pings[p][c], gap);
          if (cost < node.cost) node = {cost, p, c, static_cast<std::ptrdiff_t>(n)};
        }
        nodes.push_back(node);
        if (best < 0 || node.cost < nodes[static_cast<std::size_t>(best)].cost) {
          best = static_cast<std::ptrdiff_t>(nodes.size()) - 1;
        }
      }
    }
    std::vector<std::pair<std::size_t, Candidate>> chain;
    for (auto n = best; n >= 0; n = nodes[static_cast<std::size_t>(n)].before) {
      const Node& node = nodes[static_cast<std::size_t>(n)];
      chain.emplace_back(node.ping, pings[node.ping][node.index]);
    }
    std::reverse(chain.begin(), chain.end());
    return chain;
  }

 private:
  double step(const Candidate& a, const Candidate& b, double gap) const {
    constexpr double kFar_m = 1.0;
    constexpr double kAside = 0.1;       // rad
    constexpr double kMostAside = 12.0;  // out of the beams and back elsewhere costs two pings; its line it keeps
    const FaceDirection& at = beams_.stated[static_cast<std::size_t>(a.row)].centre;
    const FaceDirection& to = beams_.stated[static_cast<std::size_t>(b.row)].centre;
    const double far = (b.sample - a.sample) * observation_.range.spacing_m / kFar_m;
    const double aside = std::hypot(to.across - at.across, to.up - at.up) / kAside;
    return far * far / gap + std::min(kMostAside, aside * aside / gap) + (gap - 1.0);
  }

  const ObservationFiles& observation_;
  const SphereBeams& beams_;
};

/// [ping] of one target; empty = not seen there.
using Followed = std::vector<std::optional<Candidate>>;

/// The sphere is not the only thing that stays: a fish may, or what the surface scatters.
std::vector<Followed> chains_through(std::vector<std::vector<Candidate>> seen, const ObservationFiles& observation,
                                     const SphereBeams& beams, const Work& work) {
  constexpr std::size_t kMostTargets = 4;
  constexpr std::size_t kLeastPings = 8;  // no beam is crossed in fewer
  std::vector<Followed> chains;
  while (chains.size() < kMostTargets) {
    const auto chain = Chain(observation, beams).through(seen, work);
    if (chain.size() < kLeastPings && !chains.empty()) break;
    Followed& followed = chains.emplace_back(seen.size());
    for (const auto& [ping, candidate] : chain) {
      followed[ping] = candidate;
      std::erase_if(seen[ping],
                    [&](const Candidate& one) { return one.row == candidate.row && one.sample == candidate.sample; });
    }
  }
  return chains;
}

/// Levels of all beams around the sphere in one ping.
std::vector<SphereLevel> levels_of(const SphereAt& at, int sample, const PowerVolume& ping,
                                   const ObservationFiles& observation, const SphereBeams& beams,
                                   const CalibrationParams& calibration, int half) {
  std::vector<SphereLevel> levels;
  const FittedBeam& centre = beams.stated[static_cast<std::size_t>(at.row)];
  for (std::size_t row = 0; row < beams.stated.size(); ++row) {
    const FittedBeam& beam = beams.stated[row];
    if (!beams.sound[row] ||
        std::abs(beam.centre.across - centre.centre.across) > kAround_widths * centre.width_across ||
        std::abs(beam.centre.up - centre.centre.up) > kAround_widths * centre.width_up) {
      continue;
    }
    const int channel = observation.grid->channel[row];
    const auto head = std::find_if(ping.heads.begin(), ping.heads.end(),
                                   [&](const ChannelPing& one) { return one.channel == channel; });
    const PointEcho echo = point_echo(ping.volume.counts.view().row(static_cast<int>(row)), sample, half);
    if (head == ping.heads.end() || !(echo.sum_w > 0.0)) continue;
    const double se_db = 10.0 / std::numbers::ln10 * std::sqrt(2.0 / echo.signal_to_noise(half));
    if (se_db > kWorstLevel_db) continue;
    const ChannelCalibration now =
        channel_calibration(observation.config.beams[static_cast<std::size_t>(channel)], *head, calibration, nullptr,
                            observation.sound_speed_given ? observation.sound_speed_mps : 0.0);
    const double pulses = observation.sample_interval_s / now.pulse_length_s;
    const double level_db = db_from_linear(echo.sum_w * pulses) + spreading_db(now, at.range_m) + sp_constant_db(now) +
                            2.0 * now.gain_db - beams.ts_db[row];
    levels.push_back({at.ping, static_cast<int>(row), level_db, se_db,
                      std::round(echo.centre_sample) - echo.centre_sample, echo.nearest_share_db});
  }
  return levels;
}

/// A target in one ping.
struct Heard {
  std::size_t chain;
  SphereAt at;
  std::vector<SphereLevel> levels;
};

/// Runs a job for each index on all threads. errors: the first index's; cancelled
Result<void> for_each_read(std::int64_t count, Work& work, const std::function<Result<void>(std::size_t)>& job) {
  std::vector<Result<void>> results(static_cast<std::size_t>(count));
  std::atomic<std::int64_t> done = 0;
  work.for_each(count, [&](std::int64_t i) {
    results[static_cast<std::size_t>(i)] = job(static_cast<std::size_t>(i));
    work.progress("sphere", ++done, count);
  });
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  for (Result<void>& result : results) {
    if (!result) return std::move(result);
  }
  return {};
}

}  // namespace

SphereBeams sphere_beams(const ObservationFiles& observation, const CalibrationParams& calibration,
                         const SphereRunParams& params) {
  const BeamGrid& grid = *observation.grid;
  SphereBeams out;
  for (std::size_t row = 0; row < grid.channel.size(); ++row) {
    const auto channel = static_cast<std::size_t>(grid.channel[row]);
    const ChannelCalibration c =
        channel_calibration(observation.config.beams[channel], first_head(observation, channel), calibration, nullptr,
                            observation.sound_speed_given ? observation.sound_speed_mps : 0.0);
    const double elevation_rad = rad_from_deg(grid.elevation_deg[row / static_cast<std::size_t>(grid.beams())]);
    const double from_mounting_rad =
        rad_from_deg(grid.azimuth_deg[row % static_cast<std::size_t>(grid.beams())] - grid.mounting_azimuth_deg);
    FittedBeam stated;
    stated.level_db = 2.0 * (c.gain_db + c.sa_correction_db);
    stated.width_across = rad_from_deg(grid.horizontal_width_deg[row]) * std::cos(from_mounting_rad);
    stated.width_up = rad_from_deg(grid.vertical_width_deg[row]) * std::cos(elevation_rad);
    stated.centre = {std::cos(elevation_rad) * std::sin(from_mounting_rad), std::sin(elevation_rad)};
    const bool sound = is_sound(c) && is_of_a_sounder(c) && stated.width_across > 0.0 && stated.width_up > 0.0;
    out.calibration.push_back(c);
    out.sound.push_back(sound);
    out.ts_db.push_back(sound ? sphere_ts_db(params.sphere, params.water, c.frequency_hz, c.pulse_length_s) : kUnknown);
    out.stated.push_back(stated);
  }
  return out;
}

Result<std::vector<SphereTrack>> find_targets(const SurveyFiles& survey, const ObservationFiles& observation,
                                              const SphereBeams& beams, const CalibrationParams& calibration,
                                              const SphereRunParams& params, Work& work) {
  const Finder finder(observation, beams, params);
  const auto pings = static_cast<std::int64_t>(observation.pings.size());
  std::vector<std::vector<Candidate>> seen(observation.pings.size());
  const auto looked = for_each_read(pings, work, [&](std::size_t p) -> Result<void> {
    const auto ping = load_volume(survey, observation, p);
    if (!ping) return pass_on(ping);
    seen[p] = finder.look(*ping);
    return {};
  });
  if (!looked) return pass_on(looked);
  const std::vector<Followed> chains = chains_through(std::move(seen), observation, beams, work);
  std::vector<std::vector<Heard>> heard(observation.pings.size());
  const auto measured = for_each_read(pings, work, [&](std::size_t p) -> Result<void> {
    if (std::none_of(chains.begin(), chains.end(), [&](const Followed& chain) { return chain[p].has_value(); })) {
      return {};
    }
    const auto ping = load_volume(survey, observation, p);
    if (!ping) return pass_on(ping);
    for (std::size_t c = 0; c < chains.size(); ++c) {
      if (!chains[c][p]) continue;
      const Candidate& candidate = *chains[c][p];
      const PointEcho echo = point_echo(ping->volume.counts.view().row(candidate.row), candidate.sample, finder.half());
      const SphereAt at{p, candidate.row, observation.range.range_m(echo.centre_sample)};
      heard[p].push_back({c, at,
                          levels_of(at, static_cast<int>(std::lround(echo.centre_sample)), *ping, observation, beams,
                                    calibration, finder.half())});
    }
    return {};
  });
  if (!measured) return pass_on(measured);
  std::vector<SphereTrack> tracks(chains.size());
  for (const auto& in_ping : heard) {
    for (const Heard& one : in_ping) {
      SphereTrack& track = tracks[one.chain];
      track.at.push_back(one.at);
      track.levels.insert(track.levels.end(), one.levels.begin(), one.levels.end());
    }
  }
  return tracks;
}

}  // namespace sonar
