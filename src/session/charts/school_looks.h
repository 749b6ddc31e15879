// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "session/looks/picture_look.h"
#include "session/open/ping_cache.h"
#include "session/open/workspace.h"
#include "session/playing/right_of_way.h"

namespace sonar {

using StateSchools = std::vector<std::shared_ptr<const StateSchool>>;

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

/// A chart of the selected schools' samples, as it is asked for.
struct SchoolWish {
  std::map<std::size_t, WishedObservation> observations;
  std::size_t left_out = 0;  ///< schools that were selected too
  bool one_ping = false;     ///< of the ping on show alone
  std::size_t shown = 0;     ///< the observation of the ping on show
  std::int64_t ping = -1;    ///< on show
  RightOfWay way;
  PictureLook look;

  [[nodiscard]] bool asks_for(std::size_t observation, std::int64_t ping_index) const {
    return !one_ping || (observation == shown && ping_index == ping);
  }
};

/// Of the first ten that are selected: more lines cannot be told apart. Without observations where nothing is selected.
[[nodiscard]] SchoolWish school_wish(Workspace& workspace, const PictureLook& look, bool one_ping);

/// A school in a ping that is to be looked at.
struct SchoolLook {
  std::size_t observation = 0;
  std::int64_t ping = 0;
  const StateSchool* school = nullptr;
};
[[nodiscard]] std::vector<SchoolLook> looks_of(const SchoolWish& wish);

/// "12 pings, 25 % looked at; 3 more selected".
/// done  of the looks
[[nodiscard]] std::string looks_words(const SchoolWish& wish, const std::vector<SchoolLook>& looks, std::size_t done);

/// A look's samples, and the masks of its ping.
struct LookedAt {
  StagedPingPtr ping;
  std::vector<const PingMask*> masks;
  const PingMask* mask = nullptr;  ///< the school's, one of the masks
};
/// errors  as Engine::staged()
[[nodiscard]] Result<LookedAt> look_at(const WishedObservation& wished, const SchoolLook& look);

template <class Part>
using HeardPings = std::map<std::pair<std::int64_t, std::int64_t>, Part>;  ///< of a school in a ping

/// What was heard of schools already, while they and those beside them stay as they are.
/// threads  any
template <class Part>
class HeardSchools {
 public:
  using Pings = HeardPings<Part>;
  [[nodiscard]] Pings of(const WishedObservation& wished) {
    const std::scoped_lock lock(mutex_);
    return room(wished).pings;
  }
  void add(const WishedObservation& wished, const typename Pings::key_type& key, const Part& part) {
    const std::scoped_lock lock(mutex_);
    room(wished).pings[key] = part;
  }

 private:
  struct Room {
    std::weak_ptr<OpenObservation> observation;  ///< one that was replaced must not be held for it
    StateSchools beside;
    Pings pings;
  };
  Room& room(const WishedObservation& wished) {
    Room& room = rooms_[wished.observation->index()];
    if (room.observation.lock() != wished.observation || room.beside != wished.beside) {
      room = {wished.observation, wished.beside, {}};
    }
    return room;
  }

  std::mutex mutex_;
  std::map<std::size_t, Room> rooms_;
};

/// Looks at the pings of schools one after the other, and adds up what each gives. The wish outlives it.
template <class Part>
class Hearing {
 public:
  using Hear = std::function<Part(const WishedObservation&, const LookedAt&)>;
  Hearing(const SchoolWish& wish, HeardSchools<Part>& kept, Hear hear)
      : wish_(wish), kept_(kept), hear_(std::move(hear)), looks_(looks_of(wish)), give_way_(wish.way) {
    for (const auto& [index, one] : wish.observations) heard_[index] = kept.of(one);
  }

  /// Draws what was heard after 4, 8, 16, ... pings and in the end; what could not be drawn before may be so in the end.
  /// draw    of the words below the title
  /// errors  cancelled, once something could be seen; as draw() in the end
  Result<void> run(const CancelToken& token, const std::function<Result<void>(const std::string& words)>& draw) {
    constexpr std::size_t kFirstPings = 4;
    for (std::size_t done = 0; done < looks_.size();) {
      look(looks_[done++]);
      if (done < kFirstPings) continue;
      if (token.cancelled()) return fail(ErrorCode::cancelled, "another chart is wanted");
      if (std::has_single_bit(done) && done < looks_.size()) (void)draw(looks_words(wish_, looks_, done));
    }
    return draw(looks_words(wish_, looks_, looks_.size()));
  }

  /// Of all pings that are asked for and were looked at.
  [[nodiscard]] Part sum(std::size_t observation, std::int64_t number) const {
    Part all;
    for (const auto& [of, part] : heard_.at(observation)) {
      if (of.first == number && wish_.asks_for(observation, of.second)) all.add(part);
    }
    return all;
  }

 private:
  /// A ping that cannot be read any more tells nothing.
  void look(const SchoolLook& look) {
    HeardPings<Part>& pings = heard_[look.observation];
    const typename HeardPings<Part>::key_type key(look.school->number, look.ping);
    if (pings.contains(key)) return;
    give_way_();
    const WishedObservation& of = wish_.observations.at(look.observation);
    const auto there = look_at(of, look);
    if (!there) return;
    pings[key] = hear_(of, *there);
    kept_.add(of, key, pings[key]);
  }

  const SchoolWish& wish_;
  HeardSchools<Part>& kept_;
  Hear hear_;
  std::map<std::size_t, HeardPings<Part>> heard_;
  std::vector<SchoolLook> looks_;
  GivesWay give_way_;
};

}  // namespace sonar
