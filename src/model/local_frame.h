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
    Ping(const Placement& ping, const Geographic& origin);
    /// Levelled and bent as the placement has it.
    [[nodiscard]] Point<Enu> place(const Point<Sonar>& p) const;

   private:
    PlaneShift into_;
    Placement placement_;
  };
  /// placement  of the ping, with how its beams turn and bend
  /// Empty where the ping has no position or no heading.
  [[nodiscard]] std::optional<Ping> ping(const PingNavigation& ping, const Placement& placement) const;

 private:
  explicit LocalFrame(const Geographic& origin) : origin_(origin) {}
  Geographic origin_;
};

}  // namespace sonar
