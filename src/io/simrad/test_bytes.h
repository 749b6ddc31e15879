// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests only: raw files byte by byte, out of the tables of the format, sharing nothing with the readers.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/test_paths.h"
#include "base/time.h"

namespace sonar::test {

/// 2020-01-01T00:00:00Z
inline constexpr TimeNs kStart = 1'577'836'800 * kSecondNs;

class Bytes {
 public:
  template <class T>
  Bytes& put(T value) {
    const auto* p = reinterpret_cast<const std::byte*>(&value);
    data.insert(data.end(), p, p + sizeof(T));
    return *this;
  }
  Bytes& text(std::string_view s, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) put(i < s.size() ? s[i] : '\0');
    return *this;
  }
  Bytes& zeros(std::size_t size) { return text("", size); }
  Bytes& add(const Bytes& other) {
    data.insert(data.end(), other.data.begin(), other.data.end());
    return *this;
  }
  template <class T>
  void patch(std::size_t offset, T value) {
    std::memcpy(data.data() + offset, &value, sizeof(T));
  }
  [[nodiscard]] std::size_t size() const { return data.size(); }

  std::vector<std::byte> data;
};

inline Bytes datagram(std::string_view type, TimeNs time, const Bytes& body) {
  const auto length = static_cast<std::int32_t>(body.size() + 12);
  const std::uint64_t filetime = static_cast<std::uint64_t>(time) / 100 + 116'444'736'000'000'000ULL;
  Bytes bytes;
  return bytes.put(length).text(type, 4).put(filetime).add(body).put(length);
}

struct BeamSpec {
  float frequency_hz = 100'000.0F;
  float dir_x_deg = 0.0F;
  float dir_y_deg = 0.0F;
  float gain_db = 20.0F;
  float psi_db = -23.0F;  ///< of widths of 7 x 3 degrees, and a transmit beam that is a little wider
};

struct Con0Spec {
  std::string sounder = "MBS";
  std::vector<BeamSpec> beams;
  float gps_x_m = 0.0F;
  float gps_y_m = 0.0F;
  std::int32_t stated_beams = -1;  ///< -1 = as many as there are
};

inline Bytes con0(const Con0Spec& spec, TimeNs time = kStart) {
  Bytes b;
  b.text("survey", 128).text("transect", 128).text(spec.sounder, 128).text("2.4.3", 30).zeros(6);
  b.put(1500.0F).put(1490.0F).zeros(24).put(spec.gps_x_m).put(spec.gps_y_m).put(0.0F).zeros(48);
  b.put(spec.stated_beams >= 0 ? spec.stated_beams : static_cast<std::int32_t>(spec.beams.size()));
  for (const BeamSpec& beam : spec.beams) {
    b.text("a beam", 128).put(std::int32_t{1}).put(beam.frequency_hz).put(beam.gain_db).put(beam.psi_db);
    b.put(7.0F).put(3.0F).zeros(28).put(beam.dir_x_deg).put(beam.dir_y_deg).put(0.0F);
    b.put(0.002F).zeros(24).put(beam.gain_db).zeros(24).put(-1.5F).zeros(68);
  }
  return datagram("CON0", time, b);
}

struct Raw0Spec {
  int channel = 1;  ///< as in the file, 1-based
  int mode = 1;
  float transducer_depth_m = 0.0F;
  float frequency_hz = 100'000.0F;
  float power_w = 30.0F;
  float pulse_s = 0.002F;
  float interval_s = 0.0005F;
  float sound_speed_mps = 1500.0F;
  float absorption_db_per_m = 0.03F;
  float heave_m = 0.0F;
  float roll_deg = 0.0F;
  float pitch_deg = 0.0F;
  float heading_deg = 0.0F;
  int transmit_mode = 0;
  std::int32_t offset = 0;
  std::int32_t stated_count = -1;  ///< -1 = as many as there are
};

inline Bytes raw0(TimeNs time, const Raw0Spec& spec, const std::vector<std::int16_t>& power) {
  Bytes b;
  b.put(static_cast<std::int16_t>(spec.channel)).put(static_cast<std::int16_t>(spec.mode));
  b.put(spec.transducer_depth_m).put(spec.frequency_hz).put(spec.power_w).put(spec.pulse_s).put(1000.0F);
  b.put(spec.interval_s)
      .put(spec.sound_speed_mps)
      .put(spec.absorption_db_per_m)
      .put(spec.heave_m)
      .put(spec.roll_deg)
      .put(spec.pitch_deg);
  b.put(8.0F).put(spec.heading_deg).put(static_cast<std::int16_t>(spec.transmit_mode)).zeros(6).put(spec.offset);
  b.put(spec.stated_count >= 0 ? spec.stated_count : static_cast<std::int32_t>(power.size()));
  if ((spec.mode & 1) != 0) {
    for (const std::int16_t count : power) b.put(count);
  }
  if ((spec.mode & 2) != 0) b.zeros(2 * power.size());
  return datagram("RAW0", time, b);
}

/// `sentence` without "$" and checksum.
inline std::string with_checksum(const std::string& sentence) {
  unsigned sum = 0;
  for (const char c : sentence) sum ^= static_cast<unsigned char>(c);
  constexpr std::string_view hex = "0123456789ABCDEF";
  return "$" + sentence + "*" + hex[sum / 16] + hex[sum % 16] + "\r\n";
}

inline Bytes nme0(TimeNs time, const std::string& text) {
  Bytes b;
  return datagram("NME0", time, b.text(text, (text.size() + 3) / 4 * 4));
}

/// 2 fans (-10, 0 degrees) x 3 beams (-2.5, 0, 2.5 degrees), channels in MS70 order.
inline Con0Spec small_ms70() {
  Con0Spec spec;
  for (const float elevation : {-10.0F, 0.0F}) {
    for (const float azimuth : {-2.5F, 0.0F, 2.5F}) spec.beams.push_back({100'000.0F, elevation, azimuth, 20.0F});
  }
  return spec;
}

/// All six channels of small_ms70, four samples each: channel * 10 + sample.
inline Bytes small_ping(TimeNs time, const Raw0Spec& base = {}) {
  Bytes bytes;
  for (int channel = 1; channel <= 6; ++channel) {
    Raw0Spec spec = base;
    spec.channel = channel;
    std::vector<std::int16_t> power;
    for (int s = 0; s < 4; ++s) power.push_back(static_cast<std::int16_t>(channel * 10 + s));
    bytes.add(raw0(time, spec, power));
  }
  return bytes;
}

/// A short, sound MS70 file: configuration, then pings one second apart with a fix and a heading before each.
inline Bytes small_file(int pings, TimeNs start = kStart, const Raw0Spec& base = {}) {
  Bytes bytes = con0(small_ms70(), start);
  for (int i = 0; i < pings; ++i) {
    const TimeNs time = start + i * kSecondNs;
    bytes.add(nme0(time - kSecondNs / 2, with_checksum("GPGGA,000000,6000.0000,N,00500.0000,E,1,8,1,0,M,0,M,,")));
    bytes.add(nme0(time - kSecondNs / 2, with_checksum("INHDT,90.0,T")));
    bytes.add(small_ping(time, base));
  }
  return bytes;
}

/// A folder that is gone again with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sonar-test-XXXXXX").string();
    path_ = ::mkdtemp(name.data()) != nullptr ? name : std::string();
  }
  ~TemporaryFolder() {
    std::error_code error;
    if (!path_.empty()) std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const Bytes& bytes) const {
    std::filesystem::path file = path_ / name;
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data.data()), static_cast<std::streamsize>(bytes.size()));
    return file;
  }

 private:
  std::filesystem::path path_;
};

/// Folder of real recorded files; empty where there is none.
inline std::filesystem::path data_folder() {
  const std::filesystem::path folder = recorded_data();
  std::error_code error;
  return std::filesystem::is_directory(folder, error) ? folder : std::filesystem::path();
}

}  // namespace sonar::test
