// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "io/simrad/test_bytes.h"

namespace sonar::test {

/// A recording of a sounder with 38 and 120 kHz, 30 pings a second apart of 300 equal samples each; for tests.
inline void write_ek60(const std::filesystem::path& file, TimeNs start) {
  Con0Spec con0_spec;
  con0_spec.sounder = "ER60";
  con0_spec.beams = {{38'000.0F, 0.0F, 0.0F, 25.0F, -20.5F}, {120'000.0F, 0.0F, 0.0F, 27.0F, -21.0F}};
  Bytes bytes = con0(con0_spec, start);
  for (int ping = 0; ping < 30; ++ping) {
    for (int channel = 1; channel <= 2; ++channel) {
      Raw0Spec spec;
      spec.channel = channel;
      spec.frequency_hz = channel == 1 ? 38'000.0F : 120'000.0F;
      spec.transducer_depth_m = 6.0F;
      bytes.add(raw0(start + ping * kSecondNs, spec, std::vector<std::int16_t>(300, -9000)));
    }
  }
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace sonar::test
