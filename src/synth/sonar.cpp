// SPDX-License-Identifier: Apache-2.0
#include "synth/sonar.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/check.h"
#include "base/units.h"
#include "geo/geodesic.h"
#include "synth/body_truth.h"
#include "synth/faults.h"
#include "synth/field.h"
#include "synth/layout.h"
#include "synth/scene_background.h"
#include "synth/seabed_response.h"
#include "synth/speckle.h"

namespace sonar::synth {

struct SyntheticSonar::State {
  Scene scene;
  Layout layout;
  std::vector<Scatterers> bodies;  ///< [body]
  Background background;
  Sector sector;  ///< empty without a grid
  std::vector<int> channel_of_row;
};

namespace {

/// One ping's geometry.
struct View {
  PingNavigation navigation;
  Point<Enu> ship;  ///< in the scene's frame
  double heading_rad = 0.0;
  double seconds = 0.0;
};

View view_of(const Scene& scene, int ping) {
  View v;
  v.seconds = scene.seconds_of(ping);
  v.navigation = navigation_at(scene, v.seconds);
  v.ship = ship_at(scene, v.seconds);
  v.heading_rad = rad_from_deg(v.navigation.heading_deg);
  return v;
}

/// From the transducer, in the local frame there: north is not the same direction as at the scene's origin.
Point<Enu> from_transducer(const Scene& scene, const View& view, const Point<Enu>& in_scene) {
  Point<Enu> p = to_enu(to_geographic(in_scene, scene.ship.origin), view.navigation.transducer);
  p.z = in_scene.z + view.navigation.transducer_depth_m;
  return p;
}

/// Bodies by the school they belong to at this time.
std::map<int, std::vector<std::size_t>> schools_at(const Scene& scene, double seconds) {
  std::map<int, std::vector<std::size_t>> schools;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) schools[scene.bodies[i].id_at(seconds)].push_back(i);
  return schools;
}

struct Rendered {
  std::vector<SchoolField> fields;
  std::vector<BodyTruth> bodies;
};

void add_field(const SchoolField& field, View3<float> out, const Array3<float>* factor) {
  const Shape3 box = field.sv.shape();
  for (int fan = 0; fan < box.fans; ++fan) {
    for (int beam = 0; beam < box.beams; ++beam) {
      const auto from = field.sv.row(fan, beam);
      const int f = field.first_fan + fan;
      const int b = field.first_beam + beam;
      const auto to = out.row(f, b);
      const int begin = std::max(0, field.first_sample);
      const int end = std::min(out.shape().samples, field.first_sample + box.samples);
      for (int s = begin; s < end; ++s) {
        const float sv = from[static_cast<std::size_t>(s - field.first_sample)];
        const auto i = static_cast<std::size_t>(s);
        to[i] += factor != nullptr ? sv * factor->row(f, b)[i] : sv;
      }
    }
  }
}

}  // namespace

SyntheticSonar::SyntheticSonar(Scene scene) {
  SONAR_CHECK(!scene.beams.empty() && scene.pings > 0);
  auto state = std::make_unique<State>();
  state->layout = make_layout(scene.beams, scene.beam_pattern);
  state->background = make_background(state->layout, scene);
  for (const Body& body : scene.bodies) state->bodies.push_back(scatterers(body.shape));
  if (state->layout.grid) state->sector = state->layout.grid->grid.sector(state->layout.range);
  for (const RowBeam& row : state->layout.rows) state->channel_of_row.push_back(row.channel);
  state->scene = std::move(scene);
  state_ = std::move(state);
}

SyntheticSonar::~SyntheticSonar() = default;
SyntheticSonar::SyntheticSonar(SyntheticSonar&&) noexcept = default;
SyntheticSonar& SyntheticSonar::operator=(SyntheticSonar&&) noexcept = default;

const Scene& SyntheticSonar::scene() const { return state_->scene; }
const std::optional<GridRecord>& SyntheticSonar::grid() const { return state_->layout.grid; }
const std::vector<int>& SyntheticSonar::channel_of_row() const { return state_->channel_of_row; }

namespace {

Rendered render_schools(const Scene& scene, const Layout& layout, const std::vector<Scatterers>& bodies,
                        const View& view, int ping) {
  Rendered out;
  for (const auto& [id, members] : schools_at(scene, view.seconds)) {
    std::vector<SeenScatterer> seen;
    BodyMeasure measure(layout);
    for (const std::size_t i : members) {
      const Point<Enu> centre = from_transducer(scene, view, scene.bodies[i].centre_at(view.seconds));
      measure.add(scene.bodies[i], bodies[i], centre, view.seconds);
      if (out_of_reach(layout, bodies[i], centre, view.heading_rad)) continue;
      append_seen(seen, layout, bodies[i], centre, view.heading_rad);
    }
    out.bodies.push_back(measure.row(seen, view.navigation, id, ping));
    if (seen.empty()) continue;
    SchoolField field = school_field(layout, seen, id, scene.noise.side_lobe_db);
    if (field.sv.shape().size() > 0) out.fields.push_back(std::move(field));
  }
  return out;
}

void add_seabed(const Seabed& seabed, const Background& background, View3<float> power_w) {
  for (int row = 0; row < static_cast<int>(power_w.shape().rows()); ++row) {
    const auto power = power_w.row(row);
    const auto factor = background.power_per_sv.view().row(row);
    for (int s = seabed.first_sample(row); s < seabed.last_sample(row); ++s) {
      const auto i = static_cast<std::size_t>(s);
      power[i] += static_cast<float>(seabed.sv(row, s)) * factor[i];
    }
  }
}

Volume make_volume(const Scene& scene, const Layout& layout, const std::vector<bool>& recorded, int ping,
                   View3<const float> power_w) {
  Volume v{Array3<std::int16_t>(layout.shape, kNoData), Array3<SampleFlags>(layout.shape, SampleFlags::none)};
  for (int r = 0; r < static_cast<int>(layout.rows.size()); ++r) {
    const RowBeam& row = layout.rows[static_cast<std::size_t>(r)];
    const auto count = static_cast<std::size_t>(recorded[static_cast<std::size_t>(r)] ? row.count : 0);
    const auto expected = power_w.row(r).first(count);
    const auto counts = v.counts.view().row(r);
    if (scene.noise.speckle) {
      speckled_counts(expected, scene.noise.speckle_correlation,
                      RandomStream(scene.seed, Purpose::speckle, scene.observation, static_cast<std::uint32_t>(ping),
                                   static_cast<std::uint32_t>(row.channel)),
                      counts.first(count));
    } else {
      expected_counts(expected, counts.first(count));
    }
    const auto missing = v.flags.view().row(r).subspan(count);
    std::fill(missing.begin(), missing.end(), SampleFlags::dropout);
  }
  return v;
}

void light_voxels(const Scene& scene, const Layout& layout, const Background& background, int ping,
                  View3<const float> power_w, Volume& volume) {
  for (const VoxelTarget& target : scene.voxel_targets) {
    if (target.ping != ping || target.sample < 0 || target.sample >= layout.shape.samples) continue;
    for (int r = 0; r < static_cast<int>(layout.rows.size()); ++r) {
      if (layout.rows[static_cast<std::size_t>(r)].channel != target.channel) continue;
      const auto i = static_cast<std::size_t>(target.sample);
      if (any(volume.flags.view().row(r)[i])) continue;
      const double per_sv = static_cast<double>(background.power_per_sv.view().row(r)[i]);
      volume.counts.view().row(r)[i] =
          count_of_power(static_cast<double>(power_w.row(r)[i]) + per_sv * linear_from_db(target.sv_db));
    }
  }
}

}  // namespace

SyntheticPing SyntheticSonar::ping(int ping) const {
  const State& s = *state_;
  const View view = view_of(s.scene, ping);
  Rendered schools = render_schools(s.scene, s.layout, s.bodies, view, ping);
  const Seabed seabed(s.layout, s.scene, view.ship, view.heading_rad);

  Array3<float> power = s.background.power_w;
  for (const SchoolField& field : schools.fields) add_field(field, power.view(), &s.background.power_per_sv);
  add_seabed(seabed, s.background, power.view());
  add_faults(s.layout, s.scene, ping, power.view());

  SyntheticPing out;
  out.recorded = recorded_rows(s.layout, s.scene, ping);
  out.power = make_volume(s.scene, s.layout, out.recorded, ping, std::as_const(power).view());
  light_voxels(s.scene, s.layout, s.background, ping, std::as_const(power).view(), out.power);
  out.bodies = std::move(schools.bodies);
  if (!s.layout.grid) return out;

  std::vector<RowLimits> limits = s.background.limits;
  for (std::size_t row = 0; row < limits.size(); ++row) limits[row].seabed_begin = seabed.limit(static_cast<int>(row));
  const auto background_sv = [&](int row, int sample) {
    const auto i = static_cast<std::size_t>(sample);
    const double own = static_cast<double>(s.background.power_w.view().row(row)[i]) /
                       static_cast<double>(s.background.power_per_sv.view().row(row)[i]);
    return own + seabed.sv(row, sample);
  };
  const TruthInput input{s.layout.grid->grid, s.sector, view.navigation, limits, background_sv, ping};
  out.schools = school_truth(input, schools.fields);
  for (SchoolTruth& school : out.schools) {
    if (s.scene.water.seabed_db > -200.0) school.row.bottom_depth_m = seabed.depth_m();
    complete_from_body(school.row, out.bodies);
  }
  return out;
}

Array3<float> SyntheticSonar::expected_school_sv(int ping) const {
  const View view = view_of(state_->scene, ping);
  Array3<float> sv(state_->layout.shape);
  const Rendered schools = render_schools(state_->scene, state_->layout, state_->bodies, view, ping);
  for (const SchoolField& field : schools.fields) add_field(field, sv.view(), nullptr);
  return sv;
}

Array3<float> SyntheticSonar::expected_background_sv(int ping) const {
  const State& s = *state_;
  const View view = view_of(s.scene, ping);
  const Seabed seabed(s.layout, s.scene, view.ship, view.heading_rad);
  Array3<float> sv = s.background.power_w;
  add_seabed(seabed, s.background, sv.view());
  const auto factor = s.background.power_per_sv.all();
  for (std::size_t i = 0; i < factor.size(); ++i) sv.all()[i] /= factor[i];
  return sv;
}

Volume render_ping(const Scene& scene, int ping) { return SyntheticSonar(scene).ping(ping).power; }

}  // namespace sonar::synth
