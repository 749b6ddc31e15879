// SPDX-License-Identifier: Apache-2.0
#include "io/map_layers.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <mutex>
#include <utility>

#include "base/library_gate.h"
#include "io/column_words.h"
#include "io/gdal_drivers.h"
#include "io/layer_styles.h"
#include "io/map_geometry.h"

namespace sonar {
namespace {

constexpr std::size_t kTimeTextSize = 24;

/// Keeps GDAL from printing, and today's date out of its files, while it lives.
class QuietGdal {
 public:
  /// failure  becomes the first failure that GDAL tells: those behind it follow from it
  QuietGdal(const std::string& date, std::string& failure) {
    const auto keep_first = [](CPLErr kind, CPLErrorNum, const char* text) {
      auto& first = *static_cast<std::string*>(CPLGetErrorHandlerUserData());
      if (kind >= CE_Failure && first.empty()) first = text;
    };
    CPLPushErrorHandlerEx(keep_first, &failure);
    CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", date.c_str());
    // The whole file is flushed before it is renamed; SQLite's own flushing would only cost time.
    CPLSetThreadLocalConfigOption("OGR_SQLITE_SYNCHRONOUS", "OFF");
  }
  ~QuietGdal() {
    CPLSetThreadLocalConfigOption("OGR_SQLITE_SYNCHRONOUS", nullptr);
    CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", nullptr);
    CPLPopErrorHandler();
  }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

 private:
  std::shared_lock<std::shared_mutex> inside_ = inside_library();
};

bool is_time(const TableColumn& column) { return column.name.ends_with("_utc"); }

OGRFieldType field_type(const TableColumn& column) {
  if (is_time(column)) return OFTDateTime;
  if (std::holds_alternative<std::vector<double>>(column.values)) return OFTReal;
  if (std::holds_alternative<std::vector<std::int64_t>>(column.values)) return OFTInteger64;
  return OFTString;
}

void set(OGRFeature& feature, int field, const TableColumn& column, std::size_t row) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    if (std::isfinite((*numbers)[row])) feature.SetField(field, (*numbers)[row]);
  } else if (const auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values)) {
    feature.SetField(field, static_cast<GIntBig>((*wholes)[row]));
  } else {
    const std::string& text = std::get<std::vector<std::string>>(column.values)[row];
    if (!is_time(column) || text.size() == kTimeTextSize) feature.SetField(field, text.c_str());
  }
}

/// A text of SQL.
std::string sql_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

}  // namespace

MapLayers::MapLayers(std::filesystem::path target, MapFormat format, TimeNs last_ping_time)
    : target_(std::move(target)), format_(format), date_(iso_time(last_ping_time)) {}

MapLayers::~MapLayers() {
  const QuietGdal quiet(date_, failure_);
  dataset_.reset();
}

tl::unexpected<Error> MapLayers::refused(std::string_view what) const {
  // "sqlite3_exec(CREATE TRIGGER ...) failed: database or disk is full": what it was about to do helps nobody.
  std::string_view why = failure_;
  constexpr std::string_view kFailed = ") failed: ";
  if (const auto at = why.rfind(kFailed); at != std::string_view::npos) why.remove_prefix(at + kFailed.size());
  return fail(ErrorCode::io, fmt::format("{}: {}", what, why), {.file = target_.string()});
}

Result<std::unique_ptr<MapLayers>> MapLayers::create(const std::filesystem::path& target, MapFormat format,
                                                     TimeNs last_ping_time) {
  begin_gdal();
  std::unique_ptr<MapLayers> layers(new MapLayers(target, format, last_ping_time));
  if (format == MapFormat::geopackage) {
    const auto opened = layers->open_geopackage();
    if (!opened) return pass_on(opened);
  }
  return layers;
}

Result<void> MapLayers::open_geopackage() {
  const QuietGdal quiet(date_, failure_);
  auto file = AtomicFile::create(target_);
  if (!file) return pass_on(file);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  if (driver == nullptr) return fail(ErrorCode::unsupported, "GDAL was built without GPKG");
  // GDAL wants to make the file itself.
  std::error_code absent;
  std::filesystem::remove(file->temporary(), absent);
  geopackage_ = std::move(*file);
  dataset_.reset(driver->Create(geopackage_->temporary().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset_) return refused("cannot create the map");
  if (dataset_->StartTransaction() != OGRERR_NONE) return refused("SQLite");
  return {};
}

Result<void> MapLayers::add_layer(const std::string& name, OGRwkbGeometryType type,
                                  const std::vector<TableColumn>& columns) {
  if (format_ == MapFormat::geojson) {
    auto file = GeoJsonFile::create(target_ / (name + ".geojson"), name);
    if (!file) return pass_on(file);
    json_files_.emplace(name, std::move(*file));
    return {};
  }
  const QuietGdal quiet(date_, failure_);
  OGRSpatialReference wgs84;
  wgs84.importFromEPSG(4326);
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRLayer* layer = dataset_->CreateLayer(name.c_str(), &wgs84, type, nullptr);
  if (layer == nullptr) return refused("cannot create layer " + name);
  for (const TableColumn& column : columns) {
    OGRFieldDefn field(column.name.c_str(), field_type(column));
    if (layer->CreateField(&field) != OGRERR_NONE) return refused("cannot create field " + column.name);
  }
  layers_[name] = layer;
  columns_[name] = columns;
  return {};
}

Result<void> MapLayers::execute(const std::string& sql) {
  failure_.clear();
  if (OGRLayer* answer = dataset_->ExecuteSQL(sql.c_str(), nullptr, nullptr)) dataset_->ReleaseResultSet(answer);
  return failure_.empty() ? Result<void>{} : refused("cannot describe the map");
}

/// The schema extension of GeoPackage: what each column is, with its unit.
Result<void> MapLayers::describe_columns() {
  auto done = execute(
      "CREATE TABLE IF NOT EXISTS gpkg_data_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, name TEXT, "
      "title TEXT, description TEXT, mime_type TEXT, constraint_name TEXT, CONSTRAINT pk_gdc PRIMARY KEY "
      "(table_name, column_name), CONSTRAINT gdc_tn UNIQUE (table_name, name))");
  if (done) {
    done = execute(
        "CREATE TABLE IF NOT EXISTS gpkg_data_column_constraints (constraint_name TEXT NOT NULL, constraint_type TEXT "
        "NOT NULL, value TEXT, min NUMERIC, min_is_inclusive BOOLEAN, max NUMERIC, max_is_inclusive BOOLEAN, "
        "description "
        "TEXT, CONSTRAINT gdcc_ntv UNIQUE (constraint_name, constraint_type, value))");
  }
  if (done) {
    done = execute(
        "CREATE TABLE IF NOT EXISTS gpkg_extensions (table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL, "
        "definition TEXT NOT NULL, scope TEXT NOT NULL, CONSTRAINT ge_tce UNIQUE (table_name, column_name, "
        "extension_name))");
  }
  for (const auto* table : {"gpkg_data_columns", "gpkg_data_column_constraints"}) {
    if (!done) return done;
    done =
        execute(fmt::format("INSERT INTO gpkg_extensions VALUES ('{}', NULL, 'gpkg_schema', "
                            "'http://www.geopackage.org/spec121/#extension_schema', 'read-write')",
                            table));
  }
  for (const auto& [layer, columns] : columns_) {
    for (const TableColumn& column : columns) {
      const ColumnWords* words = words_of(layer + "." + column.name);
      if (words == nullptr) words = words_of(column.name);
      if (words == nullptr || !done) continue;
      const bool has_unit = !column.unit.empty() && column.unit != "1";
      const std::string unit = has_unit ? fmt::format(" [{}]", column.unit) : "";
      done = execute(fmt::format("INSERT INTO gpkg_data_columns VALUES ({}, {}, NULL, {}, {}, NULL, NULL)",
                                 sql_text(layer), sql_text(column.name), sql_text(column.name + unit),
                                 sql_text(std::string(words->long_name) + unit)));
    }
  }
  return done;
}

/// The table in which QGIS looks for a layer's style.
Result<void> MapLayers::add_styles() {
  auto done = execute(
      "CREATE TABLE layer_styles (id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, f_table_catalog TEXT(256), "
      "f_table_schema TEXT(256), f_table_name TEXT(256), f_geometry_column TEXT(256), styleName TEXT(30), "
      "styleQML TEXT, styleSLD TEXT, useAsDefault BOOLEAN, description TEXT, owner TEXT(30), ui TEXT(30), "
      "update_time DATETIME)");
  if (done) {
    done =
        execute(fmt::format("INSERT INTO gpkg_contents (table_name, data_type, identifier, description, last_change, "
                            "srs_id) VALUES ('layer_styles', 'attributes', 'layer_styles', '', {}, 0)",
                            sql_text(date_)));
  }
  for (const auto& [layer, columns] : columns_) {
    const std::string qml = layer_style_qml(layer);
    if (qml.empty() || !done) continue;
    done =
        execute(fmt::format("INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, "
                            "f_geometry_column, styleName, styleQML, styleSLD, useAsDefault, description, owner, ui, "
                            "update_time) VALUES ('', '', {0}, 'geom', {0}, {1}, '', 1, '', '', NULL, {2})",
                            sql_text(layer), sql_text(qml), sql_text(date_)));
  }
  return done;
}

Result<void> MapLayers::add(const std::string& layer_name, const OGRGeometry* geometry,
                            const std::vector<TableColumn>& columns, std::size_t row) {
  const QuietGdal quiet(date_, failure_);
  const bool there = geometry != nullptr && !geometry->IsEmpty();
  const std::unique_ptr<OGRGeometry> cut = there ? cut_at_date_line(*geometry) : nullptr;
  if (format_ == MapFormat::geojson) return json_files_.at(layer_name).add(cut.get(), columns, row);
  OGRLayer* layer = layers_.at(layer_name);
  OGRFeature feature(layer->GetLayerDefn());
  for (std::size_t i = 0; i < columns.size(); ++i) set(feature, static_cast<int>(i), columns[i], row);
  if (cut && !cut->IsEmpty()) feature.SetGeometry(cut.get());
  if (layer->CreateFeature(&feature) != OGRERR_NONE) return refused("cannot write to layer " + layer_name);
  return {};
}

Result<void> MapLayers::commit() {
  for (auto& [layer, file] : json_files_) {
    if (auto closed = file.close(); !closed) return closed;
  }
  for (auto& [layer, file] : json_files_) {
    if (auto committed = file.commit(); !committed) return committed;
  }
  if (!geopackage_) return {};
  {
    const QuietGdal quiet(date_, failure_);
    if (auto described = describe_columns(); !described) return described;
    if (auto styled = add_styles(); !styled) return styled;
    CPLErrorReset();
    if (dataset_->CommitTransaction() != OGRERR_NONE) return refused("SQLite");
    layers_.clear();
    dataset_.reset();
    if (CPLGetLastErrorType() >= CE_Failure) return refused("cannot finish the map");
  }
  return geopackage_->commit();
}

}  // namespace sonar
