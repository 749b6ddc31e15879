// SPDX-License-Identifier: Apache-2.0
#include "session/noise/noise_steps_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "publish/noise_steps_picture.h"
#include "session/looks/screen_theme.h"
#include "session/slices/school_layers.h"
#include "session/slices/slice_build.h"
#include "session/slices/slice_places.h"

namespace sonar {
namespace {

constexpr int kLastStep = static_cast<int>(kNoiseStepNames.size()) - 1;

/// Everything that the picture depends on, as it was when it was asked for.
struct StepsWish {
  OpenObservationPtr observation;
  StagedPingPtr ping;
  SliceView view;
  bool north_up = false;
  SliceStepsStyle style;
  std::vector<MaskLayer> masks;
  PictureLook look;
};

std::string value_text(std::int16_t count) {
  return count == kNoData ? std::string("none") : fmt::format("{:.1f} dB", db_from_counts(count));
}

}  // namespace

NoiseStepsModel::NoiseStepsModel(Workspace& workspace)
    : LivePicture(workspace), workspace_(workspace), asked_(params()) {
  const auto anew = [this] { update(); };
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.slices.changed(), anew);
  listening_.to(workspace.slice_in_use.changed(), anew);
  listening_.to(workspace.school.changed(), anew);
  listening_.to(workspace.dark.changed(), anew);
  listening_.to(workspace.view_curve.changed(), anew);
  listening_.to(workspace.curve_follows_scale.changed(), anew);
  listening_.to(workspace.cursor.changed(), [this] { changed().tell(); });
  listening_.to(workspace.display, anew);
  listening_.to(workspace.plane, anew);
  listening_.to(workspace.picture_file, [this] { parameters_changed(); });
}

void NoiseStepsModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
    case DocumentChange::observation:
      room_ = std::make_shared<Room>();
      sight_.reset();
      return update();
    case DocumentChange::ping:
    case DocumentChange::state:
      return update();
    default:
      return;
  }
}

void NoiseStepsModel::parameters_changed() {
  if (params() == asked_) return;
  asked_ = params();
  update();
}

SliceKind NoiseStepsModel::kind() const {
  const StepsSlice slice = params().slice;
  if (slice == StepsSlice::live) return workspace_.slice_in_use().kind;
  return static_cast<SliceKind>(static_cast<int>(slice) - 1);
}

LivePicture::Build NoiseStepsModel::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  if (!document.shown() || !document.staged()) return {};
  StepsWish wish;
  wish.observation = document.shown();
  wish.ping = document.staged();
  const DisplayParams& display = workspace_.display.values();
  const auto ping = static_cast<std::size_t>(wish.ping->ping_index);
  const double heading_deg = wish.observation->files().navigation[ping].heading_deg;
  const Slice slice = live_slice(workspace_, kind(), wish.ping->ping_index);
  const SliceInUse& in_use = workspace_.slice_in_use();
  wish.north_up = seen_from_above(slice) && display.north_up && !std::isnan(heading_deg);
  wish.view = {slice, wish.north_up ? -rad_from_deg(heading_deg) : 0.0,
               in_use.kind == kind() ? in_use.extent : std::nullopt};
  wish.style = noise_steps_style(params(), display, slice_colours(workspace_));
  wish.style.north_up = wish.north_up;
  wish.look = look;
  for (const SchoolLayer& school : school_layers(workspace_, wish.ping->ping_index, dock_theme(look.size, look))) {
    wish.masks.push_back(school.layer);
  }
  const auto room = look.panel ? std::make_shared<Room>() : room_;  // one picture at a time uses it
  return [wish = std::move(wish), room](PixelSize size, const CancelToken&, const Show& show) -> Result<void> {
    if (!room->steps || &room->steps->ping() != wish.ping.get()) {
      room->steps = std::make_shared<const NoiseSteps>(wish.ping);
    }
    auto sight = std::make_shared<NoiseStepsSight>();
    sight->steps = room->steps;
    OpenObservation& observation = *wish.observation;
    SliceStepsData data =
        noise_steps_data(*room->steps, observation.engine().recipe(), observation.sector(), wish.view.slice);
    data.masks = wish.masks;
    auto picture = slice_steps(observation.sector(), data, slice_ping(observation, wish.ping->ping_index), wish.view,
                               wish.style, dock_theme(size, wish.look), size);
    if (!picture) return pass_on(picture);
    sight->picture = std::move(*picture);
    show({sight->picture.frame, std::nullopt, sight});
    return {};
  };
}

void NoiseStepsModel::take(const std::shared_ptr<const void>& detail) {
  sight_ = std::static_pointer_cast<const NoiseStepsSight>(detail);
}

void NoiseStepsModel::pointer(const PointerEvent& event) {
  if (event.action == PointerAction::leave) return workspace_.cursor.set(std::nullopt);
  if (!in_sight()) return;
  switch (event.action) {
    case PointerAction::move:
      return workspace_.cursor.set(sight_->picture.voxel_at(event.at));
    case PointerAction::press:
      if (event.button == PointerButton::left) click(event.at, event.shift);
      return;
    case PointerAction::wheel: {
      wheel_ += event.wheel_steps;
      const double whole = std::trunc(wheel_);
      wheel_ -= whole;
      if (whole != 0.0)
        step_slice(workspace_, kind(), static_cast<int>(std::clamp(whole, -1000.0, 1000.0)), event.shift);
      return;
    }
    default:
      return;
  }
}

void NoiseStepsModel::click(PixelPoint at, bool shift) {
  const SliceStepPlace* place = sight_->picture.at(at);
  if (place == nullptr) return;
  if (place->shows != SliceStepPlace::Shows::step) return show_all();
  if (!shift) return compare(static_cast<NoiseStep>(place->step));
  NoiseStepsParams now = params();
  now.before = static_cast<ComparedStep>(place->step + 1);
  set(now);
}

void NoiseStepsModel::set(const NoiseStepsParams& wanted) {
  PictureFileParams all = workspace_.picture_file.values();
  all.kind.noise_steps = wanted;
  workspace_.picture_file.assign(all);
}

bool NoiseStepsModel::comparing() const { return compared_steps(params()).has_value(); }

void NoiseStepsModel::compare(NoiseStep step) {
  NoiseStepsParams now = params();
  const auto number = static_cast<ComparedStep>(static_cast<int>(step) + 1);
  const bool first = step == NoiseStep::unfiltered;
  now.before = first ? number : ComparedStep{0};
  now.after = first ? ComparedStep{0} : number;
  set(now);
}

void NoiseStepsModel::step(int by) {
  const auto now = compared_steps(params());
  const int at = now ? static_cast<int>(now->second) + by : (by > 0 ? 1 : kLastStep);
  compare(static_cast<NoiseStep>(std::clamp(at, 1, kLastStep)));
}

void NoiseStepsModel::show_all() {
  NoiseStepsParams now = params();
  now.before = now.after = 0;
  set(now);
}

std::vector<Overlay> NoiseStepsModel::overlays() const {
  std::vector<Overlay> out;
  const auto& cursor = workspace_.cursor();
  if (!in_sight() || !cursor) return out;
  for (const SliceStepPlace& place : sight_->picture.places) {
    auto at = sight_->picture.map_of(place).carried(*cursor);
    if (!at) continue;
    at = PixelPoint{at->x + place.plot.x, at->y + place.plot.y};
    if (!inside(place.plot, *at)) continue;
    Overlay cross;
    cross.cross = at;
    cross.clip = place.plot;
    out.push_back(std::move(cross));
  }
  return out;
}

std::string NoiseStepsModel::hint(PixelPoint at) const {
  if (!in_sight()) return {};
  const auto voxel = sight_->picture.voxel_at(at);
  if (!voxel) return {};
  const NoiseSteps& steps = *sight_->steps;
  const Shape3& shape = steps.flags().shape();
  const auto index = static_cast<std::size_t>((voxel->fan * shape.beams + voxel->beam) * shape.samples + voxel->sample);
  std::string text = fmt::format("{}: {}", noise_step_words(NoiseStep::unfiltered),
                                 value_text(steps.value(NoiseStep::unfiltered, index)));
  for (int i = 1; i <= kLastStep; ++i) {
    const auto step = static_cast<NoiseStep>(i);
    const std::int16_t then = steps.value(before(step), index);
    const std::int16_t now = steps.value(step, index);
    if (then == now) continue;
    text += fmt::format("\n{}: {}", noise_step_words(step), now == kNoData ? "taken out" : value_text(now));
  }
  return text;
}

}  // namespace sonar
