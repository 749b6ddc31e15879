// SPDX-License-Identifier: Apache-2.0
#include "session/charts/school_looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/number_text.h"
#include "session/looks/screen_theme.h"
#include "session/open/survey_schools.h"
#include "session/slices/school_layers.h"

namespace sonar {
namespace {

constexpr std::size_t kMostSchools = 10;

const PingMask* mask_in(const StateSchool& school, std::int64_t ping_index) {
  const auto* found = in_ping(school.masks, ping_index);
  return found == nullptr ? nullptr : &found->mask;
}

}  // namespace

SchoolWish school_wish(Workspace& workspace, const PictureLook& look, bool one_ping) {
  const Document& document = workspace.document;
  std::vector<SurveySchool> schools = selected_schools(workspace);
  SchoolWish wish;
  wish.one_ping = one_ping;
  if (document.shown()) wish.shown = document.shown()->index();
  wish.ping = document.ping();
  wish.way = workspace.document.right_of_way();
  wish.look = look;
  if (schools.size() > kMostSchools) wish.left_out = schools.size() - kMostSchools;
  schools.resize(std::min(schools.size(), kMostSchools));
  const Theme theme = dock_theme(look.size, look);
  for (const SurveySchool& school : schools) {
    if (!school.observation) continue;
    WishedObservation& of = wish.observations[school.name.observation];
    of.observation = school.observation;
    of.beside = document.state(school.name.observation).schools;
    of.schools.push_back({school.state, title_of(document, school.name), drawn_colour(*school.state, theme)});
  }
  return wish;
}

std::vector<SchoolLook> looks_of(const SchoolWish& wish) {
  std::vector<SchoolLook> looks;
  for (const auto& [index, one] : wish.observations) {
    for (const WishedSchool& school : one.schools) {
      for (const auto& there : school.school->masks.pings) {
        if (wish.asks_for(index, there.ping_index)) looks.push_back({index, there.ping_index, school.school.get()});
      }
    }
  }
  return looks;
}

std::string looks_words(const SchoolWish& wish, const std::vector<SchoolLook>& looks, std::size_t done) {
  std::set<std::pair<std::size_t, std::int64_t>> pings;
  for (const SchoolLook& look : looks) pings.insert({look.observation, look.ping});
  std::string text = wish.one_ping ? fmt::format("ping {}", wish.ping) : count_of(pings.size(), "ping");
  if (done < looks.size()) text += fmt::format(", {} % looked at", 100 * done / looks.size());
  if (wish.left_out > 0) text += fmt::format("; {} more selected", wish.left_out);
  return text;
}

Result<LookedAt> look_at(const WishedObservation& wished, const SchoolLook& look) {
  OpenObservation& observation = *wished.observation;
  observation.estimate_background(look.ping);
  auto ping = observation.engine().kept_or_staged(look.ping);
  if (!ping) return pass_on(ping);
  LookedAt out{std::move(*ping), {}, mask_in(*look.school, look.ping)};
  for (const auto& school : wished.beside) {
    if (const PingMask* mask = mask_in(*school, look.ping)) out.masks.push_back(mask);
  }
  return out;
}

}  // namespace sonar
