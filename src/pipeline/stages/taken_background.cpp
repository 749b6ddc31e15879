// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/taken_background.h"

#include <cstddef>
#include <cstdint>

namespace sonar {

Result<void> take_background(Engine& engine, const ObservationProduct& product, Work& work) {
  if (product.background_db.empty()) return engine.estimate_background(0, engine.pings() - 1, work);
  for (std::size_t i = 0; i < product.background_db.size(); ++i) {
    engine.give_background(static_cast<std::int64_t>(i), product.background_db[i]);
  }
  return {};
}

}  // namespace sonar
