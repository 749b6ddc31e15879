// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "publish/volumes/live_volume.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"

namespace sonar {

/// Where the view in three dimensions is looked from by name.
enum class VolumeSide : std::uint8_t { overview, above, starboard, port, behind };

/// The ping in three dimensions.
///
/// Left drag turns it, middle drag moves it, the wheel comes nearer to what is under the pointer, a left click without a
/// drag is a press upon the voxel that is seen there. The first picture after a change is coarse, better ones follow
/// while nothing changes. Earth-fixed, the eye stays where it is on the earth while pings pass. Hidden, it gives back its
/// volumes and the back-end that drew them.
/// threads  the window's
class VolumeModel : public LivePicture {
 public:
  /// The workspace outlives the model. make: back-ends; empty = those of this machine
  explicit VolumeModel(Workspace& workspace, LiveVolume::MakeRenderer make = {});
  VolumeModel(const VolumeModel&) = delete;
  VolumeModel& operator=(const VolumeModel&) = delete;
  ~VolumeModel() override;

  void look_from(VolumeSide side);
  /// Looks at a place from the same side and as far from it; turning goes round it from then on.
  void look_at(const Point<Sonar>& place);
  [[nodiscard]] const std::optional<Camera>& camera() const { return workspace_.camera(); }
  /// Of the picture on show; null before the first.
  [[nodiscard]] const LiveVolumeShown* shown() const { return shown_.get(); }
  /// The back-end that drew it; empty before the first.
  [[nodiscard]] std::string drawn_by() const { return shown_ == nullptr ? "" : shown_->renderer; }

  void pointer(const PointerEvent& event) override;
  [[nodiscard]] bool pans() const override { return true; }
  bool aim(PixelPoint at) override;
  [[nodiscard]] std::vector<Overlay> overlays() const override;
  [[nodiscard]] PointerShape pointer_shape() const override;
  [[nodiscard]] bool refines() const override { return true; }
  [[nodiscard]] std::string hint(PixelPoint at) const override;

  /// What a pointer does upon voxels; each may be empty.
  struct Hooks {
    std::function<void(const Voxel&, bool shift, bool control, bool double_press)> press;
    std::function<void(const Voxel&)> select;  ///< with alt, or while another tool than the seed is chosen
    std::function<void(const Voxel&, bool shift, bool control)> hover;
    std::function<void()> leave;
  };
  Hooks hooks;

  /// A drag begins when the pointer has gone so far, pixels.
  static constexpr double kDragBegins_px = 4.0;

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;
  void left_page() override;
  void hidden() override;

 private:
  struct Drag {
    PointerButton button = PointerButton::none;
    PixelPoint from;
    Camera camera;
    bool moved = false;
  };
  void hear(DocumentChange change);
  void stand_still();
  /// Unlike one that others set, it needs no new picture, and is not in the frame of the ping that is asked for.
  void place_camera(const std::optional<Camera>& camera);
  [[nodiscard]] Build panel_build(const PictureLook& in_units);
  /// Places in the frame, which is in the window's units: the back-end has a scale of its own.
  [[nodiscard]] PixelPoint in_frame(PixelPoint pixel) const { return {pixel.x / scale(), pixel.y / scale()}; }
  void press(const PointerEvent& event);
  void drag(const PointerEvent& event);
  void release(const PointerEvent& event);
  void zoom(PixelPoint at, double factor);
  void orbit(PixelPoint by);
  void hover(const PointerEvent& event);
  void leave();
  void set_camera(const Camera& camera);
  [[nodiscard]] std::optional<Voxel> voxel_at(PixelPoint at) const;
  /// The refused echo whose mark lies at a place of the frame.
  [[nodiscard]] std::optional<EchoName> echo_at(PixelPoint at) const;
  void press_voxel(const PointerEvent& event, bool double_press);

  Workspace& workspace_;
  std::weak_ptr<const int> of_;              ///< identity of the observation on show
  std::optional<std::int64_t> camera_ping_;  ///< in whose frame the camera is
  bool placing_ = false;                     ///< the camera, by this model
  std::optional<Drag> drag_;
  LiveVolume::MakeRenderer make_;  ///< of panels' back-ends; empty = those of this machine
  std::shared_ptr<LiveVolume> live_;
  std::shared_ptr<const LiveVolumeShown> shown_;
  std::shared_ptr<Work> better_;      ///< draws what may be given up
  std::shared_ptr<Work> panel_work_;  ///< draws the panel of a page
  std::string told_;                  ///< the last notice
  std::shared_ptr<bool> here_ = std::make_shared<bool>(true);
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
