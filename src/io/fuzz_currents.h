// SPDX-License-Identifier: Apache-2.0
#pragma once

// The fuzz target of files of currents. HDF5's own bytes are parsed in a sandbox (target product_bytes). What is left
// is a file that is sound for netCDF and says nonsense: the input is a list of edits of a sound one.

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/check.h"
#include "io/current_file.h"
#include "io/fuzz_choices.h"
#include "io/netcdf_file.h"

namespace sonar::fuzz {

/// Two times, three bins, and what edits make of them.
struct CurrentsToSpoil {
  struct Variable {
    std::string name;
    std::string units;
    std::vector<std::size_t> shape;  ///< places in the dimensions
    std::vector<double> values;
    nc_type type = NC_DOUBLE;
    std::map<std::string, std::string> texts{};
    std::map<std::string, double> numbers{};
  };
  std::vector<std::size_t> dimensions{2, 3, 1};
  std::vector<Variable> variables{
      {"time", "days since 2009-01-01 00:00:00", {0}, {10.25, 10.5}},
      {"depth", "meter", {0, 1}, {20, 28, 36, 20, 28, 36}},
      {"u", "m s-1", {0, 1}, {0.125, 0.25, 1e38, 0.5, -0.75, 0.0}},
      {"v", "m s-1", {0, 1}, {-0.125, -0.25, 1e38, 0.0, 0.5, 0.25}},
      {"lat", "degrees_north", {0}, {60.0, 60.1}},
      {"lon", "degrees_east", {0}, {184.0, -3.5}},
      {"pflag", "", {0, 1}, {0, 0, 0, 0, 1, 0}},
  };
};

inline void edit(CurrentsToSpoil& file, Choices& in) {
  constexpr std::array kNames{"u", "UCUR", "v", "VCUR", "time", "TIME", "depth", "lat", "lon", "pflag"};
  constexpr std::array kUnits{"m",
                              "metre",
                              "m s-1",
                              "cm/s",
                              "meter",
                              "seconds since 1970-01-01T00:00:00Z",
                              "",
                              "knots",
                              "days since 2009-01-01 00:00:00",
                              "h",
                              "degree",
                              "hours since 2261-12-31",
                              "minutes since 1-1-1 0:0:0"};
  constexpr std::array kStandard{"eastward_sea_water_velocity", "northward_sea_water_velocity", "time", "depth",
                                 "latitude"};
  constexpr std::array kTexts{"units", "standard_name", "positive", "_FillValue"};
  constexpr std::array kNumbers{"_FillValue", "missing_value", "scale_factor", "add_offset", "units"};
  if (in.byte() % 16 == 0) {
    file.dimensions[in.below(file.dimensions.size())] =
        in.byte() % 4 == 0 ? std::size_t{1} << (in.byte() % 40U) : in.below(300);
    return;
  }
  CurrentsToSpoil::Variable& variable = file.variables[in.below(file.variables.size())];
  switch (in.byte() % 8) {
    case 0:
      variable.name = kNames[in.below(kNames.size())];
      break;
    case 1:
      variable.units = in.byte() % 4 == 0 ? in.text() : kUnits[in.below(kUnits.size())];
      break;
    case 2:
      variable.texts[kTexts[in.below(kTexts.size())]] =
          in.byte() % 4 == 0 ? in.text() : (in.byte() % 4 == 0 ? "up" : kStandard[in.below(kStandard.size())]);
      break;
    case 3:
      variable.numbers[kNumbers[in.below(kNumbers.size())]] = in.number();
      break;
    case 4:
      variable.shape.resize(in.below(4));
      for (std::size_t& axis : variable.shape) axis = in.below(file.dimensions.size());
      break;
    case 5:
      variable.type = 1 + static_cast<int>(in.below(12));
      break;
    default:
      variable.values[in.below(variable.values.size())] = in.number();
  }
}

/// What netCDF does not take is left out. False where there is no file then.
inline bool write_currents(const CurrentsToSpoil& made, const std::filesystem::path& path) {
  constexpr std::size_t kMostValues = 4096;
  const auto held = netcdf::lock();
  int file = -1;
  if (nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &file) != NC_NOERR) return false;
  std::vector<int> dimensions;
  for (std::size_t i = 0; i < made.dimensions.size(); ++i) {
    dimensions.push_back(-1);
    nc_def_dim(file, ("d" + std::to_string(i)).c_str(), made.dimensions[i], &dimensions.back());
  }
  for (const CurrentsToSpoil::Variable& v : made.variables) {
    std::vector<int> ids;
    std::size_t size = 1;
    for (const std::size_t axis : v.shape) {
      ids.push_back(dimensions[axis]);
      size = size > kMostValues ? size : size * made.dimensions[axis];
    }
    int id = -1;
    const auto rank = static_cast<int>(ids.size());
    if (nc_def_var(file, v.name.c_str(), v.type, rank, ids.data(), &id) != NC_NOERR) continue;
    if (rank > 0 && v.type != NC_STRING) nc_def_var_deflate(file, id, 0, 1, 1);
    nc_put_att_text(file, id, "units", v.units.size(), v.units.data());
    for (const auto& [name, value] : v.numbers) nc_put_att_double(file, id, name.c_str(), NC_DOUBLE, 1, &value);
    for (const auto& [name, text] : v.texts) nc_put_att_text(file, id, name.c_str(), text.size(), text.data());
    std::vector<double> values = v.values;
    values.resize(std::min(size, kMostValues), values.front());
    if (size > 0 && size <= kMostValues) nc_put_var_double(file, id, values.data());
  }
  return nc_close(file) == NC_NOERR;
}

/// A spoilt file is refused by its name, or gives profiles that are what they are said to be.
/// folder  holds the file meanwhile; the caller removes it
inline void currents(std::span<const std::byte> bytes, const std::filesystem::path& folder) {
  CurrentsToSpoil made;
  Choices in(bytes);
  for (int edits = 0; edits < 24 && !in.done(); ++edits) edit(made, in);
  const std::filesystem::path path = folder / "adcp.nc";
  if (!write_currents(made, path)) return;
  const auto read = read_currents(path);
  if (!read) {
    SONAR_CHECK(!read.error().text.empty() && read.error().where.file == path.string());
    return;
  }
  SONAR_CHECK(!read->empty());
  TimeNs before = 0;
  for (const CurrentProfile& profile : *read) {
    SONAR_CHECK(profile.time > before && !profile.bins.empty());
    before = profile.time;
    SONAR_CHECK(std::isnan(profile.place.latitude_deg) || std::abs(profile.place.latitude_deg) <= 90.0);
    SONAR_CHECK(std::isnan(profile.place.longitude_deg) || std::abs(profile.place.longitude_deg) <= 180.0);
    double above_m = -1.0;
    for (const CurrentAt& bin : profile.bins) {
      SONAR_CHECK(bin.depth_m > above_m && bin.depth_m <= 12'000.0);
      above_m = bin.depth_m;
      SONAR_CHECK(std::abs(bin.east_mps) <= 20.0 && std::abs(bin.north_mps) <= 20.0);
    }
  }
}

}  // namespace sonar::fuzz
