// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/number_text.h"
#include "io/atomic_file.h"
#include "io/cf_attributes.h"
#include "io/column_words.h"
#include "io/netcdf_file.h"
#include "io/product_file.h"
#include "io/product_seal.h"
#include "io/table_columns.h"
#include "model/beam_angles.h"

namespace sonar {
namespace {

using netcdf::Dimension;
using netcdf::Storage;
using netcdf::Writer;

/// One member of every ping's navigation as an array.
template <class Member>
auto per_ping(const ObservationProduct& product, Member PingNavigation::*member) {
  std::vector<Member> values;
  for (const PingNavigation& ping : product.pings) values.push_back(ping.*member);
  return values;
}

void write_attributes(Writer& out, const ObservationProduct& product) {
  const int root = out.root();
  const auto text = [&](const char* name, const std::string& value) {
    out.attribute(root, Writer::kGlobal, name, std::string_view(value));
  };
  cf::describe_file(out, product.title, product);
  out.attribute(root, Writer::kGlobal, "product_version", std::int64_t{kProductVersion});
  text("stage_versions", product.stage_versions);
  text("input_hash", product.input_hash);
  out.attribute(root, Writer::kGlobal, "next_school_id", next_school_id(product));
  out.attribute(root, Writer::kGlobal, "continues_cut", std::int64_t{product.cut_after != 0 ? 1 : 0});
  if (product.cut_after != 0) out.attribute(root, Writer::kGlobal, "cut_after", product.cut_after);
  std::vector<std::string> files;
  for (const InputFile& f : product.input_files) files.push_back(fmt::format("{} {} {}", f.name, f.size, f.hash));
  out.attribute(root, Writer::kGlobal, "input_files", files);
  text("input_files_comment", "one text per file: name, size in bytes, hash");
}

void write_background(Writer& out, int group, const Dimension& ping, const ObservationProduct& product) {
  if (product.background_db.empty() || !product.grid) return;
  const std::vector<int>& channel = product.grid->grid.channel;
  const std::size_t channels = channel.size();
  std::vector<float> levels(product.pings.size() * channels, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t p = 0; p < product.background_db.size(); ++p) {
    const std::vector<float>& of_ping = product.background_db[p];
    for (std::size_t row = 0; row < of_ping.size(); ++row) {
      levels[p * channels + static_cast<std::size_t>(channel[row])] = of_ping[row];
    }
  }
  const Dimension width = out.dimension(group, "channel", channels);
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  const int id = out.variable(group, "background_db", "dB re 1 W", {ping, width}, levels, Storage::packed, &unknown);
  cf::name(out, group, id, "received background level that was subtracted, by channel");
  cf::place(out, group, id, "time latitude longitude");
}

void write_pings(Writer& out, const ObservationProduct& product) {
  const int group = out.group(out.root(), "pings");
  const Dimension ping = out.dimension(group, "ping", product.pings.size());
  cf::ping_times(out, group, ping, per_ping(product, &PingNavigation::time));
  std::vector<double> latitude;
  std::vector<double> longitude;
  for (const PingNavigation& p : product.pings) {
    latitude.push_back(p.transducer.latitude_deg);
    longitude.push_back(p.transducer.longitude_deg);
  }
  const auto put = [&](const char* name, const char* unit, const std::vector<double>& values, const char* long_name,
                       std::string_view standard_name = {}) {
    const int id = out.variable(group, name, unit, {ping}, values, Storage::plain, &kUnknown);
    cf::name(out, group, id, long_name, standard_name);
    return id;
  };
  put("latitude", "degrees_north", latitude, "latitude of the transducer, WGS 84", "latitude");
  put("longitude", "degrees_east", longitude, "longitude of the transducer, WGS 84", "longitude");
  const auto placed = [&](const char* name, const char* unit, double PingNavigation::*member, const char* long_name,
                          std::string_view standard_name = {}) {
    cf::place(out, group, put(name, unit, per_ping(product, member), long_name, standard_name),
              "time latitude longitude");
  };
  using N = PingNavigation;
  placed("heading", "degrees", &N::heading_deg, "heading, clockwise from true north", "platform_orientation");
  placed("speed", "m s-1", &N::speed_mps, "speed over ground", "platform_speed_wrt_ground");
  placed("course", "degrees", &N::course_deg, "course over ground, clockwise from true north", "platform_course");
  placed("distance", "nautical_mile", &N::distance_nmi, "distance by the vessel's log");
  placed("pitch", "degrees", &N::pitch_deg, "pitch, positive with the bow up", "platform_pitch_fore_up");
  placed("roll", "degrees", &N::roll_deg, "roll, positive with the port side up", "platform_roll_starboard_down");
  placed("heave", "m", &N::heave_m, "heave, positive down", "platform_heave_down");
  placed("transducer_depth", "m", &N::transducer_depth_m, "depth of the transducer below the sea surface", "depth");
  placed("gps_minus_clock", "s", &N::gps_minus_clock_s, "GPS time minus the datagrams' clock");
  std::vector<std::uint8_t> bad;
  for (const PingNavigation& p : product.pings) bad.push_back(p.bad ? 1 : 0);
  const int id = out.variable(group, "bad", "1", {ping}, bad);
  cf::name(out, group, id, "whether the ping was left out");
  cf::flags(out, group, id, "used left_out");
  cf::place(out, group, id, "time latitude longitude");
  write_background(out, group, ping, product);
}

/// Left out where they are not known, as of an older product.
void write_beam_angles(Writer& out, int group, const std::vector<Dimension>& beams, const GridRecord& record) {
  const auto put = [&](const char* name, const char* unit, const std::vector<double>& values, const char* long_name) {
    if (values.size() != record.grid.channel.size()) return;
    cf::name(out, group, out.variable(group, name, unit, beams, values, Storage::plain, &kUnknown), long_name);
  };
  if (!record.grid.psi_stated_db.empty()) {
    put("psi_stated", "dB re 1 sr", record.grid.psi_stated_db,
        "equivalent two-way beam angle as the raw files state it");
    put("psi_from_widths", "dB re 1 sr", psi_from_widths_db(record.grid),
        "equivalent two-way beam angle of the square of a beam of these widths");
    put("psi_excess", "dB", psi_excess_db(record.grid), "psi_stated minus psi_from_widths");
  }
  put("psi_used", "dB re 1 sr", record.psi_used_db, "equivalent two-way beam angle that Sv was worked out with");
}

void write_grid(Writer& out, const ObservationProduct& product) {
  const int group = out.group(out.root(), "grid");
  if (!product.grid) return;
  const GridRecord& record = *product.grid;
  const BeamGrid& grid = record.grid;
  const Dimension fan = out.dimension(group, "fan", grid.elevation_deg.size());
  const Dimension beam = out.dimension(group, "beam", grid.azimuth_deg.size());
  const auto scalar = [&](const char* name, const char* unit, double value) {
    return out.variable(group, name, unit, {}, std::vector<double>{value});
  };
  const auto named = [&](int id, const char* long_name, std::string_view standard_name = {}) {
    cf::name(out, group, id, long_name, standard_name);
  };
  named(out.variable(group, "elevation", "degrees", {fan}, grid.elevation_deg), "elevation of the fan, positive up");
  named(out.variable(group, "azimuth", "degrees", {beam}, grid.azimuth_deg), "azimuth, clockwise from the bow");
  named(scalar("mounting_azimuth", "degrees", grid.mounting_azimuth_deg), "where the sonar looks, from the bow");
  named(out.variable(group, "frequency", "Hz", {fan}, grid.frequency_hz), "centre frequency of the fan",
        "sound_frequency");
  named(out.variable(group, "channel", "1", {fan, beam},
                     std::vector<std::int32_t>(grid.channel.begin(), grid.channel.end())),
        "channel of each beam, from 0");
  // A file may state no width.
  const auto width = [&](const char* name, const std::vector<double>& values_deg, const char* long_name) {
    named(out.variable(group, name, "degrees", {fan, beam}, values_deg, Storage::plain, &kUnknown), long_name);
  };
  width("vertical_width", grid.vertical_width_deg, "vertical one-way -3 dB width of the beam");
  width("horizontal_width", grid.horizontal_width_deg, "horizontal one-way -3 dB width of the beam");
  write_beam_angles(out, group, {fan, beam}, record);
  named(out.variable(group, "sample_count", "1", {fan}, record.sample_count), "samples of the fan's longest beam");
  named(out.variable(group, "sample_count_of_grid", "1", {}, std::vector<std::int32_t>{record.range.count}),
        "samples of the longest fan");
  named(scalar("sample_spacing", "m", record.range.spacing_m), "distance between samples along range");
  named(scalar("range_of_first_sample", "m", record.range.first_m), "slant range of sample 0; may be negative");
  named(scalar("sound_speed", "m s-1", record.sound_speed_mps), "speed of sound", "speed_of_sound_in_sea_water");
}

/// Doubles may be unknown; whole numbers and texts never are.
int write_values(Writer& out, int group, const TableColumn& column, const Dimension& row) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    return out.variable(group, column.name, column.unit, {row}, *numbers, Storage::plain, &kUnknown);
  }
  return std::visit([&](const auto& values) { return out.variable(group, column.name, column.unit, {row}, values); },
                    column.values);
}

void write_column(Writer& out, int group, const TableColumn& column, const Dimension& row,
                  const std::string& coordinates) {
  const int id = write_values(out, group, column, row);
  const ColumnWords* words = words_of(column.name);
  if (words == nullptr) return;
  cf::name(out, group, id, words->long_name, words->standard_name);
  if (const auto flags = words->flags(); !flags.empty()) {
    out.numbers(group, id, words->bits ? "flag_masks" : "flag_values", flags);
    out.attribute(group, id, "flag_meanings", words->meanings);
  }
  const std::string place = coordinates + " ";
  if ((" " + place).find(" " + column.name + " ") == std::string::npos) cf::place(out, group, id, coordinates);
}

/// Visitor: the time columns of a row, as numbers beside their texts: `first_time` of `first_time_utc`.
struct TimesOfRows {
  std::vector<std::pair<std::string, std::vector<TimeNs>>> columns;
  std::size_t at = 0;
  void operator()(std::string_view name, std::string_view, TimeColumn column) {
    if (at == columns.size()) columns.push_back({std::string(name), {}});
    columns[at++].second.push_back(column.value);
  }
  template <class T>
  void operator()(std::string_view, std::string_view, const T&) {}
};

template <class Row>
void write_times(Writer& out, int group, const Dimension& row, const std::vector<Row>& rows) {
  TimesOfRows times;
  Row blank;
  columns(times, blank);
  for (auto& [name, values] : times.columns) values.clear();
  for (Row one : rows) {
    times.at = 0;
    columns(times, one);
  }
  for (const auto& [name, values] : times.columns) {
    std::string number = name.substr(0, name.size() - std::string_view("_utc").size());
    if (!number.ends_with("time")) number += "_time";
    const bool may_lack = name == "decided_utc";  // nobody may have decided; what was seen was seen at some time
    cf::times(out, group, number, words_of(name)->long_name, row, values, may_lack);
  }
}

/// coordinates  where and when the rows are, names of their columns
template <class Row>
void write_rows(Writer& out, const char* group_name, const char* dimension, const std::string& coordinates,
                const std::vector<Row>& rows) {
  const int group = out.group(out.root(), group_name);
  const Dimension row = out.dimension(group, dimension, rows.size());
  write_times(out, group, row, rows);
  for (const TableColumn& column : columns_of(rows)) write_column(out, group, column, row, coordinates);
}

/// A run as it stands in the file.
struct ChannelRun {
  std::int64_t school_id;
  std::int64_t ping_index;
  std::int32_t channel;
  std::int32_t first_sample;
  std::int32_t count;
  const std::uint8_t* confidence;
  const SchoolMask* school;  ///< for the faults, which have no address of their own
  std::size_t first_voxel;
  [[nodiscard]] auto key() const { return std::tuple(school_id, ping_index, channel, first_sample); }
};

Result<std::vector<ChannelRun>> channel_runs(const ObservationProduct& product, const Where& where) {
  std::vector<ChannelRun> runs;
  const auto wrong = [&](const SchoolMask& m, const char* what) {
    return fail(ErrorCode::bad_parameter, fmt::format("mask of school {}: {}", m.school_id, what),
                {.file = where.file, .ping = m.ping_index});
  };
  for (const SchoolMask& m : product.masks) {
    if (!m.mask.empty() && !product.grid) return wrong(m, "there is no grid");
    if (m.ping_index < 0 || m.ping_index >= static_cast<std::int64_t>(product.pings.size())) {
      return wrong(m, "no such ping");
    }
    std::size_t voxel = 0;
    for (const Run& run : m.mask.runs) {
      const auto count = static_cast<std::size_t>(std::max(0, run.count));
      const GridRecord& record = *product.grid;
      if (run.count <= 0 || run.first_sample < 0 || run.first_sample > record.range.count - run.count) {
        return wrong(m, "a run outside the samples");
      }
      if (run.row < 0 || run.row >= static_cast<std::int32_t>(record.grid.channel.size())) {
        return wrong(m, "a run outside the beams");
      }
      if (count > m.mask.voxels() - voxel) return wrong(m, "fewer confidences than voxels");
      runs.push_back({m.school_id, m.ping_index, record.grid.channel[static_cast<std::size_t>(run.row)],
                      run.first_sample, run.count, m.mask.confidence.data() + voxel, &m, voxel});
      voxel += count;
    }
    if (voxel != m.mask.voxels()) return wrong(m, "more confidences than voxels");
    if (!m.fault.empty() && m.fault.size() != voxel) return wrong(m, "faults and voxels differ in number");
  }
  std::stable_sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.key() < b.key(); });
  return runs;
}

/// Left out where they are not known of every mask.
void write_faults(Writer& out, int group, const Dimension& voxel, const std::vector<ChannelRun>& runs) {
  std::vector<std::uint8_t> fault;
  for (const ChannelRun& run : runs) {
    if (run.school->fault.empty()) return;
    const auto first = run.school->fault.begin() + static_cast<std::ptrdiff_t>(run.first_voxel);
    fault.insert(fault.end(), first, first + run.count);
  }
  const int id = out.variable(group, "fault", "1", {voxel}, fault, Storage::packed);
  cf::name(out, group, id, "whether the sample is faulty and takes no part in Sv, in run order");
  cf::flags(out, group, id, "sound faulty");
}

void write_mask(Writer& out, const std::vector<ChannelRun>& runs) {
  const int group = out.group(out.root(), "mask");
  std::vector<std::int64_t> school_id;
  std::vector<std::int64_t> ping_index;
  std::vector<std::int32_t> channel;
  std::vector<std::int32_t> first_sample;
  std::vector<std::int32_t> sample_count;
  std::vector<std::uint8_t> confidence;
  for (const ChannelRun& run : runs) {
    school_id.push_back(run.school_id);
    ping_index.push_back(run.ping_index);
    channel.push_back(run.channel);
    first_sample.push_back(run.first_sample);
    sample_count.push_back(run.count);
    confidence.insert(confidence.end(), run.confidence, run.confidence + run.count);
  }
  const Dimension run = out.dimension(group, "run", runs.size());
  const Dimension voxel = out.dimension(group, "voxel", confidence.size());
  const auto named = [&](int id, const char* long_name) { out.attribute(group, id, "long_name", long_name); };
  named(out.variable(group, "school_id", "1", {run}, school_id, Storage::packed), "school of the run");
  named(out.variable(group, "ping_index", "1", {run}, ping_index, Storage::packed), "number of the run's ping, from 0");
  named(out.variable(group, "channel", "1", {run}, channel, Storage::packed), "number of the run's channel, from 0");
  named(out.variable(group, "first_sample", "1", {run}, first_sample, Storage::packed),
        "number of the run's first sample, from 0");
  const int count = out.variable(group, "sample_count", "1", {run}, sample_count, Storage::packed);
  named(count, "length of the run");
  out.attribute(group, count, "sample_dimension", std::string_view("voxel"));  // the voxels are a ragged array
  const int id = out.variable(group, "confidence", "1", {voxel}, confidence, Storage::packed);
  out.attribute(group, id, "scale_factor", 1.0 / 255.0);
  named(id, "confidence of each voxel, in run order");
  write_faults(out, group, voxel, runs);
}

void write_diagnostics(Writer& out, const Diagnostics& notes) {
  const int group = out.group(out.root(), "diagnostics");
  std::vector<std::string> code;
  std::vector<std::string> file;
  std::vector<std::int64_t> offset;
  std::vector<std::int64_t> ping_index;
  std::vector<std::string> text;
  for (const Diagnostic& note : notes) {
    code.emplace_back(name(note.code));
    file.push_back(note.file);
    offset.push_back(note.offset);
    ping_index.push_back(note.ping_index);
    text.push_back(note.text);
  }
  const Dimension n = out.dimension(group, "note", notes.size());
  const std::int64_t none = -1;
  cf::name(out, group, out.variable(group, "code", "", {n}, code), "code of the note");
  cf::name(out, group, out.variable(group, "file", "", {n}, file), "file that the note is about");
  cf::name(out, group, out.variable(group, "offset", "1", {n}, offset, Storage::plain, &none),
           "place in the file, bytes from its beginning");
  cf::name(out, group, out.variable(group, "ping_index", "1", {n}, ping_index, Storage::plain, &none),
           "number of the ping, from 0");
  cf::name(out, group, out.variable(group, "text", "", {n}, text), "what the note says");
}

Result<void> check_shapes(const ObservationProduct& product, const Where& where) {
  const auto wrong = [&](const char* what) { return fail(ErrorCode::bad_parameter, what, where); };
  if (!product.background_db.empty() && product.background_db.size() != product.pings.size()) {
    return wrong("background levels and pings differ in number");
  }
  if (!product.grid) return {};
  const BeamGrid& grid = product.grid->grid;
  const std::size_t cells = grid.elevation_deg.size() * grid.azimuth_deg.size();
  const bool whole = cells > 0 && grid.frequency_hz.size() == grid.elevation_deg.size() &&
                     grid.channel.size() == cells && grid.vertical_width_deg.size() == cells &&
                     grid.horizontal_width_deg.size() == cells &&
                     product.grid->sample_count.size() == grid.elevation_deg.size();
  if (!whole) return wrong("the grid's arrays differ in size");
  for (const std::vector<double>& psi_db : {grid.psi_stated_db, product.grid->psi_used_db}) {
    if (!psi_db.empty() && psi_db.size() != cells) return wrong("beam angles and beams differ in number");
  }
  std::set<int> channels(grid.channel.begin(), grid.channel.end());
  if (channels.size() != cells || *channels.begin() != 0 || *channels.rbegin() != static_cast<int>(cells) - 1) {
    return wrong("the grid's channels are not 0, 1, ... each once");
  }
  for (const std::vector<float>& levels : product.background_db) {
    if (!levels.empty() && levels.size() != cells) return wrong("background levels and beams differ in number");
  }
  return {};
}

}  // namespace

Result<void> write_product(const ObservationProduct& product, const std::filesystem::path& path, Beside beside) {
  const Where where{.file = path.string()};
  if (auto checked = check_shapes(product, where); !checked) return checked;
  const auto runs = channel_runs(product, where);
  if (!runs) return pass_on(runs);
  auto file = AtomicFile::create(path, beside);
  if (!file) return pass_on(file);
  Writer out(path.string());
  write_attributes(out, product);
  write_pings(out, product);
  write_grid(out, product);
  write_rows(out, "schools", "school", "first_time latitude longitude depth_m", product.schools);
  write_rows(out, "school_pings", "row", "time latitude longitude depth_m", product.school_pings);
  write_mask(out, *runs);
  write_rows(out, "rejected", "echo", "latitude longitude depth_m", product.rejected);
  write_diagnostics(out, product.diagnostics);
  const auto hash = out.close_into(*file);
  if (!hash) return pass_on(hash);
  if (auto sealed = file->write(seal_text(*hash)); !sealed) return sealed;
  return file->commit();
}

}  // namespace sonar
