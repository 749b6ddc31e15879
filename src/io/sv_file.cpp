// SPDX-License-Identifier: Apache-2.0
#include "io/sv_file.h"

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "base/units.h"
#include "io/atomic_file.h"
#include "io/cf_attributes.h"
#include "io/netcdf_file.h"

namespace sonar {
namespace {

using netcdf::Dimension;
using netcdf::Storage;
using netcdf::Writer;

constexpr std::string_view kFlagMeanings =
    "near_field surface corrupted_packets dropout interference impulse_noise seabed low_snr";
constexpr std::string_view kCell = "range elevation azimuth";
constexpr std::string_view kWhere = "ping_time range elevation azimuth";

template <class Member>
auto per_ping(std::span<const PingNavigation> pings, Member PingNavigation::*member) {
  std::vector<Member> values;
  for (const PingNavigation& ping : pings) values.push_back(ping.*member);
  return values;
}

}  // namespace

struct SvFile::State {
  State(const std::filesystem::path& path, const ObservationProduct& observation, std::size_t first_ping,
        std::size_t pings)
      : target(path), product(observation), first(first_ping), out(path.string()) {
    const BeamGrid& grid = product.grid->grid;
    shape = {out.dimension(out.root(), "ping", pings), out.dimension(out.root(), "fan", grid.elevation_deg.size()),
             out.dimension(out.root(), "beam", grid.azimuth_deg.size()),
             out.dimension(out.root(), "sample", static_cast<std::size_t>(product.grid->range.count))};
    write_attributes();
    write_platform();
    write_environment();
    define_beams();
    for (const SchoolMask& mask : product.masks) {
      const auto ping = static_cast<std::size_t>(mask.ping_index);
      if (ping >= first && ping < first + pings) masks.push_back(&mask);
    }
  }

  [[nodiscard]] std::span<const PingNavigation> navigation() const {
    return std::span(product.pings).subspan(first, shape[0].length);
  }
  [[nodiscard]] std::size_t voxels() const { return shape[1].length * shape[2].length * shape[3].length; }

  void write_attributes() { cf::describe_file(out, product.title + ": Sv, flags and masks", product); }

  void write_platform() {
    const int group = out.group(out.root(), "Platform");
    cf::ping_times(out, group, shape[0], per_ping(navigation(), &PingNavigation::time));
    const auto put = [&](const char* name, const char* unit, const std::vector<double>& values,
                         std::string_view long_name, std::string_view standard_name = {}) {
      const int id = out.variable(group, name, unit, {shape[0]}, values, Storage::plain, &kUnknown);
      cf::name(out, group, id, long_name, standard_name);
      return id;
    };
    const auto placed = [&](const char* name, const char* unit, double PingNavigation::*member,
                            std::string_view long_name, std::string_view standard_name) {
      cf::place(out, group, put(name, unit, per_ping(navigation(), member), long_name, standard_name),
                "time latitude longitude");
    };
    std::vector<double> latitude;
    std::vector<double> longitude;
    for (const PingNavigation& ping : navigation()) {
      latitude.push_back(ping.transducer.latitude_deg);
      longitude.push_back(ping.transducer.longitude_deg);
    }
    using N = PingNavigation;
    put("latitude", "degrees_north", latitude, "latitude of the transducer, WGS 84", "latitude");
    put("longitude", "degrees_east", longitude, "longitude of the transducer, WGS 84", "longitude");
    placed("heading", "degrees", &N::heading_deg, "heading, clockwise from true north", "platform_orientation");
    placed("speed_ground", "m s-1", &N::speed_mps, "speed over ground", "platform_speed_wrt_ground");
    placed("pitch", "degrees", &N::pitch_deg, "pitch, positive with the bow up", "platform_pitch_fore_up");
    placed("roll", "degrees", &N::roll_deg, "roll, positive with the port side up", "platform_roll_starboard_down");
    placed("transducer_depth", "m", &N::transducer_depth_m, "depth of the transducer below the sea surface", "depth");
  }

  void write_environment() {
    const int group = out.group(out.root(), "Environment");
    cf::name(out, group,
             out.variable(group, "sound_speed", "m s-1", {}, std::vector<double>{product.grid->sound_speed_mps}),
             "speed of sound", "speed_of_sound_in_sea_water");
  }

  void define_beams() {
    beams = out.group(out.group(out.root(), "Sonar"), "Beam_group1");
    const GridRecord& record = *product.grid;
    cf::times(out, beams, "ping_time", "time of the ping, UTC", shape[0],
              per_ping(navigation(), &PingNavigation::time));
    const auto axis = [&](const char* name, const char* unit, const Dimension& along, const std::vector<double>& values,
                          std::string_view long_name, std::string_view standard_name = {}) {
      cf::name(out, beams, out.variable(beams, name, unit, {along}, values), long_name, standard_name);
    };
    axis("elevation", "degrees", shape[1], record.grid.elevation_deg, "elevation of the fan, positive up");
    axis("azimuth", "degrees", shape[2], record.grid.azimuth_deg, "azimuth of the beam, clockwise from the bow");
    axis("frequency", "Hz", shape[1], record.grid.frequency_hz, "centre frequency of the fan", "sound_frequency");
    std::vector<double> range_m;
    for (int i = 0; i < record.range.count; ++i) range_m.push_back(record.range.range_m(i));
    axis("range", "m", shape[3], range_m, "slant range of the sample from the transducer");
    write_volumes();
    sv = counts("Sv", "volume backscattering strength Sv, unfiltered");
    filtered = counts("Sv_filtered", "volume backscattering strength Sv, median-filtered, as schools were detected in");
    flags = out.sliced_variable<std::uint8_t>(beams, "flags", "1", shape);
    cf::name(out, beams, flags, "why a sample is not to be trusted");
    out.numbers(beams, flags, "flag_masks", std::vector<std::uint8_t>{1, 2, 4, 8, 16, 32, 64, 128});
    out.attribute(beams, flags, "flag_meanings", kFlagMeanings);
    school_id = out.sliced_variable<std::int32_t>(beams, "school_id", "1", shape);
    cf::name(out, beams, school_id, "school that the voxel belongs to; 0 = none");
    confidence = out.sliced_variable<std::uint8_t>(beams, "confidence", "1", shape);
    cf::name(out, beams, confidence, "how surely the voxel belongs to its school");
    out.attribute(beams, confidence, "scale_factor", 1.0 / 255.0);
    for (const int id : {sv, filtered, flags, school_id, confidence}) cf::place(out, beams, id, kWhere);
  }

  /// Variable of Sv counts; exact in doubles, whatever reads them.
  int counts(const char* name, std::string_view long_name) {
    const int id = out.sliced_variable<std::int16_t>(beams, name, "dB re 1 m-1", shape, &kNoData);
    out.attribute(beams, id, "scale_factor", kDbPerCount);
    cf::name(out, beams, id, long_name, cf::kVolumeBackscattering);
    return id;
  }

  void write_volumes() {
    const Sector sector = product.grid->grid.sector(product.grid->range);
    std::vector<double> volume;
    volume.reserve(voxels());
    for (int fan = 0; fan < sector.fans(); ++fan) {
      for (int beam = 0; beam < sector.beams(); ++beam) {
        const double solid_angle = sector.solid_angle_sr(fan, beam);
        for (int s = 0; s < sector.range().count; ++s) volume.push_back(solid_angle * sector.shell_m3_per_sr(s));
      }
    }
    const int id = out.variable(beams, "volume", "m3", {shape[1], shape[2], shape[3]}, volume, Storage::packed);
    cf::name(out, beams, id, "volume of the cell");
    cf::place(out, beams, id, kCell);
  }

  /// Number of the table from power to Sv among those that were met.
  std::int32_t setting_of(const std::shared_ptr<const Array3<std::int16_t>>& table) {
    const auto number = std::find(tables.begin(), tables.end(), table) - tables.begin();
    if (number == std::ssize(tables)) tables.push_back(table);
    return static_cast<std::int32_t>(number);
  }

  void write_background() {
    const Dimension setting = out.dimension(beams, "setting", tables.size());
    std::vector<std::int16_t> all;
    for (const auto& table : tables) all.insert(all.end(), table->all().begin(), table->all().end());
    const int id = out.variable(beams, "sv_minus_power", "dB", {setting, shape[1], shape[2], shape[3]}, all,
                                Storage::packed, &kNoData);
    out.attribute(beams, id, "scale_factor", kDbPerCount);
    cf::name(out, beams, id, "Sv minus received power: what the sonar equation adds, for each setting of the sounder");
    cf::place(out, beams, id, kCell);
    cf::name(out, beams, out.variable(beams, "setting_of_ping", "1", {shape[0]}, settings),
             "which setting the ping was made with");
    const double unknown = kUnknown;
    const int noise = out.variable(beams, "background_power", "dB re 1 W", {shape[0], shape[1], shape[2]}, background,
                                   Storage::packed, &unknown);
    cf::name(out, beams, noise, "received background noise power, which is subtracted for a school's figures");
    cf::place(out, beams, noise, "ping_time elevation azimuth");
  }

  std::filesystem::path target;
  const ObservationProduct& product;
  std::size_t first;
  Writer out;
  std::vector<Dimension> shape;
  int beams = -1;
  int sv = -1;
  int filtered = -1;
  int flags = -1;
  int school_id = -1;
  int confidence = -1;
  std::vector<const SchoolMask*> masks;
  std::vector<std::shared_ptr<const Array3<std::int16_t>>> tables;
  std::vector<std::int32_t> settings;
  std::vector<double> background;
};

SvFile::SvFile(const std::filesystem::path& path, const ObservationProduct& product, std::size_t first_ping,
               std::size_t pings)
    : state_(std::make_unique<State>(path, product, first_ping, pings)) {
  state_->settings.assign(pings, 0);
  state_->background.assign(pings * state_->shape[1].length * state_->shape[2].length, kUnknown);
}

SvFile::~SvFile() = default;

void SvFile::write(std::size_t ping, const SvPing& arrays) {
  State& s = *state_;
  const std::size_t at = ping - s.first;
  const auto copy = [&](const auto& view) { return std::vector<std::int16_t>(view.all().begin(), view.all().end()); };
  s.out.slice(s.beams, s.sv, at, s.shape, copy(arrays.sv));
  s.out.slice(s.beams, s.filtered, at, s.shape, copy(arrays.filtered));
  std::vector<std::uint8_t> bytes;
  bytes.reserve(s.voxels());
  for (const SampleFlags flags : arrays.flags.all()) bytes.push_back(static_cast<std::uint8_t>(flags));
  s.out.slice(s.beams, s.flags, at, s.shape, bytes);
  std::vector<std::int32_t> ids(s.voxels(), 0);
  std::fill(bytes.begin(), bytes.end(), std::uint8_t{0});
  for (const SchoolMask* mask : s.masks) {
    if (static_cast<std::size_t>(mask->ping_index) != ping) continue;
    std::size_t voxel = 0;
    for (const Run& run : mask->mask.runs) {
      std::size_t place =
          static_cast<std::size_t>(run.row) * s.shape[3].length + static_cast<std::size_t>(run.first_sample);
      for (std::int32_t i = 0; i < run.count; ++i, ++place) {
        ids[place] = static_cast<std::int32_t>(mask->school_id);
        bytes[place] = mask->mask.confidence[voxel++];
      }
    }
  }
  s.out.slice(s.beams, s.school_id, at, s.shape, ids);
  s.out.slice(s.beams, s.confidence, at, s.shape, bytes);
  s.settings[at] = s.setting_of(arrays.calibration);
  const std::size_t rows = s.shape[1].length * s.shape[2].length;
  for (std::size_t row = 0; row < std::min(rows, arrays.background_db.size()); ++row) {
    s.background[at * rows + row] = arrays.background_db[row];
  }
}

Result<void> SvFile::finish() {
  state_->write_background();
  auto file = AtomicFile::create(state_->target);
  if (!file) return pass_on(file);
  if (auto closed = state_->out.close_into(*file); !closed) return pass_on(closed);
  return file->commit();
}

}  // namespace sonar
