// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/ek80_channels.h"

#include <cstddef>
#include <set>
#include <string>

#include "io/simrad/fields.h"
#include "io/simrad/scanner.h"

namespace sonar::simrad {

Result<std::int64_t> ek80_channels(const ByteSource& source) {
  constexpr std::size_t kNameBytes = 128;
  constexpr std::size_t kMostChannels = 1000;
  std::set<std::string> names;
  const auto take_in = [&](const Datagram& datagram) {
    if (datagram.type != "RAW3" || datagram.body.size() < kNameBytes || names.size() >= kMostChannels) return;
    names.insert(text_at(datagram.body, 0, kNameBytes));
  };
  Scanner scanner;
  Notes notes;  // the index has told them
  if (auto scanned = scanner.scan(source, take_in, notes); !scanned) return pass_on(scanned);
  if (auto scanned = scanner.finish(source, take_in, notes); !scanned) return pass_on(scanned);
  return static_cast<std::int64_t>(names.size());
}

}  // namespace sonar::simrad
