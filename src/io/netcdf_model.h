// SPDX-License-Identifier: Apache-2.0
#pragma once

// A small netCDF-4 file as values, for the fuzz target and the tests of the product reader: read it, spoil it, write it.

#include <netcdf.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "io/netcdf_file.h"

namespace sonar::fuzz {

struct NetcdfModel {
  struct Attribute {
    enum class Kind { text, texts, number, whole, none };
    std::string name;
    Kind kind = Kind::text;
    std::vector<std::string> texts;
    double number = 0.0;
  };
  struct Dimension {
    std::string name;
    std::size_t length = 0;
  };
  struct Variable {
    std::string name;
    int type = NC_NAT;
    std::vector<std::size_t> shape;  ///< places in the group's dimensions
    std::vector<double> numbers;     ///< one of these three by type
    std::vector<long long> wholes;
    std::vector<std::string> texts;
  };
  struct Group {
    std::string name;
    std::vector<Dimension> dimensions;
    std::vector<Variable> variables;
  };
  std::vector<Attribute> attributes;  ///< of the root
  std::vector<Group> groups;
};

namespace model_detail {

using Name = std::array<char, NC_MAX_NAME + 1>;
/// Larger variables stay unwritten: they take no room in the file, whatever they pretend to hold.
inline constexpr std::size_t kMostValues = 4096;

inline NetcdfModel::Attribute read_attribute(int file, int number) {
  Name name{};
  nc_type type = NC_NAT;
  std::size_t length = 0;
  nc_inq_attname(file, NC_GLOBAL, number, name.data());
  nc_inq_att(file, NC_GLOBAL, name.data(), &type, &length);
  NetcdfModel::Attribute made{name.data(), NetcdfModel::Attribute::Kind::text, {}, 0.0};
  if (type == NC_STRING) {
    std::vector<char*> pointers(length, nullptr);
    nc_get_att_string(file, NC_GLOBAL, name.data(), pointers.data());
    made.texts.assign(pointers.begin(), pointers.end());
    nc_free_string(length, pointers.data());
    made.kind = NetcdfModel::Attribute::Kind::texts;
  } else if (type == NC_CHAR) {
    made.texts.assign(1, std::string(length, ' '));
    nc_get_att_text(file, NC_GLOBAL, name.data(), made.texts[0].data());
  } else {
    nc_get_att_double(file, NC_GLOBAL, name.data(), &made.number);
    made.kind = NetcdfModel::Attribute::Kind::whole;
  }
  return made;
}

inline NetcdfModel::Variable read_variable(int group, int id, const NetcdfModel::Group& in) {
  Name name{};
  int rank = 0;
  std::array<int, NC_MAX_VAR_DIMS> ids{};
  NetcdfModel::Variable made;
  nc_inq_var(group, id, name.data(), &made.type, &rank, ids.data(), nullptr);
  made.name = name.data();
  std::size_t size = 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rank); ++i) {
    nc_inq_dimname(group, ids[i], name.data());
    std::size_t axis = 0;
    while (in.dimensions.at(axis).name != name.data()) ++axis;
    made.shape.push_back(axis);
    size *= in.dimensions[axis].length;
  }
  if (made.type == NC_STRING) {
    std::vector<char*> pointers(size, nullptr);
    nc_get_var_string(group, id, pointers.data());
    made.texts.assign(pointers.begin(), pointers.end());
    nc_free_string(size, pointers.data());
  } else if (made.type == NC_INT64) {
    made.wholes.resize(size);
    nc_get_var_longlong(group, id, made.wholes.data());
  } else {
    made.numbers.resize(size);
    nc_get_var_double(group, id, made.numbers.data());
  }
  return made;
}

inline NetcdfModel::Group read_group(int group) {
  Name name{};
  NetcdfModel::Group made;
  nc_inq_grpname(group, name.data());
  made.name = name.data();
  int count = 0;
  std::array<int, NC_MAX_DIMS> ids{};
  nc_inq_dimids(group, &count, ids.data(), 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    std::size_t length = 0;
    nc_inq_dim(group, ids[i], name.data(), &length);
    made.dimensions.push_back({name.data(), length});
  }
  nc_inq_nvars(group, &count);
  for (int id = 0; id < count; ++id) made.variables.push_back(read_variable(group, id, made));
  return made;
}

inline void write_attribute(int file, const NetcdfModel::Attribute& a) {
  using Kind = NetcdfModel::Attribute::Kind;
  const std::string text = a.texts.empty() ? std::string{} : a.texts.front();
  std::vector<const char*> pointers;
  for (const std::string& each : a.texts) pointers.push_back(each.c_str());
  const char* name = a.name.c_str();
  if (a.kind == Kind::text) nc_put_att_text(file, NC_GLOBAL, name, text.size(), text.data());
  if (a.kind == Kind::texts) nc_put_att_string(file, NC_GLOBAL, name, pointers.size(), pointers.data());
  if (a.kind == Kind::number) nc_put_att_double(file, NC_GLOBAL, name, NC_DOUBLE, 1, &a.number);
  if (a.kind == Kind::whole) nc_put_att_double(file, NC_GLOBAL, name, NC_INT64, 1, &a.number);
}

inline void write_variable(int group, const NetcdfModel::Variable& v, const NetcdfModel::Group& in,
                           const std::vector<int>& dimension_ids) {
  std::vector<int> ids;
  std::size_t size = 1;
  for (const std::size_t axis : v.shape) {
    ids.push_back(dimension_ids[axis]);
    const std::size_t length = in.dimensions[axis].length;
    size = size > kMostValues ? size : size * length;
  }
  int id = -1;
  const auto rank = static_cast<int>(ids.size());
  if (nc_def_var(group, v.name.c_str(), v.type, rank, ids.data(), &id) != NC_NOERR) return;
  if (rank > 0 && v.type != NC_STRING) nc_def_var_deflate(group, id, 0, 1, 1);
  if (size == 0 || size > kMostValues) return;
  const auto sized = [&](auto values) {
    values.resize(values.empty() ? 0 : size);
    return values;
  };
  if (const auto values = sized(v.numbers); !values.empty()) nc_put_var_double(group, id, values.data());
  if (const auto values = sized(v.wholes); !values.empty()) nc_put_var_longlong(group, id, values.data());
  const auto texts = sized(v.texts);
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  if (!pointers.empty() && v.type == NC_STRING) nc_put_var_string(group, id, pointers.data());
}

inline void write_group(int file, const NetcdfModel::Group& made) {
  int group = -1;
  if (nc_def_grp(file, made.name.c_str(), &group) != NC_NOERR) return;
  std::vector<int> ids;
  for (const NetcdfModel::Dimension& dimension : made.dimensions) {
    ids.push_back(-1);
    nc_def_dim(group, dimension.name.c_str(), dimension.length, &ids.back());
  }
  for (const NetcdfModel::Variable& variable : made.variables) write_variable(group, variable, made, ids);
}

}  // namespace model_detail

/// path  a sound file
inline NetcdfModel read_netcdf_model(const std::filesystem::path& path) {
  const auto held = netcdf::lock();
  NetcdfModel made;
  int file = -1;
  if (nc_open(path.c_str(), NC_NOWRITE, &file) != NC_NOERR) return made;
  int count = 0;
  nc_inq_natts(file, &count);
  for (int i = 0; i < count; ++i) made.attributes.push_back(model_detail::read_attribute(file, i));
  nc_inq_grps(file, &count, nullptr);
  std::vector<int> groups(static_cast<std::size_t>(count));
  nc_inq_grps(file, &count, groups.data());
  for (const int group : groups) made.groups.push_back(model_detail::read_group(group));
  nc_close(file);
  return made;
}

/// What netCDF does not take is left out of the file. False where there is none.
inline bool write_netcdf_model(const NetcdfModel& model, const std::filesystem::path& path) {
  const auto held = netcdf::lock();
  int file = -1;
  if (nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &file) != NC_NOERR) return false;
  for (const NetcdfModel::Attribute& attribute : model.attributes) model_detail::write_attribute(file, attribute);
  for (const NetcdfModel::Group& group : model.groups) model_detail::write_group(file, group);
  return nc_close(file) == NC_NOERR;
}

}  // namespace sonar::fuzz
