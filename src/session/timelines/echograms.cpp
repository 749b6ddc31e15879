// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/echograms.h"

#include <algorithm>
#include <utility>

#include "publish/echograms/echogram_cache.h"

namespace sonar {
namespace {

constexpr std::int64_t kAtOnce = 4;              ///< pings between two looks at the token
constexpr std::int64_t kPictures = 24;           ///< of an echogram while it is filled
constexpr std::int64_t kLeastNew = 8;            ///< pings between two of them
constexpr int kWidth_px = 2048;                  ///< what an echogram is kept fine enough for
constexpr std::int64_t kMostCells = 8192 * 512;  ///< of an echogram that is filled here: 100 MB
constexpr std::size_t kMostParts = 6;            ///< echograms of one beam, fan or channel that are kept

int pings_per_column(std::int64_t pings, int bins) {
  int per_column = 1;
  while (pings / per_column * bins > kMostCells) per_column *= 2;
  return per_column;
}

}  // namespace

/// An echogram that is being filled. Touched by the background alone, but for its first members.
struct Echograms::Filling {
  EchogramName name;
  OpenObservationPtr keeps;  ///< what is open anyhow, or opened for this; null for a channel
  std::shared_ptr<const SurveyFiles> survey;
  Recipe recipe;
  IndexCache cache;
  std::uint64_t memory_bytes = 0;

  bool begun = false;
  bool whole = true;  ///< no ping failed for the disk's sake
  EchogramEntry entry;
  std::unique_ptr<ChannelEchogram> channel;
  std::unique_ptr<EchogramPyramid> echogram;
  EchogramPtr done;

  [[nodiscard]] const ObservationFiles& files() const { return survey->observations[name.observation]; }
  [[nodiscard]] std::int64_t pings() const { return std::ssize(files().pings); }
  void begin();
  /// The same observation with more pings.
  void go_on_with(OpenObservationPtr grown);
  void add_next();
  void finish();
  [[nodiscard]] EchogramRange range();
  [[nodiscard]] Result<std::vector<EchogramCell>> column(std::int64_t ping) const;
  /// As fine as a picture needs it; of one beam each ping can be looked at.
  [[nodiscard]] EchogramPtr fine_enough(const EchogramPyramid& all) const {
    const int level = name.all_beams() ? echogram_level(static_cast<std::size_t>(pings()), kWidth_px) : 0;
    return std::make_shared<const EchogramPyramid>(all.coarser(level));
  }
};

EchogramRange Echograms::Filling::range() {
  if (name.channel >= 0) {
    channel = std::make_unique<ChannelEchogram>(*survey, files(), recipe, name.channel, name.of.height);
    return channel->range();
  }
  if (name.all_beams()) return echogram_range(keeps->sector().range());
  std::vector<Placement> placements;
  for (std::int64_t i = 0; i < pings(); ++i) placements.push_back(keeps->placement(i));
  return echogram_range(keeps->sector(), placements, name.of);
}

void Echograms::Filling::begin() {
  begun = true;
  if (!keeps && name.channel < 0) {
    keeps = std::make_shared<OpenObservation>(survey, name.observation, recipe, 0, memory_bytes);
  }
  const EchogramRange bins = range();
  const int per_column = pings_per_column(pings(), bins.bins);
  // What is filled more coarsely than a ping a column is not kept: readers expect every level. Nor is what is of one beam:
  // a survey has hundreds.
  if (per_column == 1 && name.all_beams()) {
    entry =
        echogram_entry(cache, *survey, keeps->files(), recipe_hash(recipe), name.shown.filtered, kNotFiltered, bins);
    const int level = echogram_level(static_cast<std::size_t>(pings()), kWidth_px);
    if (auto kept = kept_echogram(entry, level)) {
      done = std::make_shared<const EchogramPyramid>(std::move(*kept));
      return;
    }
  }
  echogram = std::make_unique<EchogramPyramid>(bins, per_column);
}

void Echograms::Filling::go_on_with(OpenObservationPtr grown) {
  keeps = std::move(grown);
  survey = {keeps, &keeps->survey()};
  done.reset();
  if (!echogram) begun = false;  // it came whole from the cache
  entry = {};                    // not kept while it grows
}

Result<std::vector<EchogramCell>> Echograms::Filling::column(std::int64_t ping) const {
  if (channel) return channel->column(ping);
  const auto staged = keeps->ping(ping);
  if (!staged) return pass_on(staged);
  if (!name.all_beams()) {
    return echogram_column(**staged, keeps->sector(), keeps->placement(ping), name.of, name.shown, echogram->range());
  }
  const Volume& filtered = *(*staged)->filtered;
  const Volume shown{name.shown.filtered ? filtered.counts : (*staged)->sv.counts, filtered.flags};
  return echogram_column(keeps->sector(), shown, kNotFiltered, echogram->range());
}

void Echograms::Filling::add_next() {
  const auto i = static_cast<std::int64_t>(echogram->pings());
  auto cells = column(i);
  if (!cells && cells.error().code != ErrorCode::format) whole = false;
  const PingNavigation& navigation = files().navigation[static_cast<std::size_t>(i)];
  // Clocks may step back; an echogram's times do not.
  const TimeNs least = echogram->times().empty() ? navigation.time : echogram->times().back();
  echogram->add_ping(std::max(least, navigation.time), cells ? *cells : std::vector<EchogramCell>{},
                     navigation.distance_nmi);
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
  parts_.clear();
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

std::int64_t Echograms::pings_of(const EchogramName& name) const {
  if (name.channel < 0) {
    const OpenObservationPtr open = document_.open_observation(name.observation);
    return open ? open->pings() : 0;
  }
  const SurveyFiles* survey = document_.survey();
  const bool there = survey != nullptr && name.observation < survey->observations.size();
  return there ? std::ssize(survey->observations[name.observation].pings) : 0;
}

void Echograms::follow_growth() {
  for (auto& [name, pings] : asked_) {
    const std::int64_t now = pings_of(name);
    if (now <= pings) continue;
    pings = now;
    if (!name.all_beams()) {
      // Its bins may lie elsewhere now: it is filled anew, and what there was is seen until then.
      fillings_.erase(name);
    } else {
      grows_.insert(name);
      if (const auto filling = fillings_.find(name); filling != fillings_.end() && filling->second) {
        background_.post([of = filling->second, open = document_.open_observation(name.observation)](
                             const CancelToken&) { of->go_on_with(open); });
      }
    }
    if (const auto kept = kept_.find(name); kept != kept_.end()) kept->second.complete = false;
  }
  go_on();
}

EchogramPtr Echograms::of(const EchogramName& name) const {
  const auto found = kept_.find(name);
  return found == kept_.end() ? nullptr : found->second.echogram;
}

bool Echograms::complete(const EchogramName& name) const {
  const auto found = kept_.find(name);
  return found != kept_.end() && found->second.complete;
}

void Echograms::want(const void* asker, std::vector<EchogramName> names) {
  for (const EchogramName& name : names) {
    if (name.all_beams()) continue;
    std::erase(parts_, name);
    parts_.push_back(name);
  }
  wanted_[asker] = std::move(names);
  forget_unwanted();
  go_on();
}

void Echograms::forget_unwanted() {
  const auto is_wanted = [this](const EchogramName& name) {
    return std::any_of(wanted_.begin(), wanted_.end(), [&](const auto& of_one) {
      return std::find(of_one.second.begin(), of_one.second.end(), name) != of_one.second.end();
    });
  };
  for (std::size_t i = 0; i < parts_.size() && parts_.size() > kMostParts;) {
    if (is_wanted(parts_[i])) {
      ++i;
      continue;
    }
    kept_.erase(parts_[i]);
    fillings_.erase(parts_[i]);
    asked_.erase(parts_[i]);
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

std::shared_ptr<Echograms::Filling> Echograms::begun(const EchogramName& name) const {
  auto filling = std::make_shared<Filling>();
  filling->name = name;
  if (name.channel < 0) {
    filling->keeps = document_.open_observation(name.observation);
    filling->survey = {document_.shown(), &document_.shown()->survey()};
  } else {
    filling->survey = document_.survey_files();
  }
  filling->recipe = document_.measuring_recipe();
  filling->cache = document_.options().cache;
  filling->memory_bytes = document_.options().memory_bytes;
  return filling;
}

void Echograms::go_on() {
  // An act comes first: its end tells a new state.
  if (reading_ || document_.busy() || document_.survey() == nullptr || !document_.survey()->raw_gone.empty()) return;
  std::optional<EchogramName> next;
  std::size_t best = 0;
  for (const auto& [asker, names] : wanted_) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].channel < 0 && !document_.shown()) continue;
      if (complete(names[i]) || (next && i >= best)) continue;
      next = names[i];
      best = i;
      break;
    }
  }
  if (!next) return;
  auto& filling = fillings_[*next];
  if (!filling) {
    filling = begun(*next);
    asked_[*next] = std::ssize(document_.survey()->observations[next->observation].pings);
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
      const auto found = fillings_.find(filling->name);
      if (found != fillings_.end() && found->second == filling) take(filling->name, picture, complete);
      go_on();
    });
  });
}

void Echograms::take(const EchogramName& name, EchogramPtr echogram, bool complete) {
  if (complete && !grows_.contains(name)) fillings_.erase(name);  // else it goes on from here
  if (!echogram) return;
  kept_[name] = {std::move(echogram), complete};
  changed_.tell();
}

}  // namespace sonar
