// SPDX-License-Identifier: Apache-2.0
#include "school/second_look.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "school/judge/confirmation.h"
#include "school/judge/size.h"
#include "school/moved_mask.h"
#include "school/settle_members.h"

namespace sonar {
namespace {

constexpr std::ptrdiff_t kBeyond = 5;  ///< pings before and behind
constexpr int kEvery = 8;              ///< samples that one place of a mask stands for

double seconds(TimeNs from, TimeNs to) { return static_cast<double>(to - from) / static_cast<double>(kSecondNs); }

double evidence_at(const WaterLevels& echo, int row, double sample) {
  const auto block = static_cast<std::int32_t>(std::lround(echo.block_at(row, sample)));
  const auto key = [](const EchoCell& cell) { return std::pair(cell.row, cell.block); };
  const auto at = std::ranges::lower_bound(echo.cells, std::pair(row, block), {}, key);
  if (at == echo.cells.end() || at->row != row || at->block != block) return 0.0;
  return static_cast<double>(at->evidence);
}

int row_of(const MovedPoint& place, const Sector& sector) {
  return static_cast<int>(std::lround(place.index.fan)) * sector.beams() +
         static_cast<int>(std::lround(place.index.beam));
}

/// Carries a school's masks from ping to ping.
class Carrier {
 public:
  Carrier(std::span<const DetectedPing> pings, const Sector& sector, const Point<Enu>& velocity_mps)
      : pings_(pings), sector_(sector), velocity_mps_(velocity_mps) {}

  [[nodiscard]] std::vector<MovedPoint> places(const TrackedDetection& seen, std::ptrdiff_t in) const {
    const DetectedPing& ping = *ping_of(pings_, seen.ping_index);
    const DetectedPing& there = pings_[static_cast<std::size_t>(in)];
    const Geographic origin = pings_.front().placement.transducer;
    const Point<Enu> shift = velocity_mps_ * seconds(ping.time, there.time);
    return moved_mask(mask_of(seen, ping), sector_, PingFrame(ping.placement, origin),
                      PingFrame(there.placement, origin), shift, kEvery);
  }

  /// The most where a sight's mask would be in another ping; none outside the sector.
  [[nodiscard]] std::optional<double> evidence(const TrackedDetection& seen, std::ptrdiff_t in) const {
    const std::vector<MovedPoint> expected = places(seen, in);
    if (expected.empty()) return std::nullopt;
    const WaterLevels& water = pings_[static_cast<std::size_t>(in)].water;
    double most = 0.0;
    if (!water.known()) return most;
    for (const MovedPoint& place : expected) {
      most = std::max(most, evidence_at(water, row_of(place, sector_), place.index.sample));
    }
    return most;
  }

 private:
  std::span<const DetectedPing> pings_;
  const Sector& sector_;
  Point<Enu> velocity_mps_;
};

PingMask mask_of_places(std::vector<MovedPoint> places, const Sector& sector) {
  std::vector<Run> runs;
  for (const MovedPoint& place : places) {
    const int middle = static_cast<int>(std::lround(place.index.sample));
    const int first = std::max(0, middle - kEvery / 2);
    const int end = std::min(sector.range().count, middle + kEvery / 2);
    if (first < end) runs.push_back({row_of(place, sector), first, end - first});
  }
  std::sort(runs.begin(), runs.end());
  PingMask mask;
  for (const Run& run : runs) {
    if (mask.runs.empty() || mask.runs.back().row != run.row || mask.runs.back().end() < run.first_sample) {
      mask.runs.push_back(run);
    } else {
      mask.runs.back().count = std::max(mask.runs.back().end(), run.end()) - mask.runs.back().first_sample;
    }
  }
  return mask;
}

}  // namespace

Passage look_again(std::span<const TrackedDetection> school, std::span<const DetectedPing> pings, const Sector& sector,
                   const Point<Enu>& velocity_mps) {
  const Carrier carrier(pings, sector, velocity_mps);
  const auto first = ping_of(pings, school.front().ping_index) - pings.begin();
  const auto last = ping_of(pings, school.back().ping_index) - pings.begin();
  Passage passage;
  std::ptrdiff_t begin = first;
  std::vector<double> before;
  for (; begin > 0 && first - begin < kBeyond; --begin) {
    const auto found = carrier.evidence(school.front(), begin - 1);
    if (!found) break;
    before.push_back(*found);
  }
  passage.first = static_cast<std::size_t>(begin);
  passage.evidence.assign(before.rbegin(), before.rend());
  auto seen = school.begin();
  for (std::ptrdiff_t p = first; p <= last; ++p) {
    const DetectedPing& ping = pings[static_cast<std::size_t>(p)];
    while (seen + 1 != school.end() && (seen + 1)->ping_index <= ping.ping_index) ++seen;
    if (seen->ping_index == ping.ping_index) {
      double most = 0.0;
      for (const int d : seen->detections) most = std::max(most, ping.detections[static_cast<std::size_t>(d)].evidence);
      passage.evidence.push_back(most);
      continue;
    }
    const double behind = carrier.evidence(*seen, p).value_or(0.0);
    passage.evidence.push_back(std::max(behind, carrier.evidence(*(seen + 1), p).value_or(0.0)));
  }
  for (std::ptrdiff_t p = last + 1; p < std::ssize(pings) && p - last <= kBeyond; ++p) {
    const auto found = carrier.evidence(school.back(), p);
    if (!found) break;
    passage.evidence.push_back(*found);
  }
  return passage;
}

std::vector<ExpectedSight> expected_sights(const SchoolTrack& school, std::span<const DetectedPing> pings,
                                           const Sector& sector) {
  const Carrier carrier(pings, sector, school.velocity_mps);
  const Passage passage = look_again(school.pings, pings, sector, school.velocity_mps);
  const std::span<const double> evidence = passage.evidence;
  const auto position = [&](const TrackedDetection& seen) { return ping_of(pings, seen.ping_index) - pings.begin(); };
  const auto begin = static_cast<std::ptrdiff_t>(passage.first);
  std::ptrdiff_t first = position(school.pings.front());
  std::ptrdiff_t last = position(school.pings.back());
  while (first > begin && evidence[static_cast<std::size_t>(first - 1 - begin)] > 0.0) --first;
  while (last + 1 < begin + std::ssize(evidence) && evidence[static_cast<std::size_t>(last + 1 - begin)] > 0.0) ++last;
  std::vector<ExpectedSight> expected;
  auto behind = school.pings.begin();  // the last sight that is no later
  for (std::ptrdiff_t p = first; p <= last; ++p) {
    const double here = evidence[static_cast<std::size_t>(p - begin)];
    while (behind + 1 != school.pings.end() && position(*(behind + 1)) <= p) ++behind;
    if (position(*behind) == p || here <= 0.0) continue;
    const bool next = behind + 1 != school.pings.end() && p > position(*behind) &&
                      position(*(behind + 1)) - p < p - position(*behind);
    const TrackedDetection& nearest = next ? *(behind + 1) : *behind;
    const DetectedPing& ping = *ping_of(pings, nearest.ping_index);
    const Detection& seen = ping.detections[static_cast<std::size_t>(nearest.detections.front())];
    PingMask place = mask_of_places(carrier.places(nearest, p), sector);
    if (place.empty()) continue;
    expected.push_back({static_cast<std::size_t>(p), std::move(place), seen.reference_db, seen.threshold_db, here});
  }
  return expected;
}

std::optional<Detection> detect_expected(const PingEcho& echo, const ExpectedSight& expected, const PingMask& taken,
                                         const DetectParams& params) {
  MemberSettler settler(echo.sv, echo.unfiltered, echo.flags, echo.background, echo.water, params.tolerance_db,
                        echo.peaked, &taken);
  Array3<std::uint8_t> claimed(echo.sv.shape());
  PingMask mask =
      settler.settle_at(expected.place.runs, expected.reference_db, expected.threshold_db, claimed.view()).mask;
  if (mask.empty()) return std::nullopt;
  Detection detection = describe_mask(std::move(mask), echo.flags, echo.sector);
  if (!(detection.volume_m3 > 0.0) || judge_size(echo, detection, params)) return std::nullopt;
  detection.reference_db = expected.reference_db;
  detection.threshold_db = expected.threshold_db;
  detection.evidence = expected.evidence;
  return detection;
}

}  // namespace sonar
