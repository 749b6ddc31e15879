// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/navigation.h"
#include "synth/body.h"
#include "synth/field.h"
#include "synth/layout.h"
#include "synth/truth.h"

namespace sonar::synth {

/// Gathers the bodies of one school in one ping into a row of bodies.csv.
class BodyMeasure {
 public:
  explicit BodyMeasure(const Layout& layout) : layout_(layout) {}
  void add(const Body& body, const Scatterers& scatterers, const Point<Enu>& centre_from_transducer, double seconds);
  /// seen  the school's scatterers in reach
  [[nodiscard]] BodyTruth row(const std::vector<SeenScatterer>& seen, const PingNavigation& navigation, int school_id,
                              int ping) const;

 private:
  struct Part {
    const Body* body = nullptr;
    const Scatterers* scatterers = nullptr;
    Point<Enu> centre;
    Point<Enu> velocity;
  };
  void measure_extents(BodyTruth& row) const;
  [[nodiscard]] double inside_backscatter_m2(const std::vector<SeenScatterer>& seen) const;

  const Layout& layout_;
  std::vector<Part> parts_;
};

/// The beam-corrected columns of a school's row are the body's own figures.
void complete_from_body(SchoolPingRow& row, const std::vector<BodyTruth>& bodies);

}  // namespace sonar::synth
