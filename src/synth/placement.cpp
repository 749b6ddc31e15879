// SPDX-License-Identifier: Apache-2.0
#include "synth/placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/units.h"
#include "synth/layout.h"
#include "synth/random.h"
#include "synth/scene_background.h"
#include "synth/terrain.h"

namespace sonar::synth {
namespace {

constexpr int kTries = 3000;
constexpr double kShallowestTop_m = 10.0;
constexpr double kDeepestOfSeabed = 0.6;  ///< below this share of the water depth the seabed's echo is near
constexpr double kHighestElevation_deg = -2.0;
constexpr double kLowestElevation_deg = -40.0;
constexpr int kRefinements = 8;  ///< of the place above a seabed that is not level
constexpr double kInView_m = 700.0;
constexpr double kClear_m = 20.0;      ///< between schools, beyond the larger one's size: the beams smear that far
constexpr double kMostOfWindow = 0.6;  ///< a school's length, of what the sector is wide at its range
constexpr double kPartSpeed_mps = 0.8;

/// Background Sv where a school would be.
class BackgroundLevel {
 public:
  explicit BackgroundLevel(const Scene& scene)
      : layout_(make_layout(scene.beams, scene.beam_pattern)), background_(make_background(layout_, scene)) {}

  [[nodiscard]] int nearest_row(double elevation_rad) const {
    int nearest = 0;
    double least = std::numeric_limits<double>::max();
    for (int row = 0; row < static_cast<int>(layout_.rows.size()); ++row) {
      const RowBeam& beam = layout_.rows[static_cast<std::size_t>(row)];
      const double off = std::abs(beam.elevation_rad - elevation_rad) +
                         std::abs(beam.azimuth_rad - rad_from_deg(layout_.mounting_azimuth_deg));
      if (off < least) {
        least = off;
        nearest = row;
      }
    }
    return nearest;
  }
  [[nodiscard]] double sv_db(int row, double range_m) const {
    const auto s = static_cast<std::size_t>(
        std::clamp(static_cast<int>(layout_.range.sample_at(range_m)), 0, layout_.shape.samples - 1));
    return db_from_linear(static_cast<double>(background_.power_w.view().row(row)[s]) /
                          static_cast<double>(background_.power_per_sv.view().row(row)[s]));
  }
  /// How much a beam dims a body that does not fill it, dB.
  [[nodiscard]] double dimming_db(int row, double range_m, double width_m, double height_m) const {
    const RowBeam& beam = layout_.rows[static_cast<std::size_t>(row)];
    const double full = std::sqrt(2.0 * std::numbers::pi) * range_m;
    return db_from_linear(std::min(1.0, height_m / (full * beam.sigma_v_rad)) *
                          std::min(1.0, width_m / (full * beam.sigma_h_rad)));
  }

 private:
  Layout layout_;
  Background background_;
};

struct School {
  std::vector<Body> bodies;
  double abeam_s = 0.0;
  double length_m = 0.0;
  bool alone = true;  ///< kept apart from the others
};

Point<Enu> level_velocity(double speed_mps, double course_deg) {
  const double course = rad_from_deg(course_deg);
  return {speed_mps * std::sin(course), speed_mps * std::cos(course), 0.0};
}

class Placer {
 public:
  Placer(const SurveyParams& params, Scene& scene)
      : params_(params),
        scene_(scene),
        level_(scene),
        terrain_(scene),
        random_(scene.seed, Purpose::placement, scene.observation) {
    for (const Body& body : scene.bodies) placed_.push_back({{body}, 0.0, body.shape.length_m, true});
  }

  void place() {
    int left = params_.schools;
    for (int i = 0; i < params_.crossings && left >= 2; ++i) left -= place_crossing();
    for (int i = 0; i < params_.splits && left >= 1; ++i) left -= place_split();
    for (; left > 0; --left) {
      if (auto school = find_room([&] { return candidate(params_.length_max_m); })) {
        schools_.push_back(std::move(*school));
      }
    }
    number();
  }

 private:
  struct Spot {
    double abeam_s;
    double range_m;
    double elevation_rad;
    SizeAndLevel size;
  };

  [[nodiscard]] double duration_s() const { return scene_.seconds_of(scene_.pings - 1); }

  [[nodiscard]] SizeAndLevel draw_size(double longest_m) {
    const double u = random_.uniform();
    const double v = std::clamp(u + random_.uniform(-0.25, 0.25), 0.0, 1.0);
    SizeAndLevel size{};
    size.length_m = params_.length_min_m + u * (longest_m - params_.length_min_m);
    size.width_m = size.length_m * random_.uniform(0.5, 0.8);
    size.height_m = params_.height_min_m + v * (params_.height_max_m - params_.height_min_m);
    size.axis_deg = random_.uniform(0.0, 180.0);
    return size;
  }

  /// A place that is wholly in the water and in the sector, and bright enough; or none.
  [[nodiscard]] std::optional<Spot> draw_spot(double longest_m) {
    Spot spot{};
    spot.abeam_s = random_.uniform(0.02, 0.98) * duration_s();
    spot.range_m = random_.uniform(params_.range_min_m, params_.range_max_m);
    spot.elevation_rad = rad_from_deg(random_.uniform(kLowestElevation_deg, kHighestElevation_deg));
    spot.size = draw_size(longest_m);
    const double half_m = spot.size.height_m / 2.0 * (1.0 + params_.raggedness);
    const bool near_seabed = params_.above_seabed_max_m > 0.0;
    if (near_seabed) {
      const double above_m = random_.uniform(params_.above_seabed_min_m, params_.above_seabed_max_m);
      spot.elevation_rad = elevation_above_seabed(spot, above_m + half_m);
    }
    const double depth_m = scene_.ship.transducer_depth_m - spot.range_m * std::sin(spot.elevation_rad);
    const double half_rad = std::atan(half_m / spot.range_m);
    const double window_m = 2.0 * spot.range_m * std::tan(rad_from_deg(30.0));
    const int row = level_.nearest_row(spot.elevation_rad);
    const double dimming_db = level_.dimming_db(row, spot.range_m, spot.size.width_m, spot.size.height_m);
    const double weakest_db =
        std::max(params_.sv_min_db, level_.sv_db(row, spot.range_m) + params_.above_background_db - dimming_db);
    const double deepest_m = near_seabed ? depth_m + half_m : kDeepestOfSeabed * scene_.water.seabed_depth_m;
    if (depth_m - half_m < kShallowestTop_m || depth_m + half_m > deepest_m ||
        spot.elevation_rad + half_rad > rad_from_deg(-1.0) || spot.elevation_rad - half_rad < rad_from_deg(-44.0) ||
        spot.size.length_m > kMostOfWindow * window_m || weakest_db > params_.sv_max_db) {
      return std::nullopt;
    }
    spot.size.sv_db = random_.uniform(weakest_db, params_.sv_max_db);
    return spot;
  }

  /// Where a school is seen at its range when its centre is so far above the seabed.
  [[nodiscard]] double elevation_above_seabed(const Spot& spot, double above_m) const {
    const Point<Enu> ship = ship_at(scene_, spot.abeam_s);
    const Point<Enu> port = level_velocity(1.0, scene_.ship.course_deg - 90.0);
    double elevation_rad = spot.elevation_rad;
    for (int i = 0; i < kRefinements; ++i) {
      const Point<Enu> place = ship + port * (spot.range_m * std::cos(elevation_rad));
      const double below_m = terrain_.depth_m(place) - above_m - scene_.ship.transducer_depth_m;
      elevation_rad = -std::asin(std::clamp(below_m / spot.range_m, 0.0, 1.0));
    }
    return elevation_rad;
  }

  /// own  velocity through the water
  [[nodiscard]] Body body_at(const Spot& spot, const Point<Enu>& own) {
    const Point<Enu> velocity = own + Point<Enu>{params_.current_east_mps, params_.current_north_mps, 0.0};
    Body body;
    const std::uint64_t high = random_.next();
    const std::uint64_t seed = high << 32U | random_.next();
    body.shape = ragged_shape(params_, spot.size, seed);
    body.velocity_mps = velocity;
    const Point<Enu> ship = ship_at(scene_, spot.abeam_s);
    const Point<Enu> port = level_velocity(1.0, scene_.ship.course_deg - 90.0);
    Point<Enu> centre = ship + port * (spot.range_m * std::cos(spot.elevation_rad));
    centre.z = spot.range_m * std::sin(spot.elevation_rad) - scene_.ship.transducer_depth_m;
    body.centre_m = centre - velocity * spot.abeam_s;
    return body;
  }

  [[nodiscard]] double draw_speed() { return random_.uniform(params_.own_speed_min_mps, params_.own_speed_max_mps); }

  [[nodiscard]] std::optional<School> candidate(double longest_m) {
    const auto spot = draw_spot(longest_m);
    if (!spot) return std::nullopt;
    const double speed_mps = draw_speed();
    Point<Enu> velocity = level_velocity(speed_mps, random_.uniform(0.0, 360.0));
    // One that keeps to the seabed neither sinks into it nor rises.
    velocity.z = params_.above_seabed_max_m > 0.0 ? 0.0 : random_.uniform(-0.02, 0.02);
    return School{{body_at(*spot, velocity)}, spot->abeam_s, spot->size.length_m, true};
  }

  template <class Draw>
  [[nodiscard]] std::optional<School> find_room(const Draw& draw) {
    for (int i = 0; i < kTries; ++i) {
      auto school = draw();
      if (school && has_room(*school)) return school;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool has_room(const School& school) const {
    const auto near = [&](const School& other) { return too_near(school, other); };
    return std::none_of(schools_.begin(), schools_.end(), near) && std::none_of(placed_.begin(), placed_.end(), near);
  }

  [[nodiscard]] bool too_near(const School& a, const School& b) const {
    const double apart_m =
        (a.length_m + b.length_m) / 2.0 * (1.0 + params_.raggedness) + std::max(a.length_m, b.length_m) + kClear_m;
    for (int ping = 0; ping < scene_.pings; ++ping) {
      const double t = scene_.seconds_of(ping);
      const Point<Enu> ship = ship_at(scene_, t);
      for (const Body& x : a.bodies) {
        for (const Body& y : b.bodies) {
          const Point<Enu> p = x.centre_at(t);
          const Point<Enu> q = y.centre_at(t);
          if (std::min(norm(p - ship), norm(q - ship)) < kInView_m && norm(p - q) < apart_m) return true;
        }
      }
    }
    return false;
  }

  /// Two schools that swim along the track in opposite ways and meet abeam. Returns how many were placed.
  int place_crossing() {
    const auto draw = [&]() -> std::optional<School> {
      const auto spot = draw_spot(std::max(params_.length_min_m, params_.length_max_m / 2.0));
      if (!spot) return std::nullopt;
      const double along = scene_.ship.course_deg;
      School pair{{body_at(*spot, level_velocity(draw_speed(), along))}, spot->abeam_s, spot->size.length_m, false};
      Spot second = *spot;
      second.size.sv_db = random_.uniform(spot->size.sv_db, params_.sv_max_db);
      second.range_m += spot->size.width_m / 3.0;
      pair.bodies.push_back(body_at(second, level_velocity(draw_speed(), along + 180.0)));
      return pair;
    };
    auto pair = find_room(draw);
    if (!pair) return 2;
    School other = *pair;
    other.bodies.erase(other.bodies.begin());
    other.abeam_s += 1e-3;
    pair->bodies.pop_back();
    schools_.push_back(std::move(*pair));
    schools_.push_back(std::move(other));
    return 2;
  }

  /// A school of two halves, one behind the other, that part when they are abeam.
  int place_split() {
    const auto draw = [&]() -> std::optional<School> {
      auto spot = draw_spot(params_.length_max_m);
      if (!spot) return std::nullopt;
      spot->size.length_m *= 0.6;
      const double course = random_.uniform(0.0, 360.0);
      spot->size.axis_deg = wrap_360(course);
      School school{{}, spot->abeam_s, spot->size.length_m * 2.0, false};
      const Point<Enu> velocity = level_velocity(draw_speed(), course);
      for (const double side : {-1.0, 1.0}) {
        Body half = body_at(*spot, velocity);
        half.centre_m = half.centre_m + level_velocity(side * spot->size.length_m * 0.45, course);
        half.splits_at_s = spot->abeam_s;
        half.split_velocity_mps = level_velocity(side * kPartSpeed_mps, course);
        school.bodies.push_back(std::move(half));
      }
      return school;
    };
    if (auto school = find_room(draw)) schools_.push_back(std::move(*school));
    return 1;
  }

  /// Ids in the order in which the ship passes them; the second half of a split comes last.
  void number() {
    std::stable_sort(schools_.begin(), schools_.end(),
                     [](const School& a, const School& b) { return a.abeam_s < b.abeam_s; });
    int id = 0;
    for (const Body& body : scene_.bodies) id = std::max(id, body.school_id);
    for (School& school : schools_) {
      ++id;
      for (Body& body : school.bodies) body.school_id = id;
    }
    for (School& school : schools_) {
      if (school.bodies.size() > 1) school.bodies.back().id_after_split = ++id;
      for (Body& body : school.bodies) scene_.bodies.push_back(std::move(body));
    }
  }

  const SurveyParams& params_;
  Scene& scene_;
  BackgroundLevel level_;
  Terrain terrain_;
  RandomStream random_;
  std::vector<School> placed_;  ///< already in the scene
  std::vector<School> schools_;
};

}  // namespace

BodyShape ragged_shape(const SurveyParams& params, const SizeAndLevel& size, std::uint64_t seed) {
  BodyShape shape;
  shape.length_m = size.length_m;
  shape.width_m = size.width_m;
  shape.height_m = size.height_m;
  shape.axis_deg = size.axis_deg;
  shape.sv_db = size.sv_db;
  shape.raggedness = params.raggedness;
  shape.ragged_scale_m = std::max(2.0, size.height_m / 2.0);
  shape.seed = seed;
  RandomStream random(seed, Purpose::placement);
  const auto lump = [&](double reach, double radius, double excess_db) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double out = reach * std::sqrt(random.uniform());
    shape.lumps.push_back({out * std::cos(angle), out * std::sin(angle), random.uniform(-0.3, 0.3), radius, excess_db});
  };
  // Arguments have no order of evaluation: one draw a statement, or compilers would disagree.
  for (int i = 0; i < params.nuclei; ++i) {
    const double radius = random.uniform(0.15, 0.3);
    lump(0.6, radius, random.uniform(0.5, 1.0) * params.nucleus_db);
  }
  for (int i = 0; i < params.vacuoles; ++i) lump(0.6, random.uniform(0.1, 0.2), kVacuole);
  return shape;
}

void place_schools(const SurveyParams& params, Scene& scene) { Placer(params, scene).place(); }

}  // namespace sonar::synth
