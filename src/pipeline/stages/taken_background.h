// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/stages/engine.h"

namespace sonar {

/// The background of every ping as a product of the engine's observation and recipe has it; estimated where it tells none.
/// errors  cancelled
[[nodiscard]] Result<void> take_background(Engine& engine, const ObservationProduct& product, Work& work);

}  // namespace sonar
