// SPDX-License-Identifier: Apache-2.0
#include "io/geojson_file.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <ogr_api.h>

#include <cmath>
#include <utility>
#include <variant>

#include "base/number_text.h"

namespace sonar {
namespace {

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string value_text(const TableColumn& column, std::size_t row) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    const double value = (*numbers)[row];
    if (!std::isfinite(value)) return "null";
    return column.is_degrees ? degrees_text(value) : shortest(value);
  }
  if (const auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values)) {
    return std::to_string((*wholes)[row]);
  }
  const std::string& text = std::get<std::vector<std::string>>(column.values)[row];
  return text.empty() ? "null" : json_text(text);
}

/// RFC 7946, 3.1.6: exterior rings run anticlockwise, holes clockwise. Some readers take the wrong side else.
class RightHanded : public OGRDefaultGeometryVisitor {
 public:
  using OGRDefaultGeometryVisitor::visit;
  void visit(OGRPolygon* polygon) override {
    bool exterior = true;
    for (OGRLinearRing* ring : *polygon) {
      if ((ring->isClockwise() != 0) == exterior) ring->reverseWindingOrder();
      exterior = false;
    }
  }
};

std::string geometry_text(const OGRGeometry* geometry) {
  if (geometry == nullptr || geometry->IsEmpty()) return "null";
  const std::unique_ptr<OGRGeometry> turned(geometry->clone());
  RightHanded right_handed;
  turned->accept(&right_handed);
  CPLStringList options;
  options.SetNameValue("COORDINATE_PRECISION", "8");
  const std::unique_ptr<char, decltype([](char* text) { CPLFree(text); })> text(
      OGR_G_ExportToJsonEx(OGRGeometry::ToHandle(turned.get()), options.List()));
  return text ? text.get() : "null";
}

}  // namespace

Result<GeoJsonFile> GeoJsonFile::create(const std::filesystem::path& target, std::string_view layer) {
  auto file = AtomicFile::create(target);
  if (!file) return pass_on(file);
  GeoJsonFile made(std::move(*file));
  auto begun =
      made.write(fmt::format("{{\n\"type\": \"FeatureCollection\",\n\"name\": {},\n\"features\": [", json_text(layer)));
  if (!begun) return pass_on(begun);
  return made;
}

Result<void> GeoJsonFile::write(std::string_view text) {
  constexpr std::size_t kAtOnce = 1U << 16U;
  buffer_ += text;
  return buffer_.size() < kAtOnce ? Result<void>{} : flush();
}

Result<void> GeoJsonFile::flush() {
  auto written = file_.write(buffer_);
  buffer_.clear();
  return written;
}

Result<void> GeoJsonFile::add(const OGRGeometry* geometry, const std::vector<TableColumn>& columns, std::size_t row) {
  std::string text =
      empty_ ? "\n{ \"type\": \"Feature\", \"properties\": {" : ",\n{ \"type\": \"Feature\", \"properties\": {";
  empty_ = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    text += fmt::format("{} {}: {}", i == 0 ? "" : ",", json_text(columns[i].name), value_text(columns[i], row));
  }
  text += " }, \"geometry\": " + geometry_text(geometry) + " }";
  return write(text);
}

Result<void> GeoJsonFile::close() {
  if (auto ended = write("\n]\n}\n"); !ended) return ended;
  return flush();
}

}  // namespace sonar
