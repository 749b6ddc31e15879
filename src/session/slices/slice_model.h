// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"
#include "session/slices/slice_build.h"
#include "session/tools/brush_tool.h"
#include "session/tools/seed_tool.h"
#include "session/tools/slice_measure.h"
#include "view/slices/slice_picture.h"

namespace sonar {

/// A slice of the ping on show with everything that lies over it, and what pointers do to it: move = cursor and preview;
/// left = the tool; alt-left = select only; middle = pan; wheel = next fan, beam, range or plane; with control zoom, with
/// shift a single sample of range, or a turn of the plane.
class SliceModel : public LivePicture {
 public:
  /// All outlive the model.
  SliceModel(SliceKind kind, Workspace& workspace, SeedTool& seed, BrushTool& brush);

  void pointer(const PointerEvent& event) override;
  /// Of a slice that shows all there is nothing to move: fingers go through its fans, as the wheel does.
  [[nodiscard]] bool pans() const override { return zoomed(); }
  bool aim(PixelPoint at) override;
  [[nodiscard]] std::vector<Overlay> overlays() const override;
  [[nodiscard]] PointerShape pointer_shape() const override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// With the growth that the picture shows the trial of.
  [[nodiscard]] std::string timing() const override;
  /// All of the sector again.
  void show_all();
  [[nodiscard]] bool zoomed() const { return extent_.has_value(); }
  /// The picture on show; null before the first.
  [[nodiscard]] const std::shared_ptr<const SlicePicture>& picture() const { return picture_; }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  void hear(DocumentChange change);
  void forget_colours();
  [[nodiscard]] std::optional<Voxel> voxel_at(PixelPoint at) const;
  /// The refused echo whose mark lies there.
  [[nodiscard]] std::optional<EchoName> echo_at(PixelPoint at) const;
  [[nodiscard]] PixelPoint on_map(PixelPoint at) const;
  /// Where the other slices run through this one.
  [[nodiscard]] const std::vector<Overlay>& cut_lines() const;
  [[nodiscard]] bool on_seed() const { return workspace_.tool() == ToolName::seed; }
  [[nodiscard]] bool on_brush() const {
    return workspace_.tool() == ToolName::brush || workspace_.tool() == ToolName::eraser;
  }
  void end_section(PixelPoint at);
  void point(const PointerEvent& event);
  void press(const PointerEvent& event, bool double_press);
  void move(const PointerEvent& event);
  void release(const PointerEvent& event);
  void leave();
  void turn_wheel(const PointerEvent& event);
  void zoom(PixelPoint about, double factor);
  void pan(PixelPoint by);

  SliceKind kind_;
  Workspace& workspace_;
  SeedTool& seed_;
  BrushTool& brush_;
  SliceMeasure measure_{workspace_};
  std::weak_ptr<const int> of_;  ///< identity of the observation on show
  std::shared_ptr<const SlicePicture> picture_;
  std::shared_ptr<const SvColours> colours_;                       ///< null = to be made
  std::shared_ptr<FlagRoom> room_ = std::make_shared<FlagRoom>();  ///< of builds
  std::optional<SliceExtent> extent_;                              ///< empty = all
  std::optional<PixelPoint> pointer_;                              ///< where the pointer is; empty = elsewhere
  std::optional<PixelPoint> panned_;                               ///< where it was while the picture is dragged
  std::optional<PixelPoint> section_;  ///< where the line of a section begins while it is drawn
  double wheel_ = 0.0;                 ///< steps that make no whole one yet
  /// What cut_lines() found, and for which picture and slices.
  struct Cuts {
    std::shared_ptr<const SlicePicture> in;
    std::vector<Slice> others;
    std::vector<Overlay> lines;
  };
  mutable Cuts cuts_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
