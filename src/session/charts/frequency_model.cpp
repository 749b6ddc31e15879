// SPDX-License-Identifier: Apache-2.0
#include "session/charts/frequency_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "base/number_text.h"
#include "session/screen_theme.h"
#include "session/slices/school_layers.h"
#include "session/survey_schools.h"

namespace sonar {

using StateSchools = std::vector<std::shared_ptr<const StateSchool>>;
using HeardPings = std::map<std::pair<std::int64_t, std::int64_t>, SchoolFans>;  ///< of a school in a ping

/// What was heard of schools already, while they and those beside them stay as they are.
/// threads  any
class HeardSchools {
 public:
  [[nodiscard]] HeardPings of(const OpenObservationPtr& observation, const StateSchools& beside) {
    const std::scoped_lock lock(mutex_);
    return room(observation, beside).pings;
  }
  void add(const OpenObservationPtr& observation, const StateSchools& beside, const HeardPings::key_type& key,
           const SchoolFans& fans) {
    const std::scoped_lock lock(mutex_);
    room(observation, beside).pings[key] = fans;
  }

 private:
  struct Room {
    std::weak_ptr<OpenObservation> observation;  ///< one that was replaced must not be held for it
    StateSchools beside;
    HeardPings pings;
  };
  Room& room(const OpenObservationPtr& observation, const StateSchools& beside) {
    Room& room = rooms_[observation->index()];
    if (room.observation.lock() != observation || room.beside != beside) room = {observation, beside, {}};
    return room;
  }

  std::mutex mutex_;
  std::map<std::size_t, Room> rooms_;
};

namespace {

constexpr std::size_t kMostSchools = 10;  ///< more lines cannot be told apart
constexpr std::size_t kFirstPings = 4;    ///< after which a first chart is shown
constexpr double kReach_px = 8.0;

struct WishedSchool {
  std::shared_ptr<const StateSchool> school;
  std::string title;
  Rgba8 colour;
};

/// Schools of one observation, and all that lie beside them.
struct WishedObservation {
  OpenObservationPtr observation;
  StateSchools beside;
  std::vector<WishedSchool> schools;
};

struct FrequencyWish {
  std::map<std::size_t, WishedObservation> observations;
  std::size_t left_out = 0;  ///< schools that were selected too
  FrequencyParams params;
  std::int64_t ping = -1;  ///< on show
  RightOfWay way;
  PictureLook look;
};

const PingMask* mask_in(const StateSchool& school, std::int64_t ping_index) {
  const auto& pings = school.masks.pings;
  const auto found =
      std::find_if(pings.begin(), pings.end(), [&](const auto& one) { return one.ping_index == ping_index; });
  return found == pings.end() ? nullptr : &found->mask;
}

/// A school in a ping that is to be looked at.
struct Look {
  std::size_t observation = 0;
  std::int64_t ping = 0;
  const StateSchool* school = nullptr;
};

std::vector<Look> looks_of(const FrequencyWish& wish) {
  std::vector<Look> looks;
  for (const auto& [index, one] : wish.observations) {
    for (const WishedSchool& school : one.schools) {
      for (const auto& in_ping : school.school->masks.pings) {
        if (wish.params.one_ping && in_ping.ping_index != wish.ping) continue;
        looks.push_back({index, in_ping.ping_index, school.school.get()});
      }
    }
  }
  return looks;
}

Result<SchoolFans> heard_in(const WishedObservation& wished, const Look& look) {
  OpenObservation& observation = *wished.observation;
  observation.estimate_background(look.ping);
  const auto ping = observation.engine().kept_or_staged(look.ping);
  if (!ping) return pass_on(ping);
  std::vector<const PingMask*> beside;
  for (const auto& school : wished.beside) {
    if (const PingMask* mask = mask_in(*school, look.ping)) beside.push_back(mask);
  }
  SchoolFans fans;
  fans.add(*mask_in(*look.school, look.ping), beside, **ping, observation.sector());
  return fans;
}

/// Looks at the pings of schools, and draws what was heard.
class Hearing {
 public:
  Hearing(const FrequencyWish& wish, HeardSchools& heard, PixelSize size)
      : wish_(wish), kept_(heard), size_(size), looks_(looks_of(wish)), give_way_(wish.way) {
    for (const auto& [index, one] : wish.observations) heard_[index] = heard.of(one.observation, one.beside);
  }

  [[nodiscard]] std::size_t looks() const { return looks_.size(); }

  /// A ping that cannot be read any more tells nothing.
  void look(std::size_t i) {
    const Look& look = looks_[i];
    HeardPings& pings = heard_[look.observation];
    const HeardPings::key_type key(look.school->number, look.ping);
    if (pings.contains(key)) return;
    give_way_();
    const WishedObservation& of = wish_.observations.at(look.observation);
    const auto heard = heard_in(of, look);
    if (!heard) return;
    pings[key] = *heard;
    kept_.add(of.observation, of.beside, key, *heard);
  }

  /// What was heard in the first looks.
  Result<std::shared_ptr<const FrequencySight>> drawn(std::size_t looks) const {
    const Theme theme = dock_theme(size_, wish_.look);
    auto sight = std::make_shared<FrequencySight>();
    sight->data.title = "Schools over frequency";
    sight->data.pings = words(looks);
    for (const auto& [index, one] : wish_.observations) {
      for (const WishedSchool& school : one.schools) add(index, one, school, theme, sight->data);
    }
    auto made = frequency_chart(sight->data, size_, theme);
    if (!made) return pass_on(made);
    sight->chart = std::move(*made);
    return std::shared_ptr<const FrequencySight>(std::move(sight));
  }

 private:
  [[nodiscard]] std::string words(std::size_t looks) const {
    std::set<std::pair<std::size_t, std::int64_t>> pings;
    for (const Look& look : looks_) pings.insert({look.observation, look.ping});
    std::string text = wish_.params.one_ping ? fmt::format("ping {}", wish_.ping) : count_of(pings.size(), "ping");
    if (looks < looks_.size()) text += fmt::format(", {} % looked at", 100 * looks / looks_.size());
    if (wish_.left_out > 0) text += fmt::format("; {} more selected", wish_.left_out);
    return text;
  }

  void add(std::size_t index, const WishedObservation& one, const WishedSchool& school, const Theme& theme,
           FrequencyChartData& data) const {
    SchoolFans fans;
    for (const auto& [of, part] : heard_.at(index)) {
      const bool asked = !wish_.params.one_ping || of.second == wish_.ping;
      if (of.first == school.school->number && asked) fans.add(part);
    }
    for (FrequencySeries& series : frequency_series(fans, school.title, school.colour, theme,
                                                    one.observation->grid().frequency_hz, wish_.params.water)) {
      data.series.push_back(std::move(series));
    }
  }

  const FrequencyWish& wish_;
  HeardSchools& kept_;
  std::map<std::size_t, HeardPings> heard_;
  PixelSize size_;
  std::vector<Look> looks_;
  GivesWay give_way_;
};

Result<void> require_frequencies(const FrequencyWish& wish) {
  for (const auto& [index, one] : wish.observations) {
    const auto known = require_fan_frequencies(one.observation->name(), one.observation->grid().frequency_hz,
                                               one.observation->sector().fans());
    if (!known) return known;
  }
  return {};
}

}  // namespace

FrequencyModel::FrequencyModel(Workspace& workspace)
    : LivePicture(workspace), workspace_(workspace), asked_(params()), heard_(std::make_shared<HeardSchools>()) {
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
      heard_ = std::make_shared<HeardSchools>();
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
  std::vector<SurveySchool> schools = selected_schools(workspace_);
  FrequencyWish wish;
  wish.params = params();
  wish.ping = workspace_.document.ping();
  wish.way = workspace_.document.right_of_way();
  wish.look = look;
  if (schools.size() > kMostSchools) wish.left_out = schools.size() - kMostSchools;
  schools.resize(std::min(schools.size(), kMostSchools));
  const Theme theme = dock_theme(look.size, look);
  for (const SurveySchool& school : schools) {
    WishedObservation& of = wish.observations[school.name.observation];
    of.observation = workspace_.document.open_observation(school.name.observation);
    of.beside = workspace_.document.state(school.name.observation).schools;
    of.schools.push_back(
        {school.state, title_of(workspace_.document, school.name), drawn_colour(*school.state, theme)});
  }
  std::erase_if(wish.observations, [](const auto& one) { return !one.second.observation; });
  if (wish.observations.empty()) {
    if (!look.panel) sight_.reset();
    return {};
  }
  return [wish = std::move(wish), heard = heard_](PixelSize size, const CancelToken& token,
                                                  const Show& show) -> Result<void> {
    if (auto known = require_frequencies(wish); !known) return known;
    Hearing hearing(wish, *heard, size);
    const auto draw = [&](std::size_t looks) -> Result<void> {
      auto sight = hearing.drawn(looks);
      if (!sight) return pass_on(sight);
      show({(*sight)->chart.frame, std::nullopt, *sight});
      return {};
    };
    for (std::size_t done = 0; done < hearing.looks();) {
      hearing.look(done++);
      if (token.cancelled() && done >= kFirstPings) return fail(ErrorCode::cancelled, "another chart is wanted");
      // After 4, 8, 16, ... pings; what is not above the background yet may be so in the end.
      if (done >= kFirstPings && std::has_single_bit(done) && done < hearing.looks()) (void)draw(done);
    }
    return draw(hearing.looks());
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
