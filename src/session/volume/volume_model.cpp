// SPDX-License-Identifier: Apache-2.0
#include "session/volume/volume_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/units.h"
#include "session/review/refused_layer.h"
#include "session/tools/growth.h"
#include "session/tools/measure_tool.h"
#include "session/volume/volume_input.h"
#include "view/volume/earth_pose.h"

namespace sonar {
namespace {

constexpr double kWheelStep = 0.85;  ///< of the distance, a notch
constexpr double kNearest_m = 0.5;
constexpr double kMarkReach_px = 7.0;
constexpr double kFarthest = 20.0;  ///< in ranges of the sonar

/// What of a panel is whole units.
PixelSize whole_units(const PictureLook& look) {
  return {static_cast<int>(look.size.width / look.scale), static_cast<int>(look.size.height / look.scale)};
}

/// A drag over the volume's height is half a turn.
Camera turned(const Camera& camera, double right_px, double down_px, double height_px) {
  const double rad_per_px = std::numbers::pi / height_px;
  return orbited(camera, right_px * rad_per_px, down_px * rad_per_px);
}

/// Where a ray comes as far away as the camera's target.
Point<Sonar> at_target_depth(const Camera& camera, const CameraBasis& b, const Ray& ray) {
  const Point<Sonar> arm = camera.target - camera.eye;
  const Point<Sonar>& d = ray.direction;
  const double cosine = d.x * b.forward.x + d.y * b.forward.y + d.z * b.forward.z;
  return ray.origin + d * (norm(arm) / std::max(0.1, cosine));
}

}  // namespace

VolumeModel::VolumeModel(Workspace& workspace, LiveVolume::MakeRenderer make)
    : LivePicture(workspace), workspace_(workspace), make_(make), live_(std::make_shared<LiveVolume>(std::move(make))) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  for (Listeners<>* changed :
       {&workspace.motion.changed(), &workspace.view_curve.changed(), &workspace.preview.changed(),
        &workspace.dark.changed(), &workspace.curve_follows_scale.changed(), &workspace.school.changed(),
        &workspace.chosen_schools.changed(), &workspace.echo.changed(), &workspace.depth_raster.changed()}) {
    listening_.to(*changed, [this] { update(); });
  }
  for (Listeners<>* changed_over :
       {&workspace.cursor.changed(), &workspace.tool.changed(), &workspace.measurement.changed()}) {
    listening_.to(*changed_over, [this] { changed().tell(); });
  }
  listening_.to(workspace.camera.changed(), [this] {
    if (placing_) return;
    camera_ping_ = workspace_.document.ping();
    update();
  });
  listening_.to(workspace.slices.changed(), [this] {
    const VolumeParams& params = workspace_.volume.values();
    if ((params.context && params.slice_planes) || params.clip != VolumeClip::none) update();
  });
  listening_.to(workspace.display, [this] { update(); });
  listening_.to(workspace.volume, [this] { update(); });
}

VolumeModel::~VolumeModel() {
  if (better_) better_->cancel();
  VolumeModel::left_page();
  // Where a back-end was made it must end, and that is not the window's thread.
  end_behind([this] { live_->let_go(); });
}

void VolumeModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
    case DocumentChange::observation: {
      const auto& observation = workspace_.document.shown();
      const auto identity = observation ? observation->identity() : nullptr;
      // One more observation is open, or another calibration chosen: the camera stays.
      if (change == DocumentChange::observation && identity == of_.lock()) return update();
      of_ = identity;
      place_camera(std::nullopt);
      camera_ping_.reset();
      drag_.reset();
      shown_.reset();
      return update();
    }
    case DocumentChange::ping:
      if (!seen()) stand_still();  // pictures in files are looked at from there too
      return update();
    case DocumentChange::propagating:
    case DocumentChange::state:
      return update();
    default:
      return;
  }
}

void VolumeModel::place_camera(const std::optional<Camera>& camera) {
  placing_ = true;
  workspace_.camera.set(camera);
  placing_ = false;
}

/// Puts the camera into the frame of the ping that is shown next, where it is where it was on the earth. What is not known
/// there of position and heading leaves it with the ship.
void VolumeModel::stand_still() {
  const OpenObservationPtr& shown = workspace_.document.shown();
  const StagedPingPtr& staged = workspace_.document.staged();
  if (!shown || !staged) return;
  const std::int64_t now = staged->ping_index;
  const std::int64_t then = std::exchange(camera_ping_, now).value_or(now);
  const auto& pings = shown->files().navigation;
  if (!workspace_.volume.values().earth_fixed || then == now || then >= static_cast<std::int64_t>(pings.size())) return;
  const auto moved = [&](const Camera& camera) {
    return standing_still(camera, pings[static_cast<std::size_t>(then)], pings[static_cast<std::size_t>(now)]);
  };
  // An overview stands where it was seen from.
  const PixelSize rays = shown_ ? shown_->view.size : units();
  if (!workspace_.camera() && (rays.width < 1 || rays.height < 1)) return;
  const auto stands = moved(workspace_.camera() ? *workspace_.camera() : overview(shown->sector(), rays));
  if (!stands) return;
  place_camera(stands);
  if (drag_) drag_->camera = moved(drag_->camera).value_or(drag_->camera);
}

LivePicture::Build VolumeModel::build(const PictureLook& look) {
  PictureLook in_units = look;
  in_units.size = look.panel ? whole_units(look) : units();
  stand_still();
  if (look.panel) return panel_build(in_units);
  if (better_) better_->cancel();  // what is under way shows something that is past
  auto input = volume_input(workspace_, workspace_.camera(), in_units);
  if (!input) return {};
  better_ = std::make_shared<Work>(workspace_.document.options().threads);
  const auto way = std::make_shared<std::shared_ptr<const void>>(workspace_.document.right_of_way().take());
  return [live = live_, better = better_, way, scale = scale(), input = std::move(*input)](
             PixelSize /*size*/, const CancelToken& token, const Show& show) {
    return live->draw(input, token, *better, [&](LiveVolume::Picture picture) {
      way->reset();  // finer ones may take their time
      show({std::move(picture.frame), std::nullopt, std::move(picture.shown), scale});
    });
  };
}

/// With a back-end of its own, which ends on the thread where it began.
LivePicture::Build VolumeModel::panel_build(const PictureLook& in_units) {
  PictureLook look = in_units;
  look.panel->text_px /= look.scale;
  look.panel->line_px /= look.scale;
  left_page();  // what is under way shows something that is past
  auto input = volume_input(workspace_, workspace_.camera(), look);
  if (!input) return {};
  panel_work_ = std::make_shared<Work>(workspace_.document.options().threads);
  return [make = make_, work = panel_work_, input = std::move(*input)](PixelSize /*size*/, const CancelToken& token,
                                                                       const Show& show) {
    LiveVolume live(make);
    return live.draw(input, token, *work, [&](LiveVolume::Picture picture) {
      show({std::move(picture.frame), std::nullopt, std::move(picture.shown), input.scale});
    });
  };
}

void VolumeModel::left_page() {
  if (panel_work_) panel_work_->cancel();
}

void VolumeModel::take(const std::shared_ptr<const void>& detail) {
  if (!seen()) return;
  shown_ = std::static_pointer_cast<const LiveVolumeShown>(detail);
  if (shown_ && shown_->notice != told_) {
    told_ = shown_->notice;
    if (!told_.empty()) workspace_.document.tell(told_);
  }
}

void VolumeModel::hidden() {
  if (better_) better_->cancel();
  drag_.reset();
  shown_.reset();
  behind([live = live_] { live->let_go(); });
}

void VolumeModel::set_camera(const Camera& camera) {
  const double far_m = shown_ ? shown_->volume->sector.range().range_m(shown_->volume->sector.range().count) : 1e3;
  const double distance_m = norm(camera.eye - camera.target);
  if (distance_m < kNearest_m || distance_m > kFarthest * far_m) return;
  if (workspace_.camera() == camera) return;
  place_camera(camera);
  update();
}

void VolumeModel::look_from(VolumeSide side) {
  if (side == VolumeSide::overview) {
    place_camera(std::nullopt);
    return update();
  }
  const auto& observation = workspace_.document.shown();
  if (!observation) return;
  const auto from = [side] {
    switch (side) {
      case VolumeSide::above:
        // One degree aft, so that the bow points up.
        return Sector::direction(rad_from_deg(89.0), rad_from_deg(180.0));
      case VolumeSide::starboard:
        return Sector::direction(0.0, rad_from_deg(90.0));
      case VolumeSide::port:
        return Sector::direction(0.0, rad_from_deg(270.0));
      default:
        return Sector::direction(0.0, rad_from_deg(180.0));
    }
  };
  const PixelSize rays = shown_ ? shown_->view.size : units();
  set_camera(seen_from(observation->sector(), from(), rays));
}

void VolumeModel::look_at(const Point<Sonar>& place) {
  const auto& observation = workspace_.document.shown();
  if (!observation) return;
  Camera camera = workspace_.camera() ? *workspace_.camera()
                                      : overview(observation->sector(), shown_ ? shown_->view.size : units());
  camera.eye = camera.eye + (place - camera.target);
  camera.target = place;
  set_camera(camera);
}

void VolumeModel::pointer(const PointerEvent& pointed) {
  PointerEvent event = pointed;
  event.at = in_frame(pointed.at);
  switch (event.action) {
    case PointerAction::press:
      return press(event);
    case PointerAction::double_press:
      drag_.reset();
      if (event.button == PointerButton::left) press_voxel(event, true);
      return;
    case PointerAction::move:
      return drag_ ? drag(event) : hover(event);
    case PointerAction::release:
      return release(event);
    case PointerAction::wheel:
      return zoom(event.at, std::pow(kWheelStep, event.wheel_steps));
    case PointerAction::zoom:
      return zoom(event.at, 1.0 / event.factor);
    case PointerAction::pan:
      return orbit(in_frame(event.by));
    case PointerAction::leave:
      return leave();
  }
}

void VolumeModel::press(const PointerEvent& event) {
  if (!shown_ || (event.button != PointerButton::left && event.button != PointerButton::middle)) return;
  drag_ = Drag{event.button, event.at, workspace_.camera().value_or(shown_->view.camera), false};
}

void VolumeModel::drag(const PointerEvent& event) {
  const double right = event.at.x - drag_->from.x;
  const double down = event.at.y - drag_->from.y;
  if (!shown_ || (!drag_->moved && std::hypot(right, down) <= kDragBegins_px)) return;
  if (!drag_->moved) leave();
  drag_->moved = true;
  const double height = shown_->place.height;
  set_camera(drag_->button == PointerButton::left ? turned(drag_->camera, right, down, height)
                                                  : panned(drag_->camera, -right / height, down / height));
}

void VolumeModel::release(const PointerEvent& event) {
  if (!drag_ || event.button != drag_->button) return;
  const bool click = !drag_->moved && drag_->button == PointerButton::left;
  drag_.reset();
  if (click) press_voxel(event, false);
}

void VolumeModel::orbit(PixelPoint by) {
  if (!shown_) return;
  set_camera(turned(workspace_.camera().value_or(shown_->view.camera), by.x, by.y, shown_->place.height));
}

void VolumeModel::zoom(PixelPoint at, double factor) {
  if (!shown_ || factor == 1.0) return;
  const Camera camera = workspace_.camera().value_or(shown_->view.camera);
  const CameraBasis b = basis(camera, shown_->view.size);
  const double scale = shown_->view.size.width / shown_->place.width;
  const PixelPoint pixel{(at.x - shown_->place.x) * scale, (at.y - shown_->place.y) * scale};
  // While a new camera's picture is still on its way, nothing is known of what it will show.
  const auto picked = camera == shown_->view.camera ? shown_->picked_at(at) : std::nullopt;
  const Point<Sonar> about = picked ? picked->position : at_target_depth(camera, b, b.ray(pixel));
  set_camera(zoomed_about(camera, about, factor));
}

std::optional<Voxel> VolumeModel::voxel_at(PixelPoint at) const {
  const auto& staged = workspace_.document.staged();
  if (!shown_ || !staged || staged->ping_index != shown_->ping_index) return std::nullopt;
  const auto picked = shown_->picked_at(at);
  if (!picked) return std::nullopt;
  return Voxel{picked->fan, picked->beam, picked->sample};
}

std::optional<EchoName> VolumeModel::echo_at(PixelPoint at) const {
  const auto& observation = workspace_.document.shown();
  if (!shown_ || !observation) return std::nullopt;
  std::vector<PlacedMark> placed;
  for (const RefusedMark& mark : refused_layer_in(workspace_, shown_->ping_index)) {
    const Voxel& loudest = mark.loudest;
    const auto there = shown_->place_of(observation->sector().centre(loudest.fan, loudest.beam, loudest.sample));
    if (there) placed.push_back({*there, mark.echo_id});
  }
  const auto id = mark_at(placed, at, kMarkReach_px);
  return id ? std::optional(EchoName{observation->index(), *id}) : std::nullopt;
}

void VolumeModel::press_voxel(const PointerEvent& event, bool double_press) {
  const auto voxel = voxel_at(event.at);
  if (!voxel) return;
  if (workspace_.tool() == ToolName::measure && !event.alt) {
    if (!double_press) measure_voxel(workspace_, *voxel);
  } else if (event.alt || workspace_.tool() != ToolName::seed) {
    if (hooks.select) hooks.select(*voxel);
  } else if (hooks.press) {
    hooks.press(*voxel, event.shift, event.control, double_press);
  }
}

void VolumeModel::hover(const PointerEvent& event) {
  if (event.button != PointerButton::none) return;
  const auto voxel = voxel_at(event.at);
  workspace_.cursor.set(voxel);
  if (const auto echo = echo_at(event.at)) workspace_.echo.set(echo);
  if (voxel && workspace_.tool() == ToolName::measure) hover_voxel(workspace_, *voxel);
  if (workspace_.tool() != ToolName::seed) return;
  if (voxel && hooks.hover) hooks.hover(*voxel, event.shift, event.control);
  if (!voxel && hooks.leave) hooks.leave();
}

bool VolumeModel::aim(PixelPoint at) {
  const auto voxel = voxel_at(in_frame(at));
  const Document& document = workspace_.document;
  if (const auto echo = echo_at(in_frame(at))) workspace_.echo.set(echo);
  if (!voxel) return false;
  workspace_.cursor.set(voxel);
  const auto under = school_of_voxel(document.state(), shown_->ping_index, document.shown()->sector(), *voxel);
  if (under && hooks.select) hooks.select(*voxel);
  return under.has_value();
}

void VolumeModel::leave() {
  workspace_.cursor.set(std::nullopt);
  if (hooks.leave) hooks.leave();
}

std::vector<Overlay> VolumeModel::overlays() const {
  const auto& cursor = workspace_.cursor();
  const auto& observation = workspace_.document.shown();
  if (!shown_ || !observation) return {};
  std::vector<Overlay> over;
  const auto place_of = [&](const Point<Sonar>& place) -> std::optional<PixelPoint> {
    const auto at = shown_->place_of(place);
    return at ? std::optional(PixelPoint{at->x * scale(), at->y * scale()}) : std::nullopt;
  };
  const auto& measured = workspace_.measurement();
  const bool here = measured && measured->on == Measurement::On::volume && on_show(workspace_, *measured);
  if (here && measured->ping == shown_->ping_index) {
    const auto from = place_of(*measured->ends->front().place);
    const auto to = place_of(*measured->ends->back().place);
    const PixelRect& view = shown_->place;
    const PixelRect plot{view.x * scale(), view.y * scale(), view.width * scale(), view.height * scale()};
    if (from && to) over = measured_overlays(*measured, {*from, *to}, plot, workspace_.units());
  }
  if (!cursor) return over;
  if (const auto at = place_of(observation->sector().centre(cursor->fan, cursor->beam, cursor->sample))) {
    Overlay cross;
    cross.cross = *at;
    over.push_back(std::move(cross));
  }
  return over;
}

PointerShape VolumeModel::pointer_shape() const {
  return workspace_.tool() == ToolName::measure ? PointerShape::cross : PointerShape::arrow;
}

std::string VolumeModel::hint(PixelPoint at) const {
  if (const auto echo = echo_at(in_frame(at))) return refused_hint(workspace_, *echo);
  const auto voxel = voxel_at(in_frame(at));
  if (!voxel) return {};
  // The line below the views has the rest.
  const ReadOut text = read_out(workspace_, *voxel);
  std::string hint = text.sv + ", " + text.range + ", " + text.depth;
  if (!text.flags.empty()) hint += "\nremoved: " + text.flags;
  if (!text.school.empty()) hint += "\n" + text.school;
  return hint;
}

}  // namespace sonar
