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
constexpr std::uint64_t kReachForPosition = std::uint64_t{1} << 20U;
constexpr std::uint64_t kMostReach = std::uint64_t{16} << 20U;  ///< some pings
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
      auto got = bytes_.read(one.offset + offset, out.subspan(done, wanted));
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

/// Whether more of the file's beginning would tell nothing that is looked for there. A position stands near the first ping, or
/// nobody tells any.
bool tells_beginning(const RawIndex& index, std::uint64_t head) {
  if (index.format != RawFormat::unknown && !index.gives_samples()) return true;
  return !index.pings.empty() && (head >= kReachForPosition || placed(index, index.pings.front().time));
}

/// A file's first bytes, and its last datagrams where they are known.
std::vector<simrad::Extent> ends_of(std::uint64_t size, std::uint64_t head, const std::vector<simrad::Extent>& last) {
  std::vector<simrad::Extent> ends{{0, head}};
  for (const simrad::Extent& one : last) {
    if (one.offset >= head) ends.push_back(one);
  }
  if (last.empty() && head < size) {
    const std::uint64_t from = std::max(head, size - std::min(size, kLeastReach));
    ends.push_back({from, size - from});
  }
  return ends;
}

/// As much of a file's beginning as is needed.
Result<std::uint64_t> head_of(const ByteSource& bytes, std::uint64_t size, RawIndex& index) {
  for (std::uint64_t reach = kLeastReach;; reach *= 4) {
    const std::uint64_t head = size <= 4 * reach ? size : reach;
    auto first = index_raw(Stretches(bytes, {{0, head}}));
    if (!first) return pass_on(first);
    index = std::move(*first);
    if (head == size || reach >= kMostReach || tells_beginning(index, head)) return head;
  }
}

}  // namespace

Result<RawIndex> index_ends(const ByteSource& bytes) {
  const auto size = bytes.size();
  if (!size) return pass_on(size);
  RawIndex index;
  const auto head = head_of(bytes, *size, index);
  if (!head) return pass_on(head);
  if (*head < *size) {
    const bool positions = std::any_of(index.navigation.begin(), index.navigation.end(), [](const NavSeries& series) {
      return series.quantity == NavQuantity::position;
    });
    const std::uint64_t from = std::max(*head, *size - std::min(*size, kMostReach));
    const auto last = simrad::last_datagrams(bytes, *size, from, positions);
    if (!last) return pass_on(last);
    auto both = index_raw(Stretches(bytes, ends_of(*size, *head, *last)));
    if (!both) return both;
    index = std::move(*both);
  }
  index.size = *size;
  std::erase_if(index.diagnostics, [](const Diagnostic& note) {
    return note.code != DiagnosticCode::format_not_read && note.code != DiagnosticCode::not_recognised;
  });
  return index;
}

}  // namespace sonar
