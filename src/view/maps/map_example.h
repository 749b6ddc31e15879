// SPDX-License-Identifier: Apache-2.0
#pragma once

// A small product for the tests of maps: a ship sails on a given course at 4 m/s, one ping every 5 s; a sector of 3 fans
// and 4 beams looks to port, 60 samples of 2 m.

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "geo/geodesic.h"
#include "model/product.h"
#include "view/frame_description.h"
#include "view/volume/mask_plan.h"

namespace sonar::map_example {

inline constexpr TimeNs kStart = 1'600'000'000 * kSecondNs;

inline GridRecord grid() {
  GridRecord record;
  record.grid.elevation_deg = {-25.0, -15.0, -5.0};
  record.grid.azimuth_deg = {262.5, 267.5, 272.5, 277.5};
  record.grid.frequency_hz = {75'000.0, 90'000.0, 110'000.0};
  for (int row = 0; row < 12; ++row) record.grid.channel.push_back(row);
  record.grid.vertical_width_deg.assign(12, 10.0);
  record.grid.horizontal_width_deg.assign(12, 5.0);
  record.sample_count = {60, 60, 60};
  record.range = {-1.0, 2.0, 60};
  record.sound_speed_mps = 1490.0;
  return record;
}

/// Neighbouring beams and samples of one fan.
inline PingMask block(int fan, int first_beam, int beams, int first_sample, int samples, std::uint8_t q = 255) {
  PingMask mask;
  for (int b = first_beam; b < first_beam + beams; ++b) mask.runs.push_back({fan * 4 + b, first_sample, samples});
  mask.confidence.assign(static_cast<std::size_t>(beams * samples), q);
  return mask;
}

inline ObservationProduct product(std::string name, int pings, Geographic start = {60.0, 5.0}, double course_deg = 0.0,
                                  TimeNs first = kStart) {
  ObservationProduct p;
  p.observation = std::move(name);
  p.title = "Fish schools of SYNTHETIC example " + p.observation;
  p.grid = grid();
  for (int i = 0; i < pings; ++i) {
    PingNavigation n;
    n.time = first + 5 * kSecondNs * i;
    n.transducer = destination(start, 20.0 * i, course_deg);
    n.heading_deg = course_deg;
    n.course_deg = course_deg;
    n.distance_nmi = 100.0 + 20.0 * i / 1852.0;
    n.transducer_depth_m = 7.0;
    p.pings.push_back(n);
  }
  return p;
}

/// A school at a place, with the same mask in pings first .. last.
inline void add_school(ObservationProduct& p, std::int64_t id, Geographic at, int first, int last,
                       const PingMask& mask) {
  SchoolRow school;
  school.observation = p.observation;
  school.school_id = id;
  school.latitude = at.latitude_deg;
  school.longitude = at.longitude_deg;
  school.sv_mean_db = -45.0;
  school.backscatter_m2 = 0.5;
  for (int i = first; i <= last; ++i) {
    SchoolPingRow row;
    row.school_id = id;
    row.ping_index = i;
    row.time_utc = p.pings[static_cast<std::size_t>(i)].time;
    row.range_m = 60.0;
    p.school_pings.push_back(row);
    p.masks.push_back({id, i, mask});
  }
  p.schools.push_back(school);
}

struct ComparedCells {
  int lit = 0;        ///< where some confidence is expected
  int different = 0;  ///< where the patch has another
};
/// All cells of a raster.
/// expected  confidence that belongs there, 0 = none, of (x, y)
template <class Expected>
ComparedCells compared(const MaskPatch& patch, const PlanRaster& raster, const Expected& expected) {
  ComparedCells cells;
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const int column = x - patch.first_x;
      const int row = y - patch.first_y;
      const bool inside = column >= 0 && column < patch.width && row >= 0 && row < patch.height;
      const int found = inside ? patch.confidence.at(static_cast<std::size_t>(row * patch.width + column)) : 0;
      const int due = expected(x, y);
      cells.lit += due > 0 ? 1 : 0;
      cells.different += found != due ? 1 : 0;
    }
  }
  return cells;
}

/// Whether a text of the picture holds these words.
inline bool says(const FrameDescription& frame, const std::string& words) {
  return std::any_of(frame.items.begin(), frame.items.end(), [&](const auto& item) {
    const auto* t = std::get_if<TextItem>(&item);
    return t != nullptr && t->text.find(words) != std::string::npos;
  });
}

/// One of its images, in their order; null = there are not so many.
inline const ImageItem* image_of(const FrameDescription& frame, int which = 0) {
  for (const auto& item : frame.items) {
    if (const auto* i = std::get_if<ImageItem>(&item); i != nullptr && which-- == 0) return i;
  }
  return nullptr;
}

}  // namespace sonar::map_example
