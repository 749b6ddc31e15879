// SPDX-License-Identifier: Apache-2.0
#include "io/mask_volume.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

#include "io/atomic_file.h"
#include "io/cf_attributes.h"
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
  const int root = out.root();
  cf::ping_times(out, root, ping, time);
  const auto put = [&](const char* name, const char* unit, const std::vector<double>& values,
                       std::string_view long_name, std::string_view standard_name) {
    const int id = out.variable(root, name, unit, {ping}, values, netcdf::Storage::plain, &kUnknown);
    cf::name(out, root, id, long_name, standard_name);
    return id;
  };
  put("latitude", "degrees_north", latitude, "latitude of the transducer, WGS 84", "latitude");
  put("longitude", "degrees_east", longitude, "longitude of the transducer, WGS 84", "longitude");
  cf::place(out, root, put("heading", "degrees", heading, "heading, clockwise from true north", "platform_orientation"),
            "time latitude longitude");
}

void write_arrays(Writer& out, const ObservationProduct& product, const Dimension& ping, const Work& work) {
  const GridRecord& record = *product.grid;
  const auto samples = static_cast<std::size_t>(record.range.count);
  const std::vector<Dimension> shape = {ping, out.dimension(out.root(), "fan", record.grid.elevation_deg.size()),
                                        out.dimension(out.root(), "beam", record.grid.azimuth_deg.size()),
                                        out.dimension(out.root(), "sample", samples)};
  std::vector<double> range_m;
  for (int i = 0; i < record.range.count; ++i) range_m.push_back(record.range.range_m(i));
  const auto axis = [&](const char* name, const char* unit, const Dimension& along, const std::vector<double>& values,
                        std::string_view long_name, std::string_view standard_name = {}) {
    cf::name(out, out.root(), out.variable(out.root(), name, unit, {along}, values), long_name, standard_name);
  };
  axis("elevation", "degrees", shape[1], record.grid.elevation_deg, "elevation of the fan, positive up");
  axis("azimuth", "degrees", shape[2], record.grid.azimuth_deg, "azimuth of the beam, clockwise from the bow");
  axis("frequency", "Hz", shape[1], record.grid.frequency_hz, "centre frequency of the fan", "sound_frequency");
  axis("range", "m", shape[3], range_m, "slant range of the sample from the transducer");
  const std::string_view where = "time latitude longitude elevation azimuth range";
  const int school_id = out.sliced_variable<std::int32_t>(out.root(), "school_id", "1", shape);
  cf::name(out, out.root(), school_id, "school that the voxel belongs to; 0 = none");
  cf::place(out, out.root(), school_id, where);
  const int confidence = out.sliced_variable<std::uint8_t>(out.root(), "confidence", "1", shape);
  cf::name(out, out.root(), confidence, "how surely the voxel belongs to its school");
  cf::place(out, out.root(), confidence, where);
  out.attribute(out.root(), confidence, "scale_factor", 1.0 / 255.0);
  std::vector<std::int32_t> ids(shape[1].length * shape[2].length * samples);
  std::vector<std::uint8_t> values(ids.size());
  const auto by_ping = masks_by_ping(product);
  for (std::size_t index = 0; index < ping.length; ++index) {
    if (work.cancelled()) return;
    const auto found = by_ping.find(index);
    const std::vector<const SchoolMask*> masks =
        found != by_ping.end() ? found->second : std::vector<const SchoolMask*>{};
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
  cf::describe_file(out, product.title + ": masks", product);
  const Dimension ping = out.dimension(out.root(), "ping", product.pings.size());
  write_coordinates(out, product, ping);
  if (product.grid && ping.length > 0 && product.grid->range.count > 0) write_arrays(out, product, ping, work);
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  if (auto closed = out.close_into(*file); !closed) return pass_on(closed);
  return file->commit();
}

}  // namespace sonar
