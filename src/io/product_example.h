// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "geo/geodesic.h"
#include "io/product_seal.h"
#include "model/product.h"

namespace sonar::example {

// Small hand-made products for tests: a ship sails north at 3 m/s from a given place, a sector of 3 fans x 4 beams with
// 60 samples of 2 m looks to port.

inline constexpr int kFans = 3;
inline constexpr int kBeams = 4;
inline constexpr int kSamples = 60;
inline constexpr TimeNs kStart = 1'700'000'000'123'456'700;
inline constexpr double kPingSeconds = 2.0;
inline constexpr double kShip_mps = 3.0;

/// Seals a file as it is now.
inline bool append_seal(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(bytes)));
  std::ofstream out(path, std::ios::binary | std::ios::app);
  out << seal_text(to_hex(hasher.value()));
  out.close();
  return !out.fail();
}

inline GridRecord grid() {
  GridRecord record;
  record.grid.elevation_deg = {-25.0, -15.0, -5.0};
  record.grid.azimuth_deg = {262.5, 267.5, 272.5, 277.5};
  record.grid.frequency_hz = {75'000.0, 90'000.0, 110'000.0};
  // Channels count downwards, so that a mix-up of row and channel shows.
  for (int row = 0; row < kFans * kBeams; ++row) record.grid.channel.push_back(kFans * kBeams - 1 - row);
  record.grid.vertical_width_deg.assign(12, 10.0);
  record.grid.horizontal_width_deg.assign(12, 5.0);
  for (int row = 0; row < kFans * kBeams; ++row) {
    record.grid.psi_stated_db.push_back(-20.0 + 0.1 * row);
    record.psi_used_db.push_back(-21.0 + 0.2 * row);
  }
  record.sample_count = {60, 60, 58};
  record.range = {-1.0, 2.0, kSamples};
  record.sound_speed_mps = 1490.0;
  return record;
}

/// A block of beams and samples in one fan, confidence `q` throughout.
inline PingMask block(int fan, int first_beam, int beams, int first_sample, int samples, std::uint8_t q = 255) {
  PingMask mask;
  for (int b = first_beam; b < first_beam + beams; ++b) mask.runs.push_back({fan * kBeams + b, first_sample, samples});
  mask.confidence.assign(static_cast<std::size_t>(beams * samples), q);
  return mask;
}

inline ObservationProduct empty(std::string name, int pings, Geographic start = {60.0, 5.0}, TimeNs first = kStart) {
  ObservationProduct p;
  p.observation = std::move(name);
  p.program_version = "0.1.0";
  p.title = "SYNTHETIC example";
  p.source = "MS70";
  p.history = "made by hand";
  p.recipe_json = "{\"recipe_version\":1}";
  p.recipe_hash = "00ff";
  p.stage_versions = "median 1";
  p.input_hash = "abc" + p.observation;
  p.input_files = {{"a file.raw", 12345, "0123"}};
  p.grid = grid();
  for (int i = 0; i < pings; ++i) {
    PingNavigation n;
    n.time = first + static_cast<TimeNs>(i * kPingSeconds * 1e9);
    n.transducer = destination(start, i * kPingSeconds * kShip_mps, 0.0);
    n.heading_deg = 0.0;
    n.speed_mps = kShip_mps;
    n.course_deg = 0.0;
    n.transducer_depth_m = 7.0;
    p.pings.push_back(n);
  }
  return p;
}

/// Adds a school that fills the same block in pings first .. last; its row stands 60 m to port.
inline void add_school(ObservationProduct& p, std::int64_t id, int first, int last, const PingMask& mask) {
  SchoolRow school;
  school.observation = p.observation;
  school.school_id = id;
  for (int i = first; i <= last; ++i) {
    const PingNavigation& n = p.pings[static_cast<std::size_t>(i)];
    SchoolPingRow row;
    row.observation = p.observation;
    row.school_id = id;
    row.ping_index = i;
    row.time_utc = n.time;
    const Geographic at = destination(n.transducer, 60.0, 270.0);
    row.latitude = at.latitude_deg;
    row.longitude = at.longitude_deg;
    row.depth_m = 20.0;
    row.range_m = 60.0;
    row.n_voxels = static_cast<std::int64_t>(mask.voxels());
    row.volume_m3 = 1000.0;
    row.volume_corrected_m3 = 500.0;
    row.sv_mean_db = -45.0;
    row.backscatter_m2 = 0.0316;
    p.school_pings.push_back(row);
    p.masks.push_back({id, i, mask});
  }
  school.n_pings = last - first + 1;
  school.n_pings_whole = school.n_pings;
  school.first_time_utc = p.pings[static_cast<std::size_t>(first)].time;
  school.last_time_utc = p.pings[static_cast<std::size_t>(last)].time;
  school.latitude = p.school_pings.back().latitude;
  school.longitude = p.school_pings.back().longitude;
  school.depth_m = 20.0;
  school.volume_m3 = 1000.0;
  school.sv_mean_db = -45.0;
  school.backscatter_m2 = 0.0316;
  school.comment = "a \"quoted\", comma";
  p.schools.push_back(school);
}

}  // namespace sonar::example
