// SPDX-License-Identifier: Apache-2.0
#include "session/charts/frequency_model.h"

#include <utility>

#include "session/looks/screen_theme.h"

namespace sonar {

namespace {

constexpr double kReach_px = 8.0;

struct FrequencyWish {
  SchoolWish schools;
  FrequencyParams params;
};

SchoolFans heard_in(const WishedObservation& wished, const LookedAt& there) {
  SchoolFans fans;
  fans.add(*there.mask, there.masks, *there.ping, wished.observation->sector());
  return fans;
}

Result<std::shared_ptr<const FrequencySight>> drawn(const FrequencyWish& wish, const Hearing<SchoolFans>& heard,
                                                    const std::string& words, PixelSize size) {
  const Theme theme = dock_theme(size, wish.schools.look);
  auto sight = std::make_shared<FrequencySight>();
  sight->data.title = "Schools over frequency";
  sight->data.pings = words;
  for (const auto& [index, one] : wish.schools.observations) {
    for (const WishedSchool& school : one.schools) {
      for (FrequencySeries& series :
           frequency_series(heard.sum(index, school.school->number), school.title, school.colour, theme,
                            one.observation->grid().frequency_hz, wish.params.water)) {
        sight->data.series.push_back(std::move(series));
      }
    }
  }
  auto made = frequency_chart(sight->data, size, theme);
  if (!made) return pass_on(made);
  sight->chart = std::move(*made);
  return std::shared_ptr<const FrequencySight>(std::move(sight));
}

Result<void> require_frequencies(const FrequencyWish& wish) {
  for (const auto& [index, one] : wish.schools.observations) {
    const auto known = require_fan_frequencies(one.observation->name(), one.observation->grid().frequency_hz,
                                               one.observation->sector().fans());
    if (!known) return known;
  }
  return {};
}

}  // namespace

FrequencyModel::FrequencyModel(Workspace& workspace)
    : LivePicture(workspace),
      workspace_(workspace),
      asked_(params()),
      heard_(std::make_shared<HeardSchools<SchoolFans>>()) {
  const auto anew = [this] { update(); };
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.school.changed(), anew);
  listening_.to(workspace.chosen_schools.changed(), anew);
  listening_.to(workspace.dark.changed(), anew);
  listening_.to(workspace.picture_file, [this] {
    if (params() == asked_) return;
    asked_ = params();
    update();
  });
}

void FrequencyModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
      heard_ = std::make_shared<HeardSchools<SchoolFans>>();
      sight_.reset();
      return update();
    case DocumentChange::observation:
    case DocumentChange::state:
      return update();
    case DocumentChange::ping:
      if (params().one_ping) update();
      return;
    default:
      return;
  }
}

LivePicture::Build FrequencyModel::build(const PictureLook& look) {
  FrequencyWish wish{school_wish(workspace_, look, params().one_ping), params()};
  if (wish.schools.observations.empty()) {
    if (!look.panel) sight_.reset();
    return {};
  }
  return [wish = std::move(wish), kept = heard_](PixelSize size, const CancelToken& token,
                                                 const Show& show) -> Result<void> {
    if (auto known = require_frequencies(wish); !known) return known;
    Hearing<SchoolFans> heard(wish.schools, *kept, heard_in);
    return heard.run(token, [&](const std::string& words) -> Result<void> {
      auto sight = drawn(wish, heard, words, size);
      if (!sight) return pass_on(sight);
      show({(*sight)->chart.frame, std::nullopt, *sight});
      return {};
    });
  };
}

void FrequencyModel::take(const std::shared_ptr<const void>& detail) {
  sight_ = std::static_pointer_cast<const FrequencySight>(detail);
}

std::string FrequencyModel::hint(PixelPoint at) const {
  if (!sight_ || !problem().empty()) return {};
  const PanelChart::Place* place = sight_->chart.at(at, kReach_px * scale());
  if (place == nullptr) return {};
  const FrequencySeries& series = sight_->data.series[place->curve];
  return frequency_point_text(series, series.points[place->point]);
}

}  // namespace sonar
