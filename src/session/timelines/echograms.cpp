// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/echograms.h"

#include <algorithm>
#include <utility>

#include "publish/echogram_cache.h"

namespace sonar {
namespace {

constexpr std::int64_t kAtOnce = 4;          ///< pings between two looks at the token
constexpr std::int64_t kPictures = 24;       ///< of an echogram while it is filled
constexpr std::int64_t kLeastNew = 8;        ///< pings between two of them
constexpr int kWidth_px = 2048;              ///< what an echogram is kept fine enough for
constexpr std::int64_t kMostColumns = 8192;  ///< of an echogram that is filled here: 100 MB

int pings_per_column(std::int64_t pings) {
  int per_column = 1;
  while (pings / per_column > kMostColumns) per_column *= 2;
  return per_column;
}

}  // namespace

/// An echogram that is being filled. Touched by the background alone, but for its first members.
struct Echograms::Filling {
  OpenObservationPtr keeps;  ///< what is open anyhow, or opened for this
  std::shared_ptr<const SurveyFiles> survey;
  std::size_t index = 0;
  Recipe recipe;
  IndexCache cache;
  std::uint64_t memory_bytes = 0;

  bool begun = false;
  bool whole = true;  ///< no ping failed for the disk's sake
  EchogramEntry entry;
  std::unique_ptr<EchogramPyramid> echogram;
  EchogramPtr done;

  [[nodiscard]] std::int64_t pings() const { return keeps->pings(); }
  void begin();
  /// The same observation with more pings.
  void go_on_with(OpenObservationPtr grown);
  void add_next();
  void finish();
  [[nodiscard]] EchogramPtr fine_enough(const EchogramPyramid& all) const {
    return std::make_shared<const EchogramPyramid>(
        all.coarser(echogram_level(static_cast<std::size_t>(pings()), kWidth_px)));
  }
};

void Echograms::Filling::begin() {
  begun = true;
  if (!keeps) keeps = std::make_shared<OpenObservation>(survey, index, recipe, 0, memory_bytes);
  const EchogramRange range = echogram_range(keeps->sector().range());
  const int per_column = pings_per_column(pings());
  // What is filled more coarsely than a ping a column is not kept: readers expect every level.
  if (per_column == 1) {
    entry = echogram_entry(cache, *survey, keeps->files(), recipe_hash(recipe), false, kNotFiltered, range);
    const int level = echogram_level(static_cast<std::size_t>(pings()), kWidth_px);
    if (auto kept = kept_echogram(entry, level)) {
      done = std::make_shared<const EchogramPyramid>(std::move(*kept));
      return;
    }
  }
  echogram = std::make_unique<EchogramPyramid>(range, per_column);
}

void Echograms::Filling::go_on_with(OpenObservationPtr grown) {
  keeps = std::move(grown);
  survey = {keeps, &keeps->survey()};
  done.reset();
  if (!echogram) begun = false;  // it came whole from the cache
  entry = {};                    // not kept while it grows
}

void Echograms::Filling::add_next() {
  const auto i = static_cast<std::int64_t>(echogram->pings());
  const auto ping = keeps->ping(i);
  std::vector<EchogramCell> column;
  if (ping) {
    const Volume shown{(*ping)->sv.counts, (*ping)->filtered->flags};
    column = echogram_column(keeps->sector(), shown, kNotFiltered, echogram->range());
  } else if (ping.error().code != ErrorCode::format) {
    whole = false;
  }
  const PingNavigation& navigation = keeps->files().navigation[static_cast<std::size_t>(i)];
  // Clocks may step back; an echogram's times do not.
  const TimeNs least = echogram->times().empty() ? navigation.time : echogram->times().back();
  echogram->add_ping(std::max(least, navigation.time), column, navigation.distance_nmi);
}

void Echograms::Filling::finish() {
  if (whole) keep_echogram(entry, *echogram);
  done = fine_enough(*echogram);
}

Echograms::Echograms(ChangeQueue& queue, Document& document) : queue_(queue), document_(document) {
  listening_.to(document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::survey) forget();
    if (change == DocumentChange::observation) {
      follow_calibration();
      follow_growth();
    }
    if (change == DocumentChange::state || change == DocumentChange::ping) go_on();
  });
}

Echograms::~Echograms() = default;

void Echograms::forget() {
  kept_.clear();
  wanted_.clear();
  fillings_.clear();
  asked_.clear();
  grows_.clear();
  changed_.tell();
}

void Echograms::follow_calibration() {
  std::string hash = recipe_hash(document_.measuring_recipe());
  if (hash == recipe_) return;
  const bool other = !recipe_.empty();
  recipe_ = std::move(hash);
  if (!other) return;
  kept_.clear();
  fillings_.clear();
  changed_.tell();
}

void Echograms::follow_growth() {
  for (auto& [index, pings] : asked_) {
    const OpenObservationPtr now = document_.open_observation(index);
    if (!now || now->pings() <= pings) continue;
    pings = now->pings();
    grows_.insert(index);
    if (const auto filling = fillings_.find(index); filling != fillings_.end() && filling->second) {
      background_.post([of = filling->second, now](const CancelToken&) { of->go_on_with(now); });
    }
    if (const auto kept = kept_.find(index); kept != kept_.end()) kept->second.complete = false;
  }
  go_on();
}

EchogramPtr Echograms::of(std::size_t observation) const {
  const auto found = kept_.find(observation);
  return found == kept_.end() ? nullptr : found->second.echogram;
}

bool Echograms::complete(std::size_t observation) const {
  const auto found = kept_.find(observation);
  return found != kept_.end() && found->second.complete;
}

void Echograms::want(const void* asker, std::vector<std::size_t> observations) {
  wanted_[asker] = std::move(observations);
  go_on();
}

void Echograms::go_on() {
  // An act comes first: its end tells a new state.
  if (reading_ || document_.busy() || !document_.shown()) return;
  std::optional<std::size_t> next;
  std::size_t best = 0;
  for (const auto& [asker, observations] : wanted_) {
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (complete(observations[i]) || (next && i >= best)) continue;
      next = observations[i];
      best = i;
      break;
    }
  }
  if (!next) return;
  auto& filling = fillings_[*next];
  if (!filling) {
    filling = std::make_shared<Filling>();
    filling->keeps = document_.open_observation(*next);
    filling->survey = {document_.shown(), &document_.shown()->survey()};
    filling->index = *next;
    filling->recipe = document_.measuring_recipe();
    filling->cache = document_.options().cache;
    filling->memory_bytes = document_.options().memory_bytes;
    asked_[*next] = std::ssize(document_.survey()->observations[*next].pings);
  }
  read(filling);
}

void Echograms::read(const std::shared_ptr<Filling>& filling) {
  reading_ = true;
  background_.post([this, filling, give_way = GivesWay(document_.right_of_way())](const CancelToken& token) mutable {
    if (!filling->begun) filling->begin();
    EchogramPtr picture = filling->done;
    if (!picture) {
      const std::int64_t pings = filling->pings();
      const std::int64_t step = std::max(kLeastNew, pings / kPictures);
      for (std::int64_t i = 0; i < kAtOnce && !token.cancelled(); ++i) {
        const auto have = static_cast<std::int64_t>(filling->echogram->pings());
        if (have >= pings) break;
        give_way();
        filling->add_next();
        if ((have + 1) % step == 0) picture = filling->fine_enough(*filling->echogram);
      }
      if (static_cast<std::int64_t>(filling->echogram->pings()) >= pings) {
        filling->finish();
        picture = filling->done;
      }
    }
    queue_.post([this, alive = std::weak_ptr<bool>(alive_), filling, picture, complete = filling->done != nullptr] {
      if (alive.expired()) return;
      reading_ = false;
      // Of a survey that was closed meanwhile nothing is kept.
      const auto found = fillings_.find(filling->index);
      if (found != fillings_.end() && found->second == filling) take(filling->index, picture, complete);
      go_on();
    });
  });
}

void Echograms::take(std::size_t observation, EchogramPtr echogram, bool complete) {
  if (complete && !grows_.contains(observation)) fillings_.erase(observation);  // else it goes on from here
  if (!echogram) return;
  kept_[observation] = {std::move(echogram), complete};
  changed_.tell();
}

}  // namespace sonar
