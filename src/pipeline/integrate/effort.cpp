// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/effort.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "geo/geodesic.h"
#include "school/track/dead_reckoning.h"

namespace sonar {
namespace {

/// What a ping is part of: two pings of one transect, or of one stretch off effort, have the same.
struct Part {
  std::string name;
  std::string stratum;
  EffortType type = EffortType::transect;
  friend bool operator==(const Part&, const Part&) = default;
};

Part part_at(std::span<const Transect> transects, TimeNs time) {
  const Transect* found = nullptr;
  for (const Transect& one : transects) {
    if (!one.holds(time)) continue;
    if (one.type == EffortType::off) return {one.name, one.stratum, EffortType::off};
    found = &one;
  }
  if (found == nullptr) return {"", "", EffortType::off};
  return {found->name, found->stratum, EffortType::transect};
}

/// Puts one ping after the other into units.
class Cutter {
 public:
  Cutter(double edsu_m, Effort& effort) : edsu_m_(edsu_m), effort_(effort) {}

  /// follows  the ship sailed here from the ping before
  std::size_t add(const Part& part, const PingNavigation& ping, const Geographic& place, bool follows) {
    if (follows && last_ && last_part_ == part) sail(part, geodesic(last_place_, place).distance_m);
    const std::size_t unit = part.type == EffortType::off ? stretch(part) : edsu_of(part);
    effort_.units[unit].times.push_back(ping.time);
    effort_.units[unit].transducers.push_back(ping.transducer);
    last_ = unit;
    last_part_ = part;
    last_place_ = place;
    return unit;
  }

 private:
  void sail(const Part& part, double metres) {
    effort_.units[*last_].sailed_m += metres;
    if (part.type == EffortType::transect) sailed_m_[part.name] += metres;
  }

  std::size_t stretch(const Part& part) {
    if (last_ && last_part_ == part) return *last_;
    return begin(part, 0, 0.0);
  }

  std::size_t edsu_of(const Part& part) {
    const double from = sailed_m_[part.name];
    const auto number = static_cast<std::int64_t>(from / edsu_m_) + 1;
    const auto [known, is_new] = edsus_.try_emplace({part.name, number}, effort_.units.size());
    return is_new ? begin(part, number, from) : known->second;
  }

  std::size_t begin(const Part& part, std::int64_t number, double from_m) {
    EffortUnit unit;
    unit.stratum = part.stratum;
    unit.transect = part.name;
    unit.type = part.type;
    unit.edsu = number;
    unit.from_m = from_m;
    effort_.units.push_back(std::move(unit));
    return effort_.units.size() - 1;
  }

  double edsu_m_;
  Effort& effort_;
  std::map<std::string, double> sailed_m_;  ///< on each transect
  std::map<std::pair<std::string, std::int64_t>, std::size_t> edsus_;
  std::optional<std::size_t> last_;
  Part last_part_;
  Geographic last_place_;
};

std::vector<std::string> transects_without_pings(std::span<const Transect> transects,
                                                 std::span<const EffortUnit> units) {
  std::vector<std::string> names;
  for (const Transect& one : transects) {
    if (one.type != EffortType::transect) continue;
    const bool sailed = std::any_of(units.begin(), units.end(), [&](const EffortUnit& unit) {
      return unit.type == EffortType::transect && unit.transect == one.name;
    });
    if (!sailed) names.push_back(one.name);
  }
  return names;
}

}  // namespace

Effort sailed_effort(const SurveyFiles& survey, std::span<const Transect> transects, double edsu_m) {
  Effort effort;
  Cutter cutter(edsu_m, effort);
  std::optional<Sounder> sonar;
  std::string whole;  // the observation that others go on from
  for (std::size_t i = 0; i < survey.observations.size(); ++i) {
    const ObservationFiles& observation = survey.observations[i];
    const Sounder sounder = sounder_of(observation.config);
    if (!observation.grid || (sonar && *sonar != sounder)) {
      effort.left_out.push_back(observation.name);
      continue;
    }
    sonar = sounder;
    if (!observation.continues_cut || whole.empty()) whole = observation.name;
    const DeadReckoning reckoned = dead_reckoning(observation.navigation);
    ObservationEffort own{i, {}};
    for (std::size_t ping = 0; ping < observation.navigation.size(); ++ping) {
      const PingNavigation& at = observation.navigation[ping];
      const Part part = transects.empty() ? Part{whole, "", EffortType::transect} : part_at(transects, at.time);
      const bool follows = ping > 0 || observation.continues_cut;
      own.unit.push_back(cutter.add(part, at, reckoned.pings[ping].transducer, follows));
    }
    effort.observations.push_back(std::move(own));
  }
  effort.without_pings = transects_without_pings(transects, effort.units);
  return effort;
}

}  // namespace sonar
