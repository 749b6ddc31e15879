// SPDX-License-Identifier: Apache-2.0
#include "synth/truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar::synth {
namespace {

constexpr double kMemberBelowStrongest_db = 10.0;
constexpr std::uint8_t kCertain = 255;

struct Voxel {
  int fan;
  int beam;
  int sample;
};

/// sv of a school in a voxel of the whole grid; 0 outside its box.
float sv_at(const SchoolField& field, const Voxel& v) {
  const Shape3 box = field.sv.shape();
  const int fan = v.fan - field.first_fan;
  const int beam = v.beam - field.first_beam;
  const int sample = v.sample - field.first_sample;
  if (fan < 0 || fan >= box.fans || beam < 0 || beam >= box.beams || sample < 0 || sample >= box.samples) return 0.0F;
  return field.sv(fan, beam, sample);
}

/// One school of one ping, measured.
class Judge {
 public:
  Judge(const TruthInput& in, const std::vector<SchoolField>& fields, std::size_t school)
      : in_(in), fields_(fields), school_(school), field_(fields[school]) {
    float strongest = 0.0F;
    for_each_recorded([&](const Voxel&, float sv) { strongest = std::max(strongest, sv); });
    threshold_ = static_cast<float>(static_cast<double>(strongest) / linear_from_db(kMemberBelowStrongest_db));
  }

  [[nodiscard]] std::optional<SchoolTruth> truth() {
    SchoolTruth t;
    collect(t.mask);
    if (t.mask.empty()) return std::nullopt;
    t.row.school_id = field_.school_id;
    t.row.ping_index = in_.ping_index;
    t.row.time_utc = in_.navigation.time;
    place(t.row);
    extents(t.row);
    strength(t.row);
    edges(t.row);
    return t;
  }

 private:
  template <class Use>
  void for_each_recorded(const Use& use) const {
    const Shape3 box = field_.sv.shape();
    for (int fan = 0; fan < box.fans; ++fan) {
      for (int beam = 0; beam < box.beams; ++beam) {
        const int count = limits(field_.first_fan + fan, field_.first_beam + beam).count;
        const auto row = field_.sv.row(fan, beam);
        const int end = std::min(box.samples, count - field_.first_sample);
        for (int s = std::max(0, -field_.first_sample); s < end; ++s) {
          use(Voxel{field_.first_fan + fan, field_.first_beam + beam, field_.first_sample + s},
              row[static_cast<std::size_t>(s)]);
        }
      }
    }
  }

  [[nodiscard]] int row_of(int fan, int beam) const { return fan * in_.grid.beams() + beam; }
  [[nodiscard]] const RowLimits& limits(int fan, int beam) const {
    return in_.limits[static_cast<std::size_t>(row_of(fan, beam))];
  }

  /// The stronger school takes a voxel; of equals the one with the smaller id.
  [[nodiscard]] bool strongest_here(const Voxel& v, float sv) const {
    for (std::size_t other = 0; other < fields_.size(); ++other) {
      if (other == school_) continue;
      const float theirs = sv_at(fields_[other], v);
      if (theirs > sv || (theirs == sv && other < school_)) return false;
    }
    return true;
  }

  [[nodiscard]] bool member(const Voxel& v, float sv) const {
    if (!(sv > 0.0F) || sv < threshold_ || !limits(v.fan, v.beam).member(v.sample)) return false;
    return static_cast<double>(sv) > in_.background_sv(row_of(v.fan, v.beam), v.sample) && strongest_here(v, sv);
  }

  void collect(PingMask& mask) {
    members_ = Array3<std::uint8_t>(field_.sv.shape());
    for_each_recorded([&](const Voxel& v, float sv) {
      if (!member(v, sv)) return;
      members_(v.fan - field_.first_fan, v.beam - field_.first_beam, v.sample - field_.first_sample) = 1;
      voxels_.push_back(v);
      const int row = row_of(v.fan, v.beam);
      if (mask.runs.empty() || mask.runs.back().row != row || mask.runs.back().end() != v.sample) {
        mask.runs.push_back({row, v.sample, 0});
      }
      ++mask.runs.back().count;
      mask.confidence.push_back(kCertain);
    });
    runs_ = mask.runs;
  }

  [[nodiscard]] double volume(const Voxel& v) const { return in_.sector.volume_m3(v.fan, v.beam, v.sample); }

  void place(SchoolPingRow& row) {
    double sum = 0.0;
    Point<Sonar> centre;
    for (const Voxel& v : voxels_) {
      const double m3 = volume(v);
      sum += m3;
      centre = centre + in_.sector.centre(v.fan, v.beam, v.sample) * m3;
    }
    centre = centre * (1.0 / sum);
    heading_rad_ = rad_from_deg(in_.navigation.heading_deg);
    centre_ = to_enu(centre, heading_rad_);
    const Geographic at = to_geographic(centre_, in_.navigation.transducer);
    row.latitude = at.latitude_deg;
    row.longitude = at.longitude_deg;
    row.depth_m = in_.navigation.transducer_depth_m + centre.z;
    row.range_m = norm(centre);
    row.bearing_deg = wrap_360(deg_from_rad(std::atan2(centre_.x, centre_.y)));
    row.volume_m3 = sum;
  }

  /// Bearing of the long axis of the horizontal spread, radians in 0..pi.
  [[nodiscard]] double axis_rad() const {
    double ee = 0.0;
    double en = 0.0;
    double nn = 0.0;
    for (const Voxel& v : voxels_) {
      const Point<Enu> p = to_enu(in_.sector.centre(v.fan, v.beam, v.sample), heading_rad_) - centre_;
      const double m3 = volume(v);
      ee += m3 * p.x * p.x;
      en += m3 * p.x * p.y;
      nn += m3 * p.y * p.y;
    }
    const double axis = 0.5 * std::atan2(2.0 * en, nn - ee);
    return axis < 0.0 ? axis + std::numbers::pi : axis;
  }

  void extents(SchoolPingRow& row) const {
    double axis = axis_rad();
    Extent along;
    Extent across;
    Extent down;
    const double half = in_.sector.range().spacing_m / 2.0;
    for (const Run& run : runs_) {
      const AngleBounds e = in_.sector.elevation_bounds(run.row / in_.grid.beams());
      const AngleBounds a = in_.sector.azimuth_bounds(run.row % in_.grid.beams());
      const std::array<double, 2> ranges = {in_.sector.range().range_m(run.first_sample) - half,
                                            in_.sector.range().range_m(run.end() - 1) + half};
      for (int corner = 0; corner < 8; ++corner) {
        const Point<Sonar> direction =
            Sector::direction((corner & 1) != 0 ? e.upper : e.lower, (corner & 2) != 0 ? a.upper : a.lower);
        const Point<Sonar> p = direction * ranges[static_cast<std::size_t>((corner & 4) >> 2)];
        const Point<Enu> q = to_enu(p, heading_rad_);
        along.add(q.x * std::sin(axis) + q.y * std::cos(axis));
        across.add(q.x * std::cos(axis) - q.y * std::sin(axis));
        down.add(in_.navigation.transducer_depth_m + p.z);
      }
    }
    if (across.size() > along.size())
      axis = axis < std::numbers::pi / 2 ? axis + std::numbers::pi / 2 : axis - std::numbers::pi / 2;
    row.length_m = std::max(along.size(), across.size());
    row.width_m = std::min(along.size(), across.size());
    row.axis_deg = deg_from_rad(axis);
    row.depth_min_m = down.least;
    row.depth_max_m = down.most;
    row.height_m = down.size();
  }

  void strength(SchoolPingRow& row) const {
    std::vector<double> values;
    double backscatter = 0.0;
    double background = 0.0;
    for (const Voxel& v : voxels_) {
      const double m3 = volume(v);
      values.push_back(static_cast<double>(sv_at(field_, v)));
      backscatter += values.back() * m3;
      background += in_.background_sv(row_of(v.fan, v.beam), v.sample) * m3;
    }
    std::sort(values.begin(), values.end());
    row.n_voxels = static_cast<std::int64_t>(values.size());
    row.sv_mean_db = db_from_linear(backscatter / row.volume_m3);
    row.sv_p95_db = db_from_linear(values[values.size() * 95 / 100]);
    row.sv_max_db = db_from_linear(values.back());
    row.backscatter_m2 = backscatter;
    row.valid_fraction = 1.0;
    row.snr_db = db_from_linear(backscatter / background);
    row.threshold_db = db_from_linear(static_cast<double>(threshold_));
    std::vector<bool> fans(static_cast<std::size_t>(in_.grid.fans()));
    std::vector<bool> beams(static_cast<std::size_t>(in_.grid.beams()));
    for (const Voxel& v : voxels_) {
      fans[static_cast<std::size_t>(v.fan)] = true;
      beams[static_cast<std::size_t>(v.beam)] = true;
    }
    row.n_fans = std::count(fans.begin(), fans.end(), true);
    row.n_beams = std::count(beams.begin(), beams.end(), true);
  }

  [[nodiscard]] bool is_member(const Voxel& v) const {
    const Shape3 box = members_.shape();
    const int fan = v.fan - field_.first_fan;
    const int beam = v.beam - field_.first_beam;
    const int sample = v.sample - field_.first_sample;
    return fan >= 0 && fan < box.fans && beam >= 0 && beam < box.beams && sample >= 0 && sample < box.samples &&
           members_(fan, beam, sample) != 0;
  }

  /// Which limit lies in a voxel beside a member; 0 = none.
  [[nodiscard]] std::int32_t limit_at(const Voxel& v) const {
    if (v.beam < 0) return kEdgeAft;
    if (v.beam >= in_.grid.beams()) return kEdgeFore;
    if (v.fan < 0) return kEdgeBottomFan;
    if (v.fan >= in_.grid.fans()) return kEdgeTopFan;
    const RowLimits& l = limits(v.fan, v.beam);
    if (v.sample < l.near_end) return kEdgeNear;
    if (v.sample >= l.count) return kEdgeFar;
    if (v.sample >= l.seabed_begin) return kEdgeSeabed;
    return v.sample >= l.surface_begin ? kEdgeSurface : 0;
  }

  void edges(SchoolPingRow& row) const {
    std::int64_t outer = 0;
    std::int64_t at_limit = 0;
    std::int32_t flags = 0;
    for (const Voxel& v : voxels_) {
      const std::array<Voxel, 6> neighbours = {{{v.fan - 1, v.beam, v.sample},
                                                {v.fan + 1, v.beam, v.sample},
                                                {v.fan, v.beam - 1, v.sample},
                                                {v.fan, v.beam + 1, v.sample},
                                                {v.fan, v.beam, v.sample - 1},
                                                {v.fan, v.beam, v.sample + 1}}};
      for (const Voxel& n : neighbours) {
        if (is_member(n)) continue;
        const std::int32_t limit = limit_at(n);
        ++outer;
        at_limit += limit != 0 ? 1 : 0;
        flags |= limit;
      }
    }
    row.edge_flags = flags;
    row.touches_edge = (flags & kTouchesEdge) != 0 ? 1 : 0;
    row.edge_fraction = static_cast<double>(at_limit) / static_cast<double>(outer);
  }

  struct Extent {
    double least = std::numeric_limits<double>::max();
    double most = std::numeric_limits<double>::lowest();
    void add(double v) {
      least = std::min(least, v);
      most = std::max(most, v);
    }
    [[nodiscard]] double size() const { return most - least; }
  };

  const TruthInput& in_;
  const std::vector<SchoolField>& fields_;
  std::size_t school_;
  const SchoolField& field_;
  float threshold_ = 0.0F;
  double heading_rad_ = 0.0;
  Point<Enu> centre_;
  Array3<std::uint8_t> members_;  ///< in the field's box
  std::vector<Voxel> voxels_;
  std::vector<Run> runs_;
};

}  // namespace

std::vector<SchoolTruth> school_truth(const TruthInput& in, const std::vector<SchoolField>& fields) {
  std::vector<SchoolTruth> schools;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (auto truth = Judge(in, fields, i).truth()) schools.push_back(std::move(*truth));
  }
  return schools;
}

}  // namespace sonar::synth
