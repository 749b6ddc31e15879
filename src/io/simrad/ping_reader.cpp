// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/ping_reader.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "io/simrad/datagram.h"
#include "io/simrad/fields.h"
#include "io/simrad/indexer.h"
#include "io/simrad/odd_channels.h"
#include "io/simrad/raw0.h"

namespace sonar::simrad {
namespace {

/// Calls `visit(body)` for each sound RAW0 of this time; the same rules as the scanner's, on bytes at hand.
template <class Visit>
void each_raw0(std::span<const std::byte> bytes, TimeNs time, const Visit& visit) {
  bool lost = false;
  for (std::size_t at = 0; at + kFrameBytes <= bytes.size();) {
    const auto rest = bytes.subspan(at);
    const Frame frame = lost ? inspect_head(rest) : inspect_length(rest);
    const std::size_t length = frame == Frame::sound ? number_at<std::uint32_t>(rest, 0) : 0;
    if (frame != Frame::sound || length + 8 > rest.size() || number_at<std::uint32_t>(rest, length + 4) != length) {
      lost = true;
      ++at;
      continue;
    }
    lost = false;
    at += length + 8;
    if (std::memcmp(rest.data() + 4, "RAW0", 4) != 0) continue;
    if (time_from_filetime(number_at<std::uint64_t>(rest, 8)) != time) continue;
    visit(rest.subspan(kHeadBytes, length - kMinLength));
  }
}

/// The counts as they lie, or copied where they lie at an odd address.
std::span<const std::int16_t> counts_of(std::span<const std::byte> power, Ping& ping, BlockPool& pool) {
  const std::size_t count = power.size() / 2;
  const std::byte* bytes = power.data();
  if (reinterpret_cast<std::uintptr_t>(bytes) % alignof(std::int16_t) != 0) {
    const auto copy = pool.take(power.size());
    std::memcpy(copy.get(), bytes, power.size());
    ping.blocks.push_back(copy);
    bytes = copy.get();
  }
  return {reinterpret_cast<const std::int16_t*>(bytes), count};
}

void leave_out_odd_channels(Ping& ping, bool all_beams) {
  std::vector<SentChannel> sent;
  for (const ChannelPing& head : ping.channels) {
    sent.push_back(sent_channel(head, static_cast<int>(head.power_count.size())));
  }
  const std::vector<const char*> odd = odd_channels(sent, all_beams);
  std::size_t i = 0;
  std::erase_if(ping.channels, [&](const ChannelPing&) { return odd[i++] != nullptr; });
}

}  // namespace

Result<Ping> read_ping(const ByteSource& source, const PingEntry& entry, BlockPool& pool) {
  const Where where{.file = source.name(), .offset = static_cast<std::int64_t>(entry.offset)};
  const auto size = source.size();
  if (!size) return pass_on(size);
  if (entry.end <= entry.offset || entry.end - entry.offset > kMaxPingBytes + kMaxLength + 8) {
    return fail(ErrorCode::format, "the index tells of no ping here", where);
  }
  if (entry.end > *size) return fail(ErrorCode::io, "the file is shorter than when it was indexed", where);
  const auto block_size = static_cast<std::size_t>(entry.end - entry.offset);
  const std::shared_ptr<std::byte[]> block = pool.take(block_size);
  const auto got = source.read(entry.offset, {block.get(), block_size});
  if (!got) return pass_on(got);
  if (*got < block_size) return fail(ErrorCode::io, "the file became shorter while it was read", where);

  Ping ping;
  ping.time = entry.time;
  ping.channels.reserve(entry.channels);
  ping.blocks.push_back(block);
  const auto before = [](const ChannelPing& a, int channel) { return a.channel < channel; };
  each_raw0({block.get(), block_size}, entry.time, [&](std::span<const std::byte> body) {
    Raw0 raw = parse_raw0(body);
    if (raw.problem != nullptr || raw.head.channel < 0) return;
    const auto place = std::lower_bound(ping.channels.begin(), ping.channels.end(), raw.head.channel, before);
    if (place != ping.channels.end() && place->channel == raw.head.channel) return;
    raw.head.power_count = counts_of(raw.power, ping, pool);
    ping.channels.insert(place, raw.head);
  });
  if (entry.odd_channels > 0) leave_out_odd_channels(ping, entry.all_beams);
  if (ping.channels.empty()) {
    return fail(ErrorCode::format, "no sample data of this ping is here any more; the file has changed", where);
  }
  return ping;
}

}  // namespace sonar::simrad
