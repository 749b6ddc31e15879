// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slice_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "pipeline/stages/weak_samples.h"
#include "session/looks/screen_theme.h"
#include "session/review/refused_layer.h"
#include "session/slices/slice_places.h"

namespace sonar {

SliceModel::SliceModel(SliceKind kind, Workspace& workspace, SeedTool& seed, BrushTool& brush)
    : LivePicture(workspace), kind_(kind), workspace_(workspace), seed_(seed), brush_(brush) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  const auto anew = [this] { update(); };
  const auto over = [this] { changed().tell(); };
  const auto recolour = [this] { forget_colours(); };
  listening_.to(workspace.slices.changed(), anew);
  listening_.to(workspace.school.changed(), anew);
  listening_.to(workspace.chosen_schools.changed(), anew);
  listening_.to(workspace.echo.changed(), anew);
  listening_.to(workspace.preview.changed(), anew);
  listening_.to(workspace.dark.changed(), anew);
  listening_.to(workspace.view_curve.changed(), recolour);
  listening_.to(workspace.curve_follows_scale.changed(), recolour);
  listening_.to(workspace.cursor.changed(), over);
  listening_.to(workspace.tool.changed(), over);
  listening_.to(workspace.brush_px.changed(), over);
  listening_.to(workspace.measurement.changed(), over);
  listening_.to(workspace.display, recolour);
  listening_.to(workspace.plane, [this] {
    kind_ == SliceKind::plane ? update() : changed().tell();  // the others show where it cuts them
  });
  listening_.to(workspace.views, over);
}

void SliceModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
    case DocumentChange::observation: {
      const auto& shown = workspace_.document.shown();
      const auto identity = shown ? shown->identity() : nullptr;
      if (change == DocumentChange::observation && identity == of_.lock()) return;
      of_ = identity;
    }
      extent_.reset();
      picture_.reset();
      return update();
    case DocumentChange::ping:
    case DocumentChange::state:
      return update();
    case DocumentChange::propagating:
      if (workspace_.document.propagating().contains(workspace_.document.ping())) update();
      return;
    default:
      return;
  }
}

void SliceModel::forget_colours() {
  colours_.reset();
  update();
}

LivePicture::Build SliceModel::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  if (!document.shown() || !document.staged()) return {};
  SliceWish wish;
  wish.observation = document.shown();
  wish.ping = document.staged();
  wish.display = workspace_.display.values();
  const auto ping = static_cast<std::size_t>(wish.ping->ping_index);
  const double heading_deg = wish.observation->files().navigation[ping].heading_deg;
  const Slice slice = live_slice(workspace_, kind_, wish.ping->ping_index);
  if (picture_ && seen_from_above(picture_->map->view().slice) != seen_from_above(slice)) extent_.reset();
  wish.north_up = seen_from_above(slice) && wish.display.north_up && !std::isnan(heading_deg);
  if (workspace_.slice_in_use().kind == kind_) workspace_.slice_in_use.set({kind_, extent_});
  wish.view = {slice, wish.north_up ? -rad_from_deg(heading_deg) : 0.0, extent_};
  if (!colours_) colours_ = std::make_shared<const SvColours>(slice_colours(workspace_));
  wish.colours = colours_;
  wish.look = look;
  const Theme theme = screen_theme(look.size, look);
  wish.layers = school_layers(workspace_, wish.ping->ping_index, theme);
  wish.refused = refused_layer_in(workspace_, wish.ping->ping_index);
  if (picture_ && !look.panel) wish.earlier = picture_->map;
  wish.room = look.panel ? std::make_shared<FlagRoom>() : room_;  // one picture at a time uses it
  return [wish = std::move(wish)](PixelSize size, const CancelToken&, const Show& show) -> Result<void> {
    auto picture = slice_of(wish, size);
    if (!picture) return pass_on(picture);
    auto detail = std::make_shared<const SlicePicture>(std::move(*picture));
    show({detail->frame, std::nullopt, detail});
    return {};
  };
}

void SliceModel::take(const std::shared_ptr<const void>& detail) {
  const auto before = std::exchange(picture_, std::static_pointer_cast<const SlicePicture>(detail));
  const bool moved = before && !(before->map->view().slice == picture_->map->view().slice);
  // Another slice has come under a pointer that rests.
  if (moved && pointer_) point({PointerAction::move, PointerButton::none, *pointer_});
}

std::optional<Voxel> SliceModel::voxel_at(PixelPoint at) const {
  return picture_ && problem().empty() ? picture_->voxel_at(at) : std::nullopt;
}

std::optional<EchoName> SliceModel::echo_at(PixelPoint at) const {
  const auto& shown = workspace_.document.shown();
  if (!picture_ || !shown) return std::nullopt;
  const auto id = mark_at(picture_->refused, at, mark_reach_px(screen_theme(size(), scale(), workspace_.dark())));
  return id ? std::optional(EchoName{shown->index(), *id}) : std::nullopt;
}

PixelPoint SliceModel::on_map(PixelPoint at) const {
  return {at.x - picture_->plot.place.x, at.y - picture_->plot.place.y};
}

std::string SliceModel::hint(PixelPoint at) const {
  const auto voxel = voxel_at(at);
  const Document& document = workspace_.document;
  if (!voxel || !document.shown() || !document.staged()) return {};
  const ReadOut text = read_out(workspace_, *voxel);
  std::string hint = text.sv;
  if (const std::string& why = text.flags; !why.empty()) hint += "\nremoved: " + why;
  const int row = voxel->fan * document.shown()->sector().beams() + voxel->beam;
  const auto snr_db = signal_to_noise_db(*document.staged(), row, voxel->sample);
  if (snr_db && *snr_db < workspace_.display.values().weak_below_db) {
    hint += fmt::format("\nweak: {:.1f} dB above the noise", *snr_db);
  }
  if (!text.school.empty()) hint += "\n" + text.school;
  if (const auto echo = echo_at(at)) return hint + "\n" + refused_hint(workspace_, *echo);
  // Over a school the preview says which one it is, over what is removed why nothing grows: as the lines before do.
  const Preview& preview = workspace_.preview();
  const bool said = !text.school.empty() || !text.flags.empty();
  if (!preview.text.empty() && (preview.mask || !said)) hint += "\n" + preview.text;
  return hint;
}

}  // namespace sonar
