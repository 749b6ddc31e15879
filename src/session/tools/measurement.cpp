// SPDX-License-Identifier: Apache-2.0
#include "session/tools/measurement.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "base/number_text.h"
#include "base/units.h"
#include "geo/geodesic.h"
#include "session/looks/place_text.h"

namespace sonar {
namespace {

constexpr double kUpright_m = 1e-6;  ///< a line whose ends lie nearer has no bearing

/// Joins what is there.
std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string all;
  for (const std::string& part : parts) {
    if (part.empty()) continue;
    if (!all.empty()) all += between;
    all += part;
  }
  return all;
}

std::string bearing_text(const LineFigures& line) {
  if (std::isnan(line.bearing_deg)) return {};
  // 359.97 is north as well.
  const double tenth = std::round(line.bearing_deg * 10.0) / 10.0;
  return line.from_bow ? fmt::format("bow {:+.1f}\u00B0", tenth)
                       : fmt::format("bearing {:05.1f}\u00B0", wrap_360(tenth));
}

std::string depth_text(const LineFigures& line, const Unit& unit) {
  if (std::isnan(line.deeper_m)) return {};
  if (unit.of(std::abs(line.deeper_m)) < 0.05) return "equally deep";
  return fmt::format("{} {}", quantity_text(std::abs(line.deeper_m), 1, unit),
                     line.deeper_m > 0.0 ? "deeper" : "shallower");
}

std::string distance_text(const Measurement& measured, const Unit& unit) {
  const double distance_m = measured.line.horizontal_m;
  if (measured.on != Measurement::On::map) return quantity_text(distance_m, 1, unit) + " horizontal";
  return fmt::format("{} {}, {:.3f} nmi", grouped(static_cast<std::size_t>(std::llround(unit.of(distance_m)))),
                     unit.name, distance_m / kMetresPerNauticalMile);
}

std::string slant_text(const LineFigures& line, const Unit& unit) {
  return std::isnan(line.slant_m) ? std::string{} : quantity_text(line.slant_m, 1, unit) + " slant";
}

std::string end_text(const char* which, const MeasuredEnd& end, const Unit& unit) {
  std::vector<std::string> parts;
  if (end.where) {
    parts.push_back(latitude_minutes_text(end.where->latitude_deg));
    parts.push_back(longitude_minutes_text(end.where->longitude_deg));
  }
  if (!std::isnan(end.depth_m)) parts.push_back("depth " + quantity_text(end.depth_m, 1, unit));
  if (!std::isnan(end.sv_db)) parts.push_back(fmt::format("Sv {:.1f} dB", end.sv_db));
  return parts.empty() ? std::string{} : which + joined(parts, ", ");
}

/// Which voxels an area is about: those of one slice are not all of a body.
std::string part_text(const Measurement& measured) {
  if (measured.area.fans > 0) return fmt::format("in all {} fans", measured.area.fans);
  if (!measured.slice) return {};
  if (const auto* top = std::get_if<TopSlice>(&*measured.slice)) return fmt::format("in fan {} alone", top->fan);
  if (const auto* side = std::get_if<SideSlice>(&*measured.slice)) {
    return fmt::format("in beam {} of each fan alone", side->beam);
  }
  if (const auto* shell = std::get_if<RangeSlice>(&*measured.slice)) {
    return fmt::format("at sample {} alone", shell->sample);
  }
  return "in this plane alone";
}

std::string sv_text(const EchoStatistics& echo) {
  if (echo.voxels == 0) return {};
  if (echo.heard == 0) return "no sound voxel";
  if (std::isnan(echo.sv_mean_db)) return "no echo above the noise";
  return fmt::format("mean Sv {:.1f} dB, max {:.1f} dB", echo.sv_mean_db, echo.sv_max_db);
}

std::string sigma_text(const EchoStatistics& echo) {
  return std::isnan(echo.sv_mean_db) ? std::string{} : fmt::format("\u03C3_bs {:.3g} m\u00B2", echo.backscatter_m2);
}

std::string extent_text(const MaskExtents& extents, const Unit& unit) {
  if (std::isnan(extents.depth_min_m)) return {};
  return fmt::format("depth {:.1f} to {}", unit.of(extents.depth_min_m), quantity_text(extents.depth_max_m, 1, unit));
}

std::vector<std::string> area_parts(const Measurement& measured, const Unit& unit) {
  const EchoStatistics& echo = measured.area.statistics.echo;
  std::vector<std::string> parts;
  const auto voxels = static_cast<std::size_t>(echo.voxels);
  parts.push_back(fmt::format("{} voxel{} {}", grouped(voxels), voxels == 1 ? "" : "s", part_text(measured)));
  if (voxels > 0) parts.push_back(fmt::format("{:.3g} m\u00B3", echo.volume_m3));
  parts.push_back(sv_text(echo));
  parts.push_back(sigma_text(echo));
  parts.push_back(extent_text(measured.area.statistics.extents, unit));
  if (const auto& given_back = measured.area.extinction_db) {
    parts.push_back(std::isnan(*given_back) ? std::string("corrected for extinction")
                                            : fmt::format("corrected for extinction by {:.1f} dB", *given_back));
  }
  if (echo.voxels > echo.heard) parts.push_back(fmt::format("{} faulty left out", echo.voxels - echo.heard));
  if (measured.area.never > 0) {
    parts.push_back(fmt::format("{} near transducer, surface or seabed left out", measured.area.never));
  }
  return parts;
}

/// A column of the table.
struct Column {
  std::string name;
  std::string value;
};

std::string with_decimals(double value, int decimals) {
  return std::isnan(value) ? std::string{} : fmt::format("{:.{}f}", value, decimals);
}

Column length_column(const std::string& what, double m, const Unit& unit) {
  return {with_unit(what, unit), with_decimals(unit.of(m), 2)};
}

void add_end(const std::string& which, const MeasuredEnd& end, bool in_water, const Unit& unit,
             std::vector<Column>& columns) {
  columns.push_back({which + " latitude (deg)", end.where ? degrees_text(end.where->latitude_deg) : ""});
  columns.push_back({which + " longitude (deg)", end.where ? degrees_text(end.where->longitude_deg) : ""});
  if (!in_water) return;
  columns.push_back(length_column(which + " depth", end.depth_m, unit));
  columns.push_back({which + " Sv (dB re 1 m-1)", with_decimals(end.sv_db, 2)});
}

std::vector<Column> line_columns(const Measurement& measured, const Unit& unit) {
  const LineFigures& line = measured.line;
  const bool in_water = measured.on != Measurement::On::map;
  std::vector<Column> columns;
  columns.push_back(length_column("horizontal distance", line.horizontal_m, unit));
  columns.push_back({"horizontal distance (nmi)", with_decimals(line.horizontal_m / kMetresPerNauticalMile, 5)});
  if (in_water) columns.push_back(length_column("slant distance", line.slant_m, unit));
  columns.push_back(
      {line.from_bow ? "bearing from the bow (deg)" : "true bearing (deg)", with_decimals(line.bearing_deg, 2)});
  if (in_water) columns.push_back(length_column("depth difference", line.deeper_m, unit));
  if (measured.ends) {
    add_end("from", measured.ends->front(), in_water, unit, columns);
    add_end("to", measured.ends->back(), in_water, unit, columns);
  }
  return columns;
}

std::vector<Column> area_columns(const Measurement& measured, const Unit& unit) {
  const EchoStatistics& echo = measured.area.statistics.echo;
  const MaskExtents& extents = measured.area.statistics.extents;
  return {{"shape", measured.shape == Measurement::Shape::box ? "box" : "lasso"},
          {"part", part_text(measured)},
          {"voxels", std::to_string(echo.voxels)},
          {"faulty voxels, not in mean Sv", std::to_string(echo.voxels - echo.heard)},
          {"voxels near transducer, surface or seabed, not counted", std::to_string(measured.area.never)},
          {"volume (m3)", shortest(echo.volume_m3)},
          {"mean Sv (dB re 1 m-1)", with_decimals(echo.sv_mean_db, 3)},
          {"Sv 5th percentile (dB re 1 m-1)", with_decimals(echo.sv_p5_db, 3)},
          {"Sv median (dB re 1 m-1)", with_decimals(echo.sv_p50_db, 3)},
          {"Sv 95th percentile (dB re 1 m-1)", with_decimals(echo.sv_p95_db, 3)},
          {"Sv maximum (dB re 1 m-1)", with_decimals(echo.sv_max_db, 3)},
          {"sigma_bs total (m2)", shortest(echo.backscatter_m2)},
          {"corrected for extinction by (dB)", with_decimals(measured.area.extinction_db.value_or(kUnknown), 3)},
          length_column("depth min", extents.depth_min_m, unit),
          length_column("depth max", extents.depth_max_m, unit),
          length_column("range min", extents.range_min_m, unit),
          length_column("range max", extents.range_max_m, unit),
          length_column("length", extents.length_m, unit),
          length_column("width", extents.width_m, unit)};
}

}  // namespace

LineFigures line_figures(const MeasuredEnd& from, const MeasuredEnd& to, const Placement& placement,
                         bool heading_known) {
  LineFigures line;
  if (from.place && to.place) {
    const Point<Sonar> way = levelled(*to.place, placement) - levelled(*from.place, placement);
    line.horizontal_m = std::hypot(way.x, way.y);
    line.slant_m = norm(way);
    line.deeper_m = way.z;
    line.from_bow = !heading_known;
    const double bow_deg = deg_from_rad(std::atan2(way.y, way.x));
    if (line.horizontal_m > kUpright_m) {
      line.bearing_deg = heading_known ? wrap_360(bow_deg + deg_from_rad(placement.heading_rad)) : wrap_180(bow_deg);
    }
  } else if (from.where && to.where) {
    const GeodesicStep step = geodesic(*from.where, *to.where);
    line.horizontal_m = step.distance_m;
    if (step.distance_m > kUpright_m) line.bearing_deg = step.bearing_deg;
  }
  return line;
}

std::string brief_text(const Measurement& measured, const Units& units) {
  const Unit unit = units.length();
  if (measured.shape != Measurement::Shape::line) return joined(area_parts(measured, unit), "\n");
  return joined({distance_text(measured, unit), slant_text(measured.line, unit), bearing_text(measured.line),
                 depth_text(measured.line, unit)},
                "\n");
}

std::string whole_text(const Measurement& measured, const Units& units) {
  const Unit unit = units.length();
  if (measured.shape != Measurement::Shape::line) {
    const char* shape = measured.shape == Measurement::Shape::box ? "box: " : "lasso: ";
    return shape + joined(area_parts(measured, unit), ", ");
  }
  std::string text = "line: " + joined({distance_text(measured, unit), slant_text(measured.line, unit),
                                        bearing_text(measured.line), depth_text(measured.line, unit)},
                                       ", ");
  if (!measured.ends) return text;
  return joined({text, end_text("from ", measured.ends->front(), unit), end_text("to ", measured.ends->back(), unit)},
                "; ");
}

std::string table_text(const Measurement& measured, const Units& units) {
  const Unit unit = units.length();
  std::vector<Column> columns;
  if (measured.on != Measurement::On::map) {
    columns.push_back({"observation", measured.name});
    columns.push_back({"ping", std::to_string(measured.ping)});
  }
  const bool line = measured.shape == Measurement::Shape::line;
  for (Column& column : line ? line_columns(measured, unit) : area_columns(measured, unit))
    columns.push_back(std::move(column));
  std::string names;
  std::string values;
  for (const Column& column : columns) {
    const char* tab = names.empty() ? "" : "\t";
    names += tab + column.name;
    values += tab + column.value;
  }
  return names + "\n" + values + "\n";
}

}  // namespace sonar
