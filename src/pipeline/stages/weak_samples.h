// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/array.h"
#include "base/sample_flags.h"
#include "pipeline/stages/engine.h"

namespace sonar {

/// Flags of some rows of a ping, low_snr set where filtered Sv lies less than a margin above the expected background.
/// out     [fan][beam][sample] of the ping's shape; other rows stay as they are
/// cost    one pass over the rows
void flag_weak_rows(const StagedPing& ping, std::span<const int> rows, double margin_db, View3<SampleFlags> out);
/// The same of all rows.
void flag_weak(const StagedPing& ping, double margin_db, View3<SampleFlags> out);

/// Filtered Sv counts, but as recorded where samples were taken out for no other reason than these.
/// out     [fan][beam][sample]
/// cost    one pass over the ping
[[nodiscard]] Array3<std::int16_t> counts_put_back(const StagedPing& ping, SampleFlags reasons);

/// Filtered Sv above the expected background, dB; empty where one of them is not known.
[[nodiscard]] std::optional<double> signal_to_noise_db(const StagedPing& ping, int row, int sample);

}  // namespace sonar
