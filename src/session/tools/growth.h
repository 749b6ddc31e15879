// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "base/result.h"
#include "model/mask.h"
#include "session/looks/display.h"
#include "session/open/document.h"
#include "session/open/workspace.h"
#include "view/slices/slice.h"

namespace sonar {

/// A growth that is looked at before anybody asks for it: everything that it depends on, so that it may run anywhere.
struct GrowthTrial {
  OpenObservationPtr observation;
  StagedPingPtr ping;
  JournalStatePtr state;  ///< the one that the growth would be done upon; null = no schools yet
  GrowCommand command;
};

/// The voxels that the command would add to a school, or take from one: what the command itself then does.
/// errors   bad_parameter: why nothing grows, in one line
/// threads  pure
[[nodiscard]] Result<PingMask> try_growth(const GrowthTrial& trial);

/// Why a plain click's seed would grow nothing: the growth curve is 0 there, as over most of the water. Empty where it
/// is not, or something else is in the way.
[[nodiscard]] std::string too_weak(const Volume& filtered, const BeamGrid& grid, const GrowCommand& command);

/// "1 204 voxels, 3.1e4 m3, mean -48.2 dB": mean of the measured members, linear, weighted by their volumes, the expected
/// background taken off, as the table of schools has it.
[[nodiscard]] std::string growth_text(const PingMask& mask, const StagedPing& ping, const Sector& sector);

/// try_growth() as views show it; a refusal is the preview's text.
[[nodiscard]] Preview preview_of(const GrowthTrial& trial);

[[nodiscard]] GrowParams grow_params(const SelectParams& params);
/// A propagation as the control panel has it, both ways as far as its reach; the school is still to be named.
[[nodiscard]] PropagateCommand propagation_as_set(const Workspace& workspace);
[[nodiscard]] SeedKey seed_key(const OpenObservation& observation, const Voxel& voxel);
/// The member of a school from which it grows best: the loudest of the filtered ping; of several the first.
/// Empty where no member may be a seed.
[[nodiscard]] std::optional<SeedKey> best_seed(const PingMask& mask, const Volume& filtered, const BeamGrid& grid);
/// The state of an observation; null before it is known.
[[nodiscard]] JournalStatePtr state_of(const Document& document, std::size_t observation);
/// Index of the school that has a voxel of a ping; empty where nobody has it.
[[nodiscard]] std::optional<std::size_t> school_of_voxel(const JournalState& state, std::int64_t ping_index,
                                                         const Sector& sector, const Voxel& voxel);

}  // namespace sonar
