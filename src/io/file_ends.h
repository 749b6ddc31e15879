// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "io/byte_source.h"
#include "io/raw_index.h"

namespace sonar {

/// The index of a file's first and last bytes, as if nothing lay between them: what it is, whose, from when to when, and where
/// the ship was at both ends. Of the beginning 256 kB are read, up to 1 MB where a position near the first ping is not among
/// them, up to 16 MB where there is no ping; of the end as much as last_datagrams() takes. Counts and the hash are those of what was read, `size` is the file's.
/// Nothing is said of damage: what lies behind the first bytes stands at other places than the index says.
/// errors  io
[[nodiscard]] Result<RawIndex> index_ends(const ByteSource& bytes);

}  // namespace sonar
