// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "model/beam_angles.h"
#include "pipeline/exports/info.h"

namespace sonar {
namespace {

using Json = nlohmann::ordered_json;

Json time_json(const std::optional<TimeNs>& time) { return time ? Json(iso_time(*time)) : Json(nullptr); }

Json notes_json(const Diagnostics& notes) {
  Json list = Json::array();
  for (const Diagnostic& note : notes) {
    Json entry{{"code", name(note.code)},
               {"offset", note.offset >= 0 ? Json(note.offset) : Json(nullptr)},
               {"text", note.text}};
    if (note.ping_index >= 0) entry["ping_index"] = note.ping_index;
    list.push_back(std::move(entry));
  }
  return list;
}

/// To the 8 decimals that degrees have everywhere: a millimetre.
double rounded_deg(double degrees) { return std::round(degrees * 1e8) / 1e8; }

Json position_json(const std::optional<Geographic>& position) {
  if (!position) return nullptr;
  return {{"latitude", rounded_deg(position->latitude_deg)}, {"longitude", rounded_deg(position->longitude_deg)}};
}

Json file_json(const FileInfo& file, bool counted) {
  Json json{{"path", file.path},
            {"format", file.format},
            {"sounder", file.sounder},
            {"size", file.size},
            {"datagrams", counted ? Json(file.datagrams) : Json(nullptr)},
            {"channels", file.channels},
            {"pings", counted ? Json(file.pings) : Json(nullptr)},
            {"samples", counted ? Json{{"min", file.min_samples}, {"max", file.max_samples}} : Json(nullptr)},
            {"first_time_utc", time_json(file.first_time)},
            {"last_time_utc", time_json(file.last_time)},
            {"first_position", position_json(file.first_position)},
            {"last_position", position_json(file.last_position)},
            {"talkers", file.talkers},
            {"gps_minus_clock_s", std::isnan(file.gps_minus_clock_s) ? Json(nullptr) : Json(file.gps_minus_clock_s)},
            {"notes", notes_json(file.notes)}};
  if (file.power_count_sum) json["power_count_sum"] = *file.power_count_sum;
  return json;
}

/// To a thousandth of a dB; null = not known.
Json by_fan(const std::vector<double>& values_db, const BeamGrid& grid) {
  Json fans = Json::array();
  for (int fan = 0; fan < grid.fans(); ++fan) {
    Json row = Json::array();
    for (int beam = 0; beam < grid.beams(); ++beam) {
      const double db = values_db[static_cast<std::size_t>(fan * grid.beams() + beam)];
      row.push_back(std::isfinite(db) ? Json(std::round(db * 1e3) / 1e3) : Json(nullptr));
    }
    fans.push_back(std::move(row));
  }
  return fans;
}

Json psi_json(const BeamGrid& grid) {
  return {{"stated_db", by_fan(grid.psi_stated_db, grid)},
          {"from_widths_db", by_fan(psi_from_widths_db(grid), grid)},
          {"excess_db", by_fan(psi_excess_db(grid), grid)}};
}

/// What the whole grid's beam angles are beside their widths, and a number for each fan.
std::string psi_text(const BeamGrid& grid) {
  const std::vector<double> excess_db = psi_excess_db(grid);
  const std::string all = text_of(excess_over(excess_db));
  if (all.empty()) return {};
  std::string text = fmt::format("  {}\n  by fan, deepest first, dB:", all);
  for (int fan = 0; fan < grid.fans(); ++fan) {
    const PsiExcess of_fan = excess_of_fan(excess_db, grid, fan);
    text += of_fan.beams > 0 ? fmt::format(" {:.1f}", of_fan.mean_db) : std::string(" -");
  }
  return text + '\n';
}

Json range_json(const SettingRange& range) {
  return range.empty() ? Json(nullptr) : Json{{"min", range.least}, {"max", range.greatest}};
}

Json instrument_json(const InstrumentInfo& instrument, bool fans) {
  return {{"model", instrument.model},
          {"beams", instrument.beams},
          {"frequency_hz", range_json(instrument.frequency_hz)},
          {"pulse_length_s", range_json(instrument.pulse_length_s)},
          {"transmit_power_w", range_json(instrument.transmit_power_w)},
          {"gain_db", range_json(instrument.gain_db)},
          {"width_alongship_deg", range_json(instrument.width_alongship_deg)},
          {"width_athwartship_deg", range_json(instrument.width_athwartship_deg)},
          {"width_vertical_deg", fans ? range_json(instrument.width_alongship_deg) : Json(nullptr)},
          {"width_horizontal_deg", fans ? range_json(instrument.width_athwartship_deg) : Json(nullptr)}};
}

/// "75 to 112 kHz, ", or "38 kHz, "; nothing where no beam tells.
std::string range_text(const char* what, const SettingRange& range, double unit, const char* unit_name) {
  if (range.empty()) return {};
  const std::string least = fmt::format("{:.4g}", range.least / unit);
  const std::string greatest = fmt::format("{:.4g}", range.greatest / unit);
  return fmt::format(", {}{} {}", what, least == greatest ? least : least + " to " + greatest, unit_name);
}

std::string instrument_text(const InstrumentInfo& instrument, bool fans) {
  return fmt::format(
      "  {}{}{}{}{}{}{}\n", count_of(static_cast<std::size_t>(instrument.beams), "beam"),
      range_text("", instrument.frequency_hz, 1e3, "kHz"), range_text("pulse ", instrument.pulse_length_s, 1e-3, "ms"),
      range_text("power ", instrument.transmit_power_w, 1.0, "W"), range_text("gain ", instrument.gain_db, 1.0, "dB"),
      range_text(fans ? "-3 dB width vertical " : "-3 dB width alongship ", instrument.width_alongship_deg, 1.0, "deg"),
      range_text(fans ? "horizontal " : "athwartship ", instrument.width_athwartship_deg, 1.0, "deg"));
}

Json observation_json(const SurveyInfo::Observation& observation, bool counted) {
  Json grid = nullptr;
  Json psi = nullptr;
  if (observation.grid) {
    grid = {{"fans", observation.grid->fans()}, {"beams", observation.grid->beams()}};
    psi = psi_json(*observation.grid);
  }
  return {{"name", observation.name},
          {"files", observation.files},
          {"sounder", observation.sounder},
          {"instrument", instrument_json(observation.instrument, observation.grid.has_value())},
          {"pings", counted ? Json(observation.pings) : Json(nullptr)},
          {"first_time_utc", iso_time(observation.first_time)},
          {"last_time_utc", iso_time(observation.last_time)},
          {"grid", std::move(grid)},
          {"psi", std::move(psi)},
          {"continues_cut", observation.continues_cut},
          {"talkers", observation.talkers},
          {"notes", notes_json(observation.notes)}};
}

std::string talkers_text(const Talkers& talkers) {
  std::string text;
  for (const auto& [quantity, talker] : talkers) text += fmt::format(" {} {}", quantity, talker);
  return text;
}

std::string notes_text(const Diagnostics& notes) {
  std::string text;
  for (const Diagnostic& note : notes) {
    const std::string place = note.offset >= 0 ? fmt::format("byte {}: ", note.offset) : std::string();
    text += fmt::format("  note {}: {}{}\n", name(note.code), place, printable(note.text));
  }
  return text;
}

std::string file_text(const FileInfo& file, bool counted) {
  std::string text = fmt::format("{}\n  {}{}{}, {} bytes\n", printable(file.path), file.format,
                                 file.sounder.empty() ? "" : ", ", printable(file.sounder), file.size);
  if (counted && !file.datagrams.empty()) {
    text += "  datagrams:";
    for (const auto& [type, count] : file.datagrams) text += fmt::format(" {} {}", printable(type), count);
    text += '\n';
  }
  if (counted && file.pings > 0) {
    text +=
        fmt::format("  {}, {}, {} to {} samples\n", count_of(static_cast<std::size_t>(file.pings), "ping"),
                    count_of(static_cast<std::size_t>(file.channels), "channel"), file.min_samples, file.max_samples);
  }
  if (file.first_time) text += fmt::format("  {} to {}\n", iso_time(*file.first_time), iso_time(*file.last_time));
  for (const auto& [which, position] : {std::pair("first", file.first_position), {"last", file.last_position}}) {
    if (!position) continue;
    text += fmt::format("  {} position {:.6f}, {:.6f}\n", which, position->latitude_deg, position->longitude_deg);
  }
  if (!file.talkers.empty()) text += fmt::format("  talkers:{}\n", talkers_text(file.talkers));
  if (!std::isnan(file.gps_minus_clock_s)) {
    text += fmt::format("  GPS minus clock {:.3f} s\n", file.gps_minus_clock_s);
  }
  if (file.power_count_sum) text += fmt::format("  sum of power counts {}\n", *file.power_count_sum);
  return text + notes_text(file.notes);
}

std::string observation_text(const SurveyInfo::Observation& o, bool counted) {
  const std::string grid =
      o.grid ? fmt::format("{} fans x {} beams", o.grid->fans(), o.grid->beams()) : std::string("no grid");
  std::string text =
      fmt::format("{}: {}, {}{}, {} to {}{}\n", printable(o.name), printable(o.instrument.model_and_name),
                  counted ? count_of(static_cast<std::size_t>(o.pings), "ping") + ", " : std::string{}, grid,
                  iso_time(o.first_time), iso_time(o.last_time), o.continues_cut ? ", goes on the one before" : "");
  text += instrument_text(o.instrument, o.grid.has_value());
  text += o.grid ? psi_text(*o.grid) : std::string("  schools are not looked for in single-beam data\n");
  for (const std::string& file : o.files) text += fmt::format("  {}\n", printable(file));
  return text + notes_text(o.notes);
}

}  // namespace

std::string info_json(const SurveyInfo& info) {
  Json json{{"files", Json::array()}, {"observations", Json::array()}};
  for (const FileInfo& file : info.files) json["files"].push_back(file_json(file, !info.from_ends));
  for (const auto& observation : info.observations) {
    json["observations"].push_back(observation_json(observation, !info.from_ends));
  }
  // Names of files need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string info_text(const SurveyInfo& info) {
  std::string text;
  for (const FileInfo& file : info.files) text += file_text(file, !info.from_ends);
  for (const auto& observation : info.observations) text += observation_text(observation, !info.from_ends);
  return text;
}

}  // namespace sonar
