// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geo/frames.h"
#include "model/outline.h"
#include "model/product.h"

namespace sonar {

/// One frame of metres for all pings of an observation: x east, y north, z up from the mean sea surface, about the place of
/// its first ping that has position and heading. Tangent plane: good to centimetres over a few kilometres.
class LocalFrame {
 public:
  /// Empty where no ping has position and heading.
  [[nodiscard]] static std::optional<LocalFrame> of(const ObservationProduct& product);

  [[nodiscard]] const Geographic& origin() const { return origin_; }

  /// From one ping's sector into the frame.
  class Ping {
   public:
    Ping(const PingNavigation& ping, const Geographic& origin);
    [[nodiscard]] Point<Enu> place(const Point<Sonar>& p) const;

   private:
    PlaneShift into_;
    Placement placement_;
  };
  /// Empty where the ping has no position or no heading.
  [[nodiscard]] std::optional<Ping> ping(const PingNavigation& ping) const;

 private:
  explicit LocalFrame(const Geographic& origin) : origin_(origin) {}
  Geographic origin_;
};

}  // namespace sonar
