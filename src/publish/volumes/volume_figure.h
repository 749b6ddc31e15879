// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/navigation.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/engine.h"
#include "publish/picture_options.h"
#include "render/context_picture.h"
#include "render/volume_renderer.h"
#include "view/axes.h"
#include "view/refused_marks.h"
#include "view/volume/context_scene.h"
#include "view/volume/volume_cut.h"

namespace sonar {

/// One ping made ready for pictures in three dimensions: what files and a live view draw alike.
struct VolumeFigure {
  std::shared_ptr<const VolumeData> volume;
  std::vector<MaskLayer> masks;
  std::vector<std::string> names;                     ///< [mask] beside it in the picture; empty = none
  std::vector<std::pair<Rgba8, std::string>> legend;  ///< of the masks
  PingNavigation navigation;
  std::string title;
  std::string title_line;                                  ///< of the picture; the title with the ping
  bool samples = true;                                     ///< false: the masks alone are known
  std::shared_ptr<const SeabedPatch> seabed{};             ///< drawn where it is given, with a scale of its depths
  bool schools_tracked = false;                            ///< some of `trails` may be schools'
  std::shared_ptr<const std::vector<SceneLine>> trails{};  ///< of ship and schools; null = none
  CurrentColumn currents{};                                ///< below the ship; none = no arrows
  std::shared_ptr<const std::vector<int>> shadow_from{};   ///< as ContextParams has it
  std::optional<FittedSeabed> fitted{};                    ///< of this ping's echoes; drawn where `seabed` is not given
  int fan = 0;                                             ///< of the slice from above
  int beam = 0;                                            ///< of the slice from the side
  bool outlined = false;                                   ///< masks are lines over the data, not a tint
  bool searched = true;                                    ///< schools were looked for
  std::vector<RefusedMark> refused{};                      ///< marked, whatever stands before them
  bool moved = false;                                      ///< as SlicePing has it
  std::string mark{};                                      ///< what nobody may miss, over the volume; empty = nothing

  [[nodiscard]] const Sector& sector() const { return volume->sector; }
};

/// A ping's stages as a volume to draw, without what the options and the cut leave out.
[[nodiscard]] std::shared_ptr<const VolumeData> drawn_volume(const Sector& sector, const StagedPing& staged,
                                                             const PictureOptions& options, const VolumeCut& cut,
                                                             double transducer_depth_m);
/// What of a volume is cut away where it is looked at so.
/// fan, beam  of the slices
[[nodiscard]] VolumeCut volume_cut(const Sector& sector, const PictureOptions& options, const Camera& camera, int fan,
                                   int beam);
/// The seabed as detection has found it in a ping; empty where it has not.
[[nodiscard]] std::optional<FittedSeabed> fitted_seabed(const StagedPing& staged);
/// What arrows below the ship tell of the recipe's water velocities; none where the options want none, and without
/// position or heading.
[[nodiscard]] CurrentColumn volume_currents(const Recipe& recipe, const Sector& sector,
                                            const PingNavigation& navigation, const VolumeParams& params,
                                            const Units& units = {});
/// Whether drawn_volume() is the same for both.
[[nodiscard]] bool same_volume(const PictureOptions& a, const PictureOptions& b);

/// Whether masks are to be outlined: where a ray's colour tells one Sv a tint would make it another, or hide it.
[[nodiscard]] bool wants_outlines(const VolumeFigure& figure, const PictureOptions& options);

/// Where a volume lies in its picture.
struct VolumePlace {
  Theme theme;
  Layout layout;
  PixelRect rect;  ///< of the picture
  PixelSize rays;  ///< pixels of the volume: the rectangle's, times the scale
  double scale = 1.0;
};
/// scale   device pixels a pixel of the picture
/// errors  bad_parameter: no room for a volume
[[nodiscard]] Result<VolumePlace> volume_place(const PictureOptions& options, double scale = 1.0);

/// Text and lines as large as they are among the rays.
[[nodiscard]] Theme scaled_theme(const VolumePlace& place);

/// The camera asked for, else the overview; orbit, rise and zoom added.
/// errors  as named_camera()
[[nodiscard]] Result<Camera> volume_camera(const Sector& sector, const PictureOptions& options, PixelSize size);
/// The view curve's colours and extinctions. errors: bad_parameter
[[nodiscard]] Result<OpticalTable> volume_table(const PictureOptions& options);
/// What stands round the volume, and how it is labelled.
[[nodiscard]] ContextParams volume_surroundings(const VolumeFigure& figure, const PictureOptions& options);
[[nodiscard]] ContextPicture volume_context(const VolumeFigure& figure, const PictureOptions& options,
                                            const VolumePlace& place, const Camera& camera, Work& work);
[[nodiscard]] VolumeView volume_view(const VolumeFigure& figure, const PictureOptions& options,
                                     const VolumePlace& place, const Camera& camera, const ContextPicture& context);

/// The whole picture: title, what stands behind and before the volume, its rays, labels, legend, colour bars.
[[nodiscard]] FrameDescription volume_figure_frame(const VolumeFigure& figure, const PictureOptions& options,
                                                   const VolumePlace& place, const VolumeView& view,
                                                   const ContextPicture& context, const RayImage& rays, Work& work);

}  // namespace sonar
