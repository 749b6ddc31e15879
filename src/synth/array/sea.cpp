// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "synth/array/company.h"
#include "synth/array/fish.h"
#include "synth/random.h"

namespace sonar::synth::array {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kAround_m = 550.0;  ///< what the sonar hears lies no farther from the track

/// The stretch of water that the voyage passes.
struct Stretch {
  double bow_from, bow_to;  ///< along the course from the start
  double course_rad;
  Point<Enu> start;
  [[nodiscard]] Point<Enu> at(double along, double port) const {
    const double s = std::sin(course_rad);
    const double c = std::cos(course_rad);
    return {start.x + along * s - port * c, start.y + along * c + port * s, 0.0};
  }
  [[nodiscard]] double area_m2() const { return (bow_to - bow_from) * kAround_m; }
};

Stretch stretch_of(const Voyage& voyage) {
  const double lasts = voyage.seconds_of(voyage.pings);
  return {-0.6 * kAround_m, voyage.ship.speed_mps * lasts + 0.6 * kAround_m, rad_from_deg(voyage.ship.course_deg),
          voyage.ship.start_m};
}

void draw_hull(Sea& sea, RandomStream& random) {
  const double much = sea.company.hull_bubbles;
  const int clouds = much > 0.0 ? 1 + random.index(1 + static_cast<int>(4.0 * much)) : 0;
  for (int i = 0; i < clouds; ++i) {
    HullCloud c{};
    c.bow_m = random.uniform(-30.0, 15.0);
    c.port_m = random.uniform(18.0, 80.0);
    c.depth_m = random.uniform(4.0, 9.0);
    c.long_m = random.uniform(2.0, 7.0);
    c.wide_m = random.uniform(1.5, 6.0);
    c.high_m = random.uniform(1.0, 2.5);
    const double sv_db = -62.0 + 22.0 * much + random.uniform(-3.0, 3.0);
    c.backscatter_m2 = linear_from_db(sv_db) * std::pow(kTurn, 1.5) * c.long_m * c.wide_m * c.high_m;
    c.period_s = random.uniform(30.0, 120.0);
    c.phase = random.uniform(0.0, kTurn);
    sea.hull.push_back(c);
  }
}

void draw_plumes(Sea& sea, const Voyage& voyage, RandomStream& random) {
  const double much = sea.company.plumes;
  if (much <= 0.0) return;
  const Stretch stretch = stretch_of(voyage);
  const double lasts = voyage.seconds_of(voyage.pings);
  const double row_spacing = random.uniform(25.0, 60.0);
  constexpr double kLongest_s = 240.0;
  constexpr double kArea_m2 = 9000.0;  ///< of sea in which one plume is born in kLongest_s at strength 1
  const int plumes = static_cast<int>(much * stretch.area_m2() / kArea_m2 * (lasts + kLongest_s) / kLongest_s);
  const double s = std::sin(sea.wind_rad);
  const double c = std::cos(sea.wind_rad);
  for (int i = 0; i < plumes; ++i) {
    const double along = random.uniform(stretch.bow_from, stretch.bow_to);
    const Point<Enu> anywhere = stretch.at(along, random.uniform(0.0, kAround_m));
    // Rows lie down the wind: the place across it is a row's.
    const double down = anywhere.x * s + anywhere.y * c;
    const double across = row_spacing * std::round((anywhere.x * c - anywhere.y * s) / row_spacing) + random.normal();
    Plume p{};
    p.east_m = down * s + across * c;
    p.north_m = down * c - across * s;
    p.length_m = random.uniform(6.0, 25.0);
    p.width_m = random.uniform(2.0, 5.0);
    p.depth_m = random.uniform(1.0, 1.0 + 2.5 * much);
    const double sv_db = -56.0 + 16.0 * much + 3.0 * random.normal();
    p.backscatter_m2 = linear_from_db(sv_db) * p.length_m * p.width_m * p.depth_m;
    p.born_s = random.uniform(-kLongest_s, lasts);
    p.fades_s = random.uniform(40.0, 150.0);
    sea.plumes.push_back(p);
  }
}

void draw_layers(Sea& sea, const Voyage& voyage, RandomStream& random) {
  const double much = sea.company.layers;
  const int layers = much > 0.0 ? 1 + random.index(2) : 0;
  for (int i = 0; i < layers; ++i) {
    const double depth = random.uniform(20.0, 150.0);
    const double thickness = random.uniform(2.0, 10.0);
    const double sv_db = -82.0 + 20.0 * much + random.uniform(-3.0, 3.0);
    sea.layers.push_back({depth, thickness, linear_from_db(sv_db), Ripples(40.0, 300.0, 8, random)});
    // Some of the layer's echo is from fish that are louder than it.
    const Stretch stretch = stretch_of(voyage);
    const int fish = static_cast<int>(1500.0 * much * sea.company.single_fish);
    for (int k = 0; k < fish; ++k) {
      Point<Enu> at = stretch.at(random.uniform(stretch.bow_from, stretch.bow_to), random.uniform(0.0, kAround_m));
      at.z = -std::max(2.0, depth + thickness * random.normal());
      sea.lone.push_back({at, {}, 0.0, random.uniform(10.0, 35.0)});
    }
  }
}

void draw_lone(Sea& sea, const ArrayParams& params, const Voyage& voyage, RandomStream& random) {
  const Stretch stretch = stretch_of(voyage);
  const double deepest = std::min(250.0, sea.terrain.there ? sea.company.seabed_depth_m : 250.0);
  const int fish = static_cast<int>(2500.0 * sea.company.single_fish);
  for (int k = 0; k < fish; ++k) {
    Point<Enu> at = stretch.at(random.uniform(stretch.bow_from, stretch.bow_to), random.uniform(0.0, kAround_m));
    at.z = -random.uniform(3.0, deepest);
    sea.lone.push_back({at, {}, 0.0, random.uniform(15.0, 60.0)});
  }
  for (LoneFish& one : sea.lone) {
    const double course = random.uniform(0.0, kTurn);
    const double speed = random.uniform(0.0, 0.8);
    one.velocity_mps = {speed * std::sin(course), speed * std::cos(course), 0.0};
    one.broadside_m2 = broadside_m2(params.fish, one.length_cm);
  }
}

void draw_seabed(Sea& sea, RandomStream& random) {
  const double much = sea.company.seabed;
  Terrain& t = sea.terrain;
  t.there = much > 0.0;
  t.depth_m = sea.company.seabed_depth_m;
  t.slope_east = random.uniform(-0.03, 0.03);
  t.slope_north = random.uniform(-0.03, 0.03);
  t.roughness_m = 0.5 + 5.0 * much * random.uniform();
  t.strength = linear_from_db(-28.0 + 16.0 * much + random.uniform(-3.0, 3.0));
  t.relief = Ripples(25.0, 400.0, 10, random);
  t.patches = Ripples(15.0, 120.0, 6, random);
}

void draw_others(Sea& sea, const Voyage& voyage, int fans, RandomStream& random) {
  const double bearing = random.uniform(-0.6, 0.6);
  for (int ping = 0; ping < voyage.pings; ++ping) {
    const double chance = random.uniform();
    const double start = random.uniform();
    const int fan = random.index(fans);
    const double strength = random.uniform(-130.0, -105.0);
    const int samples = 3 + random.index(20);
    if (chance > 0.3 * sea.company.other_sounders) continue;
    const Direction from = direction(random.uniform(-0.1, 0.0), bearing + 0.002 * ping);
    sea.others.push_back({ping, fan, from, 40 + static_cast<int>(1200.0 * start), samples, linear_from_db(strength)});
  }
}

}  // namespace

double Sea::surface_patch_db(double east_m, double north_m, double seconds) const {
  constexpr double kSpread_db = 3.0;
  // Two fields that take turns: what one ping shows is gone after patches_last_s, whatever the ship does.
  const double turn = seconds / patches_last_s * std::numbers::pi / 2.0;
  const double x = east_m - patches_mps * seconds * std::sin(wind_rad);
  const double y = north_m - patches_mps * seconds * std::cos(wind_rad);
  return kSpread_db * (std::cos(turn) * surface_patches.at(x, y) + std::sin(turn) * surface_patches_later.at(x, y));
}

Sea make_sea(const ArrayParams& params, const Voyage& voyage, std::uint32_t observation, int fans) {
  Sea sea;
  sea.company = company_of(params, static_cast<int>(observation));
  RandomStream random(static_cast<std::uint64_t>(params.seed), Purpose::sea, observation);
  sea.wind_rad = random.uniform(0.0, kTurn);
  const double bends = random.uniform(-1.0, 0.6);
  sea.gradient_per_s = 0.1 * sea.company.refraction * bends;
  sea.reverberation_sv = linear_from_db(sea.company.reverberation_sv_db);
  const double surface_db = -58.0 + 20.0 * sea.company.surface + random.uniform(-2.0, 2.0);
  sea.surface_per_m2 = sea.company.surface > 0.0 ? linear_from_db(surface_db) : 0.0;
  sea.patches_mps = random.uniform(0.1, 0.6);
  sea.patches_last_s = random.uniform(30.0, 120.0);
  sea.surface_patches = Ripples(8.0, 80.0, 8, random);
  sea.surface_patches_later = Ripples(8.0, 80.0, 8, random);
  draw_seabed(sea, random);
  draw_hull(sea, random);
  draw_plumes(sea, voyage, random);
  draw_layers(sea, voyage, random);
  draw_lone(sea, params, voyage, random);
  draw_others(sea, voyage, fans, random);
  return sea;
}

}  // namespace sonar::synth::array
