// SPDX-License-Identifier: Apache-2.0
#pragma once

// The fuzz target of the product reader. HDF5's own bytes are not what it works on: those are parsed in a
// sandbox. What is left is a file that is sound for netCDF and says nonsense. So the input is a list of edits of a sound product's attributes, dimensions, variables and
// values; what they leave is written by netCDF as a fresh file, sealed, and read.

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.h"
#include "io/atomic_file.h"
#include "io/fuzz_choices.h"
#include "io/netcdf_model.h"
#include "io/product_example.h"
#include "io/product_file.h"
#include "io/product_seal.h"

namespace sonar::fuzz {

/// The product that the edits start from: two schools, a bad ping, a note, background levels.
inline ObservationProduct product_to_spoil() {
  ObservationProduct p = example::empty("obs-0001", 5);
  example::add_school(p, 1, 0, 3, example::block(1, 1, 2, 20, 8, 200));
  example::add_school(p, 2, 2, 4, example::block(0, 0, 3, 40, 5));
  p.pings[2].bad = true;
  p.diagnostics.push_back({DiagnosticCode::file_truncated, "a file.raw", 17, -1, "text, with \"quotes\""});
  p.background_db.assign(5, std::vector<float>(12, -150.0F));
  p.background_db[3].clear();
  return p;
}

inline void edit_attribute(NetcdfModel& file, Choices& in) {
  NetcdfModel::Attribute& attribute = file.attributes[in.below(file.attributes.size())];
  attribute.kind = static_cast<NetcdfModel::Attribute::Kind>(in.byte() % 5);
  if (in.byte() % 2 == 0) return;
  attribute.texts = {in.text(), "a.raw 1 0", in.text()};
  attribute.texts.resize(in.byte() % 4);
  attribute.number = in.number();
}

inline void edit_variable(NetcdfModel::Group& group, Choices& in) {
  NetcdfModel::Variable& variable = group.variables[in.below(group.variables.size())];
  switch (in.byte() % 5) {
    case 0:
      variable.type = 1 + static_cast<int>(in.below(12));
      break;
    case 1:
      variable.shape.resize(group.dimensions.empty() ? 0 : in.byte() % 3);
      for (std::size_t& axis : variable.shape) axis = in.below(group.dimensions.size());
      break;
    case 2:
      std::swap(variable.name, group.variables[in.below(group.variables.size())].name);
      break;
    case 3:
      variable.name += '_';
      break;
    default:
      variable.numbers.clear();
      variable.wholes.clear();
      variable.texts.clear();
  }
}

inline void edit_value(NetcdfModel::Variable& variable, Choices& in) {
  const auto put = [&](auto& values, const auto& value) {
    if (values.empty()) return;
    if (in.byte() == 255) std::fill(values.begin(), values.end(), value);
    values[in.below(values.size())] = value;
  };
  put(variable.numbers, in.number());
  put(variable.wholes, in.whole());
  if (!variable.texts.empty()) put(variable.texts, in.text());
}

inline void edit(NetcdfModel& file, Choices& in) {
  const std::size_t what = in.byte() % 8;
  if (what == 0) return edit_attribute(file, in);
  NetcdfModel::Group& group = file.groups[in.below(file.groups.size())];
  if (what == 1 && !group.dimensions.empty()) {
    group.dimensions[in.below(group.dimensions.size())].length =
        in.byte() % 4 == 0 ? std::size_t{1} << (in.byte() % 40U) : in.below(300);
  } else if (what == 2 && in.byte() == 0) {
    group.name += '_';
  } else if (!group.variables.empty()) {
    if (what < 4) return edit_variable(group, in);
    edit_value(group.variables[in.below(group.variables.size())], in);
  }
}

/// A spoilt product is refused, or what is read of it can be written, and the same is read and written again.
/// folder  holds the files meanwhile; the caller removes it
class ProductFuzz {
 public:
  explicit ProductFuzz(std::filesystem::path folder) : folder_(std::move(folder)) {
    SONAR_CHECK(write_product(product_to_spoil(), folder_ / "sound.nc").has_value());
    sound_ = read_netcdf_model(folder_ / "sound.nc");
  }

  void operator()(std::span<const std::byte> bytes) const {
    NetcdfModel file = sound_;
    Choices in(bytes);
    for (int edits = 0; edits < 24 && !in.done(); ++edits) edit(file, in);
    const std::filesystem::path spoilt = folder_ / "spoilt.nc";
    if (!write_netcdf_model(file, spoilt)) return;
    SONAR_CHECK(example::append_seal(spoilt));
    const auto read = read_product(spoilt);
    if (!read) {
      SONAR_CHECK(!read.error().text.empty() && read.error().where.file == spoilt.string());
      return;
    }
    SONAR_CHECK(read_product_key(spoilt).has_value());
    const std::string once = rewritten(*read, "once.nc");
    const auto again = read_product(folder_ / "once.nc");
    SONAR_CHECK(again.has_value() && rewritten(*again, "twice.nc") == once);
  }

 private:
  [[nodiscard]] std::string rewritten(const ObservationProduct& product, const char* name) const {
    SONAR_CHECK(write_product(product, folder_ / name).has_value());
    return read_file(folder_ / name).value();
  }

  std::filesystem::path folder_;
  NetcdfModel sound_;
};

/// Any bytes under a right seal are refused or read: what HDF5 makes of them happens in the reading child.
inline void product_bytes(std::string_view bytes, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "obs-0001.nc";
  {
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    SONAR_CHECK(out.good());
  }
  SONAR_CHECK(example::append_seal(file));
  const auto read = read_product(file);
  SONAR_CHECK(read.has_value() || !read.error().text.empty());
}

}  // namespace sonar::fuzz
