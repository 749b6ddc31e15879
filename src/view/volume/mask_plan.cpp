// SPDX-License-Identifier: Apache-2.0
#include "view/volume/mask_plan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "model/outline.h"

namespace sonar {
namespace {

struct Interval {
  double near_m;
  double far_m;
};

/// A wedge that grows as voxels come.
class Profile {
 public:
  void put(const Interval& i, double bin_m, std::uint8_t confidence) {
    // Bins whose middle lies in the interval; at least the one that holds its middle. Where edges fall on middles (a
    // first range of a whole number of samples) rounding must not lose a bin: both neighbours take it.
    constexpr double kTie = 1e-6;
    auto first = static_cast<std::int32_t>(std::ceil(i.near_m / bin_m - 0.5 - kTie));
    auto end = static_cast<std::int32_t>(std::floor(i.far_m / bin_m - 0.5 + kTie)) + 1;
    if (end <= first) {
      first = static_cast<std::int32_t>(std::floor((i.near_m + i.far_m) / 2.0 / bin_m));
      end = first + 1;
    }
    first = std::max(first, 0);
    if (end <= first) return;
    reach(first, end);
    for (std::int32_t b = first; b < end; ++b) {
      std::uint8_t& bin = wedge_.bins[static_cast<std::size_t>(b - wedge_.first_bin)];
      bin = std::max(bin, confidence);
    }
  }
  [[nodiscard]] MaskWedge take(const AngleBounds& bounds) {
    wedge_.first_rad = bounds.lower;
    wedge_.last_rad = bounds.upper;
    return std::move(wedge_);
  }
  [[nodiscard]] bool empty() const { return wedge_.bins.empty(); }

 private:
  void reach(std::int32_t first, std::int32_t end) {
    if (wedge_.bins.empty()) {
      wedge_.first_bin = first;
      wedge_.bins.assign(static_cast<std::size_t>(end - first), 0);
      return;
    }
    if (first < wedge_.first_bin) {
      wedge_.bins.insert(wedge_.bins.begin(), static_cast<std::size_t>(wedge_.first_bin - first), 0);
      wedge_.first_bin = first;
    }
    const auto needed = static_cast<std::size_t>(end - wedge_.first_bin);
    if (needed > wedge_.bins.size()) wedge_.bins.resize(needed, 0);
  }
  MaskWedge wedge_;
};

Interval slant_interval(const RangeAxis& axis, int sample) {
  return {std::max(0.0, axis.range_m(sample) - axis.spacing_m / 2.0),
          std::max(0.0, axis.range_m(sample) + axis.spacing_m / 2.0)};
}

/// Calls f(run, confidences of its voxels) for every run that lies in the sector's rows.
template <class F>
void each_run(const Sector& sector, const PingMask& mask, const F& f) {
  std::size_t next = 0;
  const int rows = sector.fans() * sector.beams();
  for (const Run& run : mask.runs) {
    const auto count = static_cast<std::size_t>(std::max(0, run.count));
    if (next + count > mask.confidence.size()) return;
    if (run.row >= 0 && run.row < rows) f(run, mask.confidence.data() + next);
    next += count;
  }
}

/// A box that grows over cells.
struct Box {
  double low_x = std::numeric_limits<double>::infinity();
  double low_y = std::numeric_limits<double>::infinity();
  double high_x = -std::numeric_limits<double>::infinity();
  double high_y = -std::numeric_limits<double>::infinity();
  void add(double x, double y) {
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
    low_y = std::min(low_y, y);
    high_y = std::max(high_y, y);
  }
};

/// From a plan's plane to cells.
class ToCells {
 public:
  explicit ToCells(const PlanRaster& r) : raster_(r), det_(r.x_step_u * r.y_step_v - r.x_step_v * r.y_step_u) {}
  [[nodiscard]] bool sound() const { return std::isfinite(det_) && det_ != 0.0; }
  void add(Box& box, double u, double v) const {
    const PlanePoint p = at(u, v);
    box.add(p.x, p.y);
  }
  /// In cells: whole numbers are middles.
  [[nodiscard]] PlanePoint at(double u, double v) const {
    const double du = u - raster_.origin_u;
    const double dv = v - raster_.origin_v;
    return {(du * raster_.y_step_v - dv * raster_.y_step_u) / det_,
            (dv * raster_.x_step_u - du * raster_.x_step_v) / det_};
  }

 private:
  const PlanRaster& raster_;
  double det_;
};

/// Corners of a wedge between two distances, its outer arc included.
Box box_of(const MaskWedge& w, double bin_m, const ToCells& cells) {
  Box box;
  const double near_m = w.first_bin * bin_m;
  const double far_m = (w.first_bin + static_cast<double>(w.bins.size())) * bin_m;
  const int steps = std::max(2, static_cast<int>(std::ceil((w.last_rad - w.first_rad) / 0.05)));
  for (int i = 0; i <= steps; ++i) {
    const double a = w.first_rad + (w.last_rad - w.first_rad) * i / steps;
    cells.add(box, near_m * std::cos(a), near_m * std::sin(a));
    // The arc bulges between its corners by less than this.
    cells.add(box, 1.0004 * far_m * std::cos(a), 1.0004 * far_m * std::sin(a));
  }
  return box;
}

struct CellBox {
  int first_x, first_y, end_x, end_y;
};

CellBox clamped(const Box& b, int width, int height) {
  const auto cell = [](double v, int most) { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(most))); };
  if (!(b.low_x <= b.high_x)) return {0, 0, 0, 0};
  return {cell(std::floor(b.low_x - 0.5), width), cell(std::floor(b.low_y - 0.5), height),
          cell(std::floor(b.high_x + 0.5) + 1.0, width), cell(std::floor(b.high_y + 0.5) + 1.0, height)};
}

/// Nothing lit in the cells of a box that the raster has.
MaskPatch dark_patch(const Box& box, const PlanRaster& raster) {
  MaskPatch patch;
  const CellBox whole = clamped(box, raster.width, raster.height);
  if (whole.end_x <= whole.first_x || whole.end_y <= whole.first_y) return patch;
  patch.first_x = whole.first_x;
  patch.first_y = whole.first_y;
  patch.width = whole.end_x - whole.first_x;
  patch.height = whole.end_y - whole.first_y;
  patch.confidence.assign(static_cast<std::size_t>(patch.width) * static_cast<std::size_t>(patch.height), 0);
  return patch;
}

void light(MaskPatch& patch, int x, int y, std::uint8_t q) {
  if (x < patch.first_x || x >= patch.first_x + patch.width || y < patch.first_y || y >= patch.first_y + patch.height) {
    return;
  }
  std::uint8_t& cell =
      patch.confidence[static_cast<std::size_t>(y - patch.first_y) * static_cast<std::size_t>(patch.width) +
                       static_cast<std::size_t>(x - patch.first_x)];
  cell = std::max(cell, q);
}

void light(MaskPatch& patch, const PlanePoint& at, std::uint8_t q) {
  light(patch, static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)), q);
}

/// Wedges are narrower than half a turn: two cross products tell on which side of the bounds a cell lies.
void paint(const MaskWedge& w, double bin_m, const PlanRaster& r, const CellBox& box, MaskPatch& patch) {
  const double cos1 = std::cos(w.first_rad);
  const double sin1 = std::sin(w.first_rad);
  const double cos2 = std::cos(w.last_rad);
  const double sin2 = std::sin(w.last_rad);
  const double inverse = 1.0 / bin_m;
  const auto bins = static_cast<std::int32_t>(w.bins.size());
  for (int y = box.first_y; y < box.end_y; ++y) {
    for (int x = box.first_x; x < box.end_x; ++x) {
      const double u = r.origin_u + x * r.x_step_u + y * r.y_step_u;
      const double v = r.origin_v + x * r.x_step_v + y * r.y_step_v;
      if (cos1 * v - sin1 * u < 0.0 || cos2 * v - sin2 * u >= 0.0) continue;
      const auto bin = static_cast<std::int32_t>(std::sqrt(u * u + v * v) * inverse) - w.first_bin;
      if (bin < 0 || bin >= bins) continue;
      const std::uint8_t q = w.bins[static_cast<std::size_t>(bin)];
      if (q > 0) light(patch, x, y, q);
    }
  }
}

/// Each lit bin lights the cell of its own middle.
void stamp(const MaskWedge& w, double bin_m, const ToCells& cells, MaskPatch& patch) {
  const double a = (w.first_rad + w.last_rad) / 2.0;
  for (std::size_t i = 0; i < w.bins.size(); ++i) {
    if (w.bins[i] == 0) continue;
    const double d = (w.first_bin + static_cast<double>(i) + 0.5) * bin_m;
    light(patch, cells.at(d * std::cos(a), d * std::sin(a)), w.bins[i]);
  }
}

/// Cells of one confidence from above.
struct LitRings {
  std::vector<Ring> rings;          ///< in cells
  std::vector<PlanePoint> middles;  ///< of its voxels, in cells
  std::uint8_t confidence = 0;
};

/// What follows of a run from a sample on with the same confidence.
/// q  of the run's voxels
Run of_one_confidence(const Run& run, int sample, const std::uint8_t* q) {
  const std::uint8_t* from = q + (sample - run.first_sample);
  const std::uint8_t* end = std::find_if(from, q + run.count, [&](std::uint8_t other) { return other != *from; });
  return {run.row, sample, static_cast<std::int32_t>(end - from)};
}

LitRings lit_rings(const Sector& sector, const Run& run, std::uint8_t confidence, const Placement& bow_up,
                   const ToCells& cells) {
  LitRings out{mask_rings(sector, {{run}, {}}, bow_up), {}, confidence};
  for (Ring& ring : out.rings) {
    for (PlanePoint& p : ring) p = cells.at(p.y, p.x);
  }
  if (out.rings.empty()) return out;  // no attitude is known
  for (std::int32_t s = run.first_sample; s < run.end(); ++s) {
    const SectorIndex voxel{static_cast<double>(run.row / sector.beams()),
                            static_cast<double>(run.row % sector.beams()), static_cast<double>(s)};
    const Point<Sonar> middle = levelled(sector.place_at(voxel), bow_up);
    out.middles.push_back(cells.at(middle.x, middle.y));
  }
  return out;
}

/// The whole numbers of low .. high that are `first` or more and less than `end`.
std::pair<int, int> whole_numbers(double low, double high, int first, int end) {
  const auto within = [&](double v) { return static_cast<int>(std::clamp<double>(v, first, end)); };
  return {within(std::ceil(low)), within(std::floor(high) + 1.0)};
}

/// Lights the cells whose middles a ring holds.
void fill(const Ring& ring, std::uint8_t q, MaskPatch& patch) {
  if (ring.empty()) return;
  const auto [top, bottom] =
      std::minmax_element(ring.begin(), ring.end(), [](const PlanePoint& a, const PlanePoint& b) { return a.y < b.y; });
  const auto [first_y, end_y] = whole_numbers(top->y, bottom->y, patch.first_y, patch.first_y + patch.height);
  std::vector<double> crossings;
  for (int y = first_y; y < end_y; ++y) {
    crossings.clear();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const PlanePoint& a = ring[i];
      const PlanePoint& b = ring[(i + 1) % ring.size()];
      if ((a.y > y) != (b.y > y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const auto [first_x, end_x] =
          whole_numbers(crossings[i], crossings[i + 1], patch.first_x, patch.first_x + patch.width);
      for (int x = first_x; x < end_x; ++x) light(patch, x, y, q);
    }
  }
}

}  // namespace

MaskPlan plan_from_above(const Sector& sector, const PingMask& mask, double bin_m) {
  std::vector<Profile> beams(static_cast<std::size_t>(sector.beams()));
  each_run(sector, mask, [&](const Run& run, const std::uint8_t* q) {
    const AngleBounds e = sector.elevation_bounds(run.row / sector.beams());
    const bool level = e.lower < 0.0 && e.upper > 0.0;
    const double a = std::max(0.0, std::cos(e.lower));
    const double b = std::max(0.0, std::cos(e.upper));
    Profile& beam = beams[static_cast<std::size_t>(run.row % sector.beams())];
    for (std::int32_t s = run.first_sample; s < run.end(); ++s, ++q) {
      const Interval slant = slant_interval(sector.range(), s);
      beam.put({slant.near_m * std::min(a, b), slant.far_m * (level ? 1.0 : std::max(a, b))}, bin_m, *q);
    }
  });
  MaskPlan plan;
  plan.bin_m = bin_m;
  for (int beam = 0; beam < sector.beams(); ++beam) {
    Profile& p = beams[static_cast<std::size_t>(beam)];
    if (!p.empty()) plan.wedges.push_back(p.take(sector.azimuth_bounds(beam)));
  }
  return plan;
}

MaskPlan plan_from_side(const Sector& sector, const PingMask& mask, double bin_m) {
  std::vector<Profile> fans(static_cast<std::size_t>(sector.fans()));
  each_run(sector, mask, [&](const Run& run, const std::uint8_t* q) {
    Profile& fan = fans[static_cast<std::size_t>(run.row / sector.beams())];
    for (std::int32_t s = run.first_sample; s < run.end(); ++s, ++q) {
      fan.put(slant_interval(sector.range(), s), bin_m, *q);
    }
  });
  MaskPlan plan;
  plan.bin_m = bin_m;
  for (int fan = 0; fan < sector.fans(); ++fan) {
    Profile& p = fans[static_cast<std::size_t>(fan)];
    if (!p.empty()) plan.wedges.push_back(p.take(sector.elevation_bounds(fan)));
  }
  return plan;
}

MaskPatch patch_of(const MaskPlan& plan, const PlanRaster& raster) {
  MaskPatch patch;
  const ToCells cells(raster);
  if (!cells.sound() || plan.wedges.empty()) return patch;
  Box all;
  std::vector<CellBox> boxes;
  for (const MaskWedge& w : plan.wedges) {
    const Box box = box_of(w, plan.bin_m, cells);
    all.add(box.low_x, box.low_y);
    all.add(box.high_x, box.high_y);
    boxes.push_back(clamped(box, raster.width, raster.height));
  }
  patch = dark_patch(all, raster);
  if (patch.empty()) return patch;
  for (std::size_t i = 0; i < plan.wedges.size(); ++i) {
    paint(plan.wedges[i], plan.bin_m, raster, boxes[i], patch);
    stamp(plan.wedges[i], plan.bin_m, cells, patch);
  }
  return patch;
}

MaskPatch patch_from_above(const Sector& sector, const PingMask& mask, const Placement& placement,
                           const PlanRaster& raster) {
  const ToCells cells(raster);
  if (!cells.sound()) return {};
  // Seen from above with the bow to the north, east is starboard.
  Placement bow_up = placement;
  bow_up.heading_rad = 0.0;
  std::vector<LitRings> lit;
  Box all;
  each_run(sector, mask, [&](const Run& run, const std::uint8_t* q) {
    for (int s = run.first_sample; s < run.end();) {
      const Run alike = of_one_confidence(run, s, q);
      lit.push_back(lit_rings(sector, alike, q[s - run.first_sample], bow_up, cells));
      for (const Ring& ring : lit.back().rings) {
        for (const PlanePoint& p : ring) all.add(p.x, p.y);
      }
      s = alike.end();
    }
  });
  MaskPatch patch = dark_patch(all, raster);
  if (patch.empty()) return patch;
  for (const LitRings& cell : lit) {
    for (const Ring& ring : cell.rings) fill(ring, cell.confidence, patch);
    for (const PlanePoint& middle : cell.middles) light(patch, middle, cell.confidence);
  }
  return patch;
}

}  // namespace sonar
