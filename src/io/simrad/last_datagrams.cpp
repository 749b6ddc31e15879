// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/last_datagrams.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

#include "io/nmea.h"
#include "io/simrad/datagram.h"
#include "io/simrad/fields.h"

namespace sonar::simrad {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{256} << 10U;
constexpr std::size_t kMostSentenceBytes = 1024;

/// Reads a file from its end to its beginning, a block at a time.
class Backwards {
 public:
  explicit Backwards(const ByteSource& bytes) : bytes_(bytes) {}

  /// count  no more than kBlockBytes, and offset + count no more than the file holds
  /// out    shorter where the file has become so
  Result<std::span<const std::byte>> peek(std::uint64_t offset, std::size_t count) {
    if (offset < offset_ || offset + count > offset_ + block_.size()) {
      const std::uint64_t end = offset + count;
      offset_ = end - std::min<std::uint64_t>(end, kBlockBytes);
      block_.resize(static_cast<std::size_t>(end - offset_));
      const auto got = bytes_.read(offset_, block_);
      if (!got) return pass_on(got);
      block_.resize(*got);
    }
    const auto begin = std::min<std::size_t>(static_cast<std::size_t>(offset - offset_), block_.size());
    return std::span<const std::byte>(block_).subspan(begin, std::min(count, block_.size() - begin));
  }

 private:
  const ByteSource& bytes_;
  std::uint64_t offset_ = 0;
  std::vector<std::byte> block_;
};

bool tells_position(std::span<const std::byte> body) {
  const auto sentence = parse_nmea({reinterpret_cast<const char*>(body.data()), body.size()});
  return sentence && !sentence->checksum_wrong && nmea_fix(*sentence);
}

}  // namespace

Result<std::vector<Extent>> last_datagrams(const ByteSource& bytes, std::uint64_t size, std::uint64_t from) {
  std::vector<Extent> found;
  Backwards file(bytes);
  bool samples = false;
  bool position = false;
  std::uint64_t end = size;
  while (!(samples && position) && end > from + kFrameBytes) {
    const auto trailer = file.peek(end - 4, 4);
    if (!trailer) return pass_on(trailer);
    if (inspect_length(*trailer) != Frame::sound) break;
    const std::uint64_t whole = number_at<std::uint32_t>(*trailer, 0) + std::uint64_t{8};
    if (whole > end) break;
    const std::uint64_t begin = end - whole;
    const auto head = file.peek(begin, kHeadBytes);
    if (!head) return pass_on(head);
    if (inspect_head(*head) != Frame::sound || number_at<std::uint32_t>(*head, 0) + std::uint64_t{8} != whole) break;
    const std::string type = type_text(head->subspan<4, 4>());
    if (type == "NME0") {
      const auto body = file.peek(begin + kHeadBytes, std::min<std::size_t>(whole - kFrameBytes, kMostSentenceBytes));
      if (!body) return pass_on(body);
      position = position || tells_position(*body);
      found.push_back({begin, whole});
    } else if (type.starts_with("RAW") && !samples) {
      samples = true;
      found.push_back({begin, whole});
    }
    end = begin;
  }
  std::reverse(found.begin(), found.end());
  return found;
}

}  // namespace sonar::simrad
