// SPDX-License-Identifier: Apache-2.0
#include "session/echograms/echogram_model.h"

#include <algorithm>
#include <utility>

#include "session/review/refused_layer.h"

namespace sonar {
namespace {

/// Empty where no shadow is to be shown, or nothing is there to cast one.
std::optional<ShadowWish> shadow_of(const EchogramWish& wish) {
  if (!wish.display.shadow || !wish.display.masks || !wish.open || !wish.product || !wish.of.echogram) return {};
  return ShadowWish{wish.open, wish.product, wish.of.name.of, wish.of.echogram->range(), wish.display.shadow_db};
}

}  // namespace

EchogramModel::EchogramModel(Workspace& workspace, std::shared_ptr<Echograms> echograms)
    : LivePicture(workspace), workspace_(workspace), echograms_(std::move(echograms)) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.slices.changed(), [this] {
    if (!held_) update();
  });
  listening_.to(workspace.school.changed(), [this] { update(); });
  listening_.to(workspace.echo.changed(), [this] { update(); });
  listening_.to(workspace.display, [this] { update(); });
  listening_.to(workspace.dark.changed(), [this] { update(); });
  listening_.to(workspace.cursor.changed(), [this] { changed().tell(); });
  listening_.to(echograms_->changed(), [this] {
    // Nobody looks: what is being filled may rest.
    if (!seen() && !on_page()) echograms_->want(this, {});
    update();
  });
}

EchogramModel::~EchogramModel() { echograms_->want(this, {}); }

void EchogramModel::forget_places() {
  places_.reset();
  shown_.reset();
  heights_.reset();
  pan_.reset();
  held_.reset();
}

void EchogramModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
      forget_places();
      channel_ = 0;
      return update();
    case DocumentChange::observation: {
      const auto& shown = workspace_.document.shown();
      const auto identity = shown ? shown->identity() : nullptr;
      if (shown_of_.lock() != identity) forget_places();
      shown_of_ = identity;
      return update();
    }
    case DocumentChange::looking:
    case DocumentChange::ping:
      follow_ping();
      return changed().tell();  // the ping on show is an overlay
    case DocumentChange::state:
    case DocumentChange::measures:
      return update();
    case DocumentChange::propagating:
    case DocumentChange::glance:
    case DocumentChange::progress:
    case DocumentChange::notice:
      return;
  }
}

/// The first observation without fans, of those that ran at a time; null = whenever.
std::optional<EchogramName> EchogramModel::channel_at(const TimelineInterval* time) const {
  const SurveyFiles* survey = workspace_.document.survey();
  if (survey == nullptr) return std::nullopt;
  for (std::size_t i = 0; i < survey->observations.size(); ++i) {
    const ObservationFiles& one = survey->observations[i];
    if (one.grid || one.navigation.empty() || one.config.beams.empty()) continue;
    if (time != nullptr && (one.navigation.front().time > time->last || one.navigation.back().time < time->first)) {
      continue;
    }
    EchogramName name{i, {}, {}, channel_ % static_cast<int>(one.config.beams.size())};
    name.of.height = height_;
    return name;
  }
  return std::nullopt;
}

std::optional<EchogramName> EchogramModel::name() const {
  const auto& shown = workspace_.document.shown();
  if (!shown) return channel_at(nullptr);
  const SlicePlaces places = held_.value_or(workspace_.slices());
  EchogramName name{shown->index(), {}, echogram_samples(workspace_.display.values())};
  name.of.fan = std::clamp(places.fan, 0, shown->sector().fans() - 1);
  if (!of_fan_) name.of.beam = std::clamp(places.beam, 0, shown->sector().beams() - 1);
  name.of.height = height_;
  return name;
}

std::optional<EchogramName> EchogramModel::below() const {
  const auto& shown = workspace_.document.shown();
  if (!shown || !other_below_) return std::nullopt;
  const auto& pings = shown->files().navigation;
  const TimelineInterval time{pings.front().time, pings.back().time};
  return channel_at(&time);
}

bool EchogramModel::has_channels() const { return channel_at(nullptr).has_value(); }

LivePicture::Build EchogramModel::build(const PictureLook& look) {
  const auto of = name();
  if (!of) return {};
  const Document& document = workspace_.document;
  EchogramWish wish;
  wish.survey = document.survey_files();
  wish.of = {*of, echograms_->of(*of)};
  std::vector<EchogramName> fill{*of};
  if (const auto other = below()) {
    wish.below = EchogramSoFar{*other, echograms_->of(*other)};
    fill.push_back(*other);
  }
  if (of->channel < 0) {
    wish.open = document.shown();
    wish.survey = {wish.open, &wish.open->survey()};
    wish.product = document.product(of->observation);
    const auto& states = document.choices().states;
    if (const auto found = states.find(of->observation); found != states.end()) wish.state = found->second;
    const auto& school = workspace_.school();
    if (school && school->observation == of->observation) wish.selected = school->number;
    wish.refused = refused_layer(workspace_, of->observation);
    wish.chosen_echo = chosen_echo(workspace_, of->observation);
  }
  echograms_->want(this, std::move(fill));
  wish.display = workspace_.display.values();
  wish.shown = shown_;
  wish.heights = heights_;
  wish.look = look;
  return [wish = std::move(wish), shadows = shadows_, give_way = GivesWay(workspace_.document.right_of_way())](
             PixelSize size, const CancelToken& token, const Show& show) mutable -> Result<void> {
    const auto shadow = shadow_of(wish);
    const auto draw = [&]() -> Result<void> {
      if (shadow) wish.shadow = shadows->so_far(*shadow);
      auto built = built_echogram(wish, size);
      if (!built) return pass_on(built);
      show({std::move(built->frame), std::nullopt, std::move(built->places)});
      return {};
    };
    Result<void> done = draw();
    if (done && shadow) {
      shadows->work_out(
          *shadow, token, [&] { give_way(); }, [&] { done = draw(); });
    }
    return done;
  };
}

std::string EchogramModel::incomplete() const {
  const auto of = name();
  const SurveyFiles* survey = workspace_.document.survey();
  if (survey != nullptr && !survey->raw_gone.empty()) return {};
  return !of || echograms_->complete(*of) ? std::string() : "the echogram is still being read";
}

void EchogramModel::take(const std::shared_ptr<const void>& detail) {
  places_ = std::static_pointer_cast<const EchogramPlaces>(detail);
}

/// Another axis, or other samples: what part of the upright axis is shown no longer means the same.
void EchogramModel::renew() {
  heights_.reset();
  pan_.reset();
  update();
}

void EchogramModel::set_of_fan(bool on) {
  of_fan_ = on;
  update();
}

void EchogramModel::set_along_depth(bool on) {
  height_ = on ? EchogramHeight::depth : EchogramHeight::range;
  renew();
}

void EchogramModel::set_held(bool on) {
  held_ = on ? std::optional(workspace_.slices()) : std::nullopt;
  update();
  changed().tell();
}

void EchogramModel::set_other_below(bool on) {
  other_below_ = on;
  update();
}

void EchogramModel::next_channel() {
  ++channel_;
  update();
}

}  // namespace sonar
