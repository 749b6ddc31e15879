// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "signal/median_box.h"

namespace sonar {

// The layout in which the median's network works: one plane of lanes a slice. Internal to this room.

/// A plane holds every beam of a slice, fan by fan, with one replicated beam on each side and one replicated fan below
/// and above: a neighbour in beam is one lane away, a neighbour in fan one stride.
struct PlaneLayout {
  int fans = 0;
  int beams = 0;
  int lanes = 0;  ///< of a vector
  int fan_stride = 0;
  int first_output = 0;  ///< lane of the first beam of the first fan: a multiple of `lanes`
  int strips = 0;        ///< vectors that hold outputs
  int plane = 0;         ///< lanes of a plane

  PlaneLayout(Shape3 shape, int vector_lanes)
      : fans(shape.fans), beams(shape.beams), lanes(vector_lanes), fan_stride(shape.beams + 2) {
    const int before = fan_stride + 1;
    first_output = (before + lanes - 1) / lanes * lanes;
    const int outputs = (fans - 1) * fan_stride + beams;
    strips = (outputs + lanes - 1) / lanes;
    const int last = first_output + strips * lanes + fan_stride + 1;
    plane = (last + 15) / 16 * 16;
  }

  /// Where lane p comes from; clamped to the grid.
  struct Place {
    int fan;
    int beam;
    bool output;  ///< not a replica
  };
  [[nodiscard]] Place place(int p) const {
    const int from_corner = p - first_output + fan_stride + 1;
    if (from_corner < 0) return {0, 0, false};
    const int fan = from_corner / fan_stride - 1;
    const int beam = from_corner % fan_stride - 1;
    const auto clamp = [](int i, int n) { return i < 0 ? 0 : (i < n ? i : n - 1); };
    return {clamp(fan, fans), clamp(beam, beams), fan >= 0 && fan < fans && beam >= 0 && beam < beams};
  }
};

/// Cache-aligned memory that keeps its size between pings; one for each thread.
class PlaneMemory {
 public:
  std::int16_t* at_least(std::size_t counts) {
    if (counts > size_) {
      // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): its deleter knows the alignment
      memory_.reset(new (std::align_val_t{64}) std::int16_t[counts]);
      size_ = counts;
    }
    return memory_.get();
  }

 private:
  struct Free {
    void operator()(std::int16_t* p) const { ::operator delete[](p, std::align_val_t{64}); }
  };
  std::unique_ptr<std::int16_t[], Free> memory_;
  std::size_t size_ = 0;
};

}  // namespace sonar
