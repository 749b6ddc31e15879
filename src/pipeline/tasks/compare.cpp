// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <system_error>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/time.h"
#include "io/csv_table.h"
#include "io/product_file.h"
#include "io/table_columns.h"
#include "pipeline/tasks/merge.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

enum class Equal : std::uint8_t { no, nearly, exactly };

Equal equal(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return Equal::exactly;
  if (!std::isfinite(a) || !std::isfinite(b)) return Equal::no;
  return std::abs(a - b) <= kEqualRelative * std::max(std::abs(a), std::abs(b)) ? Equal::nearly : Equal::no;
}
Equal equal(float a, float b) { return equal(static_cast<double>(a), static_cast<double>(b)); }
template <class T>
Equal equal(const T& a, const T& b) {
  return a == b ? Equal::exactly : Equal::no;
}

std::string text_of(double v) { return std::isnan(v) ? "unknown" : shortest(v); }
std::string text_of(float v) { return text_of(static_cast<double>(v)); }
std::string text_of(const std::string& v) {
  constexpr std::size_t kShown = 80;
  return fmt::format("'{}'", v.size() <= kShown ? v : v.substr(0, kShown) + "...");
}
std::string text_of(bool v) { return v ? "true" : "false"; }
std::string text_of(std::integral auto v) { return std::to_string(v); }

/// Remembers the first difference, and what was taken for equal though it is not to the last digit.
class Differ {
 public:
  template <class T>
  void value(const std::string& place, const T& a, const T& b) {
    const Equal so = equal(a, b);
    if (found() || so == Equal::exactly) return;
    std::string said = fmt::format("{}: {}, {}", place, text_of(a), text_of(b));
    so == Equal::nearly ? tolerate(std::move(said)) : refuse(std::move(said));
  }
  void tolerate(std::string said) {
    if (all_.tolerated++ == 0) all_.first_tolerated = std::move(said);
  }
  void refuse(std::string said) { all_.difference = std::move(said); }
  template <class T>
  void values(const std::string& place, const std::vector<T>& a, const std::vector<T>& b) {
    value(place + " (length)", a.size(), b.size());
    for (std::size_t i = 0; i < a.size() && !found(); ++i) {
      if (equal(a[i], b[i]) != Equal::exactly) value(fmt::format("{}[{}]", place, i), a[i], b[i]);
    }
  }
  template <class Row>
  void rows(const std::string& group, const std::vector<Row>& a, const std::vector<Row>& b) {
    if (found()) return;
    value(group + " (rows)", a.size(), b.size());
    const auto in_a = columns_of(a);
    const auto in_b = columns_of(b);
    for (std::size_t c = 0; c < in_a.size() && !found(); ++c) {
      std::visit(
          [&](const auto& values_a) {
            values(group + "/" + in_a[c].name, values_a, std::get<std::decay_t<decltype(values_a)>>(in_b[c].values));
          },
          in_a[c].values);
    }
  }
  [[nodiscard]] bool found() const { return !all_.difference.empty(); }
  [[nodiscard]] Comparison take() { return std::move(all_); }

 private:
  Comparison all_;
};

/// What is told of one file after what was told of others.
void add(Comparison& all, const Comparison& one, const std::string& file) {
  if (!one.difference.empty()) all.difference = file + ": " + one.difference;
  if (all.tolerated == 0 && one.tolerated > 0) all.first_tolerated = file + ": " + one.first_tolerated;
  all.tolerated += one.tolerated;
}

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

void compare_contents(Differ& differ, const ObservationProduct& a, const ObservationProduct& b) {
  compare_masks(differ, a, b);
  differ.rows("/school_pings", a.school_pings, b.school_pings);
  differ.rows("/schools", a.schools, b.schools);
  differ.rows("/rejected", a.rejected, b.rejected);
  if (!differ.found()) compare_grid(differ, a, b);
  if (!differ.found()) compare_pings(differ, a, b);
  if (!differ.found()) compare_names(differ, a, b);
  if (!differ.found()) compare_notes(differ, a.diagnostics, b.diagnostics);
}

Result<Comparison> compare_products(const fs::path& a, const fs::path& b, Compared what) {
  const auto in_a = read_product(a);
  if (!in_a) return pass_on(in_a);
  const auto in_b = read_product(b);
  if (!in_b) return pass_on(in_b);
  return compare_products(*in_a, *in_b, what);
}

/// Two fields: as numbers where both are, else as text.
void compare_fields(Differ& differ, const std::string& place, const CsvTable& a, const CsvRecord& in_a,
                    const CsvTable& b, const CsvRecord& in_b, std::size_t c) {
  if (in_a.fields[c] == in_b.fields[c]) return;
  const auto number_a = a.number(in_a, c);
  const auto number_b = b.number(in_b, c);
  const Equal so = number_a && number_b ? equal(*number_a, *number_b) : Equal::no;
  std::string said = fmt::format("{}: {}, {}", place, text_of(in_a.fields[c]), text_of(in_b.fields[c]));
  so == Equal::no ? differ.refuse(std::move(said)) : differ.tolerate(std::move(said));
}

Result<Comparison> compare_tables(const fs::path& a, const fs::path& b) {
  const auto in_a = read_csv(a);
  if (!in_a) return pass_on(in_a);
  const auto in_b = read_csv(b);
  if (!in_b) return pass_on(in_b);
  Differ differ;
  differ.values("header", in_a->header, in_b->header);
  differ.value("rows", in_a->records.size(), in_b->records.size());
  for (std::size_t r = 0; r < in_a->records.size(); ++r) {
    for (std::size_t c = 0; c < in_a->header.size() && !differ.found(); ++c) {
      const std::string place = fmt::format("{}[{}]", in_a->header[c], r);
      compare_fields(differ, place, *in_a, in_a->records[r], *in_b, in_b->records[r], c);
    }
  }
  return differ.take();
}

class Folders {
 public:
  Folders(const fs::path& a, const fs::path& b, Work& work) : a_(a), b_(b), work_(work) {}

  Result<Comparison> compare(Compared what) {
    auto listed = list();
    if (!listed || !all_.difference.empty()) return listed ? Result<Comparison>(all_) : pass_on(listed);
    // What any product says comes before how the first was made.
    if (auto done = products(Compared::content); !done) return pass_on(done);
    if (auto done = tables(); !done) return pass_on(done);
    if (what == Compared::content || !all_.difference.empty()) return all_;
    const Comparison contents = all_;
    if (auto done = products(what); !done) return pass_on(done);
    return Comparison{all_.difference, contents.tolerated, contents.first_tolerated};
  }

 private:
  Result<void> list() {
    auto in_a = product_files(a_);
    if (!in_a) return pass_on(in_a);
    auto in_b = product_files(b_);
    if (!in_b) return pass_on(in_b);
    const auto names = [](const std::vector<fs::path>& files) {
      std::vector<std::string> out;
      for (const fs::path& f : files) out.push_back(f.filename().string());
      return out;
    };
    Differ differ;
    differ.values("products", names(*in_a), names(*in_b));
    all_ = differ.take();
    in_a_ = std::move(*in_a);
    in_b_ = std::move(*in_b);
    return {};
  }

  Result<void> products(Compared part) {
    for (std::size_t i = 0; i < in_a_.size() && all_.difference.empty(); ++i) {
      if (work_.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
      auto one = compare_products(in_a_[i], in_b_[i], part);
      if (!one) return pass_on(one);
      add(all_, *one, in_a_[i].filename().string());
    }
    return {};
  }

  Result<void> tables() {
    bool any = false;
    for (const char* table : {"schools.csv", "school_pings.csv"}) {
      if (!all_.difference.empty()) return {};
      std::error_code error;
      const bool has_a = fs::exists(a_ / table, error);
      Differ differ;
      differ.value(table, has_a, fs::exists(b_ / table, error));
      all_.difference = differ.take().difference;
      if (!has_a || !all_.difference.empty()) continue;
      any = true;
      auto one = compare_tables(a_ / table, b_ / table);
      if (!one) return pass_on(one);
      add(all_, *one, table);
    }
    if (!in_a_.empty() || any || !all_.difference.empty()) return {};
    return fail(ErrorCode::not_found, "neither products nor tables in this folder", {.file = a_.string()});
  }

  fs::path a_;
  fs::path b_;
  Work& work_;
  std::vector<fs::path> in_a_;
  std::vector<fs::path> in_b_;
  Comparison all_;
};

}  // namespace

Comparison compare_products(const ObservationProduct& a, const ObservationProduct& b, Compared what) {
  Differ differ;
  compare_contents(differ, a, b);
  if (!differ.found() && what == Compared::everything) compare_provenance(differ, a, b);
  return differ.take();
}

Result<Comparison> compare_paths(const fs::path& a, const fs::path& b, Compared what, Work& work) {
  std::error_code error;
  for (const fs::path& path : {a, b}) {
    if (!fs::exists(path, error)) return fail(ErrorCode::not_found, "no such file or folder", {.file = path.string()});
  }
  const bool folders = fs::is_directory(a, error);
  if (folders != fs::is_directory(b, error)) return fail(ErrorCode::usage, "a file and a folder cannot be compared");
  if (folders) return Folders(a, b, work).compare(what);
  const bool tables = a.extension() == ".csv" && b.extension() == ".csv";
  auto one = tables ? compare_tables(a, b) : compare_products(a, b, what);
  if (!one) return one;
  Comparison named;
  add(named, *one, a.filename().string());
  return named;
}

}  // namespace sonar
