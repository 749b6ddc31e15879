// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "pipeline/commands/state.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/measure_schools.h"
#include "pipeline/stages/placed_events.h"

namespace sonar {

struct StateProductOptions {
  ReadJournal journal;  ///< effective lines of the whole survey
  std::string program_version;
  bool background = false;  ///< with the background levels of all pings: what a file must hold, a window need not
  MeasuredPings* before = nullptr;  ///< of the same engine; null = everything is measured
  std::span<const RefusedEcho> refused =
      {};  ///< as detection told them: those that are no school in this state are kept
  std::span<const PlacedEvent> events = {};  ///< as detection noted them: what they are in this state is noted
};

/// What a state's schools measure: a product that is known before it is a file. School numbers are the state's, so that what a
/// window calls school 3 is school 3 in the tables.
/// engine   the background of the state's pings is estimated
/// errors   cancelled
[[nodiscard]] Result<ObservationProduct> state_product(Engine& engine, const JournalState& state,
                                                       const StateProductOptions& options, Work& work);

/// The same where no ping can be read: figures that a product has of the same masks, under the same
/// calibration, stay; others are not known. It says of no
/// raw files that it is made of them: its key is empty.
/// measured  the product that the state's schools were found in, see decided_schools()
[[nodiscard]] ObservationProduct state_product_of_results(const Engine& engine, const JournalState& state,
                                                          const ObservationProduct& measured);

/// Pings that state_product() would have to measure, rising: their backgrounds must be estimated before.
[[nodiscard]] std::vector<std::int64_t> pings_to_measure(const Engine& engine, const JournalState& state,
                                                         const MeasuredPings& before);

/// The schools that a product found: where the journal of its observation begins.
[[nodiscard]] std::vector<SchoolMasks> detected_schools(const ObservationProduct& product);
/// The same with what humans had decided of them when the product was made.
[[nodiscard]] std::vector<SchoolMasks> decided_schools(const ObservationProduct& product);

}  // namespace sonar
