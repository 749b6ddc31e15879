// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "io/byte_archive.h"
#include "io/index_cache.h"

namespace sonar {

void fields(auto& io, Archived<NavSample> auto& s) {
  io(s.time);
  io(s.first);
  io(s.second);
  io(s.clock_run);
}

void fields(auto& io, Archived<NavSeries> auto& s) {
  io(s.quantity);
  io(s.talker);
  io(s.sentence);
  io(s.samples);
}

void fields(auto& io, Archived<Diagnostic> auto& d) {
  io(d.code);
  io(d.offset);
  io(d.ping_index);
  io(d.text);
}

void fields(auto& io, Archived<ChannelTransmit> auto& t) {
  io(t.frequency_hz);
  io(t.transmit_power_w);
  io(t.pulse_length_s);
  io(t.sample_interval_s);
  io(t.sound_speed_mps);
  io(t.absorption_db_per_m);
  io(t.max_samples);
}

void fields(auto& io, Archived<PingEntry> auto& p) {
  io(p.time);
  io(p.offset);
  io(p.end);
  io(p.roll_deg);
  io(p.pitch_deg);
  io(p.heave_m);
  io(p.heading_deg);
  io(p.transducer_depth_m);
  io(p.min_samples);
  io(p.max_samples);
  io(p.channels);
  io(p.silent_channels);
  io(p.odd_channels);
  io(p.clock_run);
  io(p.reduced);
  io(p.all_beams);
  io(p.config);
  io(p.transmit);
}

void fields(auto& io, Archived<BeamConfig> auto& b) {
  io(b.channel_id);
  io(b.beam_type);
  io(b.frequency_hz);
  io(b.gain_db);
  io(b.equivalent_beam_angle_db);
  io(b.width_alongship_deg);
  io(b.width_athwartship_deg);
  io(b.sensitivity_alongship);
  io(b.sensitivity_athwartship);
  io(b.offset_alongship_deg);
  io(b.offset_athwartship_deg);
  io(b.position_m);
  io(b.direction_deg);
  io(b.pulse_length_s);
  io(b.gain_table_db);
  io(b.sa_correction_table_db);
}

void fields(auto& io, Archived<SounderConfig> auto& c) {
  io(c.survey_name);
  io(c.transect_name);
  io(c.sounder_name);
  io(c.version);
  io(c.kind);
  io(c.sound_speed_average_mps);
  io(c.sound_speed_transducer_mps);
  io(c.mru_offset_m);
  io(c.mru_angles_deg);
  io(c.gps_offset_m);
  io(c.beams);
  io(c.con1_xml);
}

void fields(auto& io, Archived<RawIndex> auto& r) {
  io(r.size);
  io(r.hash);
  io(r.format);
  io(r.datagrams);
  io(r.first_datagram_time);
  io(r.last_datagram_time);
  io(r.configs);
  io(r.transmits);
  io(r.pings);
  io(r.navigation);
  io(r.diagnostics);
}

namespace {

constexpr std::string_view kMagic = "SONARIDX";

/// A checksum guards the bytes, so this is about programs that changed without raising the version.
bool makes_sense(const RawIndex& index) {
  if (index.format > RawFormat::unknown) return false;
  for (const PingEntry& ping : index.pings) {
    if (ping.config >= index.configs.size() || ping.transmit >= index.transmits.size()) return false;
  }
  for (const NavSeries& series : index.navigation) {
    if (series.quantity > NavQuantity::clock) return false;
  }
  for (const Diagnostic& note : index.diagnostics) {
    if (static_cast<std::size_t>(note.code) >= diagnostic_table().size()) return false;
  }
  return true;
}

template <class T>
std::vector<Hash128> hashes_of(const std::vector<SharedValue<T>>& values) {
  std::vector<Hash128> hashes;
  for (const SharedValue<T>& value : values) {
    ArchiveWriter bytes;
    bytes(*value);
    hashes.push_back(hash_bytes(bytes.take()));
  }
  return hashes;
}

}  // namespace

void SharedSettings::share(RawIndex& index) {
  const auto configs = hashes_of(index.configs);
  const auto transmits = hashes_of(index.transmits);
  const auto each = [](auto& known, auto& values, const std::vector<Hash128>& hashes) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = known.try_emplace({hashes[i].high, hashes[i].low}, values[i]).first->second;
    }
  };
  const std::scoped_lock lock(mutex_);
  each(configs_, index.configs, configs);
  each(transmits_, index.transmits, transmits);
}

std::vector<std::byte> encode_index(const RawIndex& index) {
  ArchiveWriter content;
  content(index);
  const std::vector<std::byte> body = content.take();
  ArchiveWriter out;
  for (const char c : kMagic) out(c);
  out(kIndexVersion);
  const Hash128 hash = hash_bytes(body);
  out(hash.high);
  out(hash.low);
  std::vector<std::byte> bytes = out.take();
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

std::optional<RawIndex> decode_index(std::span<const std::byte> bytes) {
  constexpr std::size_t kHeader = kMagic.size() + sizeof(kIndexVersion) + 16;
  if (bytes.size() < kHeader || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) return std::nullopt;
  ArchiveReader header(bytes.subspan(kMagic.size()));
  int version = 0;
  Hash128 hash;
  header(version);
  header(hash.high);
  header(hash.low);
  const auto body = bytes.subspan(kHeader);
  if (version != kIndexVersion || hash_bytes(body) != hash) return std::nullopt;
  ArchiveReader reader(body);
  RawIndex index;
  reader(index);
  if (!reader.sound_to_the_end() || !makes_sense(index)) return std::nullopt;
  return index;
}

}  // namespace sonar
