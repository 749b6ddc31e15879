// SPDX-License-Identifier: Apache-2.0
#include "io/raw_file_writer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

namespace sonar {
namespace {

template <class T>
T at(const RawBytes& bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

std::string text_at(const RawBytes& bytes, std::size_t offset, std::size_t count) {
  std::string text(count, ' ');
  std::memcpy(text.data(), bytes.data() + offset, count);
  return text;
}

// 1970-01-01 is 11644473600 s after 1601-01-01; ticks are 100 ns.
constexpr TimeNs kTime = 1'258'099'909'000'000'000;
constexpr std::uint64_t kTicks = (1'258'099'909ULL + 11'644'473'600ULL) * 10'000'000ULL;

TEST(RawWriter, FramesADatagramBetweenTwoLengthsThatCountFromTheTypeOn) {
  RawBytes out;
  const RawBytes body(5, std::byte{7});
  ASSERT_TRUE(append_datagram(out, kTime, "TAG0", body));
  ASSERT_EQ(out.size(), 4U + 12U + 5U + 4U);
  EXPECT_EQ(at<std::int32_t>(out, 0), 17);
  EXPECT_EQ(text_at(out, 4, 4), "TAG0");
  EXPECT_EQ(at<std::uint32_t>(out, 8), static_cast<std::uint32_t>(kTicks));
  EXPECT_EQ(at<std::uint32_t>(out, 12), static_cast<std::uint32_t>(kTicks >> 32U));
  EXPECT_EQ(at<std::int32_t>(out, 21), 17);
  EXPECT_FALSE(append_datagram(out, kTime, "TAG", body));
}

TEST(RawWriter, Raw0StandsAsTheFormatSays) {
  const std::vector<std::int16_t> counts = {-12345, 0, 321};
  ChannelPing p;
  p.channel = 41;
  p.transducer_depth_m = 1.5;
  p.frequency_hz = 99975;
  p.transmit_power_w = 36.09;
  p.pulse_length_s = 0.002048;
  p.bandwidth_hz = 488;
  p.sample_interval_s = 0.000512;
  p.sound_speed_mps = 1474.99;
  p.absorption_db_per_m = 0.032779;
  p.heave_m = 0.25;
  p.roll_deg = -1;
  p.pitch_deg = 2;
  p.temperature_c = 8;
  p.heading_deg = 96.3;
  p.offset = 17;
  p.power_count = counts;
  RawBytes out;
  ASSERT_TRUE(append_raw0(out, kTime, p));
  ASSERT_EQ(out.size(), 4U + 12U + 72U + 6U + 4U);
  constexpr std::size_t kBody = 16;
  EXPECT_EQ(at<std::int16_t>(out, kBody + 0), 42);  // 1-based
  EXPECT_EQ(at<std::int16_t>(out, kBody + 2), 1);   // power only
  EXPECT_EQ(at<float>(out, kBody + 4), 1.5F);
  EXPECT_EQ(at<float>(out, kBody + 8), 99975.0F);
  EXPECT_EQ(at<float>(out, kBody + 12), 36.09F);
  EXPECT_EQ(at<float>(out, kBody + 16), 0.002048F);
  EXPECT_EQ(at<float>(out, kBody + 20), 488.0F);
  EXPECT_EQ(at<float>(out, kBody + 24), 0.000512F);
  EXPECT_EQ(at<float>(out, kBody + 28), 1474.99F);
  EXPECT_EQ(at<float>(out, kBody + 32), 0.032779F);
  EXPECT_EQ(at<float>(out, kBody + 36), 0.25F);
  EXPECT_EQ(at<float>(out, kBody + 40), -1.0F);
  EXPECT_EQ(at<float>(out, kBody + 44), 2.0F);
  EXPECT_EQ(at<float>(out, kBody + 48), 8.0F);
  EXPECT_EQ(at<float>(out, kBody + 52), 96.3F);
  EXPECT_EQ(at<std::int16_t>(out, kBody + 56), 0);
  EXPECT_EQ(at<std::int32_t>(out, kBody + 64), 17);
  EXPECT_EQ(at<std::int32_t>(out, kBody + 68), 3);
  EXPECT_EQ(at<std::int16_t>(out, kBody + 72), -12345);
  EXPECT_EQ(at<std::int16_t>(out, kBody + 76), 321);
  EXPECT_EQ(at<std::int32_t>(out, kBody + 78), 12 + 72 + 6);
  p.channel = -1;
  EXPECT_FALSE(append_raw0(out, kTime, p));
}

TEST(RawWriter, Con0Is516BytesAnd320ABeam) {
  SounderConfig config;
  config.survey_name = "SYNTHETIC";
  config.sounder_name = "MBS";
  config.version = "synthetic";
  config.sound_speed_average_mps = 1470;
  config.gps_offset_m = {1, 2, 3};
  config.beams.resize(2);
  BeamConfig& b = config.beams[1];
  b.channel_id = "second";
  b.frequency_hz = 75925;
  b.gain_db = 20.96;
  b.equivalent_beam_angle_db = -22.67;
  b.width_alongship_deg = 7.235;
  b.width_athwartship_deg = 3.963;
  b.direction_deg = {-45, 30, 0};
  b.pulse_length_s[0] = 0.002048;
  b.gain_table_db[0] = 19;
  b.sa_correction_table_db[0] = -1.5;
  RawBytes out;
  append_con0(out, kTime, config);
  ASSERT_EQ(out.size(), 8U + 12U + 516U + 2U * 320U);
  constexpr std::size_t kBody = 16;
  EXPECT_EQ(text_at(out, kBody, 10), std::string("SYNTHETIC\0", 10));
  EXPECT_EQ(text_at(out, kBody + 256, 4), std::string("MBS\0", 4));
  EXPECT_EQ(text_at(out, kBody + 384, 9), "synthetic");
  EXPECT_EQ(at<float>(out, kBody + 420), 1470.0F);
  EXPECT_EQ(at<float>(out, kBody + 460), 3.0F);
  EXPECT_EQ(at<std::int32_t>(out, kBody + 512), 2);
  constexpr std::size_t kBeam = kBody + 516 + 320;
  EXPECT_EQ(text_at(out, kBeam, 6), "second");
  EXPECT_EQ(at<float>(out, kBeam + 132), 75925.0F);
  EXPECT_EQ(at<float>(out, kBeam + 136), 20.96F);
  EXPECT_EQ(at<float>(out, kBeam + 140), -22.67F);
  EXPECT_EQ(at<float>(out, kBeam + 144), 7.235F);
  EXPECT_EQ(at<float>(out, kBeam + 148), 3.963F);
  EXPECT_EQ(at<float>(out, kBeam + 180), -45.0F);
  EXPECT_EQ(at<float>(out, kBeam + 184), 30.0F);
  EXPECT_EQ(at<float>(out, kBeam + 192), 0.002048F);
  EXPECT_EQ(at<float>(out, kBeam + 220), 19.0F);
  EXPECT_EQ(at<float>(out, kBeam + 248), -1.5F);
}

TEST(RawWriter, TextDatagramsArePaddedToFours) {
  RawBytes out;
  append_nme0(out, kTime, nmea_sentence("GPHDT,123.4,T"));
  ASSERT_EQ(out.size(), 8U + 12U + 20U);
  // XOR of "GPHDT,123.4,T", worked out with another program.
  EXPECT_EQ(text_at(out, 16, 17), "$GPHDT,123.4,T*31");
  EXPECT_EQ(at<std::int32_t>(out, 0), 32);
}

TEST(RawWriter, Con1ListsEveryBeam) {
  SounderConfig config;
  config.beams.resize(2);
  config.beams[0].direction_deg = {-45, -30, 0};
  config.beams[1].direction_deg = {-42.5, 2.5, 0};
  config.beams[0].frequency_hz = 111075;
  config.beams[1].frequency_hz = 109225;
  const std::string xml = con1_xml(config);
  EXPECT_NE(xml.find("SteeringRxX=\"-45;-42.5\""), std::string::npos);
  EXPECT_NE(xml.find("SteeringRxY=\"-30;2.5\""), std::string::npos);
  EXPECT_NE(xml.find("FrequencyRx=\"111075;109225\""), std::string::npos);
}

TEST(RawWriter, AFileAppearsUnderItsNameOnlyWhenItIsWhole) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "raw_writer";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto path = folder / "a.raw";
  RawBytes bytes;
  append_nme0(bytes, kTime, "$GPHDT,1,T");
  {
    auto file = RawFileWriter::create(path);
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write(bytes));
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));  // given up: nothing stays
  auto file = RawFileWriter::create(path);
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->write(bytes));
  ASSERT_TRUE(file->write(bytes));
  EXPECT_EQ(file->size(), 2 * bytes.size());
  ASSERT_TRUE(file->finish());
  EXPECT_EQ(std::filesystem::file_size(path), 2 * bytes.size());
  EXPECT_EQ(RawFileWriter::create(path).error().code, ErrorCode::usage);  // what is recorded is never written over
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace sonar
