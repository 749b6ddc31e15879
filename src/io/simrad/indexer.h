// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "base/result.h"
#include "io/byte_source.h"
#include "io/raw_index.h"
#include "io/simrad/odd_channels.h"
#include "io/simrad/raw0.h"
#include "io/simrad/raw_format.h"
#include "io/simrad/scanner.h"

namespace sonar::simrad {

/// Channels of one ping never lie farther apart than this in the file.
inline constexpr std::uint64_t kMaxPingBytes = std::uint64_t{256} << 20;

/// Builds the index of a file that may still grow. A ping is published when all beams of its configuration are there, when
/// a later one starts, or at finish(); published, it never changes. The result does not depend on how the bytes arrived.
class Indexer {
 public:
  /// Takes in what is whole; index().pings only grows.
  /// errors  io
  Result<void> refresh(const ByteSource& source);
  /// Takes in the rest, knowing that no more will come, and completes size, hash and diagnostics. Called once.
  /// errors  io
  Result<void> finish(const ByteSource& source);
  [[nodiscard]] const RawIndex& index() const { return index_; }
  [[nodiscard]] RawIndex take() { return std::move(index_); }

 private:
  Result<void> hash_what_came(const ByteSource& source);
  Result<bool> worth_scanning(const ByteSource& source, bool final);
  void take_in(const Datagram& datagram);
  void take_con0(const Datagram& datagram);
  void take_con1(const Datagram& datagram);
  void take_raw0(const Datagram& datagram);
  void take_nme0(const Datagram& datagram);
  [[nodiscard]] bool channel_exists(const Datagram& datagram, int channel);
  /// A sound RAW0, without its samples.
  struct Arrival {
    TimeNs time = 0;
    std::uint64_t offset = 0;
    std::uint64_t end = 0;
    ChannelPing head;
    int count = 0;
  };
  void arrive(Arrival arrival);
  void take(const Arrival& arrival);
  void drop(const Arrival& arrival);
  [[nodiscard]] bool join_ping(const Arrival& arrival);
  void open_ping(const Arrival& arrival);
  /// Ends the open ping, and the one that a waiting channel begins.
  void close_pings();
  void close_ping();
  void publish_ping();
  void leave_out_odd_channels();
  [[nodiscard]] std::uint16_t transmit_of_open_ping();
  void name_format();

  Scanner scanner_;
  Hasher hasher_;
  std::uint64_t hashed_ = 0;  ///< bytes
  Notes notes_;
  RawIndex index_;
  bool format_known_ = false;
  bool config_used_ = false;  ///< by some ping
  std::vector<std::byte> last_con0_;

  bool ping_open_ = false;
  bool ping_published_ = false;  ///< the open one, as it has all beams; what repeats them is noted as such
  PingEntry ping_;
  std::uint64_t ping_number_ = 0;
  std::uint64_t too_long_ = 0;  ///< number of the last ping that was
  ClockRuns clock_runs_;
  std::vector<std::uint64_t> seen_in_ping_;  ///< [channel] number of the ping it was last seen in
  struct OpenChannel {
    int channel = 0;
    ChannelTransmit transmit;
    SentChannel sent;
    int count = 0;
    bool silent = false;
    std::uint64_t offset = 0;  ///< of its datagram
  };
  std::vector<OpenChannel> open_;              ///< channels of the open ping
  std::optional<Arrival> waiting_;             ///< begins the next ping, unless its time stamp is damaged
  std::map<int, ChannelTransmit> odd_before_;  ///< what was left out of the last ping, by channel
  std::size_t transmit_entries_ = 0;           ///< over all sets
  bool transmit_overflow_ = false;

  std::int64_t bad_sentences_ = 0;
  std::uint64_t first_bad_sentence_ = 0;
  bool bad_attitude_noted_ = false;
};

}  // namespace sonar::simrad
