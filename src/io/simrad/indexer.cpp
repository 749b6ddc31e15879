// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/indexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "io/nmea.h"
#include "io/simrad/con0.h"
#include "io/simrad/con1.h"
#include "io/simrad/fields.h"

namespace sonar::simrad {
namespace {

constexpr std::size_t kMaxTypes = 64;
constexpr std::size_t kMaxConfigs = 1000;
constexpr std::size_t kMostXmlKept = 4U << 20U;
constexpr int kMaxUndescribedChannels = 4096;
constexpr std::size_t kLeastToWait = 8;  ///< channels

double known(double value) { return std::isnan(value) ? 0.0 : value; }

ChannelTransmit transmit_of(const ChannelPing& head, int count) {
  return {known(head.frequency_hz),    known(head.transmit_power_w),
          known(head.pulse_length_s),  known(head.sample_interval_s),
          known(head.sound_speed_mps), known(head.absorption_db_per_m),
          head.offset + count};
}

std::string_view text_of(std::span<const std::byte> body) {
  const std::string_view text(reinterpret_cast<const char*>(body.data()), body.size());
  return text.substr(0, text.find('\0'));
}

}  // namespace

Result<bool> Indexer::worth_scanning(const ByteSource& source, bool final) {
  // What kind of netCDF a file is may stand beyond what of it was there at first.
  if (!format_known_ || index_.format == RawFormat::other_netcdf) {
    const auto size = source.size();
    if (!size) return pass_on(size);
    if (*size < kHeadBytes && !final) return false;
    const auto format = detect_format(source);
    if (!format) return pass_on(format);
    index_.format = *format;
    index_.name = source.name();
    notes_.set_file(source.name());
    format_known_ = true;
  }
  return why_not_read(index_.format).empty();
}

Result<void> Indexer::refresh(const ByteSource& source) {
  const auto scan = worth_scanning(source, false);
  if (!scan) return pass_on(scan);
  if (*scan) {
    if (auto done = scanner_.scan(
            source, [this](const Datagram& d) { take_in(d); }, notes_);
        !done)
      return done;
  }
  return hash_what_came(source);
}

/// While it lies in memory still: of a file that grows, the end must not cost a second reading of all.
Result<void> Indexer::hash_what_came(const ByteSource& source) {
  const auto size = source.size();
  if (!size) return pass_on(size);
  std::vector<std::byte> bytes(
      static_cast<std::size_t>(std::clamp<std::uint64_t>(*size - std::min(*size, hashed_), 1, 2U << 20U)));
  while (true) {
    const auto got = source.read(hashed_, bytes);
    if (!got) return pass_on(got);
    hasher_.add(std::span<const std::byte>(bytes).first(*got));
    hashed_ += *got;
    if (*got < bytes.size()) return {};
  }
}

Result<void> Indexer::finish(const ByteSource& source) {
  const auto size = source.size();
  if (!size) return pass_on(size);
  const auto scan = worth_scanning(source, true);
  if (!scan) return pass_on(scan);
  index_.size = *size;
  if (*scan) {
    if (auto done = scanner_.finish(
            source, [this](const Datagram& d) { take_in(d); }, notes_);
        !done)
      return done;
  }
  close_pings();
  if (bad_sentences_ > 0) {
    notes_.add(
        DiagnosticCode::bad_nmea, first_bad_sentence_,
        fmt::format("{} navigation sentences with a wrong checksum or none readable, the first here", bad_sentences_));
  }
  name_format();
  if (auto hashed = hash_what_came(source); !hashed) return hashed;
  index_.hash = to_hex(hasher_.value());
  index_.diagnostics = notes_.all();
  return {};
}

void Indexer::name_format() {
  if (const std::string_view why = why_not_read(index_.format); !why.empty()) {
    notes_.add(DiagnosticCode::format_not_read, 0, std::string(why));
    return;
  }
  const auto count = [&](const char* type) {
    const auto it = index_.datagrams.find(type);
    return it == index_.datagrams.end() ? std::int64_t{0} : it->second;
  };
  const std::int64_t ek80 = count("XML0") + count("RAW3") + count("RAW4");
  if (index_.datagrams.empty()) {
    index_.format = RawFormat::unknown;
    notes_.add(DiagnosticCode::not_recognised, 0,
               index_.size == 0 ? "the file is empty" : "no datagram of a known format was found");
  } else if (ek80 > 0 && count("CON0") + count("RAW0") == 0) {
    index_.format = RawFormat::ek80;
    notes_.add(DiagnosticCode::format_not_read, 0, "an EK80 file (XML0/RAW3); this version does not read its samples");
  } else {
    index_.format = RawFormat::simrad;
  }
}

void Indexer::take_in(const Datagram& datagram) {
  if (index_.datagrams.empty()) index_.first_datagram_time = datagram.time;
  index_.last_datagram_time = datagram.time;
  const bool room = index_.datagrams.size() < kMaxTypes || index_.datagrams.contains(datagram.type);
  ++index_.datagrams[room ? datagram.type : "other"];
  if (datagram.type == "RAW0") {
    take_raw0(datagram);
  } else if (datagram.type == "NME0") {
    take_nme0(datagram);
  } else if (datagram.type == "CON0") {
    take_con0(datagram);
  } else if (datagram.type == "CON1") {
    take_con1(datagram);
  }
}

void Indexer::take_con0(const Datagram& datagram) {
  const bool first = last_con0_.empty();
  if (!first && std::equal(last_con0_.begin(), last_con0_.end(), datagram.body.begin(), datagram.body.end())) return;
  Con0 con0 = parse_con0(datagram.body);
  if (!con0.problem.empty()) notes_.add(DiagnosticCode::bad_config, datagram.offset, con0.problem);
  if (!con0.bad_numbers.empty()) notes_.add(DiagnosticCode::bad_value, datagram.offset, con0.bad_numbers);
  if (con0.config.beams.empty() && !index_.configs.empty()) return;
  if (index_.configs.size() >= kMaxConfigs) return;
  close_pings();
  if (config_used_) notes_.add(DiagnosticCode::config_changed, datagram.offset, "CON0 differs from the one before");
  last_con0_.assign(datagram.body.begin(), datagram.body.end());
  index_.configs.emplace_back(std::move(con0.config));
  config_used_ = false;
}

void Indexer::take_con1(const Datagram& datagram) {
  const std::string_view xml = text_of(datagram.body);
  if (index_.configs.empty()) {
    notes_.add(DiagnosticCode::con1_unusable, datagram.offset, "CON1 before any CON0");
    return;
  }
  if (index_.configs.back()->con1_xml == xml.substr(0, kMostXmlKept) || index_.configs.size() >= kMaxConfigs) return;
  if (config_used_) {
    close_pings();
    notes_.add(DiagnosticCode::config_changed, datagram.offset, "CON1 differs from the one before");
    index_.configs.push_back(index_.configs.back());
    config_used_ = false;
  }
  SounderConfig& config = index_.configs.back().edit();
  config.con1_xml = xml.substr(0, kMostXmlKept);
  const Con1Outcome outcome = apply_con1(parse_con1(xml), config);
  if (!outcome.problem.empty()) notes_.add(DiagnosticCode::con1_unusable, datagram.offset, outcome.problem);
  if (outcome.largest_change > 0.1) {
    notes_.add(DiagnosticCode::con1_differs, datagram.offset,
               fmt::format("angles of CON1 differ from CON0 by up to {:.3f} degrees", outcome.largest_change));
  }
}

void Indexer::take_nme0(const Datagram& datagram) {
  const auto sentence = parse_nmea(text_of(datagram.body));
  if (!sentence || sentence->checksum_wrong) {
    if (bad_sentences_++ == 0) first_bad_sentence_ = datagram.offset;
    return;
  }
  add_sentence(index_.navigation, *sentence, datagram.time, clock_runs_.run());
}

bool Indexer::channel_exists(const Datagram& datagram, int channel) {
  if (index_.configs.empty()) {
    notes_.add(DiagnosticCode::no_config, datagram.offset, "RAW0 before any CON0; its beams are not described");
    index_.configs.emplace_back();
  }
  const auto& beams = index_.configs.back()->beams;
  const int limit =
      beams.empty() ? kMaxUndescribedChannels : static_cast<int>(std::min<std::size_t>(beams.size(), 32767));
  if (channel >= 0 && channel < limit) return true;
  notes_.add(DiagnosticCode::bad_channel, datagram.offset,
             fmt::format("channel {}, expected 1 to {}", channel + 1, limit));
  return false;
}

bool Indexer::join_ping(const Arrival& arrival) {
  const auto channel = static_cast<std::size_t>(arrival.head.channel);
  if (seen_in_ping_.size() <= channel) seen_in_ping_.resize(channel + 1, 0);
  if (!ping_open_ || arrival.time != ping_.time) {
    close_ping();
    open_ping(arrival);
  } else if (seen_in_ping_[channel] == ping_number_) {
    notes_.add(DiagnosticCode::repeated_channel, arrival.offset,
               fmt::format("channel {} came before with the same time stamp", channel + 1));
    return false;
  } else if (arrival.end - ping_.offset > kMaxPingBytes) {
    if (std::exchange(too_long_, ping_number_) == ping_number_) return false;
    notes_.add(
        DiagnosticCode::ping_too_long, arrival.offset,
        fmt::format("the ping begins at byte {}, and no more than {} MB are read of one: channel {} and what lies "
                    "behind it are left out",
                    ping_.offset, kMaxPingBytes >> 20U, channel + 1));
    return false;
  }
  seen_in_ping_[channel] = ping_number_;
  return true;
}

void Indexer::open_ping(const Arrival& arrival) {
  const ChannelPing& head = arrival.head;
  clock_runs_.begin_ping(arrival.time, index_.navigation);
  ping_ = {};
  ping_.clock_run = clock_runs_.run();
  ping_.reduced = head.reduced.has_value();
  ping_.time = arrival.time;
  ping_.offset = arrival.offset;
  ping_.roll_deg = static_cast<float>(head.roll_deg);
  ping_.pitch_deg = static_cast<float>(head.pitch_deg);
  ping_.heave_m = static_cast<float>(head.heave_m);
  ping_.heading_deg = static_cast<float>(head.heading_deg);
  ping_.transducer_depth_m = static_cast<float>(head.transducer_depth_m);
  ping_.config = static_cast<std::uint16_t>(index_.configs.size() - 1);
  open_.clear();
  ping_open_ = true;
  ping_published_ = false;
  config_used_ = true;
  ++ping_number_;
}

void Indexer::take_raw0(const Datagram& datagram) {
  Raw0 raw = parse_raw0(datagram.body);
  if (raw.problem != nullptr) {
    notes_.add(raw.code, datagram.offset, fmt::format("channel {}: {}", raw.head.channel + 1, raw.problem));
    return;
  }
  if (!channel_exists(datagram, raw.head.channel)) return;
  if (raw.bad_attitude && !bad_attitude_noted_) {
    bad_attitude_noted_ = true;
    notes_.add(DiagnosticCode::bad_value, datagram.offset, "roll, pitch, heave or depth is impossible; 0 is taken");
  }
  const int count = raw.count();
  arrive({datagram.time, datagram.offset, datagram.end(), std::move(raw.head), count});
}

/// Of a sounder with many channels a single one with a time stamp of its own says little: what comes behind it tells
/// whether it begins a ping. Where its ping goes on, or its time lies outside what is before and behind it, the stamp is
/// damaged; taken for a ping it would cut the observation.
void Indexer::arrive(Arrival arrival) {
  if (waiting_) {
    const bool ping_goes_on = arrival.time == ping_.time;
    const bool alone = arrival.time != waiting_->time;
    const bool out_of_order = waiting_->time < ping_.time || waiting_->time > arrival.time;
    if (ping_goes_on || (alone && out_of_order)) {
      drop(*waiting_);
    } else {
      take(*waiting_);
    }
    waiting_.reset();
  }
  const bool many = index_.configs.back()->beams.size() >= kLeastToWait;
  if (many && ping_open_ && arrival.time != ping_.time) {
    waiting_ = std::move(arrival);
  } else {
    take(arrival);
  }
}

void Indexer::drop(const Arrival& arrival) {
  notes_.add(DiagnosticCode::bad_time, arrival.offset,
             fmt::format("channel {}: its time stamp is not that of its ping", arrival.head.channel + 1));
}

void Indexer::take(const Arrival& arrival) {
  if (!join_ping(arrival)) return;
  ping_.end = arrival.end;
  open_.push_back({arrival.head.channel, transmit_of(arrival.head, arrival.count),
                   sent_channel(arrival.head, arrival.count), arrival.count, is_silent(arrival.head), arrival.offset});
  if (open_.size() == index_.configs.at(ping_.config)->beams.size()) publish_ping();
}

void Indexer::close_pings() {
  if (waiting_) take(*waiting_);
  waiting_.reset();
  close_ping();
}

void Indexer::close_ping() {
  if (ping_open_ && !ping_published_) publish_ping();
  ping_open_ = false;
}

}  // namespace sonar::simrad
