// SPDX-License-Identifier: Apache-2.0
#include "io/recording_copy.h"

#include <cstddef>

#include "io/raw_datagrams.h"
#include "io/simrad/raw0.h"
#include "io/simrad/scanner.h"

namespace sonar {
namespace {

constexpr std::size_t kFlushBytes = 4U << 20U;

class Copy {
 public:
  Copy(const ChannelInPlace& in_place, RawFileWriter& out) : in_place_(in_place), out_(out) {}

  void visit(const simrad::Datagram& datagram) {
    if (!status_) return;
    status_ = datagram.type == "RAW0" ? channel(datagram)
                                      : append_datagram(bytes_, datagram.time, datagram.type, datagram.body);
    if (status_ && bytes_.size() >= kFlushBytes) flush();
  }

  Result<void> finish() {
    if (status_) flush();
    if (!status_) return status_;
    return out_.finish();
  }

 private:
  void flush() {
    status_ = out_.write(bytes_);
    bytes_.clear();
  }

  Result<void> channel(const simrad::Datagram& datagram) {
    const simrad::Raw0 raw = simrad::parse_raw0(datagram.body);
    if (raw.problem != nullptr) return {};
    const auto instead = in_place_(datagram.time, raw.head);
    if (!instead) return pass_on(instead);
    return *instead ? append_raw0(bytes_, datagram.time, **instead) : Result<void>{};
  }

  const ChannelInPlace& in_place_;
  RawFileWriter& out_;
  RawBytes bytes_;
  Result<void> status_;
};

}  // namespace

Result<void> copy_recording(const ByteSource& source, const ChannelInPlace& in_place, RawFileWriter& out) {
  Copy copy(in_place, out);
  simrad::Scanner scanner;
  simrad::Notes notes;
  auto scanned = scanner.finish(
      source, [&](const simrad::Datagram& datagram) { copy.visit(datagram); }, notes);
  return scanned ? copy.finish() : scanned;
}

}  // namespace sonar
