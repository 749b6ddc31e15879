// SPDX-License-Identifier: Apache-2.0
#include "session/maps/strip_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/looks/screen_theme.h"
#include "session/maps/strip_panels.h"

namespace sonar {
namespace {

constexpr double kStill_px = 3.0;
constexpr double kNarrowest_em = 7.0;  ///< of a pane
constexpr double kAround_em = 12.0;    ///< of title, labels and scale, above and below the panes
constexpr int kLeastPanes = 3;

}  // namespace

const StripPlaces::Pane* StripPlaces::pane_at(PixelPoint at) const {
  const auto found = std::find_if(panes.begin(), panes.end(), [&](const Pane& pane) {
    return at.x >= pane.place.x && at.x < pane.place.x + pane.place.width;
  });
  return found == panes.end() ? nullptr : &*found;
}

StripModel::StripModel(Workspace& workspace) : LivePicture(workspace), workspace_(workspace) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.school.changed(), [this] { update(); });
  listening_.to(workspace.dark.changed(), [this] { update(); });
  listening_.to(workspace.display, [this] { update(); });
}

void StripModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
    case DocumentChange::observation:
      running_.clear();
      places_.reset();
      follow();
      return update();
    case DocumentChange::looking:
    case DocumentChange::ping:
      follow();
      return update();
    case DocumentChange::propagating:
      keep_running(running_, workspace_.document.propagating());
      return update();
    case DocumentChange::state:
      return update();
    case DocumentChange::measures:
    case DocumentChange::glance:
    case DocumentChange::progress:
    case DocumentChange::notice:
      return;
  }
}

int StripModel::panes() const { return panes_in({size(), scale(), false, {}}); }

int StripModel::panes_in(const PictureLook& look) const {
  const double em = dock_theme(look.size, look).text_px;
  const double wide = look.size.width - 2.0 * em;
  const double high = std::max(kNarrowest_em * em, look.size.height - kAround_em * em);
  const int most = std::max(1, static_cast<int>(wide / (kNarrowest_em * em)));
  const int suggested = std::clamp(static_cast<int>(wide / std::min(high, 2.0 * kNarrowest_em * em)), 1, most);
  return std::clamp(std::max(suggested, std::min(kLeastPanes, most)) + more_panes_, 1, most);
}

std::int64_t StripModel::first_of(int panes) const {
  const auto& shown = workspace_.document.shown();
  const std::int64_t last = shown ? std::max<std::int64_t>(0, shown->pings() - panes) : 0;
  return std::clamp<std::int64_t>(centre_ - panes / 2, 0, last);
}

std::int64_t StripModel::last_first() const {
  const auto& shown = workspace_.document.shown();
  return shown ? std::max<std::int64_t>(0, shown->pings() - panes()) : 0;
}

std::int64_t StripModel::first() const { return first_of(panes()); }

/// A ping that was clicked in the strip stays where it is; every other comes to the middle.
void StripModel::follow() {
  const std::int64_t ping = workspace_.document.ping();
  if (ping == clicked_) return;
  clicked_ = -1;
  centre_ = ping;
}

void StripModel::scroll_to(std::int64_t first) {
  const std::int64_t to = std::clamp<std::int64_t>(first, 0, last_first());
  if (to == this->first()) return;
  centre_ = to + panes() / 2;
  update();
}

LivePicture::Build StripModel::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  if (!document.shown()) return {};
  StripWish wish;
  wish.observation = document.shown();
  const std::size_t index = wish.observation->index();
  if (const auto found = document.choices().states.find(index); found != document.choices().states.end()) {
    wish.state = found->second;
  }
  wish.running = running_;
  wish.panes = panes_in(look);
  wish.first = first_of(wish.panes);
  wish.ping = document.ping();
  if (workspace_.school() && workspace_.school()->observation == index) wish.selected = workspace_.school()->number;
  const DisplayParams& display = workspace_.display.values();
  wish.rejected = display.rejected;
  wish.searched = document.detected(index);
  wish.style.aspect = aspect_;
  wish.style.one_row = true;
  wish.style.palette = {.colouring = MaskColouring::schools,
                        .core_at = display.core_at,
                        .fuzzy_above = display.fuzzy_above,
                        .rejected = wish.state ? rejected_schools(*wish.state) : std::vector<bool>{}};
  if (!running_.empty()) {
    wish.carried = document.followed();
    wish.style.focus = static_cast<int>(wish.carried.value_or(wish.state ? wish.state->next_number : 1));
  } else if (wish.selected > 0) {
    wish.style.focus = static_cast<int>(wish.selected);
  }
  wish.look = look;
  return [wish = std::move(wish)](PixelSize size, const CancelToken&, const Show& show) -> Result<void> {
    const MaskedPings masks = masked_pings(wish.state, wish.running, wish.rejected, wish.carried);
    const auto panels = strip_panels(wish, masks);
    const Theme theme = dock_theme(size, wish.look);
    const Sector& sector = wish.observation->sector();
    auto frame = propagation_view(sector, panels, wish.style, size, theme, strip_title(wish));
    if (!frame) return pass_on(frame);
    const auto rects = propagation_places(sector, panels, wish.style, size, theme);
    if (!rects) return pass_on(rects);
    auto places = std::make_shared<StripPlaces>();
    for (std::size_t i = 0; i < panels.size(); ++i) {
      places->panes.push_back({panels[i].ping_index, (*rects)[i], !panels[i].masks.empty(), panels[i].note});
    }
    show({std::move(*frame), std::nullopt, std::move(places)});
    return {};
  };
}

void StripModel::take(const std::shared_ptr<const void>& detail) {
  places_ = std::static_pointer_cast<const StripPlaces>(detail);
}

void StripModel::set_aspect(MaskAspect aspect) {
  if (aspect == aspect_) return;
  aspect_ = aspect;
  update();
}

void StripModel::pointer(const PointerEvent& event) {
  switch (event.action) {
    case PointerAction::wheel: {
      wheel_ += event.wheel_steps;
      const int steps = static_cast<int>(std::trunc(wheel_));
      wheel_ -= steps;
      if (steps == 0) return;
      if (!event.control) return scroll_to(first() - steps);
      const int before = panes();
      more_panes_ -= steps;
      if (panes() == before) more_panes_ += steps;
      follow();
      return update();
    }
    case PointerAction::press:
      if (event.button == PointerButton::left || event.button == PointerButton::middle) {
        press_ = {event.at, first(), false};
      }
      return;
    case PointerAction::move: {
      if (!press_ || event.button == PointerButton::none || !places_ || places_->panes.empty()) return;
      const double moved_px = event.at.x - press_->at.x;
      press_->moved = press_->moved || std::abs(moved_px) > kStill_px * scale();
      const double pane_px = std::max(1.0, places_->panes.front().place.width);
      if (press_->moved) scroll_to(press_->first - static_cast<std::int64_t>(std::llround(moved_px / pane_px)));
      return;
    }
    case PointerAction::release: {
      const bool clicked = press_ && !press_->moved && event.button == PointerButton::left;
      press_.reset();
      const auto* pane = clicked && places_ ? places_->pane_at(event.at) : nullptr;
      if (pane == nullptr) return;
      clicked_ = pane->ping;
      return workspace_.document.look_at(pane->ping);
    }
    case PointerAction::pan:
    case PointerAction::zoom:
    case PointerAction::double_press:
    case PointerAction::leave:
      return;
  }
}

bool StripModel::aim(PixelPoint at) {
  const auto* pane = places_ ? places_->pane_at(at) : nullptr;
  if (pane == nullptr) return true;
  clicked_ = pane->ping;
  workspace_.document.look_at(pane->ping);
  return true;
}

std::string StripModel::hint(PixelPoint at) const {
  const auto* pane = places_ ? places_->pane_at(at) : nullptr;
  if (pane == nullptr) return {};
  return pane->note.empty() ? fmt::format("ping {}", pane->ping) : fmt::format("ping {}: {}", pane->ping, pane->note);
}

}  // namespace sonar
