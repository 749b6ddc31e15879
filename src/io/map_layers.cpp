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

namespace sonar {
namespace {

constexpr std::size_t kTimeTextSize = 24;

/// Keeps GDAL from printing, and today's date out of its files, while it lives.
class QuietGdal {
 public:
  explicit QuietGdal(const std::string& date) {
    CPLPushErrorHandler(CPLQuietErrorHandler);
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

void register_drivers() {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
}

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

}  // namespace

MapLayers::MapLayers(std::filesystem::path target, MapFormat format, TimeNs last_ping_time)
    : target_(std::move(target)), format_(format), date_(iso_time(last_ping_time)) {}

MapLayers::~MapLayers() {
  const QuietGdal quiet(date_);
  datasets_.clear();
}

tl::unexpected<Error> MapLayers::refused(std::string_view what) const {
  return fail(ErrorCode::io, fmt::format("{}: {}", what, CPLGetLastErrorMsg()), {.file = target_.string()});
}

Result<std::unique_ptr<MapLayers>> MapLayers::create(const std::filesystem::path& target, MapFormat format,
                                                     TimeNs last_ping_time) {
  register_drivers();
  std::unique_ptr<MapLayers> layers(new MapLayers(target, format, last_ping_time));
  if (format == MapFormat::geopackage) {
    const auto opened = layers->open(target);
    if (!opened) return pass_on(opened);
  }
  return layers;
}

Result<GDALDataset*> MapLayers::open(const std::filesystem::path& target) {
  const QuietGdal quiet(date_);
  auto file = AtomicFile::create(target);
  if (!file) return pass_on(file);
  const char* name = format_ == MapFormat::geopackage ? "GPKG" : "GeoJSON";
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(name);
  if (driver == nullptr) return fail(ErrorCode::unsupported, fmt::format("GDAL was built without {}", name));
  // GDAL wants to make the file itself.
  std::filesystem::remove(file->temporary());
  Dataset dataset(driver->Create(file->temporary().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) return refused("cannot create the map");
  if (format_ == MapFormat::geopackage && dataset->StartTransaction() != OGRERR_NONE) return refused("SQLite");
  files_.push_back(std::move(*file));
  datasets_.push_back(std::move(dataset));
  return datasets_.back().get();
}

Result<void> MapLayers::add_layer(const std::string& name, OGRwkbGeometryType type,
                                  const std::vector<TableColumn>& columns) {
  GDALDataset* dataset = format_ == MapFormat::geopackage ? datasets_.front().get() : nullptr;
  if (dataset == nullptr) {
    const auto opened = open(target_ / (name + ".geojson"));
    if (!opened) return pass_on(opened);
    dataset = *opened;
  }
  const QuietGdal quiet(date_);
  OGRSpatialReference wgs84;
  wgs84.importFromEPSG(4326);
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  CPLStringList options;
  if (format_ == MapFormat::geojson) options.SetNameValue("COORDINATE_PRECISION", "8");
  OGRLayer* layer = dataset->CreateLayer(name.c_str(), &wgs84, type, options.List());
  if (layer == nullptr) return refused("cannot create layer " + name);
  for (const TableColumn& column : columns) {
    OGRFieldDefn field(column.name.c_str(), field_type(column));
    if (layer->CreateField(&field) != OGRERR_NONE) return refused("cannot create field " + column.name);
  }
  layers_[name] = layer;
  return {};
}

Result<void> MapLayers::add(const std::string& layer_name, const OGRGeometry* geometry,
                            const std::vector<TableColumn>& columns, std::size_t row) {
  const QuietGdal quiet(date_);
  OGRLayer* layer = layers_.at(layer_name);
  OGRFeature feature(layer->GetLayerDefn());
  for (std::size_t i = 0; i < columns.size(); ++i) set(feature, static_cast<int>(i), columns[i], row);
  if (geometry != nullptr && !geometry->IsEmpty()) feature.SetGeometry(geometry);
  if (layer->CreateFeature(&feature) != OGRERR_NONE) return refused("cannot write to layer " + layer_name);
  return {};
}

Result<void> MapLayers::commit() {
  {
    const QuietGdal quiet(date_);
    CPLErrorReset();
    if (format_ == MapFormat::geopackage && datasets_.front()->CommitTransaction() != OGRERR_NONE) {
      return refused("SQLite");
    }
    layers_.clear();
    datasets_.clear();
    if (CPLGetLastErrorType() >= CE_Failure) return refused("cannot finish the map");
  }
  for (AtomicFile& file : files_) {
    if (auto committed = file.commit(); !committed) return committed;
  }
  return {};
}

}  // namespace sonar
