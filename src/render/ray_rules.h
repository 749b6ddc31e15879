// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/array.h"
#include "view/volume/volume_scene.h"

namespace sonar {

// What every back-end does alike, so that all draw the same picture.
//
// Steps. A ray's parameter t is metres from its point nearest to the transducer. Intervals are [k h, (k + 1) h] with
// h = step_samples x spacing_m, cut at the sector's faces; the sample stands at the fraction `phase` of its interval and
// counts for the interval's length. Nearer than where half the narrowest beam spacing is below h, h is shortened to that,
// to h / 8 at least. Where a ray runs along the beams (|dr/dt| above kAlongBeams) h is halved: it meets every range sample
// just once, and speckle, white along range, would show as wood grain.
// Thin cells. A cell of little optical depth is one segment with the means of its samples, but not along the beams: there a ray
// goes through hundreds of them in one row, and is short of what they vary by across it hundreds of times.
// Masks. A voxel of several schools is that one's whose confidence there is largest, as in slices and on maps: a fish is
// of one school. Confidence of a layer = interpolated over its own voxels; of layers met in one sample the lowest number
// lies in front. Where a layer first reaches fuzzy_above (half a
// quantum at least) its surface is laid over what lies behind, with fuzzy_opacity, once a ray and layer; where it
// reaches core_at, core_extinction_per_m is added to the data's extinction, colours weighted by extinction. Both places are
// looked for between samples (kMaskHalvings times the half), so that a mask does not hang on where these stand. A surface's
// slope is that half a step behind it, if the mask is so deep: at the very edge it is that of a voxel's face.
// Surfaces (first hit; volume and surface). The ray ends with opacity 1 where the level is crossed, colour of that level; what
// accumulates up to the start of that interval lies before it. Maximum. Colour of the largest Sv behind the masks'
// light; the peak is looked for between samples, at h / 2, h / 4 ... to both sides, kClimbs times.
// Ambient light on surfaces. Comes from the half space before the surface, less where something stands in it: of kSkyRays
// rays from the place, each of equal share under the cosine law, one whose Sv first reaches the level at the distance d
// brings d / occlusion_m of its light (kSkySteps steps, linear in between). Outside the sector and where Sv is not known
// water is open. Zhukov, Iones and Kronin, An ambient light illumination model, Rendering Techniques 1998 (obscurances).
// Depth. With a cue, a colour laid at a depth is mixed with cue.pale(depth) of the background; its opacity stays.

inline constexpr double kOpaqueEnough = 0.99;
inline constexpr float kAlongBeams = 0.9F;
inline constexpr float kFaceIndex = 2e-3F;  ///< within so much of an index of the sector's face is outside

/// Column or row of the full picture whose ray stands for pixel i of a picture divided by `divisor`.
[[nodiscard]] int full_pixel(int i, int divisor, int count);
/// Size of the divided picture.
[[nodiscard]] PixelSize divided(PixelSize size, int divisor);

/// Where in its interval a ray's samples stand, 0..1: 0.5 for frame 0; else
/// fract(fract(52.9829189 fract(0.06711056 x + 0.00583715 y)) + 0.61803399 frame), x, y of the full picture.
[[nodiscard]] double sample_phase(int x, int y, std::uint32_t jitter_frame);

/// Whether a series of frames moves the samples along the rays: where data add up from sample to sample, which shows
/// in stripes else. A first hit, a maximum and masks are found between the samples anyway; moved, they only differ from frame
/// to frame where a sample meets noise: 38 dB instead of 99 against sixteen rays a pixel, and no nearer to finer steps.
/// data  MaskStyle::data_too
[[nodiscard]] constexpr bool moves_samples(RayMode mode, bool data) { return accumulates(mode) && data; }

/// Where in its pixel a frame's rays stand, off the middle, -0.5..0.5 in x and y; (0, 0) for frame 0. The same for all
/// pixels. Sixteen frames stand in the middles of a pixel's 4 x 4 parts: their mean is the picture of sixteen rays a pixel
/// that is four times as large, reduced. Each second one is the mirror image of the one before. The next sixteen stand
/// elsewhere in these parts (Halton's sequence to the bases 3 and 5, which never lies on an edge).
[[nodiscard]] PixelPoint pixel_shift(std::uint32_t jitter_frame);

inline constexpr int kClimbs = 3;
inline constexpr int kMaskHalvings = 8;
inline constexpr int kSkyRays = 8;
inline constexpr int kSkySteps = 8;
/// Directions in which a frame looks whether ambient light comes: (first tangent, second tangent, normal). Two rings of
/// four rays, each of half the light; turned and tilted from frame to frame.
[[nodiscard]] std::array<std::array<float, 3>, kSkyRays> sky_rays(std::uint32_t jitter_frame);

/// Unit vector towards the light: behind the eye, from its upper left.
[[nodiscard]] Point<Sonar> light_direction(const CameraBasis& camera);

/// Colour under light. n = -gradient / |gradient|, w = min(1, |gradient| / full_gradient), half = unit(light - ray):
///   rgb (1 - w + w (ambient sky + diffuse max(0, n light))) + w specular max(0, n half)^16
/// ray  direction of the ray, away from the eye
/// sky  share of the ambient light that comes, 0..1
[[nodiscard]] std::array<double, 3> lit(const std::array<double, 3>& rgb, const Point<Sonar>& gradient_db_per_m,
                                        const Point<Sonar>& light, const Point<Sonar>& ray, const Lighting& lighting,
                                        double sky = 1.0);

/// errors  bad_parameter: no sample, or fewer than 2 fans, beams or samples; sector and array of different shape
[[nodiscard]] Result<void> check_volume(const VolumeData& volume);
/// errors  bad_parameter: see VolumeRenderer::set_transfer
[[nodiscard]] Result<void> check_transfer(const OpticalTable& table);
/// errors  bad_parameter: empty size, over 16384 a side, a divisor below 1, a step not above 0, opaque_m of another
///         size, a camera that is not finite
[[nodiscard]] Result<void> check_view(const VolumeView& view, const DrawQuality& quality);

}  // namespace sonar
