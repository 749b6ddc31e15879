// SPDX-License-Identifier: Apache-2.0
#include "school/steady_masks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/median.h"
#include "model/school.h"
#include "school/judge/confirmation.h"
#include "school/mask_shape.h"
#include "school/motion.h"
#include "school/runs.h"

namespace sonar {
namespace {

constexpr std::size_t kSide = 3;       ///< sights before and behind that are asked
constexpr double kMostApart_s = 30.0;  ///< a school keeps its shape so long
constexpr std::size_t kShare = 3;      ///< one in so many of them holds what stays
constexpr int kTogether = 4;           ///< samples that are asked about together
constexpr std::size_t kPace = 3;       ///< sights between which a velocity is told

struct Sight {
  PingMask mask;
  std::vector<int> rows;  ///< index_rows() of the mask
  PingFrame frame;
  double time_s = 0.0;
  Point<Enu> centre;
  bool cut = false;  ///< by the sector's borders: its centre goes partly with the ship
};

std::vector<Sight> sights_of(const SchoolTrack& school, std::span<const DetectedPing> pings, const Sector& sector) {
  std::vector<Sight> sights;
  const auto rows = static_cast<std::size_t>(sector.fans()) * static_cast<std::size_t>(sector.beams());
  for (const TrackedDetection& seen : school.pings) {
    const DetectedPing& ping = *ping_of(pings, seen.ping_index);
    PingMask mask = mask_of(seen, ping);
    const PingFrame frame(ping.placement, pings.front().placement.transducer);
    const Point<Enu> centre = frame.to_world(shape_of(mask, sector).centre);
    const auto since = static_cast<double>(ping.time - pings.front().time) / static_cast<double>(kSecondNs);
    std::vector<int> index = index_rows(mask.runs, rows);
    const bool cut = std::ranges::any_of(seen.detections, [&](int d) {
      return (ping.detections[static_cast<std::size_t>(d)].edge_flags & kCutsCentre) != 0;
    });
    sights.push_back({std::move(mask), std::move(index), frame, since, centre, cut});
  }
  return sights;
}

/// Median over whole sights, so that masks that hold too much do not tell it; none where there are too few.
std::optional<Point<Enu>> velocity_mps(std::span<const Sight> sights) {
  std::vector<double> east;
  std::vector<double> north;
  std::vector<double> up;
  for (std::size_t i = kPace; i < sights.size(); ++i) {
    const double took_s = sights[i].time_s - sights[i - kPace].time_s;
    if (!(took_s > 0.0) || sights[i].cut || sights[i - kPace].cut) continue;
    const Point<Enu> way = sights[i].centre - sights[i - kPace].centre;
    east.push_back(way.x / took_s);
    north.push_back(way.y / took_s);
    up.push_back(way.z / took_s);
  }
  if (east.empty()) return std::nullopt;
  return Point<Enu>{middle_of(std::move(east)), middle_of(std::move(north)), middle_of(std::move(up))};
}

bool holds(const Sight& sight, const Sector& sector, const SectorIndex& index) {
  const auto row = static_cast<std::size_t>(std::lround(index.fan) * sector.beams() + std::lround(index.beam));
  const auto sample = static_cast<std::int32_t>(std::lround(index.sample));
  if (row + 1 >= sight.rows.size()) return false;
  const auto first = sight.mask.runs.begin() + sight.rows[row];
  const auto end = sight.mask.runs.begin() + sight.rows[row + 1];
  return std::any_of(first, end, [&](const Run& run) { return sample >= run.first_sample && sample < run.end(); });
}

/// The sights near one, nearest first.
std::vector<const Sight*> others_of(std::span<const Sight> sights, std::size_t at) {
  std::vector<const Sight*> others;
  for (std::size_t d = 1; d <= kSide; ++d) {
    if (at >= d) others.push_back(&sights[at - d]);
    if (at + d < sights.size()) others.push_back(&sights[at + d]);
  }
  std::erase_if(others, [&](const Sight* other) { return std::abs(other->time_s - sights[at].time_s) > kMostApart_s; });
  return others;
}

/// Whether enough of the others, of those that can see the place, hold it.
bool stays(const Sight& here, std::span<const Sight* const> others, const Point<Enu>& place, const Point<Enu>& velocity,
           const Sector& sector) {
  std::size_t able = 0;
  std::size_t holding = 0;
  for (const Sight* other : others) {
    const Point<Enu> then = place + velocity * (other->time_s - here.time_s);
    const SectorIndex index = sector.index_of(other->frame.from_world(then));
    if (!sector.contains(index)) continue;
    ++able;
    if (holds(*other, sector, index)) ++holding;
  }
  return kShare * holding >= able;
}

PingMask steadied(const Sight& here, std::span<const Sight* const> others, const Point<Enu>& velocity,
                  const Sector& sector) {
  PingMask kept;
  auto confidence = here.mask.confidence.begin();
  for (const Run& run : here.mask.runs) {
    const Point<Sonar> beam =
        Sector::direction(sector.elevation_rad(run.row / sector.beams()), sector.azimuth_rad(run.row % sector.beams()));
    for (int first = run.first_sample; first < run.end(); first += kTogether) {
      const int count = std::min(kTogether, run.end() - first);
      const Point<Enu> place = here.frame.to_world(beam * sector.range().range_m(first + (count - 1) / 2.0));
      if (stays(here, others, place, velocity, sector)) {
        if (kept.runs.empty() || kept.runs.back().row != run.row || kept.runs.back().end() != first) {
          kept.runs.push_back({run.row, first, 0});
        }
        kept.runs.back().count += count;
        kept.confidence.insert(kept.confidence.end(), confidence, confidence + count);
      }
      confidence += count;
    }
  }
  return kept;
}

}  // namespace

void steady_masks(SchoolTrack& school, std::span<const DetectedPing> pings, const Sector& sector) {
  const std::vector<Sight> sights = sights_of(school, pings, sector);
  const auto velocity = velocity_mps(sights);
  if (!velocity) return;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const std::vector<const Sight*> others = others_of(sights, i);
    if (others.size() < 2) continue;
    PingMask kept = steadied(sights[i], others, *velocity, sector);
    if (!kept.empty()) school.pings[i].part = std::move(kept);
  }
}

}  // namespace sonar
