// SPDX-License-Identifier: Apache-2.0
#include "school/measure/edges.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "model/school.h"
#include "school/runs.h"

namespace sonar {
namespace {

constexpr SampleFlags kCropped = SampleFlags::near_field | SampleFlags::surface;

class FaceCount {
 public:
  FaceCount(const PingMask& mask, View3<const SampleFlags> flags, const Sector& sector)
      : mask_(mask),
        flags_(flags),
        shape_(flags.shape()),
        rows_(index_rows(mask.runs, flags.shape().rows())),
        cropped_(flags.shape().rows(), -1),
        last_is_fore_(std::cos(sector.azimuth_rad(sector.beams() - 1)) > std::cos(sector.azimuth_rad(0))) {}

  MaskEdges count() {
    for (const Run& run : mask_.runs) {
      end_face(run.row, run.first_sample - 1, kEdgeNear);
      end_face(run.row, run.end(), kEdgeFar);
      side(run, 1, 0, kEdgeTopFan);
      side(run, -1, 0, kEdgeBottomFan);
      side(run, 0, 1, last_is_fore_ ? kEdgeFore : kEdgeAft);
      side(run, 0, -1, last_is_fore_ ? kEdgeAft : kEdgeFore);
    }
    const auto share = [&](std::int64_t part) {
      return faces_ > 0 ? static_cast<double>(part) / static_cast<double>(faces_) : 0.0;
    };
    return {found_, share(at_edge_), share(at_boundary_), share(at_seabed_)};
  }

 private:
  void end_face(int row, int sample, EdgeFlags border) {
    if (sample < 0 || sample >= shape_.samples) return add(border, 1);
    const auto flags = flags_.row(row);
    const SampleFlags beyond = flags[static_cast<std::size_t>(sample)];
    if (border == kEdgeFar && any(beyond & SampleFlags::dropout)) {
      // A beam without any sample has no end: it is a fault, wherever the mask lies in it.
      const int end = recorded_end(flags);
      if (end > 0 && sample >= end) return add(kEdgeFar, 1);
    }
    classify(beyond, 0);
  }

  /// One past the last sample that the beam recorded.
  static int recorded_end(std::span<const SampleFlags> flags) {
    auto end = static_cast<int>(flags.size());
    while (end > 0 && any(flags[static_cast<std::size_t>(end - 1)] & SampleFlags::dropout)) --end;
    return end;
  }

  void side(const Run& run, int by_fan, int by_beam, EdgeFlags border) {
    const int fan = run.row / shape_.beams + by_fan;
    const int beam = run.row % shape_.beams + by_beam;
    if (fan < 0 || fan >= shape_.fans || beam < 0 || beam >= shape_.beams) return add(border, run.count);
    const int row = fan * shape_.beams + beam;
    const std::int32_t outside = cropped(row) ? static_cast<std::int32_t>(border) : 0;
    const auto flags = flags_.row(row);
    const auto r = static_cast<std::size_t>(row);
    const auto others =
        std::span(mask_.runs)
            .subspan(static_cast<std::size_t>(rows_[r]), static_cast<std::size_t>(rows_[r + 1] - rows_[r]));
    for_each_uncovered(run, others, [&](int first, int end) {
      for (int s = first; s < end; ++s) classify(flags[static_cast<std::size_t>(s)], outside);
    });
  }

  bool cropped(int row) {
    signed char& known = cropped_[static_cast<std::size_t>(row)];
    if (known < 0) {
      known = 1;
      for (const SampleFlags flag : flags_.row(row)) {
        if (any(flag & kCropped)) continue;
        known = 0;
        break;
      }
    }
    return known == 1;
  }

  void classify(SampleFlags beyond, std::int32_t also) {
    std::int32_t edges = also;
    if (any(beyond & SampleFlags::near_field)) edges |= kEdgeNear;
    if (any(beyond & SampleFlags::surface)) edges |= kEdgeSurface;
    if (any(beyond & SampleFlags::seabed)) edges |= kEdgeSeabed;
    if (any(beyond & kFault)) edges |= kEdgeFlagged;
    add(edges, 1);
    if (any(beyond & SampleFlags::seabed)) {
      ++at_seabed_;
    } else if (any(beyond & kNeverMember)) {
      ++at_boundary_;
    }
  }

  void add(std::int32_t edges, int faces) {
    found_ |= edges;
    faces_ += faces;
    if ((edges & kTouchesEdge) != 0) at_edge_ += faces;
  }

  const PingMask& mask_;
  View3<const SampleFlags> flags_;
  Shape3 shape_;
  std::vector<int> rows_;
  std::vector<signed char> cropped_;
  bool last_is_fore_;
  std::int32_t found_ = 0;
  std::int64_t faces_ = 0;
  std::int64_t at_edge_ = 0;
  std::int64_t at_boundary_ = 0;
  std::int64_t at_seabed_ = 0;
};

}  // namespace

MaskEdges mask_edges(const PingMask& mask, View3<const SampleFlags> flags, const Sector& sector) {
  return FaceCount(mask, flags, sector).count();
}

}  // namespace sonar
