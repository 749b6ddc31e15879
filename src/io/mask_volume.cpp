// SPDX-License-Identifier: Apache-2.0
#include "io/mask_volume.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

#include "io/atomic_file.h"
#include "io/netcdf_file.h"

namespace sonar {
namespace {

using netcdf::Dimension;
using netcdf::Writer;

/// The masks of each ping that has any.
std::map<std::size_t, std::vector<const SchoolMask*>> masks_by_ping(const ObservationProduct& product) {
  std::map<std::size_t, std::vector<const SchoolMask*>> out;
  for (const SchoolMask& m : product.masks) {
    if (m.ping_index >= 0 && !m.mask.empty()) out[static_cast<std::size_t>(m.ping_index)].push_back(&m);
  }
  return out;
}

bool fits(const SchoolMask& m, const GridRecord& record) {
  std::size_t voxels = 0;
  for (const Run& run : m.mask.runs) {
    const bool inside = run.row >= 0 && run.row < record.grid.fans() * record.grid.beams() && run.first_sample >= 0 &&
                        run.count > 0 && run.first_sample <= record.range.count - run.count;
    if (!inside) return false;
    voxels += static_cast<std::size_t>(run.count);
  }
  return voxels == m.mask.voxels() && m.school_id > 0 && m.school_id <= std::numeric_limits<std::int32_t>::max();
}

void write_coordinates(Writer& out, const ObservationProduct& product, const Dimension& ping) {
  std::vector<std::int64_t> time;
  std::vector<double> latitude;
  std::vector<double> longitude;
  std::vector<double> heading;
  for (const PingNavigation& n : product.pings) {
    time.push_back(n.time);
    latitude.push_back(n.transducer.latitude_deg);
    longitude.push_back(n.transducer.longitude_deg);
    heading.push_back(n.heading_deg);
  }
  out.variable(out.root(), "time", "nanoseconds since 1970-01-01T00:00:00Z", {ping}, time);
  out.variable(out.root(), "latitude", "degrees_north", {ping}, latitude);
  out.variable(out.root(), "longitude", "degrees_east", {ping}, longitude);
  out.variable(out.root(), "heading", "degrees", {ping}, heading);
}

void write_arrays(Writer& out, const ObservationProduct& product, const Dimension& ping, const Work& work) {
  const GridRecord& record = *product.grid;
  const auto samples = static_cast<std::size_t>(record.range.count);
  const std::vector<Dimension> shape = {ping, out.dimension(out.root(), "fan", record.grid.elevation_deg.size()),
                                        out.dimension(out.root(), "beam", record.grid.azimuth_deg.size()),
                                        out.dimension(out.root(), "sample", samples)};
  std::vector<double> range_m;
  for (int i = 0; i < record.range.count; ++i) range_m.push_back(record.range.range_m(i));
  out.variable(out.root(), "elevation", "degrees", {shape[1]}, record.grid.elevation_deg);
  out.variable(out.root(), "azimuth", "degrees", {shape[2]}, record.grid.azimuth_deg);
  out.variable(out.root(), "frequency", "Hz", {shape[1]}, record.grid.frequency_hz);
  out.variable(out.root(), "range", "m", {shape[3]}, range_m);
  const int school_id = out.sliced_variable<std::int32_t>(out.root(), "school_id", "1", shape);
  out.attribute(out.root(), school_id, "long_name", "school that the voxel belongs to; 0 = none");
  const int confidence = out.sliced_variable<std::uint8_t>(out.root(), "confidence", "1", shape);
  out.attribute(out.root(), confidence, "scale_factor", 1.0 / 255.0);
  std::vector<std::int32_t> ids(shape[1].length * shape[2].length * samples);
  std::vector<std::uint8_t> values(ids.size());
  for (const auto& [index, masks] : masks_by_ping(product)) {
    if (work.cancelled()) return;
    std::fill(ids.begin(), ids.end(), 0);
    std::fill(values.begin(), values.end(), std::uint8_t{0});
    for (const SchoolMask* m : masks) {
      std::size_t voxel = 0;
      for (const Run& run : m->mask.runs) {
        std::size_t at = static_cast<std::size_t>(run.row) * samples + static_cast<std::size_t>(run.first_sample);
        for (std::int32_t i = 0; i < run.count; ++i, ++at) {
          ids[at] = static_cast<std::int32_t>(m->school_id);
          values[at] = m->mask.confidence[voxel++];
        }
      }
    }
    out.slice(out.root(), school_id, index, shape, ids);
    out.slice(out.root(), confidence, index, shape, values);
  }
}

}  // namespace

Result<void> write_mask_volume(const ObservationProduct& product, const std::filesystem::path& path, const Work& work) {
  for (const SchoolMask& m : product.masks) {
    const bool in_pings = m.ping_index >= 0 && m.ping_index < static_cast<std::int64_t>(product.pings.size());
    if (!product.grid || !in_pings || !fits(m, *product.grid)) {
      return fail(ErrorCode::bad_parameter, "a mask does not fit the pings and the grid",
                  {.file = path.string(), .ping = m.ping_index});
    }
  }
  auto file = AtomicFile::create(path);
  if (!file) return pass_on(file);
  Writer out(path.string());
  out.attribute(out.root(), Writer::kGlobal, "Conventions", std::string_view("CF-1.8"));
  out.attribute(out.root(), Writer::kGlobal, "title", std::string_view(product.title));
  out.attribute(out.root(), Writer::kGlobal, "observation", std::string_view(product.observation));
  out.attribute(out.root(), Writer::kGlobal, "recipe_hash", std::string_view(product.recipe_hash));
  const Dimension ping = out.dimension(out.root(), "ping", product.pings.size());
  write_coordinates(out, product, ping);
  if (product.grid && ping.length > 0 && product.grid->range.count > 0) write_arrays(out, product, ping, work);
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  if (auto closed = out.close_into(*file); !closed) return pass_on(closed);
  return file->commit();
}

}  // namespace sonar
