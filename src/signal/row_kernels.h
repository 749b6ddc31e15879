// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/sample_flags.h"

namespace sonar {

// Vector kernels on one row of counts, chosen at run time for the processor.

/// counts += table, saturating to kMinCount..kMaxCount; kNoData on either side gives kNoData. Equal lengths.
void add_saturating(std::span<std::int16_t> counts, std::span<const std::int16_t> table);

/// The value of a given rank (0 = smallest) among `values`; exact. rank < values.size().
/// least, most  between which it is known to lie: the narrower, the faster
[[nodiscard]] std::int16_t select_rank(std::span<const std::int16_t> values, std::size_t rank,
                                       std::int16_t least = -32768, std::int16_t most = 32767);

/// How many samples are not kNoData.
[[nodiscard]] std::size_t count_data(std::span<const std::int16_t> counts);

/// Copies a row for the masked median: samples with a flag of kNotFiltered and kNoData become -32767 where
/// parity + index is even and +32767 where it is odd. Returns true where any was replaced. Equal lengths.
bool mask_row(std::span<const std::int16_t> counts, std::span<const SampleFlags> flags, int parity,
              std::span<std::int16_t> out);

/// Sets out to kNoData where a flag of kNeverMember stands, and where |out| = 32767. Equal lengths.
void drop_never_members(std::span<const SampleFlags> flags, std::span<std::int16_t> out);

/// ORs `flag` into flags where counts < limit and counts is data. Equal lengths.
void flag_below(std::span<const std::int16_t> counts, std::int16_t limit, SampleFlags flag,
                std::span<SampleFlags> flags);
/// The same with a limit for each sample.
void flag_below(std::span<const std::int16_t> counts, std::span<const std::int16_t> limit, SampleFlags flag,
                std::span<SampleFlags> flags);

/// One bit a sample, lowest first: counts[i] >= limit[i] (limit[0] alone if `limit` has one element), never for
/// kNoData. bits holds (counts.size() + 63) / 64 words.
void threshold_bits(std::span<const std::int16_t> counts, std::span<const std::int16_t> limit,
                    std::span<std::uint64_t> bits);

}  // namespace sonar
