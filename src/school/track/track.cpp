// SPDX-License-Identifier: Apache-2.0
#include "school/track/track.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/check.h"
#include "school/detect/detection_owners.h"
#include "school/track/assign.h"
#include "school/track/divide.h"
#include "school/track/inseparable.h"
#include "school/track/moved_mask.h"
#include "school/track/open_track.h"

namespace sonar {
namespace {

/// Dearer than any pair within the gates: no choice, only a mark.
constexpr double kForbidden = 1e6;

double seconds_between(TimeNs from, TimeNs to) {
  return static_cast<double>(to - from) / static_cast<double>(kSecondNs);
}

class Tracker {
 public:
  Tracker(std::span<const DetectedPing> pings, const Sector& sector, std::span<const int> channel,
          const TrackParams& params)
      : pings_(pings), sector_(sector), channel_(channel), params_(params) {
    for (const DetectedPing& ping : pings) frames_.emplace_back(ping.placement, pings.front().placement.transducer);
  }

  Tracks run() {
    for (std::size_t p = 0; p < pings_.size(); ++p) step(p);
    for (OpenTrack& track : open_) close(std::move(track));
    open_.clear();
    join_inseparable(closed_, events_, pings_, sector_);
    return number_tracks(closed_, events_, pings_, channel_, params_);
  }

 private:
  void step(std::size_t p) {
    retire(p);
    const DetectedPing& ping = pings_[p];
    const DetectionOwners owners(ping, sector_);
    std::vector<std::vector<double>> shared;  // [track][detection] m^3 of the moved mask inside the detection
    std::vector<double> moved_m3;
    std::vector<std::vector<double>> cost;
    for (OpenTrack& track : open_) {
      const double dt = seconds_between(pings_[p - 1].time, ping.time);
      track.motion.predict(dt, params_.acceleration_mps2);
      if (track.apart) track.apart->predict(dt, params_.acceleration_mps2);
      moved_m3.push_back(0.0);
      shared.push_back(overlaps(track, p, owners, moved_m3.back()));
      cost.emplace_back();
      for (std::size_t d = 0; d < ping.detections.size(); ++d) {
        cost.back().push_back(price(track, p, ping.detections[d], shared.back()[d]));
      }
    }
    part_again(p, cost);
    const std::vector<int> choice = assign(cost, alone());
    std::vector<int> taken_by(ping.detections.size(), -1);
    for (std::size_t t = 0; t < open_.size(); ++t) {
      if (choice[t] >= 0 && cost[t][static_cast<std::size_t>(choice[t])] < alone()) {
        taken_by[static_cast<std::size_t>(choice[t])] = static_cast<int>(t);
      }
    }
    if (params_.divide_joined) divide_joined(p, taken_by, shared, moved_m3);
    note_merges(p, taken_by, shared, moved_m3);
    const std::vector<std::vector<int>> pieces = gather_pieces(p, taken_by, shared);
    settle_parted(p, taken_by);
    for (std::size_t d = 0; d < taken_by.size(); ++d) {
      if (taken_by[d] >= 0)
        extend(open_[static_cast<std::size_t>(taken_by[d])], p, static_cast<int>(d),
               pieces[static_cast<std::size_t>(taken_by[d])]);
    }
    const std::size_t known = shared.size();
    for (std::size_t d = 0; d < taken_by.size(); ++d) {
      if (taken_by[d] != -1) continue;
      begin(p, static_cast<int>(d));
      for (std::size_t t = 0; t < known; ++t) {
        if (shared[t][d] < TrackParams::fragment_overlap * ping.detections[d].volume_m3) continue;
        events_.push_back({TrackEventKind::split, ping.ping_index, open_.back().number, open_[t].number});
        break;
      }
    }
  }

  /// Closes tracks that have been lost too long.
  void retire(std::size_t p) {
    for (std::size_t t = 0; t < open_.size();) {
      const std::int64_t lost = pings_[p].ping_index - pings_[open_[t].last_ping].ping_index - 1;
      const double unseen_s = seconds_between(pings_[open_[t].last_ping].time, pings_[p].time);
      if (lost <= params_.max_lost_pings && unseen_s <= params_.max_lost_s) {
        ++t;
        continue;
      }
      close(std::move(open_[t]));
      open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(t));
    }
  }

  void close(OpenTrack track) {
    const std::int64_t ping = pings_[track.last_ping].ping_index;
    if (track.last_ping + 1 < pings_.size()) events_.push_back({TrackEventKind::death, ping, track.number, -1});
    closed_.push_back(std::move(track));
  }

  [[nodiscard]] std::vector<double> overlaps(const OpenTrack& track, std::size_t p, const DetectionOwners& owners,
                                             double& moved_m3) const {
    std::vector<double> shared(pings_[p].detections.size(), 0.0);
    const double dt = seconds_between(pings_[track.last_ping].time, pings_[p].time);
    const Point<Enu> shift = track.motion.velocity() * dt;
    const TrackedDetection& last = track.pings.back();
    for (const int piece : last.detections) {
      const PingMask& whole = pings_[track.last_ping].detections[static_cast<std::size_t>(piece)].mask;
      const PingMask& mask = last.part.empty() ? whole : last.part;
      for (const MovedPoint& point :
           moved_mask(mask, sector_, frames_[track.last_ping], frames_[p], shift, TrackParams::overlap_samples)) {
        moved_m3 += point.volume_m3;
        const int owner = owners.at(point.index);
        if (owner >= 0) shared[static_cast<std::size_t>(owner)] += point.volume_m3;
      }
    }
    return shared;
  }

  [[nodiscard]] Covariance3 spread(std::size_t p, const Detection& d, bool censored) const {
    return centre_covariance(d.centre, d.covariance, frames_[p].heading_rad(), params_.position_share,
                             params_.min_position_m, TrackParams::censored_m, censored ? d.edge_flags : 0);
  }

  [[nodiscard]] double alone() const { return params_.gate_sigmas * params_.gate_sigmas + TrackParams::overlap_weight; }

  [[nodiscard]] double price(const OpenTrack& track, std::size_t p, const Detection& d, double shared_m3) const {
    const Point<Enu> place = frames_[p].to_world(d.centre);
    const double gate = params_.gate_sigmas * params_.gate_sigmas;
    const double distance2 = track.motion.distance2(place, spread(p, d, true));
    if (!(distance2 <= gate)) return kForbidden;
    // a cut coordinate lets everything through the gate: then only touching or a near body will do
    if (shared_m3 <= 0.0 && !could_reach(track, p, d, place)) return kForbidden;
    const double overlap = std::min(1.0, shared_m3 / std::max(1e-9, std::min(track.volume_m3, d.volume_m3)));
    return distance2 / 2.0 + TrackParams::overlap_weight * (1.0 - overlap) + unlikeness(track, p, d);
  }

  /// Whether a body as large as the track's, from where it was last seen alone, can have come so far: a border hides what
  /// lies beyond it, and moves no school.
  [[nodiscard]] bool could_reach(const OpenTrack& track, std::size_t p, const Detection& d,
                                 const Point<Enu>& place) const {
    const double gate = params_.gate_sigmas * params_.gate_sigmas;
    if (!(track.motion.distance2(place, spread(p, d, false)) <= gate)) return false;
    const double dt = seconds_between(pings_[track.alone_ping].time, pings_[p].time);
    const Point<Enu> way = track.motion.velocity() * dt;
    const double swum_m = TrackParams::unseen_speed_mps * dt;
    Covariance3 extent = turned(d.covariance, frames_[p].heading_rad());
    for (std::size_t k = 0; k < extent.size(); ++k) extent[k] += track.shape[k];
    for (const std::size_t k : {std::size_t{0}, std::size_t{3}, std::size_t{5}}) {
      extent[k] += swum_m * swum_m + params_.min_position_m * params_.min_position_m;
    }
    const Motion seen(track.alone_at + Point<Enu>{way.x, way.y, 0.0}, extent, 0.0);
    return seen.distance2(place, {}) <= gate;
  }

  [[nodiscard]] double unlikeness(const OpenTrack& track, std::size_t p, const Detection& d) const {
    const double missed = static_cast<double>(pings_[p].ping_index - pings_[track.last_ping].ping_index - 1);
    return TrackParams::size_weight *
               std::abs(std::log(std::max(d.volume_m3, 1e-9) / std::max(track.volume_m3, 1e-9))) +
           TrackParams::level_weight * std::abs(d.reference_db - track.reference_db) + TrackParams::lost_cost * missed;
  }

  /// Schools that shared a detection and now find several: who is who tell their motions from before they met.
  void part_again(std::size_t p, std::vector<std::vector<double>>& cost) const {
    for (std::size_t t = 0; t < open_.size(); ++t) {
      if (!open_[t].apart) continue;
      std::vector<std::size_t> group;
      for (std::size_t u = 0; u < open_.size(); ++u) {
        if (open_[u].apart && open_[u].last_ping == open_[t].last_ping &&
            open_[u].pings.back().detections.front() == open_[t].pings.back().detections.front())
          group.push_back(u);
      }
      if (group.front() != t) continue;  // seen to already
      std::vector<std::size_t> found;
      for (std::size_t d = 0; d < pings_[p].detections.size(); ++d) {
        if (std::any_of(group.begin(), group.end(), [&](std::size_t u) { return cost[u][d] < alone(); }))
          found.push_back(d);
      }
      if (found.size() > 1) price_by_past(p, group, found, cost);
    }
  }

  /// Schools that were together and have each a detection of their own again: their way while they were together is known
  /// now, and their motion from before goes on.
  void settle_parted(std::size_t p, const std::vector<int>& taken_by) {
    std::vector<std::size_t> parted;
    std::vector<Point<Enu>> now;
    for (std::size_t d = 0; d < taken_by.size(); ++d) {
      if (taken_by[d] < 0) continue;
      OpenTrack& track = open_[static_cast<std::size_t>(taken_by[d])];
      if (!track.apart) continue;
      const Detection& detection = pings_[p].detections[d];
      const Point<Enu> place = frames_[p].to_world(detection.centre);
      const bool went_on =
          track.apart->distance2(place, spread(p, detection, true)) <= params_.gate_sigmas * params_.gate_sigmas;
      if (went_on) track.motion = *track.apart;
      track.apart.reset();
      parted.push_back(static_cast<std::size_t>(taken_by[d]));
      now.push_back(place);
    }
    if (parted.size() > 1) divide_again(open_, parted, now, p, pings_, frames_, sector_, params_.min_position_m);
  }

  void price_by_past(std::size_t p, const std::vector<std::size_t>& group, const std::vector<std::size_t>& found,
                     std::vector<std::vector<double>>& cost) const {
    for (const std::size_t t : group) {
      for (const std::size_t d : found) {
        const Detection& detection = pings_[p].detections[d];
        const double distance2 =
            open_[t].apart->distance2(frames_[p].to_world(detection.centre), spread(p, detection, true));
        const bool within = distance2 <= params_.gate_sigmas * params_.gate_sigmas;
        cost[t][d] = within ? distance2 / 2.0 + unlikeness(open_[t], p, detection) : kForbidden;
      }
    }
  }

  /// Schools that go for one detection, after each was seen alone for some time, share it: their echoes have met.
  /// Marks the detection in taken_by with -3.
  void divide_joined(std::size_t p, std::vector<int>& taken_by, const std::vector<std::vector<double>>& shared,
                     const std::vector<double>& moved_m3) {
    for (std::size_t d = 0; d < taken_by.size(); ++d) {
      std::vector<std::size_t> claimants;
      for (std::size_t t = 0; t < shared.size(); ++t) {
        const bool owns = taken_by[d] == static_cast<int>(t);
        const bool lost = std::count(taken_by.begin(), taken_by.end(), static_cast<int>(t)) == 0;
        if (open_[t].merged) continue;
        const double inside = shared[t][d] / std::max(moved_m3[t], 1e-9);
        const bool well_known = open_[t].own_pings >= TrackParams::divide_own_pings || open_[t].shares();
        const bool enters = (well_known && inside > TrackParams::fragment_overlap) ||
                            (inside > TrackParams::divide_least_share && holds_both(p, d, taken_by[d], open_[t]));
        if ((owns && open_[t].own_pings > 1) || (lost && open_[t].last_ping != p && enters)) claimants.push_back(t);
      }
      if (claimants.size() > 1 && share_out(p, d, claimants)) taken_by[d] = -3;
    }
  }

  /// Whether a detection is about as large as its owner and another school were that was seen more than once.
  [[nodiscard]] bool holds_both(std::size_t p, std::size_t d, int owner, const OpenTrack& other) const {
    if (owner < 0 || other.own_pings < TrackParams::divide_both_pings) return false;
    const double both_m3 = open_[static_cast<std::size_t>(owner)].volume_m3 + other.volume_m3;
    return pings_[p].detections[d].volume_m3 > TrackParams::divide_both_share * both_m3;
  }

  bool share_out(std::size_t p, std::size_t d, const std::vector<std::size_t>& claimants) {
    const DetectedPing& ping = pings_[p];
    std::vector<ExpectedBody> bodies;
    for (const std::size_t t : claimants) bodies.push_back({open_[t].motion.position(), open_[t].shape});
    std::vector<PingMask> parts = divide(ping.detections[d].mask, sector_, frames_[p], bodies, params_.min_position_m);
    std::vector<MaskShape> shapes;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      shapes.push_back(shape_of(parts[i], sector_));
      if (!(shapes[i].weight > 0.0)) return false;
      const OpenTrack& track = open_[claimants[i]];
      // once they share they may pass through each other, where hardly anything is left for one
      if (!track.shares() && shapes[i].volume_m3 < TrackParams::divide_least_share * track.volume_m3) return false;
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      OpenTrack& track = open_[claimants[i]];
      const Covariance3 spread =
          centre_covariance(shapes[i].centre, shapes[i].covariance, frames_[p].heading_rad(), params_.position_share,
                            params_.min_position_m, TrackParams::censored_m, ping.detections[d].edge_flags);
      if (!track.apart) track.apart = track.motion;
      track.motion.update(frames_[p].to_world(shapes[i].centre), spread);
      track.last_ping = p;
      track.pings.push_back({ping.ping_index, {static_cast<int>(d)}, std::move(parts[i])});
    }
    return true;
  }

  /// A school without a detection whose moved mask lies in another's has gone into it.
  void note_merges(std::size_t p, const std::vector<int>& taken_by, const std::vector<std::vector<double>>& shared,
                   const std::vector<double>& moved_m3) {
    for (std::size_t t = 0; t < shared.size(); ++t) {
      if (open_[t].last_ping == p || open_[t].merged ||
          std::count(taken_by.begin(), taken_by.end(), static_cast<int>(t)) > 0)
        continue;
      for (std::size_t d = 0; d < taken_by.size(); ++d) {
        if (taken_by[d] < 0 || !(shared[t][d] > TrackParams::fragment_overlap * moved_m3[t])) continue;
        open_[t].merged = true;
        events_.push_back({TrackEventKind::merge, pings_[p].ping_index, open_[t].number,
                           open_[static_cast<std::size_t>(taken_by[d])].number});
        break;
      }
    }
  }

  /// Stray detections inside the moved mask of a school that was found: pieces of it, until they stay apart.
  /// Marks them in taken_by with -2.
  std::vector<std::vector<int>> gather_pieces(std::size_t p, std::vector<int>& taken_by,
                                              const std::vector<std::vector<double>>& shared) {
    std::vector<std::vector<int>> pieces(open_.size());
    std::vector<int> main_of(open_.size(), -1);
    for (std::size_t d = 0; d < taken_by.size(); ++d) {
      if (taken_by[d] >= 0) main_of[static_cast<std::size_t>(taken_by[d])] = static_cast<int>(d);
    }
    for (std::size_t d = 0; d < taken_by.size(); ++d) {
      if (taken_by[d] != -1) continue;
      const double volume = pings_[p].detections[d].volume_m3;
      int parent = -1;
      for (std::size_t t = 0; t < shared.size(); ++t) {
        if (main_of[t] < 0 || open_[t].pieces_streak >= TrackParams::split_pings) continue;
        const double main_m3 = pings_[p].detections[static_cast<std::size_t>(main_of[t])].volume_m3;
        if (volume > TrackParams::piece_volume * main_m3 || shared[t][d] < TrackParams::fragment_overlap * volume)
          continue;
        if (parent < 0 || shared[t][d] > shared[static_cast<std::size_t>(parent)][d]) parent = static_cast<int>(t);
      }
      if (parent < 0) continue;
      pieces[static_cast<std::size_t>(parent)].push_back(static_cast<int>(d));
      taken_by[d] = -2;
    }
    for (std::size_t t = 0; t < pieces.size(); ++t) {
      open_[t].pieces_streak = pieces[t].empty() ? 0 : open_[t].pieces_streak + 1;
    }
    return pieces;
  }

  void extend(OpenTrack& track, std::size_t p, int main, const std::vector<int>& pieces) {
    const DetectedPing& ping = pings_[p];
    const Detection& d = ping.detections[static_cast<std::size_t>(main)];
    TrackedDetection tracked{ping.ping_index, {main}, {}};
    tracked.detections.insert(tracked.detections.end(), pieces.begin(), pieces.end());
    double volume = 0.0;
    Point<Sonar> centre;
    for (const int i : tracked.detections) {
      const Detection& piece = ping.detections[static_cast<std::size_t>(i)];
      volume += piece.volume_m3;
      centre = centre + piece.centre * piece.volume_m3;
    }
    if (volume > 0.0) centre = centre * (1.0 / volume);
    const Point<Enu> place = frames_[p].to_world(volume > 0.0 ? centre : d.centre);
    track.motion.update(place, spread(p, d, true));
    track.alone_at = place;
    track.alone_ping = p;
    track.volume_m3 = volume;
    track.reference_db = d.reference_db;
    track.last_ping = p;
    track.merged = false;
    ++track.own_pings;
    track.shape = turned(d.covariance, frames_[p].heading_rad());
    track.pings.push_back(std::move(tracked));
  }

  void begin(std::size_t p, int detection) {
    const Detection& d = pings_[p].detections[static_cast<std::size_t>(detection)];
    OpenTrack track{next_number_++,
                    Motion(frames_[p].to_world(d.centre), spread(p, d, true), params_.initial_speed_mps),
                    {{pings_[p].ping_index, {detection}, {}}},
                    p,
                    d.volume_m3,
                    d.reference_db,
                    0,
                    false,
                    1,
                    turned(d.covariance, frames_[p].heading_rad()),
                    std::nullopt,
                    frames_[p].to_world(d.centre),
                    p};
    open_.push_back(std::move(track));
    events_.push_back({TrackEventKind::birth, pings_[p].ping_index, open_.back().number, -1});
  }

  std::span<const DetectedPing> pings_;
  const Sector& sector_;
  std::span<const int> channel_;
  const TrackParams& params_;
  std::vector<PingFrame> frames_;
  std::vector<OpenTrack> open_;
  std::vector<OpenTrack> closed_;
  std::vector<RawEvent> events_;
  int next_number_ = 0;
};

}  // namespace

Tracks track(std::span<const DetectedPing> pings, const Sector& sector, std::span<const int> channel,
             const TrackParams& params) {
  if (pings.empty()) return {};
  return Tracker(pings, sector, channel, params).run();
}

}  // namespace sonar
