// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "io/simrad/con0.h"
#include "io/simrad/con1.h"
#include "io/simrad/raw0.h"
#include "io/simrad/test_bytes.h"

namespace sonar::simrad {
namespace {

std::span<const std::byte> body_of(const test::Bytes& datagram) {
  return std::span(datagram.data).subspan(16, datagram.size() - 20);
}

TEST(Con0, FieldsAreWhereTheTableSays) {
  test::Con0Spec spec = test::small_ms70();
  spec.gps_x_m = 12.5F;
  const Con0 con0 = parse_con0(body_of(test::con0(spec)));
  EXPECT_EQ(con0.problem, "");
  EXPECT_EQ(con0.config.survey_name, "survey");
  EXPECT_EQ(con0.config.transect_name, "transect");
  EXPECT_EQ(con0.config.sounder_name, "MBS");
  EXPECT_EQ(con0.config.version, "2.4.3");
  EXPECT_EQ(con0.config.kind, SounderKind::ms70);
  EXPECT_EQ(con0.config.sound_speed_average_mps, 1500.0);
  EXPECT_EQ(con0.config.sound_speed_transducer_mps, 1490.0);
  EXPECT_EQ(con0.config.gps_offset_m[0], 12.5);
  ASSERT_EQ(con0.config.beams.size(), 6U);
  const BeamConfig& beam = con0.config.beams[5];
  EXPECT_EQ(beam.channel_id, "a beam");
  EXPECT_EQ(beam.beam_type, 1);
  EXPECT_EQ(beam.frequency_hz, 100'000.0);
  EXPECT_EQ(beam.equivalent_beam_angle_db, -23.0);
  EXPECT_EQ(beam.width_alongship_deg, 7.0);
  EXPECT_EQ(beam.width_athwartship_deg, 3.0);
  EXPECT_EQ(beam.direction_deg, (std::array<double, 3>{0.0, 2.5, 0.0}));
  EXPECT_NEAR(beam.pulse_length_s[0], 0.002, 1e-9);
  EXPECT_EQ(beam.gain_table_db[0], 20.0);
  EXPECT_EQ(beam.sa_correction_table_db[0], -1.5);
}

TEST(Con0, SounderNames) {
  EXPECT_EQ(kind_of("ER60"), SounderKind::ek60);
  EXPECT_EQ(kind_of("ES70"), SounderKind::ek60);
  EXPECT_EQ(kind_of("MBES"), SounderKind::me70);
  EXPECT_EQ(kind_of("MBS"), SounderKind::ms70);
  EXPECT_EQ(kind_of("Simrad MS70"), SounderKind::ms70);
  EXPECT_EQ(kind_of("SX90"), SounderKind::omni);
  EXPECT_EQ(kind_of("something"), SounderKind::unknown);
}

TEST(Con0, WholeBlocksAreKeptOfAShortBody) {
  test::Con0Spec spec = test::small_ms70();
  spec.stated_beams = 2'000'000'000;
  const Con0 many = parse_con0(body_of(test::con0(spec)));
  EXPECT_NE(many.problem, "");
  EXPECT_EQ(many.config.beams.size(), 6U);
  const test::Bytes bytes = test::con0(test::small_ms70());
  const Con0 cut = parse_con0(body_of(bytes).first(516 + 320 * 2 + 319));
  EXPECT_NE(cut.problem, "");
  EXPECT_EQ(cut.config.beams.size(), 2U);
  EXPECT_NE(parse_con0(body_of(bytes).first(515)).problem, "");
}

TEST(Con0, NumbersThatAreNotFiniteBecomeUnknown) {
  test::Con0Spec spec = test::small_ms70();
  spec.beams[1].gain_db = std::numeric_limits<float>::infinity();
  const Con0 con0 = parse_con0(body_of(test::con0(spec)));
  EXPECT_TRUE(std::isnan(con0.config.beams[1].gain_db));
  EXPECT_NE(con0.bad_numbers, "");
}

SounderConfig three_beams() {
  SounderConfig config;
  config.beams.resize(3);
  return config;
}

TEST(Con1, ListsAsAttributes) {
  SounderConfig config = three_beams();
  const Con1 con1 = parse_con1(
      R"(<?xml version="1.0" encoding="ISO-8859-1"?><Configuration><x><BeamArrays SteeringRxX="-1;-2.5;+3;" )"
      R"(SteeringRxY="0; 1e1 ;0.05" FrequencyTx="1;2;3"/></x></Configuration>)");
  const Con1Outcome outcome = apply_con1(con1, config);
  EXPECT_TRUE(outcome.used);
  EXPECT_EQ(outcome.problem, "");
  EXPECT_EQ(outcome.largest_change, 10.0);
  EXPECT_EQ(config.beams[1].direction_deg, (std::array<double, 3>{-2.5, 10.0, 0.0}));
  EXPECT_EQ(con1.frequency_tx, (std::vector<double>{1, 2, 3}));
}

TEST(Con1, ListsAsParameters) {
  SounderConfig config = three_beams();
  const auto outcome =
      apply_con1(parse_con1(R"(<Configuration><BeamArrays><parameter name="SteeringRxX" value="1;2;3"/>)"
                            R"(<parameter name="SteeringRxY" value="4;5;6"/></BeamArrays></Configuration>)"),
                 config);
  EXPECT_TRUE(outcome.used);
  EXPECT_EQ(config.beams[2].direction_deg, (std::array<double, 3>{3.0, 6.0, 0.0}));
}

TEST(Con1, AnglesOfCon0StayWhereTheListsAreNotRight) {
  for (const char* xml :
       {"", "no xml", "<Configuration/>", R"(<C><BeamArrays SteeringRxX="1;2" SteeringRxY="1;2;3"/></C>)",
        R"(<C><BeamArrays SteeringRxX="1;x;3" SteeringRxY="1;2;3"/></C>)",
        R"(<C><BeamArrays SteeringRxX="1;inf;3" SteeringRxY="1;2;3"/></C>)",
        R"(<C><BeamArrays SteeringRxX="1;;3" SteeringRxY="1;2;3"/></C>)"}) {
    SounderConfig config = three_beams();
    const auto outcome = apply_con1(parse_con1(xml), config);
    EXPECT_FALSE(outcome.used) << xml;
    EXPECT_NE(outcome.problem, "") << xml;
    EXPECT_EQ(config.beams[0].direction_deg[0], 0.0) << xml;
  }
}

TEST(Raw0, FieldsAreWhereTheTableSays) {
  test::Raw0Spec spec;
  spec.channel = 3;
  spec.mode = 3;
  spec.transducer_depth_m = 6.5F;
  spec.roll_deg = 1.0F;
  spec.pitch_deg = 2.0F;
  spec.heave_m = -0.5F;
  spec.heading_deg = 96.25F;
  spec.offset = 7;
  const auto bytes = test::raw0(test::kStart, spec, {-1, 5, 32767});
  const Raw0 raw = parse_raw0(body_of(bytes));
  ASSERT_EQ(raw.problem, nullptr);
  EXPECT_EQ(raw.head.channel, 2);
  EXPECT_EQ(raw.head.transducer_depth_m, 6.5);
  EXPECT_EQ(raw.head.transmit_power_w, 30.0);
  EXPECT_EQ(raw.head.sound_speed_mps, 1500.0);
  EXPECT_EQ(raw.head.roll_deg, 1.0);
  EXPECT_EQ(raw.head.pitch_deg, 2.0);
  EXPECT_EQ(raw.head.heave_m, -0.5);
  EXPECT_EQ(raw.head.heading_deg, 96.25);
  EXPECT_EQ(raw.head.temperature_c, 8.0);
  EXPECT_EQ(raw.count(), 3);
  EXPECT_EQ(raw.end(), 10);
}

// In old files two 16-bit flags stand where newer ones have the heading, and a float where the transmit mode is.
TEST(Raw0, TrawlDataOfOldFilesAreNoHeadingAndNoMode) {
  const auto head = [](float heading_deg, int transmit_mode) {
    const auto bytes = test::raw0(test::kStart, {.heading_deg = heading_deg, .transmit_mode = transmit_mode}, {1});
    return parse_raw0(body_of(bytes)).head;
  };
  for (const std::uint32_t flags : {0x00000001U, 0x00010000U, 0x00010001U}) {
    EXPECT_EQ(head(std::bit_cast<float>(flags), 1).heading_deg, 0.0);
    EXPECT_EQ(head(std::bit_cast<float>(flags), 1).transmit_mode, -1);
  }
  EXPECT_EQ(head(90.0F, 7).heading_deg, 0.0);
  EXPECT_EQ(head(90.0F, 7).transmit_mode, -1);
  EXPECT_EQ(head(90.0F, 1).heading_deg, 90.0);
  EXPECT_TRUE(is_silent(head(90.0F, 1)));
  EXPECT_TRUE(is_silent(head(0.0F, 2)));
  EXPECT_FALSE(is_silent(head(0.0F, 0)));
}

TEST(Raw0, TrawlDataOfOldFilesAreNoHeading) {
  test::Raw0Spec spec;
  spec.heading_deg = 400.0F;
  const auto bytes = test::raw0(test::kStart, spec, {1});
  EXPECT_EQ(parse_raw0(body_of(bytes)).head.heading_deg, 0.0);
}

TEST(Raw0, ImpossibleOnesAreNotUsed) {
  const auto code = [](const test::Raw0Spec& spec) {
    const auto bytes = test::raw0(test::kStart, spec, {1, 2, 3});
    const Raw0 raw = parse_raw0(body_of(bytes));
    EXPECT_NE(raw.problem, nullptr);
    EXPECT_EQ(raw.count(), 0);
    return raw.code;
  };
  for (const std::int32_t count : {4, 1'000'000, 2'147'483'647}) {
    EXPECT_EQ(code({.stated_count = count}), DiagnosticCode::bad_sample_counts);
  }
  EXPECT_EQ(code({.offset = -1}), DiagnosticCode::bad_sample_counts);
  EXPECT_EQ(code({.offset = 2'147'483'647}), DiagnosticCode::bad_sample_counts);
  EXPECT_EQ(code({.interval_s = 0.0F}), DiagnosticCode::bad_value);
  EXPECT_EQ(code({.interval_s = std::numeric_limits<float>::quiet_NaN()}), DiagnosticCode::bad_value);
  EXPECT_EQ(code({.interval_s = 0.5F}), DiagnosticCode::bad_value);  // 375 m a sample
  EXPECT_EQ(code({.interval_s = 1e-8F}), DiagnosticCode::bad_value);
  EXPECT_EQ(code({.sound_speed_mps = -1500.0F}), DiagnosticCode::bad_value);
  EXPECT_EQ(code({.sound_speed_mps = 330.0F}), DiagnosticCode::bad_value);  // air
  EXPECT_EQ(code({.mode = 2}), DiagnosticCode::no_power);
  const auto bytes = test::raw0(test::kStart, {}, {});
  EXPECT_NE(parse_raw0(body_of(bytes).first(71)).problem, nullptr);
}

}  // namespace
}  // namespace sonar::simrad
