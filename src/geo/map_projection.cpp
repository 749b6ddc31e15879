// SPDX-License-Identifier: Apache-2.0
#include "geo/map_projection.h"

#include <fmt/format.h>
#include <proj.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.h"
#include "base/library_gate.h"
#include "base/units.h"

namespace sonar {
namespace {

constexpr double kPolarFrom_deg = 70.0;
constexpr double kTropic_deg = 20.0;
constexpr double kNarrow_deg = 6.0;
constexpr double kMetresPerDegree = 111'195.0;

std::string latitude_text(double deg) { return fmt::format("{:.2f}° {}", std::abs(deg), deg < 0.0 ? 'S' : 'N'); }
std::string longitude_text(double deg) { return fmt::format("{:.2f}° {}", std::abs(deg), deg < 0.0 ? 'W' : 'E'); }

struct Choice {
  std::string definition;
  std::string name;
};

/// Values are rounded to 0.01 degrees first, so that what the legend says is what is drawn.
double rounded(double deg) { return std::round(deg * 100.0) / 100.0; }

Choice choose(const GeoExtent& e) {
  const Geographic middle = e.middle();
  const double lat = rounded(middle.latitude_deg);
  const double lon = rounded(middle.longitude_deg);
  const double width_deg = e.east_deg - e.west_deg;
  const double height_deg = e.north_deg - e.south_deg;
  const double flattened_deg = width_deg * std::cos(rad_from_deg(lat));
  const std::string meridian = fmt::format("central meridian {}; WGS 84", longitude_text(lon));
  const std::string common = fmt::format("+lon_0={} +ellps=WGS84 +units=m", lon);
  if (std::abs(lat) >= kPolarFrom_deg || e.north_deg > 88.0 || e.south_deg < -88.0) {
    const bool south = lat < 0.0;
    return {fmt::format("+proj=stere +lat_0={} +lat_ts={} {}", south ? -90 : 90, lat, common),
            fmt::format("Polar stereographic, true at {}, {}", latitude_text(lat), meridian)};
  }
  const bool narrow = width_deg <= kNarrow_deg;
  if (narrow && (std::abs(lat) < kTropic_deg || height_deg > 1.5 * flattened_deg)) {
    return {fmt::format("+proj=tmerc +lat_0={} +k=1 {}", lat, common), "Transverse Mercator, " + meridian};
  }
  if (std::abs(lat) < kTropic_deg) {
    return {fmt::format("+proj=merc +lat_ts={} {}", std::abs(lat), common),
            fmt::format("Mercator, true at {}, {}", latitude_text(lat), meridian)};
  }
  // A cone must not turn into a cylinder: its parallels stay on one side of the equator.
  const double keep = lat > 0.0 ? 1.0 : -1.0;
  const double a = rounded(keep * std::max(1.0, keep * (e.south_deg + height_deg / 6.0)));
  const double b = rounded(keep * std::max(1.0, keep * (e.north_deg - height_deg / 6.0)));
  const std::string parallels =
      a == b ? latitude_text(a) : fmt::format("{} and {}", latitude_text(a), latitude_text(b));
  return {fmt::format("+proj=lcc +lat_1={} +lat_2={} +lat_0={} {}", a, b, lat, common),
          fmt::format("Lambert conformal conic, true at {}, {}", parallels, meridian)};
}

}  // namespace

Geographic GeoExtent::middle() const { return {(south_deg + north_deg) / 2.0, wrap_180((west_deg + east_deg) / 2.0)}; }

bool GeoExtent::contains(const Geographic& place) const {
  const double east = wrap_360(place.longitude_deg - west_deg);
  return place.latitude_deg >= south_deg && place.latitude_deg <= north_deg && east <= east_deg - west_deg;
}

std::optional<GeoExtent> extent_of(std::span<const Geographic> places) {
  std::vector<double> longitudes;
  GeoExtent e{90.0, -90.0, 0.0, 0.0};
  for (const Geographic& p : places) {
    if (!std::isfinite(p.latitude_deg) || !std::isfinite(p.longitude_deg)) continue;
    e.south_deg = std::min(e.south_deg, p.latitude_deg);
    e.north_deg = std::max(e.north_deg, p.latitude_deg);
    longitudes.push_back(wrap_180(p.longitude_deg));
  }
  if (longitudes.empty()) return std::nullopt;
  // The extent is what the widest gap between neighbouring longitudes leaves.
  std::sort(longitudes.begin(), longitudes.end());
  double widest = longitudes.front() + 360.0 - longitudes.back();
  e.west_deg = longitudes.front();
  e.east_deg = longitudes.back();
  for (std::size_t i = 1; i < longitudes.size(); ++i) {
    if (longitudes[i] - longitudes[i - 1] <= widest) continue;
    widest = longitudes[i] - longitudes[i - 1];
    e.west_deg = longitudes[i];
    e.east_deg = longitudes[i - 1] + 360.0;
  }
  return e;
}

GeoExtent widened(const GeoExtent& e, double by_m) {
  const double dlat = by_m / kMetresPerDegree;
  GeoExtent out = e;
  out.south_deg = std::max(-90.0, e.south_deg - dlat);
  out.north_deg = std::min(90.0, e.north_deg + dlat);
  const double highest = std::max(std::abs(out.south_deg), std::abs(out.north_deg));
  const double cosine = std::cos(rad_from_deg(highest));
  const double dlon = cosine * 180.0 > dlat ? dlat / cosine : 180.0;
  if (e.east_deg - e.west_deg + 2.0 * dlon >= 360.0) {
    out.west_deg = wrap_180((e.west_deg + e.east_deg) / 2.0 - 180.0);
    out.east_deg = out.west_deg + 360.0;
  } else {
    out.west_deg = wrap_180(e.west_deg - dlon);
    out.east_deg = out.west_deg + (e.east_deg - e.west_deg) + 2.0 * dlon;
  }
  return out;
}

struct MapProjection::State {
  explicit State(Choice choice) : chosen(std::move(choice)) {
    const auto inside = inside_library();
    // NOLINTBEGIN(cppcoreguidelines-prefer-member-initializer): both are made inside the library's gate
    context = proj_context_create();
    SONAR_CHECK(context != nullptr);
    proj_log_level(context, PJ_LOG_NONE);
    projection = proj_create(context, chosen.definition.c_str());
    // NOLINTEND(cppcoreguidelines-prefer-member-initializer)
    SONAR_CHECK(projection != nullptr);
  }
  ~State() {
    proj_destroy(projection);
    proj_context_destroy(context);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  [[nodiscard]] static PJ_COORD coordinate(const Geographic& place) {
    return proj_coord(rad_from_deg(place.longitude_deg), rad_from_deg(place.latitude_deg), 0.0, 0.0);
  }

  Choice chosen;
  PJ_CONTEXT* context = nullptr;
  PJ* projection = nullptr;
};

MapProjection::MapProjection(const GeoExtent& extent) : state_(std::make_unique<State>(choose(extent))) {}
MapProjection::MapProjection(const MapProjection& other) : state_(std::make_unique<State>(other.state_->chosen)) {}
MapProjection& MapProjection::operator=(const MapProjection& other) {
  if (this != &other) state_ = std::make_unique<State>(other.state_->chosen);
  return *this;
}
MapProjection::MapProjection(MapProjection&&) noexcept = default;
MapProjection& MapProjection::operator=(MapProjection&&) noexcept = default;
MapProjection::~MapProjection() = default;

std::optional<PlanePoint> MapProjection::forward(const Geographic& place) const {
  const PJ_COORD out = proj_trans(state_->projection, PJ_FWD, State::coordinate(place));
  proj_errno_reset(state_->projection);
  if (!std::isfinite(out.xy.x) || !std::isfinite(out.xy.y)) return std::nullopt;
  return PlanePoint{out.xy.x, out.xy.y};
}

std::optional<Geographic> MapProjection::inverse(const PlanePoint& point) const {
  const PJ_COORD out = proj_trans(state_->projection, PJ_INV, proj_coord(point.x, point.y, 0.0, 0.0));
  proj_errno_reset(state_->projection);
  if (!std::isfinite(out.lp.lam) || !std::isfinite(out.lp.phi)) return std::nullopt;
  return Geographic{deg_from_rad(out.lp.phi), wrap_180(deg_from_rad(out.lp.lam))};
}

double MapProjection::scale_at(const Geographic& place) const {
  const PJ_FACTORS f = proj_factors(state_->projection, State::coordinate(place));
  proj_errno_reset(state_->projection);
  return f.meridional_scale > 0.0 ? f.meridional_scale : 1.0;
}

double MapProjection::north_rad(const Geographic& place) const {
  // Seen on the map itself: a hundredth of a second of latitude along the meridian.
  constexpr double kStep_deg = 1e-5;
  const double up = place.latitude_deg + kStep_deg > 90.0 ? -kStep_deg : kStep_deg;
  const auto here = forward(place);
  const auto there = forward({place.latitude_deg + up, place.longitude_deg});
  if (!here || !there) return 0.0;
  const double sign = up > 0.0 ? 1.0 : -1.0;
  return std::atan2(sign * (there->x - here->x), sign * (there->y - here->y));
}

const std::string& MapProjection::name() const { return state_->chosen.name; }
const std::string& MapProjection::definition() const { return state_->chosen.definition; }

}  // namespace sonar
