// SPDX-License-Identifier: Apache-2.0
#include "school/measure/correct_sizes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>

#include "base/units.h"
#include "school/measure/body_size.h"
#include "school/measure/edges.h"
#include "school/measure/two_way_beam.h"

namespace sonar {
namespace {

/// What the sector's border, a crop or the seabed cuts off is missing from the extent across it, however it is fitted.
constexpr std::int32_t kCutsLevel = kEdgeFore | kEdgeAft | kEdgeNear | kEdgeFar;
constexpr std::int32_t kCutsHeight = kEdgeTopFan | kEdgeBottomFan | kEdgeNear | kEdgeFar | kEdgeSeabed | kEdgeSurface;

/// Corrected columns; unknown where an extent is cut or not told apart from the beam, and what needs all three with it.
/// The beam makes a body look higher: one that is told higher than it looks has another's echo in it, a seabed's say.
void measure_body(const BodySize& body, SchoolPingRow& row) {
  if ((row.edge_flags & kCutsLevel) == 0) {
    row.length_corrected_m = body.length_m;
    row.width_corrected_m = body.width_m;
    row.incidence_deg = body.incidence_deg;
  }
  if ((row.edge_flags & kCutsHeight) == 0 && body.height_m <= row.height_m) row.height_corrected_m = body.height_m;
  row.volume_corrected_m3 =
      std::numbers::pi / 6.0 * row.length_corrected_m * row.width_corrected_m * row.height_corrected_m;
  const double sv = row.backscatter_m2 / row.volume_corrected_m3;
  if (sv > 0.0) row.sv_corrected_db = db_from_linear(sv);
}

/// A ping whose echo no shape of beam explains, as beside a corrupted packet, must not outweigh all others.
double dispersion(const BodyEcho& body) {
  double least = std::numeric_limits<double>::infinity();
  for (const HeightLikelihood& heights : body.heights) {
    if (!heights.at.empty()) least = std::min(least, heights.overdispersion());
  }
  return std::isfinite(least) ? least : 1.0;
}

/// What a ping and its neighbours in time tell of the height under a shape of beam. Neighbours that see it cut have no
/// say; the ping's own fans are needed for its length even so.
HeightLikelihood heights_near(const SchoolThroughPings& pings, std::size_t shape, std::int64_t centre,
                              std::int64_t reach) {
  HeightLikelihood sum;
  for (const MeasuredSchool* ping : pings) {
    const std::int64_t off = std::abs(ping->row.ping_index - centre);
    if (off > reach || (off != 0 && (ping->row.edge_flags & kCutsHeight) != 0)) continue;
    if (shape < ping->body.heights.size()) add_sighting(sum, ping->body.heights[shape], dispersion(ping->body));
  }
  return sum;
}

/// A school's body in each of its pings, and how its density changes along one axis by a ping and its neighbours. Those
/// that see the school cut have no say.
class BodyThroughPings {
 public:
  BodyThroughPings(const SchoolThroughPings& pings, std::size_t shape, const BeamShape& beam,
                   const MeasureParams& params)
      : pings_(pings), params_(params) {
    for (const MeasuredSchool* ping : pings) {
      const HeightLikelihood heights = heights_near(pings, shape, ping->row.ping_index, params.height_pool_pings);
      sightings_.push_back(body_sighting(ping->body, heights, beam, params));
    }
  }
  [[nodiscard]] BodySize size(std::size_t ping) const {
    if (!sightings_[ping]) return {};
    const BodyShape shape = {density(ping, &BodySighting::length), density(ping, &BodySighting::width),
                             density(ping, &BodySighting::line_of_sight)};
    return body_size(*sightings_[ping], shape, pings_[ping]->body.centre, params_);
  }

 private:
  [[nodiscard]] double density(std::size_t ping, AxisSighting BodySighting::*axis) const {
    std::vector<AxisSighting> near;
    for (std::size_t k = 0; k < pings_.size(); ++k) {
      const SchoolPingRow& row = pings_[k]->row;
      if (std::abs(row.ping_index - pings_[ping]->row.ping_index) > params_.height_pool_pings) continue;
      if (sightings_[k] && (row.edge_flags & (kCutsLevel | kCutsHeight)) == 0) near.push_back((*sightings_[k]).*axis);
    }
    return shape_variance(near, params_);
  }

  const SchoolThroughPings& pings_;
  const MeasureParams& params_;
  std::vector<std::optional<BodySighting>> sightings_;
};

constexpr std::int64_t kNoPing = -1;
constexpr std::int64_t kAllPings = std::numeric_limits<std::int64_t>::max();

/// Index of the shape of beam under which the echo of all schools is likeliest, each with one height for all its pings:
/// the shape is the sonar's, and one school's ragged body may look like another.
std::size_t likeliest_shape(const std::vector<SchoolThroughPings>& schools, const std::vector<BeamShape>& beams) {
  const std::size_t shapes = beams.size();
  std::vector<double> likelihood(shapes, 0.0);
  for (std::size_t shape = 0; shape < shapes; ++shape) likelihood[shape] = -beams[shape].handicap;
  for (const SchoolThroughPings& school : schools) {
    std::vector<double> peaks(shapes, 0.0);
    double overdispersion = std::numeric_limits<double>::infinity();
    for (std::size_t shape = 0; shape < shapes; ++shape) {
      const HeightLikelihood all = heights_near(school, shape, kNoPing, kAllPings);
      if (all.at.empty()) continue;
      peaks[shape] = *std::max_element(all.at.begin(), all.at.end());
      overdispersion = std::min(overdispersion, all.overdispersion());
    }
    for (std::size_t shape = 0; shape < shapes; ++shape) likelihood[shape] += peaks[shape] / overdispersion;
  }
  return static_cast<std::size_t>(std::max_element(likelihood.begin(), likelihood.end()) - likelihood.begin());
}

/// The same for all pings of an observation; those without an echo do not know it.
double area_of(const std::vector<SchoolThroughPings>& schools) {
  for (const SchoolThroughPings& school : schools) {
    for (const MeasuredSchool* ping : school) {
      if (ping->body.known) return ping->body.two_way_area;
    }
  }
  return 1.0;
}

}  // namespace

std::vector<SchoolPingRow> correct_sizes(const std::vector<SchoolThroughPings>& schools, const MeasureParams& params) {
  const std::vector<BeamShape> shapes = beam_shapes(params, area_of(schools));
  const std::size_t shape = likeliest_shape(schools, shapes);
  std::vector<SchoolPingRow> rows;
  for (const SchoolThroughPings& school : schools) {
    const BodyThroughPings bodies(school, shape, shapes[shape], params);
    for (std::size_t ping = 0; ping < school.size(); ++ping) {
      rows.push_back(school[ping]->row);
      measure_body(bodies.size(ping), rows.back());
    }
  }
  return rows;
}

}  // namespace sonar
