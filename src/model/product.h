// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "model/beam_grid.h"
#include "model/mask.h"
#include "model/navigation.h"
#include "model/refused_echo.h"
#include "model/school.h"

namespace sonar {

inline constexpr int kProductVersion = 2;
inline constexpr int kOldestProductVersion = 1;  ///< that is read

/// A raw file that a product came from.
struct InputFile {
  std::string name;  ///< file name without folder
  std::uint64_t size = 0;
  std::string hash;  ///< hexadecimal XXH3-128 of all its bytes
  friend bool operator==(const InputFile&, const InputFile&) = default;
};

/// What the grid's samples are, for turning (channel, sample) back into places without the raw files.
struct GridRecord {
  BeamGrid grid;
  std::vector<std::int32_t> sample_count;  ///< [fan]
  RangeAxis range;                         ///< first_m unclamped, may be negative
  double sound_speed_mps = 0.0;
  std::vector<double> psi_used_db;  ///< [fan][beam], what Sv was worked out with; empty = not told
};

/// One mask in the product's table.
struct SchoolMask {
  std::int64_t school_id = 0;
  std::int64_t ping_index = 0;
  PingMask mask;  ///< rows = fan * beams + beam of the grid; the file stores channels
  /// For each voxel of the mask, in its order: a faulty sample, which takes no part in Sv. Empty = not known: older
  /// products, and truths, which know of no faults.
  std::vector<bool> fault = {};
};

/// Everything known about one observation; one self-contained netCDF file (INTERFACES section 4).
struct ObservationProduct {
  std::string observation;      ///< display name, "obs-0001"
  std::string program_version;  ///< sonar_explorer_version
  std::string title;            ///< carries SYNTHETIC where the survey's name does
  std::string source;           ///< sounder name and version
  std::string history;          ///< how it was made; no dates
  std::string recipe_json;
  std::string recipe_hash;
  std::string stage_versions;  ///< "median 1, detect 1, ..."
  std::string input_hash;      ///< key of (input, recipe, stage versions, journal lines): equal key, equal product
  std::vector<InputFile> input_files;
  std::vector<PingNavigation> pings;
  /// [ping][row of the grid], dB re 1 W: background level that was subtracted; NaN = none. Empty, or one entry a ping
  /// (itself empty where the ping has none). With it every number can be recomputed from the raw files.
  std::vector<std::vector<float>> background_db;
  std::optional<GridRecord> grid;  ///< empty where the beams make no product grid
  std::vector<SchoolRow> schools;
  std::vector<SchoolPingRow> school_pings;  ///< sorted by school_id, ping_index
  std::vector<SchoolMask> masks;            ///< sorted by school_id, ping_index
  std::vector<RefusedEcho> rejected;        ///< sorted by ping_index, channel, sample; older products tell none
  Diagnostics diagnostics;
  /// Above every number that a school of these pings ever had; 0 = only those that are here.
  std::int64_t next_school_id = 0;
  /// Time of the ping before, where the observation was begun only because that one's reached observation_max_s; 0 = it
  /// was not.
  TimeNs cut_after = 0;
};

/// A copy without voxels: its masks and background levels are empty. They are most of it, and never copied.
[[nodiscard]] inline ObservationProduct without_voxels(const ObservationProduct& product) {
  // One more member does not compile until it is named here.
  const auto& [observation, program_version, title, source, history, recipe_json, recipe_hash, stage_versions,
               input_hash, input_files, pings, background_db, grid, schools, school_pings, masks, rejected, diagnostics,
               next_school, cut_after] = product;
  return {observation, program_version, title,       source,   history, recipe_json, recipe_hash,  stage_versions,
          input_hash,  input_files,     pings,       {},       grid,    schools,     school_pings, {},
          rejected,    diagnostics,     next_school, cut_after};
}

/// The number that the next new school of the product gets.
[[nodiscard]] inline std::int64_t next_school_id(const ObservationProduct& product) {
  std::int64_t next = product.next_school_id > 1 ? product.next_school_id : 1;
  for (const SchoolRow& school : product.schools) {
    if (school.school_id >= next) next = school.school_id + 1;
  }
  return next;
}

}  // namespace sonar
