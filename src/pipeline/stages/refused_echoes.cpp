// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/refused_echoes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <tuple>

#include "geo/geodesic.h"
#include "school/detect/detect_params.h"
#include "school/judge/confirmation.h"

namespace sonar {
namespace {

RefusedEcho row_of(const Engine& engine, std::int64_t ping_index, const Detection& echo, const Reason& reason) {
  RefusedEcho row;
  row.ping_index = ping_index;
  const Run& loudest = echo.loudest;
  row.channel = engine.grid().channel[static_cast<std::size_t>(loudest.row)];
  row.sample = loudest.first_sample;
  const Placement placement = engine.placement(ping_index);
  const Point<Sonar> centre = levelled(echo.centre, placement);
  const Geographic where = to_geographic(to_enu(centre, placement.heading_rad), placement.transducer);
  row.latitude = where.latitude_deg;
  row.longitude = where.longitude_deg;
  row.depth_m = placement.transducer_depth_m + centre.z;
  row.range_m = norm(echo.centre);
  row.n_beams = echo.box.beams();
  row.n_fans = echo.box.fans();
  row.range_extent_m = echo.box.samples() * engine.sector().range().spacing_m;
  row.volume_m3 = echo.volume_m3;
  row.level_db = echo.reference_db;
  row.above_water = echo.evidence;
  row.judge = reason.judge;
  row.figure = reason.figure;
  row.limit = reason.limit;
  row.limit_unit = reason.unit;
  return row;
}

/// Whether a human may miss it: one sighting is clear, or the sightings together have half of what is asked. Water alone shows
/// fainter ones everywhere.
bool is_above_background(const RefusedTrack& track, std::span<const DetectedPing> pings, double clear) {
  const Reason& reason = track.reason;
  if (reason.judge == "confirmation" && reason.unit == kAllSightings && 2.0 * reason.figure >= reason.limit)
    return true;
  return std::ranges::any_of(track.pings, [&](const TrackedDetection& seen) {
    const std::vector<Detection>& found = ping_of(pings, seen.ping_index)->detections;
    return std::ranges::any_of(seen.detections,
                               [&](int d) { return found[static_cast<std::size_t>(d)].evidence >= clear; });
  });
}

}  // namespace

std::vector<RefusedEcho> refused_echoes(const Engine& engine, std::span<const DetectedPing> pings,
                                        const Tracks& tracks) {
  std::vector<RefusedEcho> rows;
  std::int64_t id = 0;
  for (const DetectedPing& ping : pings) {
    for (const RefusedDetection& refused : ping.refused) {
      rows.push_back(row_of(engine, ping.ping_index, refused.detection, refused.reason));
      rows.back().echo_id = --id;
    }
  }
  const double clear = clear_evidence(engine.recipe().detect);
  for (const RefusedTrack& track : tracks.refused) {
    if (!is_above_background(track, pings, clear)) continue;
    --id;
    for (const TrackedDetection& seen : track.pings) {
      const DetectedPing& ping = *ping_of(pings, seen.ping_index);
      const Detection& echo = ping.detections[static_cast<std::size_t>(seen.detections.front())];
      rows.push_back(row_of(engine, seen.ping_index, echo, track.reason));
      rows.back().echo_id = id;
    }
  }
  std::ranges::sort(rows, {}, [](const RefusedEcho& r) { return std::tuple(r.ping_index, r.channel, r.sample); });
  std::map<std::int64_t, std::int64_t> number;  // in the order in which they are met
  for (RefusedEcho& row : rows) {
    row.echo_id = number.try_emplace(row.echo_id, static_cast<std::int64_t>(number.size()) + 1).first->second;
  }
  return rows;
}

std::vector<RefusedEcho> still_refused(std::vector<RefusedEcho> rows, const JournalState& state, const BeamGrid& grid) {
  const std::vector<int> row_of_channel = grid.row_of_channel();
  std::set<std::int64_t> taken_in;
  for (const auto& school : state.schools) {
    for (const SchoolMasks::InPing& there : school->masks.pings) {
      for (const RefusedEcho& echo : std::ranges::equal_range(rows, there.ping_index, {}, &RefusedEcho::ping_index)) {
        if (echo.channel < 0 || echo.channel >= std::ssize(row_of_channel)) continue;
        const int row = row_of_channel[static_cast<std::size_t>(echo.channel)];
        if (confidence_at(there.mask, row, static_cast<int>(echo.sample)) > 0) taken_in.insert(echo.echo_id);
      }
    }
  }
  std::erase_if(rows, [&](const RefusedEcho& echo) { return taken_in.contains(echo.echo_id); });
  return rows;
}

std::vector<std::string> refusal_lines(const ObservationProduct& product) {
  std::vector<std::string> lines;
  for (const RefusedSightings& echo : refused_sightings(product.rejected)) {
    const std::string pings =
        echo.pings == 1 ? fmt::format("ping {}", echo.first_ping)
                        : fmt::format("pings {} to {} ({} of them)", echo.first_ping, echo.last_ping, echo.pings);
    const RefusedEcho& loudest = *echo.loudest;
    lines.push_back(fmt::format("{} {}: {:.0f} m away, {:.0f} m deep, {} fans x {} beams x {:.1f} m, {:.1f} dB: {}",
                                product.observation, pings, loudest.range_m, loudest.depth_m, loudest.n_fans,
                                loudest.n_beams, loudest.range_extent_m, loudest.level_db, why_no_school(loudest)));
  }
  return lines;
}

}  // namespace sonar
