// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/last_datagrams.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <string>

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

  /// A head, wherever it lies; out of the way it costs no block.
  Result<std::span<const std::byte>> head(std::uint64_t offset) {
    if (offset >= offset_ && offset + kHeadBytes <= offset_ + block_.size()) return peek(offset, kHeadBytes);
    const auto got = bytes_.read(offset, head_);
    if (!got) return pass_on(got);
    return std::span<const std::byte>(head_).first(*got);
  }

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
  std::array<std::byte, kHeadBytes> head_{};
};

/// Who tells a position, and in which kind of sentence; empty where it tells none.
std::string position_id(std::span<const std::byte> body) {
  const auto sentence = parse_nmea({reinterpret_cast<const char*>(body.data()), body.size()});
  if (!sentence || sentence->checksum_wrong || !nmea_fix(*sentence)) return {};
  return std::string(sentence->talker) + std::string(sentence->type);
}

struct Last {
  std::uint64_t begin = 0;
  std::uint64_t size = 0;
  std::string type;  ///< empty = no whole datagram ends there
};

/// The datagram that ends at a place.
Result<Last> ending_at(Backwards& file, std::uint64_t end) {
  const auto trailer = file.peek(end - 4, 4);
  if (!trailer) return pass_on(trailer);
  if (inspect_length(*trailer) != Frame::sound) return Last{};
  const std::uint64_t size = number_at<std::uint32_t>(*trailer, 0) + std::uint64_t{8};
  if (size > end) return Last{};
  const auto head = file.head(end - size);
  if (!head) return pass_on(head);
  if (inspect_head(*head) != Frame::sound || number_at<std::uint32_t>(*head, 0) + std::uint64_t{8} != size)
    return Last{};
  return Last{end - size, size, type_text(head->subspan<4, 4>())};
}

/// The last whole datagram; of a recorder that was stopped half a one may follow.
Result<Last> last_whole(Backwards& file, std::uint64_t size, std::uint64_t from) {
  const std::uint64_t least = std::max(from + kFrameBytes, size - std::min<std::uint64_t>(size, kBlockBytes));
  for (std::uint64_t end = size; end >= least; --end) {
    auto last = ending_at(file, end);
    if (!last || !last->type.empty()) return last;
  }
  return Last{};
}

}  // namespace

Result<std::vector<Extent>> last_datagrams(const ByteSource& bytes, std::uint64_t size, std::uint64_t from,
                                           bool positions) {
  std::vector<Extent> found;
  std::set<std::string> told;
  Backwards file(bytes);
  bool samples = false;
  bool again = !positions;
  auto last = last_whole(file, size, from);
  while (last && !last->type.empty()) {
    if (last->type == "NME0") {
      const auto length = std::min<std::size_t>(last->size - kFrameBytes, kMostSentenceBytes);
      const auto body = file.peek(last->begin + kHeadBytes, length);
      if (!body) return pass_on(body);
      const std::string id = position_id(*body);
      again = again || (!id.empty() && !told.insert(id).second);
      found.push_back({last->begin, last->size});
    } else if (last->type.starts_with("RAW") && !samples) {
      samples = true;
      found.push_back({last->begin, last->size});
    }
    if ((samples && again) || last->begin <= from + kFrameBytes) break;
    last = ending_at(file, last->begin);
  }
  if (!last) return pass_on(last);
  std::reverse(found.begin(), found.end());
  return found;
}

}  // namespace sonar::simrad
