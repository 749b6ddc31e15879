// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/reduced_ping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "base/units.h"
#include "io/raw_datagrams.h"
#include "io/simrad/raw0.h"

namespace sonar {
namespace {

ChannelPing head(int channel, ReducedRow row) {
  ChannelPing p;
  p.channel = channel;
  p.sample_interval_s = 0.000512;
  p.sound_speed_mps = 1490.0;
  p.reduced = ReducedRecord{row};
  return p;
}

TEST(ReducedPing, record_survives_the_file) {
  const std::vector<std::int16_t> counts = {-12000, kReducedFault, -20000};
  ChannelPing p = head(4, {-151.25F, 700, 1324});
  p.offset = 77;
  p.power_count = counts;
  RawBytes bytes;
  ASSERT_TRUE(append_raw0(bytes, 1'700'000'000'000'000'000, p));
  const std::span<const std::byte> body = std::span(bytes).subspan(16, bytes.size() - 20);
  const simrad::Raw0 back = simrad::parse_raw0(body);
  ASSERT_EQ(back.problem, nullptr);
  EXPECT_EQ(back.head.reduced, p.reduced);
  EXPECT_EQ(back.count(), 3);
  EXPECT_EQ(back.head.offset, 77);
  EXPECT_FALSE(back.head.reduced->seabed);
  p.reduced->seabed = ReducedSeabed{151.0625, 0.015, -0.1, -80.0, 90.0, -400.25, -30.0};
  bytes.clear();
  ASSERT_TRUE(append_raw0(bytes, 1'700'000'000'000'000'000, p));
  const simrad::Raw0 with_plane = simrad::parse_raw0(std::span(bytes).subspan(16, bytes.size() - 20));
  EXPECT_EQ(with_plane.head.reduced, p.reduced);
  EXPECT_EQ(with_plane.head.reduced->seabed, p.reduced->seabed);
  const Seabed seabed = reduced_seabed(std::vector{p}, std::vector{5, 4, 3, 2, 1, 0}, 1400);
  EXPECT_TRUE(seabed.found);
  EXPECT_EQ(seabed.offset_m, 151.0625);
  EXPECT_EQ(seabed.slope_y, -0.1);
  EXPECT_EQ(seabed.min_y, -400.25);
  EXPECT_EQ(seabed.first_sample, (std::vector<std::int32_t>{1400, 700, 1400, 1400, 1400, 1400}));
  EXPECT_FALSE(with_plane.head.reduced->water);
  // The water stands behind the plane, or alone.
  p.reduced->water = WaterLevels{
      15, 2, 3, {1.0F, 1.25F}, {-2711, -2800, -2750}, {3, -2, 0, 127}, {300, 280, 290}, {{0, 1, 9.5F}, {1, 0, 4.0F}}};
  const Shape3 shape{1, 2, 30};
  for (const bool plane : {true, false}) {
    ChannelPing told = p;
    if (!plane) told.reduced->seabed.reset();
    bytes.clear();
    ASSERT_TRUE(append_raw0(bytes, 1'700'000'000'000'000'000, told));
    const simrad::Raw0 with_water = simrad::parse_raw0(std::span(bytes).subspan(16, bytes.size() - 20));
    EXPECT_EQ(with_water.head.reduced->seabed, told.reduced->seabed);
    EXPECT_EQ(with_water.head.reduced->water, told.reduced->water);
    EXPECT_EQ(reduced_water(std::vector{head(1, {}), with_water.head}, shape), *told.reduced->water);
    EXPECT_FALSE(reduced_water(std::vector{with_water.head}, {2, 2, 30}).known()) << "of another grid";
    // Cut short, nothing of it holds.
    const simrad::Raw0 cut = simrad::parse_raw0(std::span(bytes).subspan(16, bytes.size() - 20 - 3));
    EXPECT_FALSE(cut.head.reduced->water);
  }
  EXPECT_EQ(reduced_water(std::vector<ChannelPing>{}, shape), WaterLevels{});
  // Beams that were missing or short stand behind what there is of these.
  p.reduced->short_beams = {{0, {-149.5F, 900, 0}}, {499, {-151.0F, 1000, 640}}};
  for (const bool water : {true, false}) {
    ChannelPing told = p;
    if (!water) told.reduced->water.reset();
    bytes.clear();
    ASSERT_TRUE(append_raw0(bytes, 1'700'000'000'000'000'000, told));
    const auto written = std::span(bytes).subspan(16, bytes.size() - 20);
    EXPECT_EQ(simrad::parse_raw0(written).head.reduced->short_beams, told.reduced->short_beams);
    EXPECT_EQ(simrad::parse_raw0(written).head.reduced->water, told.reduced->water);
    // Cut anywhere, it is what is there in full.
    for (std::size_t cut = 1; cut <= simrad::kReducedShortHeadBytes + 2 * simrad::kReducedShortBytes; ++cut) {
      const simrad::Raw0 cut_short = simrad::parse_raw0(written.first(written.size() - cut));
      EXPECT_EQ(cut_short.head.reduced->short_beams.size(), cut <= simrad::kReducedShortBytes ? 1U : 0U) << cut;
    }
  }
  // A plane that makes no sense is none.
  p.reduced->seabed->slope_x = std::numeric_limits<double>::quiet_NaN();
  bytes.clear();
  ASSERT_TRUE(append_raw0(bytes, 1'700'000'000'000'000'000, p));
  EXPECT_FALSE(simrad::parse_raw0(std::span(bytes).subspan(16, bytes.size() - 20)).head.reduced->seabed);
  p.reduced.reset();
  bytes.clear();
  ASSERT_TRUE(append_raw0(bytes, 1'700'000'000'000'000'000, p));
  EXPECT_FALSE(simrad::parse_raw0(std::span(bytes).subspan(16, bytes.size() - 20)).head.reduced);
}

/// The record as it was written before there were open stretches: mark ends in 1, the row's last two members, which
/// begin so many bytes behind it, are not there.
std::vector<std::byte> without_open(std::span<const std::byte> record, std::string_view mark, std::ptrdiff_t open) {
  const auto wanted = std::as_bytes(std::span(mark));
  const auto at = std::search(record.begin(), record.end(), wanted.begin(), wanted.end());
  std::vector<std::byte> out(record.begin(), at + open);
  out.insert(out.end(), at + open + 8, record.end());
  out[static_cast<std::size_t>(at - record.begin()) + mark.size() - 1] = std::byte{'1'};
  return out;
}

TEST(ReducedPing, open_stretches_survive_and_files_without_them_are_read) {
  ChannelPing p = head(2, {-151.25F, 700, 1324, 750, 800});
  const std::vector<std::int16_t> counts = {-12000};
  p.power_count = counts;
  p.reduced->seabed = ReducedSeabed{151.0, 0.0, 0.0, -80.0, 90.0, -400.0, -30.0};
  p.reduced->short_beams = {{0, {-149.5F, 900, 950, 910, 920}}};
  RawBytes bytes;
  ASSERT_TRUE(append_raw0(bytes, 1'700'000'000'000'000'000, p));
  const std::vector<std::byte> written(bytes.begin() + 16, bytes.end() - 4);
  const ChannelPing now = simrad::parse_raw0(written).head;
  EXPECT_EQ(now.reduced, p.reduced);
  EXPECT_EQ(now.reduced->short_beams, p.reduced->short_beams);
  const std::vector<int> row_of_channel{2, 1, 0};
  const Seabed seabed = reduced_seabed(std::vector{now}, row_of_channel, 1324);
  // a stretch that begins later is 0.1.0's: nothing is known of the beam-edge echo
  EXPECT_EQ(seabed.first_sample, (std::vector<std::int32_t>{700, 1324, 900}));
  EXPECT_EQ(seabed.heard_sample, seabed.first_sample);
  ChannelPing with_edge = p;
  with_edge.reduced->row.open_first = with_edge.reduced->row.seabed_sample;
  const Seabed edge_read = reduced_seabed(std::vector{with_edge}, row_of_channel, 1324);
  EXPECT_EQ(edge_read.first_sample[0], 800);
  EXPECT_EQ(edge_read.heard_sample[0], 700);
  Array3<SampleFlags> flags({1, 3, 1324});
  flag_reduced_seabed(std::vector{now}, row_of_channel, flags.view());
  for (const auto& [sample, is_seabed] :
       {std::pair{699, false}, {749, true}, {750, false}, {799, false}, {800, true}}) {
    EXPECT_EQ(any(flags(0, 0, sample) & SampleFlags::seabed), is_seabed) << sample;
  }

  const std::vector<std::byte> earlier =
      without_open(without_open(written, simrad::kReducedMark, 16), simrad::kReducedShortMark, 24);
  const ChannelPing then = simrad::parse_raw0(earlier).head;
  EXPECT_EQ(then.reduced->row, (ReducedRow{-151.25F, 700, 1324}));
  EXPECT_EQ(then.reduced->seabed, p.reduced->seabed);
  EXPECT_EQ(then.reduced->short_beams, (std::vector<ReducedChannel>{{0, {-149.5F, 900, 950}}}));
}

TEST(ReducedPing, what_was_left_out_is_water_and_what_was_faulty_is_lost) {
  // Row 0 has a record: five samples recorded, the third left out, the fourth faulty. Row 1 is not in the file.
  Volume volume{Array3<std::int16_t>({1, 2, 6}, kNoData), Array3<SampleFlags>({1, 2, 6}, SampleFlags::dropout)};
  volume.counts(0, 0, 0) = -12000;
  volume.counts(0, 0, 1) = -12001;
  volume.counts(0, 0, 3) = kMinCount;  // kReducedFault as it is read
  volume.counts(0, 0, 4) = -12002;
  const std::vector<ChannelPing> heads = {head(1, {-150.0F, 4, 5})};
  const std::vector<int> row_of_channel = {1, 0};
  EXPECT_TRUE(is_reduced(heads));
  open_reduced(heads, row_of_channel, volume);
  const std::vector<std::int16_t> wanted = {-12000, -12001, kMinCount, kNoData, -12002, kNoData};
  const auto row = volume.counts.row(0, 0);
  EXPECT_EQ(std::vector<std::int16_t>(row.begin(), row.end()), wanted);
  EXPECT_EQ(volume.flags(0, 0, 2), SampleFlags::none);
  EXPECT_EQ(volume.flags(0, 0, 3), SampleFlags::dropout);
  EXPECT_EQ(volume.flags(0, 0, 5), SampleFlags::dropout);
  EXPECT_EQ(volume.counts(0, 1, 3), kMinCount);
  EXPECT_EQ(volume.flags(0, 1, 3), SampleFlags::none);

  const std::vector<float> levels = reduced_background_db(heads, row_of_channel);
  EXPECT_EQ(levels[0], -150.0F);
  EXPECT_TRUE(std::isnan(levels[1]));
  flag_reduced_seabed(heads, row_of_channel, volume.flags.view());
  EXPECT_EQ(volume.flags(0, 0, 3), SampleFlags::dropout);
  EXPECT_EQ(volume.flags(0, 0, 4), SampleFlags::seabed);
  EXPECT_FALSE(any(volume.flags(0, 1, 4) & SampleFlags::seabed));
}

TEST(ReducedPing, missing_and_short_beams_are_lost) {
  // Channels 0..3 in rows 3..0. The file has channel 1 alone; it tells that channel 0 was missing and channel 2 ended
  // after four samples. Of channel 3 it tells nothing: that is water.
  Volume volume{Array3<std::int16_t>({2, 2, 6}, kNoData), Array3<SampleFlags>({2, 2, 6}, SampleFlags::dropout)};
  ChannelPing only = head(1, {-150.0F, 6, 6});
  only.reduced->short_beams = {{0, {-149.0F, 6, 0}}, {2, {-148.0F, 2, 4}}, {1, {-1.0F, 0, 0}}, {4, {}}, {-1, {}}};
  const std::vector<ChannelPing> heads = {only};
  const std::vector<int> row_of_channel = {3, 2, 1, 0};
  open_reduced(heads, row_of_channel, volume);
  fill_reduced(volume);
  for (int s = 0; s < 6; ++s) {
    EXPECT_EQ(volume.flags(0, 0, s), SampleFlags::none);
    EXPECT_EQ(volume.flags(0, 1, s), s < 4 ? SampleFlags::none : SampleFlags::dropout);
    EXPECT_EQ(volume.counts(0, 1, s), s < 4 ? kMinCount : kNoData);
    EXPECT_EQ(volume.flags(1, 0, s), SampleFlags::none) << "what a channel says of itself holds";
    EXPECT_EQ(volume.flags(1, 1, s), SampleFlags::dropout);
  }
  EXPECT_EQ(reduced_lengths(heads, row_of_channel), (std::vector<int>{-1, 4, 6, 0}));
  const std::vector<float> levels = reduced_background_db(heads, row_of_channel);
  EXPECT_TRUE(std::isnan(levels[0]));
  EXPECT_EQ(levels[1], -148.0F);
  EXPECT_EQ(levels[3], -149.0F);
  EXPECT_EQ(reduced_seabed(heads, row_of_channel, 6).first_sample, (std::vector<std::int32_t>{6, 2, 6, 6}));
}

}  // namespace
}  // namespace sonar
