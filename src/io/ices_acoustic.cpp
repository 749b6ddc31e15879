// SPDX-License-Identifier: Apache-2.0
#include "io/ices_acoustic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/units.h"
#include "base/utf8.h"

namespace sonar {
namespace {

using Xml = pugi::xml_node;

constexpr const char* kNotKnown = "NaN";

/// Codes that the document uses: vocabulary in the document, list at ICES, code.
struct Code {
  const char* vocabulary;
  const char* list;
  const char* code;
};
constexpr Code kLocation{"TransducerLocation", "AC_TransducerLocation", "NA"};
constexpr Code kBeamType{"TransducerBeamType", "AC_TransducerBeamType", "M"};
constexpr Code kCalibrated{"AcquisitionMethod", "AC_AcquisitionMethod", "NA"};
constexpr Code kCalibration{"ProcessingMethod", "AC_ProcessingMethod", "NA"};
constexpr Code kStored{"StoredDataFormat", "AC_StoredDataFormat", "RAW"};
constexpr Code kProgram{"DataProcessingSoftwareName", "AC_DataProcessingSoftwareName", "SonarExplorer"};
constexpr Code kTriwave{"TriwaveCorrection", "AC_TriwaveCorrection", "NA"};
constexpr Code kGainUnit{"OnAxisGainUnit", "AC_OnAxisGainUnit", "dB"};
constexpr Code kSurvey{"Survey", "AC_Survey", "UNKNOWN"};
constexpr Code kCountry{"Country", "ISO_3166", "ZZ"};
constexpr Code kPlatform{"Platform", "SHIPC", "ZZ99"};
constexpr Code kAxisType{"PingAxisIntervalType", "AC_PingAxisIntervalType", "distance"};
constexpr Code kAxisUnit{"PingAxisIntervalUnit", "AC_PingAxisIntervalUnit", "nmi"};
constexpr Code kAxisOrigin{"PingAxisIntervalOrigin", "AC_PingAxisIntervalOrigin", "middle"};
constexpr Code kOrigin{"Origin", "AC_LogOrigin", "middle"};
constexpr Code kValidity{"LogValidity", "AC_LogValidity", "V"};
constexpr Code kSpecies{"SaCategory", "AC_SaCategory", "UNK"};
constexpr Code kType{"Type", "AC_AcousticDataType", "C"};
constexpr Code kUnit{"Unit", "AC_DataUnit", "m2nmi-2"};
constexpr std::array kCodes = {kLocation, kBeamType, kCalibrated, kCalibration, kStored,    kProgram,  kTriwave,
                               kGainUnit, kSurvey,   kCountry,    kPlatform,    kOrigin,    kValidity, kSpecies,
                               kType,     kUnit,     kAxisType,   kAxisUnit,    kAxisOrigin};

std::string id_of(const Code& code) { return fmt::format("{}_{}", code.list, code.code); }

void add(Xml parent, const char* name, const std::string& text) {
  parent.append_child(name).append_child(pugi::node_pcdata).set_value(clean_utf8(text).c_str());
}
void refer(Xml parent, const char* name, const std::string& id) {
  parent.append_child(name).append_attribute("IDREF") = id.c_str();
}
void refer(Xml parent, const char* name, const Code& code) { refer(parent, name, id_of(code)); }

Xml add_block(Xml parent, const char* name, const char* id) {
  Xml block = parent.append_child(name);
  block.append_attribute("ID") = id;
  return block;
}

/// Mean of levels as powers; NaN of none.
double mean_db(const std::vector<double>& levels) {
  double sum = 0.0;
  for (const double level : levels) sum += linear_from_db(level);
  return levels.empty() ? kUnknown : db_from_linear(sum / static_cast<double>(levels.size()));
}

std::string number_or_nan(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : kNotKnown; }

/// Centre of the fans' frequencies, kHz.
std::string frequency_text(const ObservationProduct& product) {
  if (!product.grid || product.grid->grid.frequency_hz.empty()) return kNotKnown;
  const auto [low, high] = std::ranges::minmax(product.grid->grid.frequency_hz);
  return number_or_nan((low + high) / 2000.0);
}

std::string day(TimeNs time) { return iso_time(time).substr(0, 10); }

void add_instrument(Xml root, const ObservationProduct& product, TimeNs first) {
  Xml instrument = add_block(root, "Instrument", "I1");
  add(instrument, "Frequency", frequency_text(product));
  refer(instrument, "TransducerLocation", kLocation);
  add(instrument, "TransducerModel", product.source);
  refer(instrument, "TransducerBeamType", kBeamType);
  if (!product.pings.empty()) {
    add(instrument, "TransducerDepth", number_or_nan(product.pings.front().transducer_depth_m));
  }
  const double azimuth = product.grid ? product.grid->grid.mounting_azimuth_deg : kUnknown;
  add(instrument, "TransducerOrientation",
      fmt::format("azimuth {} degrees clockwise from the bow", number_or_nan(azimuth)));
  Xml calibration = add_block(root, "Calibration", "C1");
  add(calibration, "Date", day(first));
  refer(calibration, "AcquisitionMethod", kCalibrated);
  refer(calibration, "ProcessingMethod", kCalibration);
  add(calibration, "AccuracyEstimate", "not known");
  add(calibration, "Comments", "Date is the first day of the data; that of the calibration is not known.");
}

void add_processing(Xml root, const ObservationProduct& product) {
  Xml acquisition = add_block(root, "DataAcquisition", "DA1");
  refer(acquisition, "StoredDataFormat", kStored);
  add(acquisition, "PingDutyCycle", "not known");
  Xml processing = add_block(root, "DataProcessing", "DP1");
  refer(processing, "SoftwareName", kProgram);
  add(processing, "SoftwareVersion", product.program_version.empty() ? "unknown" : product.program_version);
  refer(processing, "TriwaveCorrection", kTriwave);
  add(processing, "Frequency", frequency_text(product));
  for (const char* unknown : {"TransceiverPower", "TransmitPulseLength", "OnAxisGain"})
    add(processing, unknown, kNotKnown);
  refer(processing, "OnAxisGainUnit", kGainUnit);
  if (product.grid) add(processing, "SoundSpeed", number_or_nan(product.grid->sound_speed_mps));
  add(processing, "TransducerPSI", number_or_nan(product.grid ? mean_db(product.grid->psi_used_db) : kUnknown));
  add(processing, "Comments",
      "Frequency is the middle of the fans'; TransducerPSI the mean of all beams. Recipe " + product.recipe_hash + ".");
}

void add_vocabulary(Xml root) {
  Xml vocabulary = root.append_child("Vocabulary");
  for (const Code& code : kCodes) {
    Xml one = vocabulary.append_child(code.vocabulary).append_child("Code");
    one.append_attribute("ID") = id_of(code).c_str();
    one.append_attribute("CodeType") =
        fmt::format("https://acoustic.ices.dk/Services/Schema/XML/{}.xml", code.list).c_str();
    one.append_child(pugi::node_pcdata).set_value(code.code);
  }
}

/// A depth channel of an EDSU over all its range bins.
struct Channel {
  double to_m = 0.0;
  double volume_m3 = 0.0;
  double height_m = 0.0;     ///< that the sector reaches, at the range where it reaches most
  double nasc_volume = 0.0;  ///< sum of NASC / height times volume: a mean s_v on the way up
};
using Channels = std::map<double, Channel>;  ///< by their tops

/// By transect and EDSU.
std::map<std::pair<std::string_view, std::int64_t>, Channels> channels_of(std::span<const NascRow> nasc,
                                                                          IcesPart part) {
  std::map<std::pair<std::string_view, std::int64_t>, Channels> units;
  for (const NascRow& row : nasc) {
    const double value = part == IcesPart::all ? row.nasc_m2_nmi2 : row.nasc_school_m2_nmi2;
    const bool told = std::isfinite(value) && std::isfinite(row.depth_from_m);
    if (!told || !(row.volume_m3 > 0.0) || !(row.height_m > 0.0)) continue;
    Channel& channel = units[{row.transect, row.edsu}][row.depth_from_m];
    channel.to_m = row.depth_to_m;
    channel.volume_m3 += row.volume_m3;
    channel.height_m = std::max(channel.height_m, row.height_m);
    channel.nasc_volume += value / row.height_m * row.volume_m3;
  }
  return units;
}

void add_sample(Xml log, double from_m, const Channel& channel, double distance_nmi) {
  Xml sample = log.append_child("Sample");
  add(sample, "ChannelDepthUpper", shortest(from_m));
  add(sample, "ChannelDepthLower", shortest(channel.to_m));
  add(sample, "PingAxisInterval", number_or_nan(distance_nmi));
  refer(sample, "PingAxisIntervalType", kAxisType);
  refer(sample, "PingAxisIntervalUnit", kAxisUnit);
  add(sample, "SvThreshold", "-999");
  refer(sample, "Instrument", "I1");
  refer(sample, "Calibration", "C1");
  refer(sample, "DataAcquisition", "DA1");
  refer(sample, "DataProcessing", "DP1");
  refer(sample, "PingAxisIntervalOrigin", kAxisOrigin);
  Xml data = sample.append_child("Data");
  refer(data, "SaCategory", kSpecies);
  refer(data, "Type", kType);
  refer(data, "Unit", kUnit);
  add(data, "Value", number_or_nan(channel.height_m * channel.nasc_volume / channel.volume_m3));
}

void add_cruise(Xml root, const ObservationProduct& product, std::span<const EffortRow> effort,
                std::span<const NascRow> nasc, IcesPart part) {
  Xml cruise = root.append_child("Cruise");
  refer(cruise.append_child("Survey"), "Code", kSurvey);
  refer(cruise, "Country", kCountry);
  refer(cruise, "Platform", kPlatform);
  add(cruise, "StartDate", day(effort.front().first_time_utc));
  add(cruise, "EndDate", day(effort.back().last_time_utc));
  add(cruise, "LocalID", product.title);
  const auto units = channels_of(nasc, part);
  double sailed_nmi = 0.0;
  for (const EffortRow& unit : effort) {
    const double middle_nmi = sailed_nmi + unit.distance_nmi / 2.0;
    sailed_nmi += unit.distance_nmi;
    if (unit.edsu == 0 || !std::isfinite(unit.latitude)) continue;
    Xml log = cruise.append_child("Log");
    add(log, "Distance", number_or_nan(middle_nmi));
    const TimeNs middle = unit.first_time_utc + (unit.last_time_utc - unit.first_time_utc) / 2;
    add(log, "Time", iso_time(middle).substr(0, 19));
    add(log, "Latitude", degrees_text(unit.latitude));
    add(log, "Longitude", degrees_text(unit.longitude));
    refer(log, "Origin", kOrigin);
    refer(log, "Validity", kValidity);
    const auto channels = units.find({unit.transect, unit.edsu});
    if (channels == units.end()) continue;
    for (const auto& [from_m, channel] : channels->second) add_sample(log, from_m, channel, unit.distance_nmi);
  }
}

}  // namespace

std::string ices_acoustic_xml(const ObservationProduct& product, std::span<const EffortRow> effort,
                              std::span<const NascRow> nasc, IcesPart part) {
  if (effort.empty()) return {};
  pugi::xml_document document;
  Xml declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "utf-8";
  document.append_child(pugi::node_comment)
      .set_value(
          " To be filled in: Survey, Country, Platform, TransducerLocation, Calibration, TransceiverPower, "
          "TransmitPulseLength, OnAxisGain, PingDutyCycle. No threshold was applied: SvThreshold is -999. ");
  Xml root = document.append_child("Acoustic");
  add_instrument(root, product, effort.front().first_time_utc);
  add_processing(root, product);
  add_vocabulary(root);
  add_cruise(root, product, effort, nasc, part);
  std::ostringstream out;
  document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
  return out.str();
}

}  // namespace sonar
