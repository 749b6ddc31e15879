// SPDX-License-Identifier: Apache-2.0
#include "pipeline/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <vector>

#include "base/number_text.h"
#include "base/time.h"
#include "io/columns.h"
#include "io/csv_table.h"
#include "io/product.h"
#include "pipeline/merge.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

bool equal(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return a == b || std::abs(a - b) <= kEqualRelative * std::max(std::abs(a), std::abs(b));
}
bool equal(float a, float b) { return equal(static_cast<double>(a), static_cast<double>(b)); }
template <class T>
bool equal(const T& a, const T& b) {
  return a == b;
}

std::string text_of(double v) { return std::isnan(v) ? "unknown" : shortest(v); }
std::string text_of(float v) { return text_of(static_cast<double>(v)); }
std::string text_of(const std::string& v) {
  constexpr std::size_t kShown = 80;
  return fmt::format("'{}'", v.size() <= kShown ? v : v.substr(0, kShown) + "...");
}
std::string text_of(bool v) { return v ? "true" : "false"; }
std::string text_of(std::integral auto v) { return std::to_string(v); }

/// Remembers the first difference.
class Differ {
 public:
  template <class T>
  void value(const std::string& place, const T& a, const T& b) {
    if (text_.empty() && !equal(a, b)) text_ = fmt::format("{}: {}, {}", place, text_of(a), text_of(b));
  }
  template <class T>
  void values(const std::string& place, const std::vector<T>& a, const std::vector<T>& b) {
    value(place + " (length)", a.size(), b.size());
    for (std::size_t i = 0; i < a.size() && text_.empty(); ++i) {
      if (!equal(a[i], b[i])) value(fmt::format("{}[{}]", place, i), a[i], b[i]);
    }
  }
  template <class Row>
  void rows(const std::string& group, const std::vector<Row>& a, const std::vector<Row>& b) {
    if (!text_.empty()) return;
    value(group + " (rows)", a.size(), b.size());
    const auto in_a = columns_of(a);
    const auto in_b = columns_of(b);
    for (std::size_t c = 0; c < in_a.size() && text_.empty(); ++c) {
      std::visit(
          [&](const auto& values_a) {
            values(group + "/" + in_a[c].name, values_a, std::get<std::decay_t<decltype(values_a)>>(in_b[c].values));
          },
          in_a[c].values);
    }
  }
  [[nodiscard]] bool found() const { return !text_.empty(); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void compare_names(Differ& differ, const ObservationProduct& a, const ObservationProduct& b) {
  differ.value("/observation", a.observation, b.observation);
  differ.value("/title", a.title, b.title);
  differ.value("/source", a.source, b.source);
  differ.value("/cut_after", a.cut_after, b.cut_after);
  differ.value("/next_school_id", next_school_id(a), next_school_id(b));
}

/// How a product was made, not what it says.
void compare_provenance(Differ& differ, const ObservationProduct& a, const ObservationProduct& b) {
  differ.value("/recipe", a.recipe_json, b.recipe_json);
  differ.value("/recipe_hash", a.recipe_hash, b.recipe_hash);
  differ.value("/stage_versions", a.stage_versions, b.stage_versions);
  differ.value("/sonar_explorer_version", a.program_version, b.program_version);
  differ.value("/history", a.history, b.history);
  differ.value("/input_files (length)", a.input_files.size(), b.input_files.size());
  for (std::size_t i = 0; i < a.input_files.size() && !differ.found(); ++i) {
    const std::string place = fmt::format("/input_files[{}]", i);
    differ.value(place + " name", a.input_files[i].name, b.input_files[i].name);
    differ.value(place + " size", a.input_files[i].size, b.input_files[i].size);
    differ.value(place + " hash", a.input_files[i].hash, b.input_files[i].hash);
  }
  differ.value("/input_hash", a.input_hash, b.input_hash);
}

void compare_pings(Differ& differ, const ObservationProduct& a, const ObservationProduct& b) {
  differ.value("/pings (length)", a.pings.size(), b.pings.size());
  for (std::size_t i = 0; i < a.pings.size() && !differ.found(); ++i) {
    const PingNavigation& p = a.pings[i];
    const PingNavigation& q = b.pings[i];
    const auto at = [&](const char* name) { return fmt::format("/pings/{}[{}]", name, i); };
    differ.value(at("time"), p.time, q.time);
    differ.value(at("latitude"), p.transducer.latitude_deg, q.transducer.latitude_deg);
    differ.value(at("longitude"), p.transducer.longitude_deg, q.transducer.longitude_deg);
    differ.value(at("heading"), p.heading_deg, q.heading_deg);
    differ.value(at("speed"), p.speed_mps, q.speed_mps);
    differ.value(at("course"), p.course_deg, q.course_deg);
    differ.value(at("distance"), p.distance_nmi, q.distance_nmi);
    differ.value(at("pitch"), p.pitch_deg, q.pitch_deg);
    differ.value(at("roll"), p.roll_deg, q.roll_deg);
    differ.value(at("heave"), p.heave_m, q.heave_m);
    differ.value(at("transducer_depth"), p.transducer_depth_m, q.transducer_depth_m);
    differ.value(at("gps_minus_clock"), p.gps_minus_clock_s, q.gps_minus_clock_s);
    differ.value(at("bad"), p.bad, q.bad);
  }
  differ.value("/pings/background_db (length)", a.background_db.size(), b.background_db.size());
  for (std::size_t i = 0; i < a.background_db.size() && !differ.found(); ++i) {
    differ.values(fmt::format("/pings/background_db[{}]", i), a.background_db[i], b.background_db[i]);
  }
}

void compare_grid(Differ& differ, const ObservationProduct& a, const ObservationProduct& b) {
  differ.value("/grid", a.grid.has_value(), b.grid.has_value());
  if (differ.found() || !a.grid) return;
  const BeamGrid& g = a.grid->grid;
  const BeamGrid& h = b.grid->grid;
  differ.values("/grid/elevation", g.elevation_deg, h.elevation_deg);
  differ.values("/grid/azimuth", g.azimuth_deg, h.azimuth_deg);
  differ.value("/grid/mounting_azimuth", g.mounting_azimuth_deg, h.mounting_azimuth_deg);
  differ.values("/grid/frequency", g.frequency_hz, h.frequency_hz);
  differ.values("/grid/channel", g.channel, h.channel);
  differ.values("/grid/vertical_width", g.vertical_width_deg, h.vertical_width_deg);
  differ.values("/grid/horizontal_width", g.horizontal_width_deg, h.horizontal_width_deg);
  differ.values("/grid/psi_stated", g.psi_stated_db, h.psi_stated_db);
  differ.values("/grid/psi_used", a.grid->psi_used_db, b.grid->psi_used_db);
  differ.values("/grid/sample_count", a.grid->sample_count, b.grid->sample_count);
  differ.value("/grid/sample_count_of_grid", a.grid->range.count, b.grid->range.count);
  differ.value("/grid/sample_spacing", a.grid->range.spacing_m, b.grid->range.spacing_m);
  differ.value("/grid/range_of_first_sample", a.grid->range.first_m, b.grid->range.first_m);
  differ.value("/grid/sound_speed", a.grid->sound_speed_mps, b.grid->sound_speed_mps);
}

void compare_masks(Differ& differ, const ObservationProduct& a, const ObservationProduct& b) {
  differ.value("/mask (school pings)", a.masks.size(), b.masks.size());
  for (std::size_t i = 0; i < a.masks.size() && !differ.found(); ++i) {
    const SchoolMask& m = a.masks[i];
    const SchoolMask& n = b.masks[i];
    differ.value(fmt::format("/mask/school_id (school ping {})", i), m.school_id, n.school_id);
    differ.value(fmt::format("/mask/ping_index (school ping {})", i), m.ping_index, n.ping_index);
    const std::string place = fmt::format("/mask/{{}} (school {}, ping {}) run", m.school_id, m.ping_index);
    const auto named = [&](const char* name) { return fmt::format(fmt::runtime(place), name); };
    differ.value(named("run") + "s", m.mask.runs.size(), n.mask.runs.size());
    for (std::size_t r = 0; r < m.mask.runs.size() && !differ.found(); ++r) {
      const auto at = [&](const char* name) { return fmt::format("{} {}", named(name), r); };
      differ.value(at("row"), m.mask.runs[r].row, n.mask.runs[r].row);
      differ.value(at("first_sample"), m.mask.runs[r].first_sample, n.mask.runs[r].first_sample);
      differ.value(at("sample_count"), m.mask.runs[r].count, n.mask.runs[r].count);
    }
    differ.values(fmt::format("/mask/confidence (school {}, ping {})", m.school_id, m.ping_index), m.mask.confidence,
                  n.mask.confidence);
    const auto place_of_fault = fmt::format("/mask/fault (school {}, ping {})", m.school_id, m.ping_index);
    differ.values(place_of_fault, m.fault, n.fault);
  }
}

void compare_notes(Differ& differ, const Diagnostics& a, const Diagnostics& b) {
  differ.value("/diagnostics (length)", a.size(), b.size());
  for (std::size_t i = 0; i < a.size() && !differ.found(); ++i) {
    const auto at = [&](const char* name) { return fmt::format("/diagnostics/{}[{}]", name, i); };
    differ.value(at("code"), std::string(name(a[i].code)), std::string(name(b[i].code)));
    differ.value(at("file"), a[i].file, b[i].file);
    differ.value(at("offset"), a[i].offset, b[i].offset);
    differ.value(at("ping_index"), a[i].ping_index, b[i].ping_index);
    differ.value(at("text"), a[i].text, b[i].text);
  }
}

Result<std::string> compare_products(const fs::path& a, const fs::path& b, Compared what) {
  const auto in_a = read_product(a);
  if (!in_a) return pass_on(in_a);
  const auto in_b = read_product(b);
  if (!in_b) return pass_on(in_b);
  std::string difference = first_difference(*in_a, *in_b, what);
  return difference.empty() ? difference : a.filename().string() + ": " + difference;
}

/// Two fields: as numbers where both are, else as text.
bool equal_fields(const CsvTable& a, const CsvRecord& in_a, const CsvTable& b, const CsvRecord& in_b, std::size_t c) {
  if (in_a.fields[c] == in_b.fields[c]) return true;
  const auto number_a = a.number(in_a, c);
  const auto number_b = b.number(in_b, c);
  return number_a && number_b && equal(*number_a, *number_b);
}

Result<std::string> compare_tables(const fs::path& a, const fs::path& b) {
  const auto in_a = read_csv(a);
  if (!in_a) return pass_on(in_a);
  const auto in_b = read_csv(b);
  if (!in_b) return pass_on(in_b);
  Differ differ;
  const std::string file = a.filename().string();
  differ.values(file + ": header", in_a->header, in_b->header);
  differ.value(file + ": rows", in_a->records.size(), in_b->records.size());
  for (std::size_t r = 0; r < in_a->records.size() && !differ.found(); ++r) {
    for (std::size_t c = 0; c < in_a->header.size(); ++c) {
      const CsvRecord& x = in_a->records[r];
      const CsvRecord& y = in_b->records[r];
      if (equal_fields(*in_a, x, *in_b, y, c)) continue;
      differ.value(fmt::format("{}: {}[{}]", file, in_a->header[c], r), x.fields[c], y.fields[c]);
    }
  }
  return differ.take();
}

Result<std::string> compare_folders(const fs::path& a, const fs::path& b, Compared what) {
  const auto in_a = product_files(a);
  if (!in_a) return pass_on(in_a);
  const auto in_b = product_files(b);
  if (!in_b) return pass_on(in_b);
  const auto names = [](const std::vector<fs::path>& files) {
    std::vector<std::string> out;
    for (const fs::path& f : files) out.push_back(f.filename().string());
    return out;
  };
  Differ differ;
  differ.values("products", names(*in_a), names(*in_b));
  if (differ.found()) return differ.take();
  const auto all_products = [&](Compared part) -> Result<std::string> {
    for (std::size_t i = 0; i < in_a->size(); ++i) {
      auto difference = compare_products((*in_a)[i], (*in_b)[i], part);
      if (!difference || !difference->empty()) return difference;
    }
    return std::string{};
  };
  // What any product says comes before how the first was made.
  auto content = all_products(Compared::content);
  if (!content || !content->empty()) return content;
  bool any_table = false;
  for (const char* table : {"schools.csv", "school_pings.csv"}) {
    std::error_code error;
    const bool has_a = fs::exists(a / table, error);
    const bool has_b = fs::exists(b / table, error);
    differ.value(table, has_a, has_b);
    if (differ.found()) return differ.take();
    if (!has_a) continue;
    any_table = true;
    auto difference = compare_tables(a / table, b / table);
    if (!difference || !difference->empty()) return difference;
  }
  if (in_a->empty() && !any_table) {
    return fail(ErrorCode::not_found, "neither products nor tables in this folder", {.file = a.string()});
  }
  return what == Compared::content ? std::string{} : all_products(what);
}

}  // namespace

std::string first_difference(const ObservationProduct& a, const ObservationProduct& b, Compared what) {
  Differ differ;
  compare_masks(differ, a, b);
  differ.rows("/school_pings", a.school_pings, b.school_pings);
  differ.rows("/schools", a.schools, b.schools);
  differ.rows("/rejected", a.rejected, b.rejected);
  if (!differ.found()) compare_grid(differ, a, b);
  if (!differ.found()) compare_pings(differ, a, b);
  if (!differ.found()) compare_names(differ, a, b);
  if (!differ.found()) compare_notes(differ, a.diagnostics, b.diagnostics);
  if (!differ.found() && what == Compared::everything) compare_provenance(differ, a, b);
  return differ.take();
}

Result<std::string> compare_paths(const fs::path& a, const fs::path& b, Compared what) {
  std::error_code error;
  for (const fs::path& path : {a, b}) {
    if (!fs::exists(path, error)) return fail(ErrorCode::not_found, "no such file or folder", {.file = path.string()});
  }
  const bool folders = fs::is_directory(a, error);
  if (folders != fs::is_directory(b, error)) return fail(ErrorCode::usage, "a file and a folder cannot be compared");
  if (folders) return compare_folders(a, b, what);
  if (a.extension() == ".csv" && b.extension() == ".csv") return compare_tables(a, b);
  return compare_products(a, b, what);
}

}  // namespace sonar
