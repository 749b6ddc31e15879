// SPDX-License-Identifier: Apache-2.0
#include "sonar_explorer/product.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "api/throwing.h"
#include "io/column_words.h"
#include "io/product_file.h"
#include "io/table_columns.h"
#include "model/product.h"

namespace sonar_explorer {
namespace {

/// Visitor: the times of a row, which columns keep as texts.
struct TimesOfRow {
  Table& table;
  std::size_t at = 0;
  void operator()(std::string_view, std::string_view, sonar::TimeColumn time) {
    table[at++].times_ns.push_back(time.value);
  }
  template <class T>
  void operator()(std::string_view, std::string_view, const T&) {
    ++at;
  }
};

template <class Row>
Table table_of(const std::vector<Row>& rows) {
  Table table;
  for (sonar::TableColumn& column : sonar::columns_of(rows)) {
    Column out{column.name, column.unit, {}, {}, {}};
    if (const sonar::ColumnWords* words = sonar::words_of(column.name)) {
      out.long_name = words->long_name;
      out.standard_name = words->standard_name;
      out.flags = words->flags();
      out.flags_are_bits = words->bits;
      out.flag_meanings = words->meanings;
    }
    std::visit([&](auto& values) { out.values = std::move(values); }, column.values);
    table.push_back(std::move(out));
  }
  for (Row row : rows) {
    TimesOfRow times{table};
    columns(times, row);
  }
  return table;
}

sonar::SchoolMask own_mask(const Mask& mask, const sonar::ObservationProduct& product) {
  const auto wrong = [&](const char* what) {
    raise({sonar::ErrorCode::bad_parameter,
           fmt::format("mask of school {} in ping {}: {}", mask.school_id, mask.ping_index, what),
           {}});
  };
  if (!product.grid) wrong("the product has no grid");
  const sonar::BeamGrid& grid = product.grid->grid;
  const bool known = std::any_of(product.schools.begin(), product.schools.end(),
                                 [&](const sonar::SchoolRow& row) { return row.school_id == mask.school_id; });
  if (!known) wrong("the product has no such school");
  if (mask.ping_index < 0 || mask.ping_index >= std::ssize(product.pings)) wrong("there is no such ping");
  sonar::SchoolMask own{mask.school_id, mask.ping_index, {{}, mask.confidence}};
  std::size_t voxels = 0;
  for (const MaskRun& run : mask.runs) {
    const bool inside = run.fan >= 0 && run.fan < grid.fans() && run.beam >= 0 && run.beam < grid.beams() &&
                        run.first_sample >= 0 && run.count > 0 &&
                        run.first_sample <= product.grid->range.count - run.count;
    if (!inside) wrong("a run outside the grid");
    const sonar::Run next{run.fan * grid.beams() + run.beam, run.first_sample, run.count};
    const bool behind = own.mask.runs.empty() || own.mask.runs.back().row < next.row ||
                        (own.mask.runs.back().row == next.row && own.mask.runs.back().end() <= next.first_sample);
    if (!behind) wrong("runs are not sorted, or overlap");
    own.mask.runs.push_back(next);
    voxels += static_cast<std::size_t>(run.count);
  }
  if (voxels != mask.confidence.size()) wrong("as many confidences as voxels were expected");
  if (std::find(mask.confidence.begin(), mask.confidence.end(), 0) != mask.confidence.end()) {
    wrong("a confidence of 0 is no member");
  }
  return own;
}

}  // namespace

Product Product::read(const std::filesystem::path& file) {
  return Product(std::make_shared<const sonar::ObservationProduct>(value_or_throw(sonar::read_product(file))));
}

void Product::write(const std::filesystem::path& file) const {
  const std::filesystem::path folder = file.parent_path();
  std::error_code absent;
  if (!folder.empty() && !std::filesystem::is_directory(folder, absent)) {
    raise({sonar::ErrorCode::not_found, "no such folder to write to", {folder.string()}});
  }
  value_or_throw(sonar::write_product(*own_, file));
}

const std::string& Product::observation() const { return own_->observation; }
const std::string& Product::recipe_json() const { return own_->recipe_json; }
Table Product::schools() const { return table_of(own_->schools); }
Table Product::school_pings() const { return table_of(own_->school_pings); }
Table Product::rejected() const { return table_of(own_->rejected); }

std::vector<Mask> Product::masks() const {
  std::vector<Mask> masks;
  for (const sonar::SchoolMask& own : own_->masks) {
    Mask mask{own.school_id, own.ping_index, {}, own.mask.confidence};
    const int beams = own_->grid ? own_->grid->grid.beams() : 1;
    for (const sonar::Run& run : own.mask.runs) {
      mask.runs.push_back({run.row / beams, run.row % beams, run.first_sample, run.count});
    }
    masks.push_back(std::move(mask));
  }
  return masks;
}

std::optional<Shape> Product::shape() const {
  if (!own_->grid) return std::nullopt;
  return Shape{own_->grid->grid.fans(), own_->grid->grid.beams(), own_->grid->range.count};
}

std::vector<std::int32_t> Product::school_ids(std::int64_t ping) const {
  require_ping(ping, own_->pings.size(), own_->observation);
  const Shape all = shape().value_or(Shape{});
  std::vector<std::int32_t> ids(all.size(), 0);
  for (const sonar::SchoolMask& own : own_->masks) {
    if (own.ping_index != ping) continue;
    for (const sonar::Run& run : own.mask.runs) {
      const auto first = static_cast<std::ptrdiff_t>(run.row) * all.samples + run.first_sample;
      std::fill_n(ids.begin() + first, run.count, static_cast<std::int32_t>(own.school_id));
    }
  }
  return ids;
}

std::vector<std::string> Product::notes() const { return lines_of(own_->diagnostics); }

Product Product::with_masks(const std::vector<Mask>& masks) const {
  auto other = std::make_shared<sonar::ObservationProduct>(*own_);
  other->masks.clear();
  for (const Mask& mask : masks) other->masks.push_back(own_mask(mask, *own_));
  const auto key = [](const sonar::SchoolMask& mask) { return std::pair(mask.school_id, mask.ping_index); };
  std::sort(other->masks.begin(), other->masks.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < other->masks.size(); ++i) {
    if (key(other->masks[i - 1]) != key(other->masks[i])) continue;
    raise({sonar::ErrorCode::bad_parameter,
           fmt::format("two masks of school {} in ping {}", other->masks[i].school_id, other->masks[i].ping_index),
           {}});
  }
  const auto kept = [&](std::int64_t school) {
    return std::any_of(masks.begin(), masks.end(), [&](const Mask& mask) { return mask.school_id == school; });
  };
  std::erase_if(other->schools, [&](const sonar::SchoolRow& row) { return !kept(row.school_id); });
  std::erase_if(other->school_pings, [&](const sonar::SchoolPingRow& row) { return !kept(row.school_id); });
  return Product(std::move(other));
}

}  // namespace sonar_explorer
