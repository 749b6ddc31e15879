// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/ping.h"
#include "model/volume.h"
#include "pipeline/stages/load_volume.h"
#include "school/seabed/seabed.h"

namespace sonar {

// A reduced raw file holds what decides about its schools, and for each stored beam what was worked out from the whole
// ping: background, seabed, recorded length (ReducedRow), the water's own level, and which beams were missing or
// shorter than the others (ReducedChannel). What of a beam was left out counts as water without echo, never as faulty; a
// sample that was faulty in the whole ping holds kReducedFault.

/// Power count of a sample that was flagged as faulty before the file was reduced.
inline constexpr std::int16_t kReducedFault = -32767;

/// Whether a ping comes from a reduced file.
[[nodiscard]] bool is_reduced(std::span<const ChannelPing> heads);

/// Samples of each row in the whole ping; -1 where the file does not tell: then none were missing.
[[nodiscard]] std::vector<int> reduced_lengths(std::span<const ChannelPing> heads, std::span<const int> row_of_channel);

/// Puts a reduced ping's volume in the place of the whole one: what was left out becomes the weakest power there is,
/// without flags; faulty samples, those beyond a beam's recorded end and missing channels become kNoData and dropouts.
/// volume  as load_volume() gave it: power counts and flags
void open_reduced(std::span<const ChannelPing> heads, std::span<const int> row_of_channel, Volume& volume);

/// After calibration: beams that were left out have no calibration, but are water without echo as well.
void fill_reduced(Volume& volume);

/// Background of the whole ping by row; NaN where the ping has no such beam.
[[nodiscard]] std::vector<float> reduced_background_db(std::span<const ChannelPing> heads,
                                                       std::span<const int> row_of_channel);

/// The water's levels in the whole ping, and what lay above it; nothing is known, and nothing lies above it, where the file
/// does not tell or what it tells does not fit the grid.
/// shape  of the whole ping
[[nodiscard]] WaterLevels reduced_water(std::span<const ChannelPing> heads, const Shape3& shape);

/// The seabed of the whole ping: its plane where the file has it (files written before it was kept have none: then it
/// counts as not found), and where each row's began. A row without record has none.
/// samples  of the ping's rows
[[nodiscard]] Seabed reduced_seabed(std::span<const ChannelPing> heads, std::span<const int> row_of_channel,
                                    int samples);

/// Flags seabed from where it began in the whole ping on, plane or not; what lies in its beam-edge echo is water.
void flag_reduced_seabed(std::span<const ChannelPing> heads, std::span<const int> row_of_channel,
                         View3<SampleFlags> flags);

}  // namespace sonar
