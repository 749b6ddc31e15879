// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/array.h"
#include "base/result.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "model/transfer_function.h"
#include "model/volume.h"
#include "view/volume/camera.h"
#include "view/volume/depth_cue.h"

namespace sonar {

/// One ping as both back-ends and `pick` take it: Sv on the sonar's own grid. The volume drawn reaches from the first
/// to the last beam centre, fan centre and sample centre (ranges below 0 left out) and ends at the sea surface; between
/// centres Sv is interpolated in dB, linear in fractional (fan, beam, sample), piecewise linear in the angles where
/// beams are unevenly spaced.
struct VolumeData {
  Sector sector;
  Array3<std::int16_t> sv;    ///< [fan][beam][sample], Sv counts; kNoData is drawn as "nothing"
  double surface_z_m = -1e9;  ///< sonar z of the sea surface (minus the transducer's depth); above it is nothing
};

/// From a stage's volume: samples with one of `hidden` set become kNoData.
[[nodiscard]] VolumeData volume_data(const Sector& sector, const Volume& volume, SampleFlags hidden,
                                     double transducer_depth_m);

/// Colour and extinction at even steps of Sv, linear in between, constant outside: what both back-ends look up.
struct OpticalTable {
  double first_db = -90.0;
  double last_db = -20.0;
  /// [2..1024] of sRGB colour 0..1 (used as it is, no gamma) and extinction, m^-1
  std::vector<std::array<float, 4>> rgb_extinction;
  friend bool operator==(const OpticalTable&, const OpticalTable&) = default;
};
inline constexpr int kMostTableEntries = 1024;

/// extinction = -ln(1 - opacity) / opacity_length_m; opacity is capped at 0.999.
/// errors  bad_parameter: entries outside 2..1024, dB limits not rising, a table without one visible entry is allowed
[[nodiscard]] Result<OpticalTable> optical_table(const TransferFunction& transfer, int entries, double first_db,
                                                 double last_db);

/// How the samples along a ray become a colour.
enum class RayMode : std::uint8_t {
  accumulate,          ///< emission and absorption, front to back, ended at 99 % opacity
  first_hit,           ///< colour at the first place whose Sv reaches `first_hit_db`, lit where lighting is on
  maximum,             ///< colour of the largest Sv on the ray, opaque where the table's extinction is above 0
  volume_and_surface,  ///< what accumulates before the surface of first_hit, and that surface
};
/// Whether what lies along a ray adds up.
[[nodiscard]] constexpr bool accumulates(RayMode mode) {
  return mode == RayMode::accumulate || mode == RayMode::volume_and_surface;
}
/// Whether a ray ends at the first place that reaches `first_hit_db`.
[[nodiscard]] constexpr bool ends_at_surface(RayMode mode) {
  return mode == RayMode::first_hit || mode == RayMode::volume_and_surface;
}

/// Light from the eye's upper left by the gradient of Sv in metres; weighted by the gradient's strength, so that noise
/// is not lit.
struct Lighting {
  bool on = false;
  float ambient = 0.4F;
  float diffuse = 0.6F;
  float specular = 0.2F;
  float full_gradient_db_per_m = 1.0F;  ///< at and above this the surface is lit in full
  /// Of the surface where rays end: how far off what reaches the surface's Sv keeps ambient light from it, m; 0 = none
  float occlusion_m = 0.0F;
  friend bool operator==(const Lighting&, const Lighting&) = default;
};

/// How an outline is drawn; status_line() says of which school.
enum class OutlineLine : std::uint8_t { solid, dashed, dotted };

/// One school's mask in the ping. Confidence is interpolated like Sv (0 outside the mask).
struct MaskLayer {
  std::shared_ptr<const PingMask> mask;
  std::array<float, 3> rgb{1.0F, 1.0F, 1.0F};
  OutlineLine line = OutlineLine::solid;  ///< of its outline in slices
  bool selected = false;                  ///< its outline in volumes is wider
};

/// What of the masks is shown: the fuzzy area (0 < f < core) as a surface by first hit, translucent; the core
/// (f >= core) by accumulation.
struct MaskStyle {
  float fuzzy_above = 0.0F;     ///< confidence of the fuzzy surface; 0 = half a quantum
  float core_at = 0.64F;        ///< confidence
  float fuzzy_opacity = 0.35F;  ///< of the surface, 0..1
  float core_extinction_per_m = 0.15F;
  bool data_too = true;  ///< false: masks alone
  friend bool operator==(const MaskStyle&, const MaskStyle&) = default;
};

/// Everything a picture of a volume depends on beside volume, table and masks.
struct VolumeView {
  Camera camera;
  PixelSize size{1024, 768};
  RayMode mode = RayMode::accumulate;
  double first_hit_db = -50.0;
  Lighting lighting;
  MaskStyle masks;
  DepthCue cue;  ///< off where nothing is said
  /// [height][width], metres along each pixel's ray where an opaque thing (seabed, ship) ends it; empty = nothing there
  std::shared_ptr<const std::vector<float>> opaque_m;
};

/// How well, and at what cost, to draw.
struct DrawQuality {
  int divisor = 1;                  ///< 1 full resolution, 2 half (drawn small and enlarged by the caller), 4 quarter
  double step_samples = 1.0;        ///< longest step, in range samples (metres = step_samples * spacing_m)
  double homogeneous_limit = 0.03;  ///< optical depth below which a cell is one segment; 0 = never
  /// 0 = rays through the middle of pixels, samples at the middle of steps; n = the n-th jittered frame of a series
  std::uint32_t jitter_frame = 0;
  friend bool operator==(const DrawQuality&, const DrawQuality&) = default;
};

}  // namespace sonar
