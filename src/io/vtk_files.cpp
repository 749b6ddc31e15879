// SPDX-License-Identifier: Apache-2.0
#include "io/vtk_files.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/number_text.h"
#include "base/units.h"

namespace sonar {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

/// The arrays behind the XML, each with its length before it; what they are called stands in the XML.
class Appended {
 public:
  template <class T>
  std::string array(std::string_view type, std::string_view name, int components, const std::vector<T>& values) {
    const std::string element =
        fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)", type,
                    name, components, bytes_.size());
    const std::uint64_t length = values.size() * sizeof(T);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(length) + length);
    std::memcpy(bytes_.data() + at, &length, sizeof(length));
    if (length > 0) std::memcpy(bytes_.data() + at + sizeof(length), values.data(), length);
    return element + "\n";
  }

  /// The whole file round a data set's XML.
  [[nodiscard]] std::string file(std::string_view type, double seconds, const std::string& whole_extent,
                                 const std::string& piece) const {
    return fmt::format(
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
               "header_type=\"UInt64\">\n<{}{}>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
               "NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n</FieldData>\n{}</{}>\n<AppendedData "
               "encoding=\"raw\">\n_",
               type, type, whole_extent, seconds, piece, type) +
           bytes_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string bytes_;
};

void put(std::vector<float>& places, const Point<Enu>& p) {
  for (const double value : {p.x, p.y, p.z}) places.push_back(static_cast<float>(value));
}

std::vector<float> decibels(View3<const std::int16_t> counts) {
  std::vector<float> out;
  out.reserve(counts.all().size());
  for (const std::int16_t count : counts.all()) {
    out.push_back(count == kNoData ? std::numeric_limits<float>::quiet_NaN()
                                   : static_cast<float>(db_from_counts(count)));
  }
  return out;
}

/// Calls visit(row, sample, school_id, confidence) for each voxel of the masks.
template <class Visit>
void each_voxel(std::span<const SchoolMask* const> masks, const Visit& visit) {
  for (const SchoolMask* one : masks) {
    std::size_t voxel = 0;
    for (const Run& run : one->mask.runs) {
      for (int s = run.first_sample; s < run.end(); ++s) {
        visit(run.row, s, one->school_id, static_cast<float>(one->mask.confidence[voxel++]) / 255.0F);
      }
    }
  }
}

/// Corners of cells, each once.
class Corners {
 public:
  Corners(const Sector& sector, const LocalFrame::Ping& into) : sector_(sector), into_(into) {}

  std::int64_t of(int fan, int beam, int sample) {
    const auto beams = static_cast<std::int64_t>(sector_.beams()) + 1;
    const auto samples = static_cast<std::int64_t>(sector_.range().count) + 1;
    const std::int64_t key = (fan * beams + beam) * samples + sample;
    const auto [known, added] = numbers_.try_emplace(key, static_cast<std::int64_t>(places_.size() / 3));
    if (added) put(places_, into_.place(sector_.place_at({fan - 0.5, beam - 0.5, sample - 0.5})));
    return known->second;
  }
  [[nodiscard]] const std::vector<float>& places() const { return places_; }

 private:
  const Sector& sector_;
  const LocalFrame::Ping& into_;
  std::vector<float> places_;
  std::unordered_map<std::int64_t, std::int64_t> numbers_;
};

}  // namespace

std::string vts_bytes(const VtkGrid& grid, std::span<const SchoolMask* const> masks, const Sector& sector,
                      const LocalFrame::Ping& into, double seconds) {
  const Shape3 shape = grid.sv.shape();
  std::vector<float> places;
  places.reserve(3 * shape.size());
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int s = 0; s < shape.samples; ++s) {
        put(places, into.place(sector.place_at({double(f), double(b), double(s)})));
      }
    }
  }
  std::vector<std::int64_t> school(shape.size());
  std::vector<float> confidence(shape.size());
  each_voxel(masks, [&](int row, int sample, std::int64_t id, float sure) {
    const std::size_t at =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(shape.samples) + static_cast<std::size_t>(sample);
    school[at] = id;
    confidence[at] = sure;
  });
  Appended data;
  const std::string extent = fmt::format("\"0 {} 0 {} 0 {}\"", shape.samples - 1, shape.beams - 1, shape.fans - 1);
  std::string piece = "<Piece Extent=" + extent + ">\n<PointData Scalars=\"Sv\">\n";
  piece += data.array("Float32", "Sv", 1, decibels(grid.sv));
  piece += data.array("Float32", "Sv_filtered", 1, decibels(grid.filtered));
  piece += data.array("Int64", "school_id", 1, school);
  piece += data.array("Float32", "confidence", 1, confidence);
  piece += "</PointData>\n<Points>\n" + data.array("Float32", "Points", 3, places) + "</Points>\n</Piece>\n";
  return data.file("StructuredGrid", seconds, " WholeExtent=" + extent, piece);
}

std::string vtu_bytes(std::span<const SchoolMask* const> masks, const Sector& sector, const LocalFrame::Ping& into,
                      double seconds) {
  Corners corners(sector, into);
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;
  std::vector<std::int64_t> school;
  std::vector<float> confidence;
  each_voxel(masks, [&](int row, int sample, std::int64_t id, float sure) {
    const int fan = row / sector.beams();
    const int beam = row % sector.beams();
    // Round the near face, then round the far one: fan, beam, sample is right-handed, as VTK wants its hexahedra.
    for (const int s : {sample, sample + 1}) {
      connectivity.push_back(corners.of(fan, beam, s));
      connectivity.push_back(corners.of(fan + 1, beam, s));
      connectivity.push_back(corners.of(fan + 1, beam + 1, s));
      connectivity.push_back(corners.of(fan, beam + 1, s));
    }
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    school.push_back(id);
    confidence.push_back(sure);
  });
  constexpr std::uint8_t kHexahedron = 12;
  const std::vector<std::uint8_t> types(offsets.size(), kHexahedron);
  Appended data;
  std::string piece =
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<CellData Scalars=\"confidence\">\n",
                  corners.places().size() / 3, offsets.size());
  piece += data.array("Int64", "school_id", 1, school);
  piece += data.array("Float32", "confidence", 1, confidence);
  piece += "</CellData>\n<Points>\n" + data.array("Float32", "Points", 3, corners.places()) + "</Points>\n<Cells>\n";
  piece += data.array("Int64", "connectivity", 1, connectivity);
  piece += data.array("Int64", "offsets", 1, offsets);
  piece += data.array("UInt8", "types", 1, types);
  return data.file("UnstructuredGrid", seconds, "", piece + "</Cells>\n</Piece>\n");
}

std::string pvd_bytes(std::span<const VtkStep> steps, const Geographic& origin) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- metres: x east, y north, z up from the sea surface; origin latitude {} longitude "
      "{} "
      "WGS 84; seconds after the first ping -->\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n",
      degrees_text(origin.latitude_deg), degrees_text(origin.longitude_deg));
  for (const VtkStep& step : steps) {
    out += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", step.seconds, step.file);
  }
  return out + "</Collection>\n</VTKFile>\n";
}

}  // namespace sonar
