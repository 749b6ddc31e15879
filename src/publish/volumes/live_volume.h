// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "base/work.h"
#include "model/navigation.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/engine.h"
#include "publish/picture_options.h"
#include "view/frame_description.h"
#include "view/refused_marks.h"
#include "view/volume/pick.h"

namespace sonar {

struct OffscreenRenderer;

/// Everything that a live picture of a ping's volume depends on. What is the same object as before is not prepared again.
struct LiveVolumeInput {
  std::shared_ptr<const StagedPing> staged;
  /// The ping that something moves on to: Sv is interpolated between both, which the picture says. Null = `staged` as
  /// measured. All else is given as it is to be drawn.
  std::shared_ptr<const StagedPing> next{};
  double towards_next = 0.0;  ///< how far it has come, 0 <= x < 1
  std::shared_ptr<const Sector> sector;
  PingNavigation navigation;
  bool moved = false;      ///< as SlicePing has it
  std::string title;       ///< of the observation
  std::string title_line;  ///< of the picture
  std::vector<MaskLayer> masks;
  std::size_t tried = 0;  ///< the last so many masks are only tried: pointers pass through
  std::vector<std::shared_ptr<const PingMask>> casting_shadow{};  ///< masks that take sound out of beams
  std::vector<std::string> names;                                 ///< [mask] beside it in the picture; empty = none
  std::vector<std::pair<Rgba8, std::string>> legend;              ///< of the masks
  std::vector<RefusedMark> refused;
  CurrentColumn currents;         ///< below the ship
  ExtinctionParams extinction;    ///< by which schools cast a shadow, where the options show it
  TrailSubject trails;            ///< of options.volume that are shown
  int fan = 0;                    ///< of the slice from above
  int beam = 0;                   ///< of the slice from the side
  bool scale_bar = true;          ///< the colour bar shows the scale, else the transfer function
  PictureOptions options;         ///< what pictures of volumes know of them
  double scale = 1.0;             ///< device pixels a pixel of the picture
  double moving_budget_s = 0.05;  ///< what the first picture of a change may take
};

/// What stands in a picture, for pointers.
struct LiveVolumeShown {
  std::shared_ptr<const VolumeData> volume;
  std::shared_ptr<const OpticalTable> table;
  std::vector<MaskLayer> masks;  ///< that pointers meet
  VolumeView view;               ///< in device pixels
  PixelRect place;               ///< of the volume, in pixels of the picture
  std::int64_t ping_index = -1;  ///< -1 = none: it is interpolated between two
  int divisor = 1;               ///< of the rays' resolution
  int averaged = 0;              ///< jittered frames in it
  bool done = false;             ///< it gets no better
  std::string renderer;          ///< "cpu (AVX3)"
  std::string notice;            ///< why another back-end draws than was asked for, or no depth chart; empty = none

  /// What is seen at a place of the picture; below a millisecond or so.
  [[nodiscard]] std::optional<Picked> picked_at(PixelPoint at) const;
  /// Where a point appears in the picture; empty behind the eye or outside the volume's rectangle.
  [[nodiscard]] std::optional<PixelPoint> place_of(const Point<Sonar>& point) const;
};

/// Draws a ping in three dimensions for a window: coarsely at once, then better and better while nothing changes. What one
/// picture has prepared (volume, table, masks, surroundings) serves the next ones.
/// threads  one at a time. The OpenGL context is made, used and destroyed on the thread that calls draw() and let_go(),
///          which must be the same one; it belongs to no window, so that windows come and go without loss.
class LiveVolume {
 public:
  using MakeRenderer = std::function<Result<OffscreenRenderer>(RendererChoice)>;
  struct Picture {
    FrameDescription frame;
    std::shared_ptr<const LiveVolumeShown> shown;
  };
  using Show = std::function<void(Picture)>;

  /// make  back-ends; empty = offscreen_renderer()
  explicit LiveVolume(MakeRenderer make = {});
  ~LiveVolume();
  LiveVolume(const LiveVolume&) = delete;
  LiveVolume& operator=(const LiveVolume&) = delete;

  /// Shows pictures, each better than the one before, until one more would change nothing or nobody wants them. The first
  /// is shown in any case. Where OpenGL fails the processor draws, and the pictures' notice says so.
  /// better  draws all pictures but the first; cancelled, they end at once
  /// errors  bad_parameter: no room, a volume that cannot be drawn; cancelled
  [[nodiscard]] Result<void> draw(const LiveVolumeInput& input, const CancelToken& token, Work& better,
                                  const Show& show);
  /// Gives back all memory and the OpenGL context; draw() makes everything anew.
  void let_go();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sonar
