// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/sample_flags.h"

namespace sonar {

// Vector kernels of the noise flags, chosen at run time for the processor.

/// out = counts - offset, saturating and never below -32767; kNoData where a flag of `mask` stands or there is no data.
/// Equal lengths.
void copy_unflagged(std::span<const std::int16_t> counts, std::span<const SampleFlags> flags, SampleFlags mask,
                    std::int16_t offset, std::span<std::int16_t> out);

/// ORs `dropout` into the flags of samples that hold no data. Equal lengths.
void flag_no_data(std::span<const std::int16_t> counts, std::span<SampleFlags> flags);

/// Sum and number of the data in each block of a row; the last block may be short.
/// in      sums, numbers: ceil(counts.size() / block) each
void block_sums(std::span<const std::int16_t> counts, std::size_t block, std::span<std::int32_t> sums,
                std::span<std::int32_t> numbers);

/// For each sample the value that a share 1 - fraction of the rows reach, to 32 counts (0.4 dB), rounded down; kNoData
/// where fewer than minimum_rows rows hold data.
/// in      counts [row][sample], at most 32767 rows; out [sample]
void quantile_over_rows(const std::int16_t* counts, int rows, int samples, double fraction, int minimum_rows,
                        std::int16_t* out);

/// One bit a sample, lowest first: counts[i] > threshold + the largest of the samples 3 to 6 before and after it.
/// The first and last 6 samples never are. bits holds (counts.size() + 63) / 64 words.
void peak_bits(std::span<const std::int16_t> counts, std::int16_t threshold, std::span<std::uint64_t> bits);

}  // namespace sonar
