// SPDX-License-Identifier: Apache-2.0
#include "school/track/looks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/middle.h"
#include "base/units.h"
#include "model/school.h"
#include "school/mask_shape.h"

namespace sonar {
namespace {

constexpr std::size_t kSide = 3;      ///< sightings before and behind that are asked
constexpr double kFade_s = 7.0;       ///< what was seen so long ago counts for 1/e: fish change their places
constexpr double kLeastWeight = 0.5;  ///< of the others together
constexpr std::size_t kPace = 3;      ///< sightings between which a velocity is told
constexpr int kPiece = EchoPieces::kSamples;

/// Of the detections of a sighting one that knows a voxel; null where none does.
const EchoPieces* holding(const Look& look, int fan, int beam, int sample) {
  const auto at = std::ranges::find_if(
      look.pieces, [&](const EchoPieces* pieces) { return pieces->box.contains(fan, beam, sample); });
  return at == look.pieces.end() ? nullptr : *at;
}

struct Heard {
  bool allowed = false;  ///< it may be a school's
  float looks = 0.0F;    ///< 0 = nothing was heard
  float own_sv = 0.0F;
  float water_sv = 0.0F;
};

Heard heard(const Look& look, int fan, int beam, int sample) {
  const EchoPieces* pieces = holding(look, fan, beam, sample);
  if (pieces == nullptr) return {};
  const int f = fan - pieces->box.first_fan;
  const int b = beam - pieces->box.first_beam;
  const int i = pieces->piece(sample);
  const std::int16_t own = pieces->own(f, b, i);
  if (own == kNoData) return {};
  const auto water_sv = static_cast<float>(pieces->water(f, b, i) * pieces->unit_sv);
  if (own == EchoPieces::kUnheard) return {true, 0.0F, 0.0F, water_sv};
  return {true, 1.0F, static_cast<float>(own * pieces->unit_sv), water_sv};
}

IndexBox box_of_pieces(const Look& look) {
  IndexBox box = look.pieces.front()->box;
  for (const EchoPieces* pieces : look.pieces) {
    const IndexBox& other = pieces->box;
    box = {std::min(box.first_fan, other.first_fan),       std::max(box.last_fan, other.last_fan),
           std::min(box.first_beam, other.first_beam),     std::max(box.last_beam, other.last_beam),
           std::min(box.first_sample, other.first_sample), std::max(box.last_sample, other.last_sample)};
  }
  return box;
}

/// Where the school of one sighting is in another. Track and masks both tell it, and both err.
Point<Enu> way_between(const Look& here, const Look& other, const Point<Enu>& velocity) {
  const Point<Enu> by_track = velocity * (other.time_s - here.time_s);
  if (here.cut || other.cut) return by_track;
  return (by_track + (other.centre - here.centre)) * 0.5;
}

/// Where the samples of one beam lie in another sighting. The way there is straight in space and bends in angles the nearer to
/// the sonar the more: a stretch of it is taken for straight.
class Along {
 public:
  Along(const Look& here, const Look& other, const Point<Enu>& way, const Sector& sector, int fan, int beam,
        const IndexBox& box)
      : first_(box.first_sample) {
    const Point<Sonar> axis = Sector::direction(sector.elevation_rad(fan), sector.azimuth_rad(beam));
    const auto then = [&](int sample) {
      return other.frame.from_world(here.frame.to_world(axis * sector.range().range_m(sample)) + way);
    };
    const Point<Sonar> from = then(box.first_sample);
    const Point<Sonar> step = (then(box.last_sample) - from) * (1.0 / std::max(1, box.samples() - 1));
    for (int s = 0; s < box.samples() + kStretch; s += kStretch) nodes_.push_back(sector.index_of(from + step * s));
  }
  [[nodiscard]] SectorIndex at(double sample) const {
    const double place = (sample - first_) / kStretch;
    const auto k = std::min(static_cast<std::size_t>(place), nodes_.size() - 2);
    const double share = place - static_cast<double>(k);
    const SectorIndex& a = nodes_[k];
    const SectorIndex& b = nodes_[k + 1];
    return {a.fan + share * (b.fan - a.fan), a.beam + share * (b.beam - a.beam),
            a.sample + share * (b.sample - a.sample)};
  }

 private:
  static constexpr int kStretch = 48;
  int first_;
  std::vector<SectorIndex> nodes_;
};

double middle_of_piece(const IndexBox& box, int piece) {
  return box.first_sample + piece * kPiece + (kPiece - 1) / 2.0;
}

}  // namespace

std::vector<Look> looks_of(const SchoolTrack& school, std::span<const DetectedPing> pings, const Sector& sector) {
  std::vector<Look> looks;
  for (const TrackedDetection& seen : school.pings) {
    const DetectedPing& ping = *ping_of(pings, seen.ping_index);
    Look look{.mask = mask_of(seen, ping), .frame = PingFrame(ping.placement, pings.front().placement.transducer)};
    look.time_s = static_cast<double>(ping.time - pings.front().time) / static_cast<double>(kSecondNs);
    look.centre = look.frame.to_world(shape_of(look.mask, sector).centre);
    for (const int d : seen.detections) {
      const Detection& detection = ping.detections[static_cast<std::size_t>(d)];
      look.cut = look.cut || (detection.edge_flags & kCutsCentre) != 0;
      if (!detection.pieces->empty()) look.pieces.push_back(&*detection.pieces);
    }
    looks.push_back(std::move(look));
  }
  return looks;
}

std::optional<Point<Enu>> velocity_mps(std::span<const Look> looks) {
  std::vector<double> east;
  std::vector<double> north;
  std::vector<double> up;
  for (std::size_t i = kPace; i < looks.size(); ++i) {
    const double took_s = looks[i].time_s - looks[i - kPace].time_s;
    if (!(took_s > 0.0) || looks[i].cut || looks[i - kPace].cut) continue;
    const Point<Enu> way = looks[i].centre - looks[i - kPace].centre;
    east.push_back(way.x / took_s);
    north.push_back(way.y / took_s);
    up.push_back(way.z / took_s);
  }
  if (east.empty()) return std::nullopt;
  return Point<Enu>{middle_of(std::move(east)), middle_of(std::move(north)), middle_of(std::move(up))};
}

std::vector<Neighbour> neighbours_of(std::span<const Look> looks, std::size_t at) {
  std::vector<Neighbour> neighbours;
  double sum = 0.0;
  const auto add = [&](const Look& look) {
    if (look.pieces.empty()) return;
    neighbours.push_back({&look, std::exp(-std::abs(look.time_s - looks[at].time_s) / kFade_s)});
    sum += neighbours.back().weight;
  };
  for (std::size_t d = 1; d <= kSide; ++d) {
    if (at >= d) add(looks[at - d]);
    if (at + d < looks.size()) add(looks[at + d]);
  }
  return sum < kLeastWeight ? std::vector<Neighbour>{} : neighbours;
}

float MeanEcho::own_at(int fan, int beam, int sample) const {
  if (!box.contains(fan, beam, sample)) return std::numeric_limits<float>::quiet_NaN();
  return own_sv(fan - box.first_fan, beam - box.first_beam, (sample - box.first_sample) / kPiece);
}

MeanEcho mean_echo(const Look& here, std::span<const Neighbour> neighbours, const Point<Enu>& velocity,
                   const Sector& sector) {
  const IndexBox box = box_of_pieces(here);
  const Shape3 shape{box.fans(), box.beams(), (box.samples() + kPiece - 1) / kPiece};
  MeanEcho mean{box, Array3<float>(shape), Array3<float>(shape)};
  Array3<float> weight(shape);
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int i = 0; i < shape.samples; ++i) {
        const Heard one = heard(here, box.first_fan + f, box.first_beam + b, box.first_sample + i * kPiece);
        mean.own_sv(f, b, i) = one.allowed ? one.own_sv : std::numeric_limits<float>::quiet_NaN();
        mean.water_sv(f, b, i) = one.water_sv;
        weight(f, b, i) = one.looks;
      }
    }
  }
  for (const Neighbour& neighbour : neighbours) {
    const Point<Enu> way = way_between(here, *neighbour.look, velocity);
    for (int f = 0; f < shape.fans; ++f) {
      for (int b = 0; b < shape.beams; ++b) {
        const Along along(here, *neighbour.look, way, sector, box.first_fan + f, box.first_beam + b, box);
        for (int i = 0; i < shape.samples; ++i) {
          const SectorIndex then = along.at(middle_of_piece(box, i));
          const Heard one =
              heard(*neighbour.look, nearest_int(then.fan), nearest_int(then.beam), nearest_int(then.sample));
          if (one.looks == 0.0F) continue;
          mean.own_sv(f, b, i) += static_cast<float>(neighbour.weight) * one.own_sv;
          weight(f, b, i) += static_cast<float>(neighbour.weight);
        }
      }
    }
  }
  // what nobody heard is 0 / 0, not known
  for (std::size_t i = 0; i < shape.size(); ++i) mean.own_sv.all()[i] /= weight.all()[i];
  return mean;
}

}  // namespace sonar
