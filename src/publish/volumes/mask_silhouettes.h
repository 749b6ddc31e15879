// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "render/volume_renderer.h"
#include "view/image.h"
#include "view/theme.h"

namespace sonar {

/// Whose mask each pixel shows, the nearest one's where they lie behind one another: [height][width], 0 = none, else the
/// mask's place in the list, from 1.
struct MaskSilhouettes {
  std::vector<std::uint8_t> fuzzy;  ///< all of the masks that the style shows
  std::vector<std::uint8_t> core;
};

/// The renderer has its volume and transfer function; its masks are changed. Two pictures, however many masks.
/// view     camera, size, thresholds and opaque things count
/// divisor  of the rays, as DrawQuality: above 1 the silhouettes are nearly as large as they should be, and cheap
/// errors  as VolumeRenderer::draw()
[[nodiscard]] Result<MaskSilhouettes> mask_silhouettes(VolumeRenderer& renderer, std::span<const MaskLayer> masks,
                                                       const VolumeView& view, Work& work, int divisor = 1);

/// Draws silhouettes as lines in their schools' colours: a whole one with a rim round the fuzzy area, a broken one
/// round the core; the selected school's are wider by half. Inside, the rays keep their colours, so that Sv can be read
/// off the colour bar. A core lies in data of any colour: its line has a rim of the theme's text outside and one of its
/// background inside, of which one stands out.
void lay_outlines(RayImage& rays, std::span<const MaskLayer> masks, const MaskSilhouettes& silhouettes, int line_px,
                  const Theme& theme);

}  // namespace sonar
