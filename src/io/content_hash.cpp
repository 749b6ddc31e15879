// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/hash.h"
#include "io/raw_index.h"

namespace sonar {

Result<std::string> content_hash(const ByteSource& source) {
  constexpr std::size_t kBlock = 2U << 20U;
  Hasher hasher;
  std::vector<std::byte> bytes(kBlock);
  for (std::uint64_t offset = 0;;) {
    const auto got = source.read(offset, bytes);
    if (!got) return pass_on(got);
    hasher.add(std::span<const std::byte>(bytes).first(*got));
    offset += *got;
    if (*got < bytes.size()) return to_hex(hasher.value());
  }
}

}  // namespace sonar
