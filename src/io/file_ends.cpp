// SPDX-License-Identifier: Apache-2.0
#include "io/file_ends.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/ping_source.h"
#include "io/simrad/last_datagrams.h"

namespace sonar {
namespace {

constexpr std::uint64_t kLeastReach = std::uint64_t{256} << 10U;  ///< bytes; a configuration of 500 beams takes 160 kB
constexpr std::uint64_t kMostReach = std::uint64_t{16} << 20U;    ///< some pings
/// As far as navigation holds a fix unless told otherwise.
constexpr double kFixHolds_s = 30.0;

/// Some stretches of a file, one behind the other.
class Stretches final : public ByteSource {
 public:
  Stretches(const ByteSource& bytes, std::vector<simrad::Extent> stretches)
      : bytes_(bytes), stretches_(std::move(stretches)) {}

  [[nodiscard]] const std::string& name() const override { return bytes_.name(); }
  [[nodiscard]] Result<std::uint64_t> size() const override {
    std::uint64_t sum = 0;
    for (const simrad::Extent& one : stretches_) sum += one.size;
    return sum;
  }
  [[nodiscard]] Result<std::size_t> read(std::uint64_t offset, std::span<std::byte> out) const override {
    std::size_t done = 0;
    for (const simrad::Extent& one : stretches_) {
      if (done == out.size()) break;
      if (offset >= one.size) {
        offset -= one.size;
        continue;
      }
      const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(one.size - offset, out.size() - done));
      const auto got = bytes_.read(one.offset + offset, out.subspan(done, wanted));
      if (!got) return got;
      done += *got;
      if (*got < wanted) break;
      offset = 0;
    }
    return done;
  }

 private:
  const ByteSource& bytes_;
  std::vector<simrad::Extent> stretches_;
};

bool placed(const RawIndex& index, TimeNs time) {
  return std::any_of(index.navigation.begin(), index.navigation.end(), [&](const NavSeries& series) {
    return series.quantity == NavQuantity::position &&
           std::any_of(series.samples.begin(), series.samples.end(), [&](const NavSample& fix) {
             return std::abs(static_cast<double>(fix.time - time)) <= kFixHolds_s * 1e9;
           });
  });
}

/// Whether more of the file's beginning would tell nothing that is looked for there.
bool tells_beginning(const RawIndex& index, std::uint64_t head) {
  if (index.format != RawFormat::unknown && !index.gives_samples()) return true;
  return !index.pings.empty() && index.pings.front().offset < head && placed(index, index.pings.front().time);
}

/// A file's first bytes, and its last datagrams where they are known.
std::vector<simrad::Extent> ends_of(std::uint64_t size, std::uint64_t head, const std::vector<simrad::Extent>& last) {
  std::vector<simrad::Extent> ends{{0, head}};
  for (const simrad::Extent& one : last) {
    if (one.offset >= head) ends.push_back(one);
  }
  // Whoever was cut off in writing left no length word at the end.
  if (last.empty()) {
    const std::uint64_t from = std::max(head, size - std::min(size, kLeastReach));
    ends.push_back({from, size - from});
  }
  return ends;
}

}  // namespace

Result<RawIndex> index_ends(const ByteSource& bytes) {
  const auto size = bytes.size();
  if (!size) return pass_on(size);
  const auto last = simrad::last_datagrams(bytes, *size, std::max(kLeastReach, *size - std::min(*size, kMostReach)));
  if (!last) return pass_on(last);
  for (std::uint64_t reach = kLeastReach;; reach *= 4) {
    const std::uint64_t head = *size <= 4 * reach ? *size : reach;
    auto index = index_raw(Stretches(bytes, ends_of(*size, head, *last)));
    if (!index) return index;
    if (head < *size && reach < kMostReach && !tells_beginning(*index, head)) continue;
    index->size = *size;
    std::erase_if(index->diagnostics, [](const Diagnostic& note) {
      return note.code != DiagnosticCode::format_not_read && note.code != DiagnosticCode::not_recognised;
    });
    return index;
  }
}

}  // namespace sonar
