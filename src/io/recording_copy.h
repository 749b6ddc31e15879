// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "base/result.h"
#include "base/time.h"
#include "io/byte_source.h"
#include "io/raw_file_writer.h"
#include "model/ping.h"

namespace sonar {

/// What is to stand in place of a channel of the ping of that time; empty = it goes.
/// recorded  its head, without samples
/// out       its samples are looked at before the next call only
using ChannelInPlace = std::function<Result<std::optional<ChannelPing>>(TimeNs time, const ChannelPing& recorded)>;

/// Writes a recording anew, other channels in place of its own; all that is no sample data stays as it is.
/// errors  io, no_space; those of `in_place`
[[nodiscard]] Result<void> copy_recording(const ByteSource& source, const ChannelInPlace& in_place, RawFileWriter& out);

}  // namespace sonar
