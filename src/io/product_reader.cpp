// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <type_traits>
#include <utility>

#include "io/netcdf_file.h"
#include "io/product_file.h"
#include "io/product_grid_reader.h"
#include "io/product_seal.h"
#include "model/later_columns.h"

namespace sonar {
namespace {

using netcdf::Reader;

constexpr std::size_t kPingColumns = 11;  ///< numbers a ping, beside its time
constexpr std::int64_t kMostSchools = std::int64_t{1} << 53;

bool check_version(Reader& in) {
  if (!in.ok()) return false;
  if (!in.has_attribute(in.root(), "product_version")) {
    in.refuse(ErrorCode::format, "is no product of this program: it has no product_version");
    return false;
  }
  const std::int64_t version = in.whole(in.root(), "product_version");
  if (version > kProductVersion) {
    in.refuse(ErrorCode::newer_version,
              fmt::format("product_version {} is newer than this program's {}", version, kProductVersion));
  } else if (version < kOldestProductVersion) {
    in.refuse(ErrorCode::older_version,
              fmt::format("product_version {} is older than {}, the oldest that is read: run again", version,
                          kOldestProductVersion));
  }
  return in.ok();
}

/// "name size hash"; the name may hold blanks.
bool parse_input_file(const std::string& text, InputFile& file) {
  const std::size_t second = text.rfind(' ');
  if (second == std::string::npos || second == 0) return false;
  const std::size_t first = text.rfind(' ', second - 1);
  if (first == std::string::npos) return false;
  const auto [end, error] = std::from_chars(text.data() + first + 1, text.data() + second, file.size);
  file.name = text.substr(0, first);
  file.hash = text.substr(second + 1);
  return error == std::errc{} && end == text.data() + second;
}

/// It becomes part of files' names.
std::string observation_name(Reader& in) {
  std::string name = in.text(in.root(), "observation");
  if (in.ok() && !is_observation_name(name)) {
    in.refuse(ErrorCode::format, fmt::format("observation '{}' is no name of the kind obs-0001", name.substr(0, 40)));
  }
  return name;
}

void read_attributes(Reader& in, ObservationProduct& product) {
  const int root = in.root();
  product.observation = observation_name(in);
  product.program_version = in.text(root, "sonar_explorer_version");
  product.title = in.text(root, "title");
  product.source = in.text(root, "source");
  product.history = in.text(root, "history");
  product.recipe_json = in.text(root, "recipe");
  product.recipe_hash = in.text(root, "recipe_hash");
  product.stage_versions = in.text(root, "stage_versions");
  product.input_hash = in.text(root, "input_hash");
  if (in.has_attribute(root, "cut_after")) product.cut_after = in.whole(root, "cut_after");
  for (const std::string& text : in.texts(root, "input_files")) {
    if (text.empty()) continue;
    InputFile file;
    if (!parse_input_file(text, file)) in.refuse(ErrorCode::format, "'input_files' is not 'name size hash'");
    product.input_files.push_back(std::move(file));
  }
}

/// Products of programs that did not count have only the numbers that are in them.
void read_numbers(Reader& in, ObservationProduct& product) {
  if (in.has_attribute(in.root(), "next_school_id")) product.next_school_id = in.whole(in.root(), "next_school_id");
  const bool sound = product.next_school_id >= 0 && product.next_school_id <= kMostSchools &&
                     std::all_of(product.schools.begin(), product.schools.end(), [](const SchoolRow& school) {
                       return school.school_id >= 0 && school.school_id < kMostSchools;
                     });
  if (!sound) in.refuse(ErrorCode::format, "a school's number is impossible");
  if (in.ok()) product.next_school_id = next_school_id(product);
}

void read_background(Reader& in, int group, ObservationProduct& product) {
  if (!in.has_variable(group, "background_db") || !product.grid) return;
  const std::vector<int>& channel = product.grid->grid.channel;
  const std::size_t channels = channel.size();
  const std::size_t pings = product.pings.size();
  const auto levels = in.values<float>(group, "background_db", pings * channels);
  if (!in.ok()) return;
  product.background_db.assign(pings, {});
  for (std::size_t p = 0; p < pings; ++p) {
    const auto first = levels.begin() + static_cast<std::ptrdiff_t>(p * channels);
    const auto last = first + static_cast<std::ptrdiff_t>(channels);
    if (std::all_of(first, last, [](float v) { return std::isnan(v); })) continue;
    std::vector<float>& of_ping = product.background_db[p];
    of_ping.resize(channels);
    for (std::size_t row = 0; row < channels; ++row) of_ping[row] = first[channel[row]];
  }
}

/// Version 1 had nanoseconds in `time`.
const char* time_name(Reader& in, int pings) { return in.has_variable(pings, "time_ns") ? "time_ns" : "time"; }

void read_pings(Reader& in, ObservationProduct& product) {
  const int group = in.group(in.root(), "pings");
  const std::size_t n = in.dimension(group, "ping");
  const auto time = in.values<std::int64_t>(group, time_name(in, group), n);
  if (!in.ok() || !in.can_hold(n, kPingColumns * sizeof(double))) return;
  product.pings.resize(n);
  for (std::size_t i = 0; i < n; ++i) product.pings[i].time = time[i];
  for (const char* name : {"latitude", "longitude", "heading", "speed", "course", "distance", "pitch", "roll", "heave",
                           "transducer_depth", "gps_minus_clock", "bad"}) {
    in.foresee_values<double>(group, name, n);
  }
  const auto fill = [&](const char* name, auto&& put) {
    const auto values = in.values<double>(group, name, n);
    for (std::size_t i = 0; i < values.size(); ++i) put(product.pings[i], values[i]);
  };
  using N = PingNavigation;
  fill("latitude", [](N& p, double v) { p.transducer.latitude_deg = v; });
  fill("longitude", [](N& p, double v) { p.transducer.longitude_deg = v; });
  fill("heading", [](N& p, double v) { p.heading_deg = v; });
  fill("speed", [](N& p, double v) { p.speed_mps = v; });
  fill("course", [](N& p, double v) { p.course_deg = v; });
  fill("distance", [](N& p, double v) { p.distance_nmi = v; });
  fill("pitch", [](N& p, double v) { p.pitch_deg = v; });
  fill("roll", [](N& p, double v) { p.roll_deg = v; });
  fill("heave", [](N& p, double v) { p.heave_m = v; });
  fill("transducer_depth", [](N& p, double v) { p.transducer_depth_m = v; });
  fill("gps_minus_clock", [](N& p, double v) { p.gps_minus_clock_s = v; });
  fill("bad", [](N& p, double v) { p.bad = v != 0.0; });
  read_background(in, group, product);
}

/// Visitor that fills one column of all rows at each call.
template <class Row>
class RowFiller {
 public:
  RowFiller(Reader& in, int group, std::vector<Row>& rows) : in_(in), group_(group), rows_(rows) {}

  /// Visits the columns once per row, but reads each only at the first row.
  void fill() {
    if (rows_.empty()) return;
    foresee();
    for (row_ = 0; row_ < rows_.size() && in_.ok(); ++row_) {
      at_ = 0;
      columns(*this, rows_[row_]);
    }
  }
  void operator()(std::string_view name, std::string_view, std::string& v) { take(texts_, name, v); }
  void operator()(std::string_view name, std::string_view, std::int64_t& v) { take(wholes_, name, v); }
  void operator()(std::string_view name, std::string_view, double& v) { take(numbers_, name, v); }
  void operator()(std::string_view name, std::string_view, DegreesColumn v) { take(numbers_, name, v.value); }
  void operator()(std::string_view name, std::string_view, TimeColumn v) {
    std::string text;
    take(texts_, name, text);
    if (text.empty()) return;
    if (const auto time = time_from_iso(text)) {
      v.value = *time;
    } else {
      in_.refuse(ErrorCode::format, fmt::format("'{}' row {}: '{}' is no time", name, row_, text.substr(0, 40)));
    }
  }

 private:
  /// Programs of before did not write every column.
  void foresee() {
    std::vector<std::string> later;
    Row blank;
    const auto note_later = [&](std::string_view name, std::string_view, auto&&) {
      if (is_later_column(name)) later.emplace_back(name);
    };
    columns(note_later, blank);
    for (const std::string& name : later) in_.foresee_variable(group_, name);
    for (const std::string& name : later) {
      if (!in_.has_variable(group_, name)) absent_.insert(name);
    }
    const auto note_all = [&](std::string_view name, std::string_view, auto&& value) {
      using Kept = std::decay_t<decltype(value)>;
      const std::string column(name);
      if (absent_.contains(column)) return;
      if constexpr (std::is_same_v<Kept, std::int64_t>) {
        in_.foresee_values<std::int64_t>(group_, column, rows_.size());
      } else if constexpr (std::is_same_v<Kept, double> || std::is_same_v<Kept, DegreesColumn>) {
        in_.foresee_values<double>(group_, column, rows_.size());
      } else {
        in_.foresee_values<std::string>(group_, column, rows_.size());
      }
    };
    columns(note_all, blank);
  }

  template <class T>
  void take(std::vector<std::vector<T>>& store, std::string_view name, T& value) {
    if (store.size() <= at_) store.resize(at_ + 1);
    const bool absent = row_ == 0 && absent_.contains(std::string(name));
    if (row_ == 0 && !absent) store[at_] = in_.values<T>(group_, std::string(name), rows_.size());
    if (row_ < store[at_].size()) value = store[at_][row_];
    ++at_;
  }
  Reader& in_;
  int group_;
  std::vector<Row>& rows_;
  std::set<std::string> absent_;
  std::size_t row_ = 0;
  std::size_t at_ = 0;
  std::vector<std::vector<std::string>> texts_;
  std::vector<std::vector<std::int64_t>> wholes_;
  std::vector<std::vector<double>> numbers_;
};

template <class Row>
std::size_t column_count() {
  std::size_t count = 0;
  const auto add = [&](std::string_view, std::string_view, auto&&) { ++count; };
  Row blank;
  columns(add, blank);
  return count;
}

template <class Row>
void read_rows(Reader& in, int group, const char* dimension, const char* key, std::vector<Row>& rows) {
  const std::size_t n = in.dimension(group, dimension);
  if (n > 0 && in.size(group, key) != n) in.refuse(ErrorCode::format, fmt::format("'{}' has another length", key));
  if (!in.ok() || !in.can_hold(n, column_count<Row>() * sizeof(double))) return;
  rows.resize(n);
  RowFiller<Row>(in, group, rows).fill();
}

/// Text keeps milliseconds; the pings know the rest.
void restore_nanoseconds(ObservationProduct& product) {
  const auto exact = [&](std::int64_t ping, TimeNs& time) {
    if (ping < 0 || ping >= static_cast<std::int64_t>(product.pings.size())) return;
    const TimeNs of_ping = product.pings[static_cast<std::size_t>(ping)].time;
    // Unsigned, for the file's times may be as far apart as no difference can say.
    const auto later = static_cast<std::uint64_t>(of_ping) - static_cast<std::uint64_t>(time);
    if (of_ping >= time && later < 1'000'000) time = of_ping;
  };
  for (SchoolPingRow& row : product.school_pings) exact(row.ping_index, row.time_utc);
  for (SchoolRow& school : product.schools) {
    for (const SchoolPingRow& row : product.school_pings) {
      if (row.school_id != school.school_id) continue;
      exact(row.ping_index, school.first_time_utc);
      exact(row.ping_index, school.last_time_utc);
    }
  }
}

/// Products from before refusals were told lack the group.
void read_rejected(Reader& in, ObservationProduct& product) {
  const int group = in.find_group(in.root(), "rejected");
  if (group >= 0) read_rows(in, group, "echo", "echo_id", product.rejected);
}

void read_diagnostics(Reader& in, ObservationProduct& product) {
  const int group = in.find_group(in.root(), "diagnostics");
  if (group < 0) return;
  const std::size_t n = in.dimension(group, "note");
  const auto code = in.values<std::string>(group, "code", n);
  const auto file = in.values<std::string>(group, "file", n);
  const auto offset = in.values<std::int64_t>(group, "offset", n);
  const auto ping_index = in.values<std::int64_t>(group, "ping_index", n);
  const auto text = in.values<std::string>(group, "text", n);
  for (std::size_t i = 0; i < n && in.ok(); ++i) {
    const auto table = diagnostic_table();
    const auto entry = std::find_if(table.begin(), table.end(), [&](const auto& e) { return e.name == code[i]; });
    if (entry == table.end()) {
      in.refuse(ErrorCode::format, fmt::format("note {} has the unknown code '{}'", i, code[i].substr(0, 40)));
      return;
    }
    product.diagnostics.push_back({entry->code, file[i], offset[i], ping_index[i], text[i]});
  }
}

Result<ObservationProduct> read_whole(const std::filesystem::path& path) {
  Reader in(path, path.string());
  ObservationProduct product;
  if (check_version(in)) {
    read_attributes(in, product);
    read_grid(in, product);
    read_pings(in, product);
    read_rows(in, in.group(in.root(), "schools"), "school", "school_id", product.schools);
    read_numbers(in, product);
    read_rows(in, in.group(in.root(), "school_pings"), "row", "school_id", product.school_pings);
    read_mask(in, product);
    read_rejected(in, product);
    read_diagnostics(in, product);
  }
  if (!in.ok()) return pass_on(in.status());
  restore_nanoseconds(product);
  return product;
}

Result<ProductKey> read_key(const std::filesystem::path& path) {
  Reader in(path, path.string());
  ProductKey key;
  if (check_version(in)) {
    const int root = in.root();
    key = {observation_name(in),         in.text(root, "input_hash"),
           in.text(root, "recipe_hash"), in.text(root, "stage_versions"),
           in.text(root, "source"),      in.text(root, "recipe")};
    const int group = in.group(root, "pings");
    key.pings = in.dimension(group, "ping");
    const auto time = in.values<std::int64_t>(group, time_name(in, group), key.pings);
    if (!time.empty()) {
      key.first_time = time.front();
      key.last_time = time.back();
    }
  }
  if (!in.ok()) return pass_on(in.status());
  return key;
}

}  // namespace

bool is_observation_name(std::string_view name) {
  constexpr std::string_view kBegin = "obs-";
  constexpr std::size_t kFewestDigits = 4;
  constexpr std::size_t kMostDigits = 9;
  if (!name.starts_with(kBegin)) return false;
  const std::string_view digits = name.substr(kBegin.size());
  return digits.size() >= kFewestDigits && digits.size() <= kMostDigits &&
         digits.find_first_not_of("0123456789") == std::string_view::npos;
}

Result<ObservationProduct> read_product(const std::filesystem::path& path) {
  if (const auto sealed = check_seal(path, path.string()); !sealed) return pass_on(sealed);
  return read_whole(path);
}

Result<ProductKey> read_product_key(const std::filesystem::path& path) {
  if (const auto sealed = check_seal(path, path.string()); !sealed) return pass_on(sealed);
  return read_key(path);
}

}  // namespace sonar
