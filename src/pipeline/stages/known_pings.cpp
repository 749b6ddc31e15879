// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/known_pings.h"

#include <algorithm>
#include <span>

#include "pipeline/stages/observe.h"
#include "pipeline/survey/observations.h"

namespace sonar {
namespace {

/// Hash of numbers, texts and hashes in order.
class Key {
 public:
  template <class T>
    requires std::is_arithmetic_v<T>
  Key& add(T value) {
    hasher_.add(std::as_bytes(std::span(&value, 1)));
    return *this;
  }
  Key& add(const std::string& text) {
    hasher_.add(text);
    return add(text.size());
  }
  Key& add(const Hash128& hash) { return add(hash.high).add(hash.low); }
  [[nodiscard]] Hash128 value() const { return hasher_.value(); }

 private:
  Hasher hasher_;
};

void add_attitude(Key& key, const PingNavigation& at) {
  key.add(at.bad).add(at.transducer_depth_m).add(at.roll_deg).add(at.pitch_deg);
}

/// What all pings of an observation have in common: may change as pings are added, and then nothing is known any more.
Hash128 of_all(const ObservationFiles& observation, Recipe recipe) {
  recipe.automatic = true;  // whether schools are looked for changes nothing of a ping
  Key key;
  key.add(std::string(kStageVersions)).add(recipe_hash(recipe)).add(identity(observation.config));
  key.add(observation.range.first_m).add(observation.range.spacing_m).add(observation.range.count);
  key.add(observation.sound_speed_mps).add(observation.sound_speed_given);
  key.add(observation.sample_interval_s).add(observation.pulse_length_s);
  for (const std::int32_t count : observation.sample_count) key.add(count);
  for (const ChannelTransmit& sent : observation.transmit) {
    key.add(sent.frequency_hz).add(sent.transmit_power_w).add(sent.pulse_length_s).add(sent.sample_interval_s);
    key.add(sent.sound_speed_mps).add(sent.absorption_db_per_m);
  }
  add_attitude(key, observation.navigation.front());  // backgrounds are cropped by the first ping's geometry
  return key.value();
}

/// Where its bytes lie, and what the files say of it.
Hash128 of_ping(const SurveyFiles& survey, const SurveyPing& ping, const PingNavigation& at) {
  Key key;
  for (const SurveyPing& part : survey.parts(ping)) {
    const PingEntry& entry = survey.entry(part);
    key.add(survey.files[part.file].path.string()).add(entry.offset).add(entry.end).add(entry.time);
    key.add(entry.channels).add(entry.odd_channels);
  }
  add_attitude(key, at);
  return key.value();
}

Hash128 of_place(const Hash128& staged, const PingNavigation& at, const std::string& observation) {
  Key key;
  key.add(staged).add(observation).add(at.time);
  for (const double value : {at.transducer.latitude_deg, at.transducer.longitude_deg, at.heading_deg, at.speed_mps,
                             at.course_deg, at.distance_nmi, at.heave_m}) {
    key.add(value);
  }
  return key.value();
}

}  // namespace

PingKeys::PingKeys(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe) {
  if (observation.pings.empty()) return;
  const Hash128 all = of_all(observation, recipe);
  const auto pings = static_cast<std::int64_t>(observation.pings.size());
  std::vector<Hash128> own;
  for (std::size_t i = 0; i < observation.pings.size(); ++i) {
    own.push_back(of_ping(survey, observation.pings[i], observation.navigation[i]));
    background_.push_back(Key().add(all).add(own.back()).value());
  }
  const std::int64_t side = recipe.background_window.pings_each_side;
  for (std::int64_t i = 0; i < pings; ++i) {
    Key key;
    // One that is not there is no neighbour: the window says where it begins and ends.
    const std::int64_t first = std::max<std::int64_t>(0, i - std::max<std::int64_t>(1, side));
    const std::int64_t last = std::min(pings - 1, i + std::max<std::int64_t>(1, side));
    key.add(i - first).add(last - i);
    for (std::int64_t near = first; near <= last; ++near) key.add(background(near));
    staged_.push_back(key.value());
    placed_.push_back(of_place(staged_.back(), observation.navigation[static_cast<std::size_t>(i)], observation.name));
  }
}

}  // namespace sonar
