// SPDX-License-Identifier: Apache-2.0
#include "io/survey_layers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "io/map_geometry.h"
#include "io/map_layers.h"
#include "model/school_totals.h"

namespace sonar {
namespace {

/// Farther than a sonar sees, up to 89 degrees of latitude.
constexpr double kDateLineMargin_deg = 1.0;

/// Attributes of the layers that show an observation.
struct ObservationRow {
  std::string observation;
  TimeNs first_time_utc = 0;
  TimeNs last_time_utc = 0;
  std::int64_t n_pings = 0;
  std::int64_t n_schools = 0;
};

template <class Visitor>
void columns(Visitor& v, ObservationRow& r) {
  v("observation", "", r.observation);
  v("first_time_utc", "", TimeColumn{r.first_time_utc});
  v("last_time_utc", "", TimeColumn{r.last_time_utc});
  v("n_pings", "1", r.n_pings);
  v("n_schools", "1", r.n_schools);
}

/// Attributes of a school's outline in one ping.
struct OutlineRow {
  std::string observation;
  std::int64_t school_id = 0;
  std::int64_t ping_index = 0;
  TimeNs time_utc = 0;
  std::int64_t survey_school = 0;
};

template <class Visitor>
void columns(Visitor& v, OutlineRow& r) {
  v("observation", "", r.observation);
  v("school_id", "1", r.school_id);
  v("ping_index", "1", r.ping_index);
  v("time_utc", "", TimeColumn{r.time_utc});
  v("survey_school", "1", r.survey_school);
}

ObservationRow observation_row(const ObservationProduct& product) {
  ObservationRow row;
  row.observation = product.observation;
  if (!product.pings.empty()) {
    row.first_time_utc = product.pings.front().time;
    row.last_time_utc = product.pings.back().time;
  }
  row.n_pings = static_cast<std::int64_t>(product.pings.size());
  row.n_schools = school_count(product);
  return row;
}

bool has_place(const PingNavigation& ping) { return ping.has_position() && std::isfinite(ping.heading_deg); }

const PingNavigation* ping_of(const ObservationProduct& product, std::int64_t index) {
  if (index < 0 || index >= static_cast<std::int64_t>(product.pings.size())) return nullptr;
  const PingNavigation& ping = product.pings[static_cast<std::size_t>(index)];
  return has_place(ping) ? &ping : nullptr;
}

const PingMask* mask_of(const ObservationProduct& product, std::int64_t school_id, std::int64_t ping_index) {
  const auto key = std::pair(school_id, ping_index);
  const auto found = std::lower_bound(product.masks.begin(), product.masks.end(), key,
                                      [](const auto& m, auto k) { return std::pair(m.school_id, m.ping_index) < k; });
  const bool there = found != product.masks.end() && std::pair(found->school_id, found->ping_index) == key;
  return there ? &found->mask : nullptr;
}

const std::vector<std::pair<const char*, OGRwkbGeometryType>> kObservationLayers = {{"vessel_track", wkbLineString},
                                                                                    {"observations", wkbPolygon},
                                                                                    {"swept", wkbMultiPolygon},
                                                                                    {"observation_starts", wkbPoint}};

}  // namespace

struct SurveyMapWriter::State {
  std::unique_ptr<MapLayers> layers;
  std::optional<double> reference_deg;  ///< longitude of the survey's first position

  Result<void> make_layers(bool near_date_line);
  Result<void> add_observation(const ObservationProduct& product, const PlacementOf& placed);
  Result<void> add_schools(const ObservationProduct& product, const Sector* sector, const PlacementOf& placed);
  Result<void> add_centres(const ObservationProduct& product);
  [[nodiscard]] double near(double longitude_deg) const {
    return near_longitude(longitude_deg, reference_deg.value_or(longitude_deg));
  }
};

Result<void> SurveyMapWriter::State::make_layers(bool near_date_line) {
  // A feature in two parts is no Polygon any more, and a layer holds only what it says it holds.
  const auto declared = [&](OGRwkbGeometryType type) {
    return near_date_line && (type == wkbLineString || type == wkbPolygon) ? wkbUnknown : type;
  };
  for (const auto& [name, type] : kObservationLayers) {
    auto made = layers->add_layer(name, declared(type), columns_of(std::vector<ObservationRow>{}));
    if (!made) return made;
  }
  auto made = layers->add_layer("schools", wkbMultiPolygon, columns_of(std::vector<SchoolRow>{}));
  if (made) made = layers->add_layer("school_outlines", declared(wkbPolygon), columns_of(std::vector<OutlineRow>{}));
  if (made) made = layers->add_layer("school_centres", wkbPoint, columns_of(std::vector<SchoolPingRow>{}));
  return made;
}

Result<void> SurveyMapWriter::State::add_observation(const ObservationProduct& product, const PlacementOf& placed) {
  const auto attributes = columns_of(std::vector{observation_row(product)});
  OGRLineString track;
  std::optional<Geographic> origin;
  std::vector<Ring> footprints;
  std::vector<PlanePoint> corners;
  const std::optional<Sector> sector =
      product.grid ? std::optional(product.grid->grid.sector(product.grid->range)) : std::nullopt;
  for (const PingNavigation& ping : product.pings) {
    if (!ping.has_position()) continue;
    if (!origin) origin = ping.transducer;
    track.addPoint(near(ping.transducer.longitude_deg), ping.transducer.latitude_deg);
    if (!sector || !has_place(ping)) continue;
    const PlaneShift into(ping.transducer, *origin);
    Ring ring = footprint(*product.grid, *sector, placed(ping));
    for (PlanePoint& p : ring) p = into.apply(p);
    corners.insert(corners.end(), ring.begin(), ring.end());
    footprints.push_back(std::move(ring));
  }
  OGRPoint start;
  std::unique_ptr<OGRPolygon> hull = std::make_unique<OGRPolygon>();
  auto swept = std::make_unique<OGRMultiPolygon>();
  if (origin) {
    start = OGRPoint(near(origin->longitude_deg), origin->latitude_deg);
    const ToDegrees degrees(*origin, *reference_deg);
    hull = polygon_of(convex_hull(std::move(corners)));
    swept = united(footprints);
    degrees.apply(*hull);
    degrees.apply(*swept);
  }
  const OGRGeometry* line = track.getNumPoints() >= 2 ? &track : nullptr;
  auto added = layers->add("vessel_track", line, attributes, 0);
  if (added) added = layers->add("observations", hull.get(), attributes, 0);
  if (added) added = layers->add("swept", swept.get(), attributes, 0);
  if (added) added = layers->add("observation_starts", &start, attributes, 0);
  return added;
}

Result<void> SurveyMapWriter::State::add_schools(const ObservationProduct& product, const Sector* sector,
                                                 const PlacementOf& placed) {
  const auto attributes = columns_of(product.schools);
  for (std::size_t i = 0; i < product.schools.size(); ++i) {
    const SchoolRow& school = product.schools[i];
    std::vector<std::unique_ptr<OGRMultiPolygon>> outlines;
    std::optional<Geographic> origin;
    for (const SchoolPingRow& row : product.school_pings) {
      if (row.school_id != school.school_id) continue;
      const PingNavigation* ping = ping_of(product, row.ping_index);
      const PingMask* mask = mask_of(product, row.school_id, row.ping_index);
      std::unique_ptr<OGRPolygon> single;
      if (ping != nullptr && mask != nullptr && sector != nullptr) {
        if (!origin) origin = ping->transducer;
        auto outline = united(mask_rings(*sector, *mask, placed(*ping)));
        single = in_one_piece(*outline);
        ToDegrees(ping->transducer, *reference_deg).apply(*single);
        shift(*outline, PlaneShift(ping->transducer, *origin));
        outlines.push_back(std::move(outline));
      }
      const std::vector<OutlineRow> rows{
          {row.observation, row.school_id, row.ping_index, row.time_utc, row.survey_school}};
      if (auto added = layers->add("school_outlines", single.get(), columns_of(rows), 0); !added) return added;
    }
    auto whole = united(outlines);
    if (origin) ToDegrees(*origin, *reference_deg).apply(*whole);
    if (auto added = layers->add("schools", whole.get(), attributes, i); !added) return added;
  }
  return {};
}

Result<void> SurveyMapWriter::State::add_centres(const ObservationProduct& product) {
  const auto attributes = columns_of(product.school_pings);
  for (std::size_t i = 0; i < product.school_pings.size(); ++i) {
    const SchoolPingRow& row = product.school_pings[i];
    OGRPoint point;
    if (std::isfinite(row.latitude) && std::isfinite(row.longitude)) {
      point = OGRPoint(near(row.longitude), row.latitude);
    }
    if (auto added = layers->add("school_centres", &point, attributes, i); !added) return added;
  }
  return {};
}

SurveyMapWriter::SurveyMapWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
SurveyMapWriter::SurveyMapWriter(SurveyMapWriter&&) noexcept = default;
SurveyMapWriter& SurveyMapWriter::operator=(SurveyMapWriter&&) noexcept = default;
SurveyMapWriter::~SurveyMapWriter() = default;

Result<SurveyMapWriter> SurveyMapWriter::create(const std::filesystem::path& target, MapFormat format,
                                                std::span<const ObservationProduct> observations) {
  TimeNs last_ping_time = 0;
  bool near_date_line = false;
  for (const ObservationProduct& product : observations) {
    for (const PingNavigation& ping : product.pings) {
      last_ping_time = std::max(last_ping_time, ping.time);
      near_date_line = near_date_line || std::abs(ping.transducer.longitude_deg) > 180.0 - kDateLineMargin_deg;
    }
  }
  auto layers = MapLayers::create(target, format, last_ping_time);
  if (!layers) return pass_on(layers);
  auto state = std::make_unique<State>();
  state->layers = std::move(*layers);
  if (auto made = state->make_layers(near_date_line); !made) return pass_on(made);
  return SurveyMapWriter(std::move(state));
}

Result<void> SurveyMapWriter::add(const ObservationProduct& product, const PlacementOf& placed) {
  for (const PingNavigation& ping : product.pings) {
    if (!state_->reference_deg && ping.has_position()) state_->reference_deg = ping.transducer.longitude_deg;
  }
  std::optional<Sector> sector;
  if (product.grid) sector = product.grid->grid.sector(product.grid->range);
  auto added = state_->add_observation(product, placed);
  if (added) added = state_->add_schools(product, sector ? &*sector : nullptr, placed);
  if (added) added = state_->add_centres(product);
  return added;
}

Result<void> SurveyMapWriter::finish() { return state_->layers->commit(); }

}  // namespace sonar
