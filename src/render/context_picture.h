// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "base/work.h"
#include "render/volume_renderer.h"
#include "view/image.h"
#include "view/volume/camera.h"
#include "view/volume/context_scene.h"
#include "view/volume/depth_cue.h"

namespace sonar {

/// A context scene as seen by a camera, in two layers: the volume's rays are drawn over `behind`, `front` over both.
struct ContextPicture {
  Image behind;  ///< background, opaque things, lines; the translucent ones too where the eye is below the sea surface
  Image front;   ///< straight alpha: what lies before the volume, faint lines among it
  std::shared_ptr<const std::vector<float>> opaque_m;  ///< VolumeView::opaque_m; null where nothing is opaque
};

/// Draws a scene by the processor, the same for both back-ends. Edges are smoothed (2 x 2 samples a pixel), and lines
/// fade into the background as `cue` says.
/// surface_z_m  of the sea surface: which layer translucent things go to depends on the eye's side of it
[[nodiscard]] ContextPicture draw_context(const ContextScene& scene, const Camera& camera, PixelSize size,
                                          const DepthCue& cue, double surface_z_m, Work& work);

/// `top` over `below`, straight alpha; sizes must agree.
[[nodiscard]] Image over(const Image& top, const Image& below);

/// The volume's rays between the two layers, over(front, over(rays, behind)); sizes must agree.
[[nodiscard]] Image between(const ContextPicture& context, const RayImage& rays, Work& work);

}  // namespace sonar
