// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "base/hash.h"
#include "base/work.h"
#include "session/open/document.h"
#include "view/echograms/echogram_schools.h"

namespace sonar {

/// What the shadow in an echogram of beams depends on.
struct ShadowWish {
  OpenObservationPtr open;
  ProductPtr product;  ///< its schools that nobody rejected cast the shadow
  EchogramOf of;
  EchogramRange range;
  double least_db = 1.0;  ///< two-way loss
};

/// The shadow that schools cast on an echogram, ping by ping: worked out where pictures are made, since each ping has to be
/// read, and kept as long as the ping's schools are the same.
/// threads  any
class EchogramShadows {
 public:
  /// As far as it is worked out, by ping.
  [[nodiscard]] std::vector<EchogramStretch> so_far(const ShadowWish& wish);
  /// Works out the rest, until the token is cancelled. A ping that cannot be read has no shadow.
  /// before_each  called before a ping is read
  /// more         called whenever some more of it is there, and when all is; never where nothing was missing
  void work_out(const ShadowWish& wish, const CancelToken& token, const std::function<void()>& before_each,
                const std::function<void()>& more);

 private:
  struct Kept {
    Hash128 schools;
    std::vector<EchogramStretch> shadow;
  };
  /// Of what it is.
  struct Of {
    std::weak_ptr<OpenObservation> open;
    EchogramOf of;
    EchogramRange range;
    double least_db = 0.0;
  };
  /// Forgets what is of something else.
  void turn_to(const ShadowWish& wish);
  [[nodiscard]] const Kept* kept(std::int64_t ping, const Hash128& schools) const;

  std::mutex mutex_;
  Of of_;
  std::map<std::int64_t, Kept> pings_;
};

}  // namespace sonar
