// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "render/ray_rules.h"
#include "render/transfer_table.h"
#include "render/volume_renderer.h"

namespace sonar {

// What the vector kernel reads: plain pointers and floats, made by CpuRenderer. Internal to this folder.

/// An AngleTable in one word an entry: index in 20 bits, step to the next entry in 12.
struct PackedAngle {
  const std::uint32_t* words = nullptr;  ///< [kAngleEntries]
  float first = 0.0F;
  float per_unit = 1.0F;
  float index_per_value = 1.0F;
  float index_per_slope = 1.0F;
};

/// Even angles within 45 degrees of the fan frame's axis: a polynomial is cheaper than the look at a table.
struct EvenAngle {
  float first_rad = 0.0F;
  float per_rad = 1.0F;
  float last = 1.0F;  ///< index
};

/// A macrocell: bits 0-7 distance to the next cell set (0 = set), then flags; bits 16-31 largest count.
inline constexpr std::int32_t kCellDistance = 0xFF;
inline constexpr int kThinBit = 8;
inline constexpr int kGapsBit = 9;
inline constexpr int kMaskBit = 10;
inline constexpr int kEmptyBit = 11;  ///< distance above 0

struct TraceGrid {  // NOLINT(cppcoreguidelines-pro-type-member-init): filled in whole
  int fans, beams, samples;
  int cell_beams, cell_ranges;
  float first_m, spacing_m, per_spacing, nearest_m, farthest_m, surface_z_m;
  float sin_side, cos_side;  ///< of the half width
  float sin_e0, cos_e0, sin_e1, cos_e1;
  bool wide;  ///< azimuths beyond 90 degrees from the middle
  PackedAngle beam_of, fan_of;
  bool even_beams, even_fans;
  EvenAngle even_beam, even_fan;
  const float* azimuth_sines;  ///< [beam] sine and cosine
  const float *sin2_elevation, *beams_per_rad, *fans_per_rad;
  float least_beam_rad, least_fan_rad;
  const std::int16_t* sv;
  const std::int16_t* columns;  ///< see lay_columns(); null where they are not read
  const std::uint8_t* known;    ///< null where all is known; 2 bytes longer than the volume
  const std::uint16_t* masks;   ///< null without masks
};

struct TraceOptics {
  float per_count, first, last_entry;
  const float* entries;  ///< [entry] extinction and, in the bits of a float, rgb10: TableEntry
};

/// A macrocell's four columns of `count` + 1 samples, with what is known of them or null.
struct CellColumns {
  const std::int16_t* sv[4];
  const std::uint8_t* known[4];
  int count;
};

[[nodiscard]] inline TraceOptics trace_optics(const TransferTable& table) {
  static_assert(sizeof(TableEntry) == 2 * sizeof(float));
  return {table.per_count, table.first, static_cast<float>(table.size() - 1),
          reinterpret_cast<const float*>(table.entries.data())};
}

struct TraceView {  // NOLINT(cppcoreguidelines-pro-type-member-init): filled in whole
  // In the fan frame; eye, right, up, forward, towards the light.
  std::array<float, 3> eye, right, up, forward, light;
  float pixel_scale;  ///< tan(half fov) / half height
  PixelSize full, size;
  std::array<float, 2> shift;  ///< pixel_shift()
  int divisor;
  float step_m;
  std::uint32_t samples_frame;  ///< of sample_phase()
  RayMode mode;
  bool data, plain, masked;
  float first_hit_count;
  Lighting lighting;
  std::array<std::array<float, 3>, kSkyRays> sky;  ///< sky_rays()
  float palest, nearest_m, per_m;                  ///< DepthCue; palest = 0 where it is off
  std::array<float, 3> ground;                     ///< 0..1
  float fuzzy_at, core_at;                         ///< 0..255
  float fuzzy_opacity, core_extinction;
  const std::array<float, 3>* mask_rgb;
  int masks;
  const float* opaque_m;
};

struct TraceJob {  // NOLINT(cppcoreguidelines-pro-type-member-init): filled in whole
  TraceGrid grid;
  TraceOptics optics;
  TraceView view;
  const std::int32_t* cells;
  const std::array<float, 4>* means;  ///< [cell]; null where no cell is thin
};

/// Traces the pixels [x0, x1) x [y0, y1) of the divided picture.
void trace_tile(const TraceJob& job, int x0, int y0, int x1, int y1, std::array<float, 4>* rgba, RayCounts& counts);
/// Whether TraceGrid::columns are of use to the instruction set in use.
[[nodiscard]] bool trace_reads_columns();
/// Name of the instruction set in use.
[[nodiscard]] const char* trace_target();

}  // namespace sonar
