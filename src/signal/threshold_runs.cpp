// SPDX-License-Identifier: Apache-2.0
#include "signal/threshold_runs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "signal/row_kernels.h"

namespace sonar {

namespace {

constexpr std::size_t kWords = 32;  // a row goes through the bits in pieces of 2048 samples

/// Appends the runs of set bits; one that starts where the last of `runs` ended in this row goes on with it.
void append_from_bits(std::span<const std::uint64_t> bits, std::size_t start, std::size_t row_begin,
                      std::vector<SampleRun>& runs) {
  for (std::size_t word = 0; word < bits.size(); ++word) {
    std::uint64_t left = bits[word];
    int at = 0;
    while (left != 0) {
      const int skip = std::countr_zero(left);
      left >>= skip;
      const int length = std::countr_one(left);
      at += skip;
      const auto first = static_cast<std::int32_t>(start + word * 64) + at;
      if (runs.size() > row_begin && runs.back().first + runs.back().count == first) {
        runs.back().count += length;
      } else {
        runs.push_back({first, length});
      }
      at += length;
      left = length < 64 ? left >> length : 0;
    }
  }
}

}  // namespace

void append_runs(std::span<const std::int16_t> counts, std::int16_t limit, std::vector<SampleRun>& runs) {
  const std::size_t row_begin = runs.size();
  std::array<std::uint64_t, kWords> bits;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  for (std::size_t start = 0; start < counts.size(); start += kWords * 64) {
    const auto piece = counts.subspan(start, std::min(kWords * 64, counts.size() - start));
    const auto words = std::span(bits).first((piece.size() + 63) / 64);
    // A single limit of kNoData would admit nothing; as a value it means "all data".
    const std::int16_t bound = std::max<std::int16_t>(limit, -32767);
    threshold_bits(piece, {&bound, 1}, words);
    append_from_bits(words, start, row_begin, runs);
  }
}

void append_runs(std::span<const std::int16_t> counts, std::span<const std::int16_t> limit,
                 std::vector<SampleRun>& runs) {
  const std::size_t row_begin = runs.size();
  const std::size_t size = std::min(counts.size(), limit.size());
  std::array<std::uint64_t, kWords> bits;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  for (std::size_t start = 0; start < size; start += kWords * 64) {
    const std::size_t length = std::min(kWords * 64, size - start);
    const auto words = std::span(bits).first((length + 63) / 64);
    if (length == 1) {  // a limit of one element would mean one limit for all
      bits[0] = counts[start] >= limit[start] && limit[start] > -32768 ? 1 : 0;
    } else {
      threshold_bits(counts.subspan(start, length), limit.subspan(start, length), words);
    }
    append_from_bits(words, start, row_begin, runs);
  }
}

}  // namespace sonar
