// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "base/sample_flags.h"

namespace sonar {

/// The steps of flag_ping() in the order in which they are taken, each by the one reason that it gives: later ones pass over
/// what earlier ones flagged. Since a step adds its own reason alone and none is cleared, the flags of a ping tell what each
/// of its steps did.
inline constexpr std::array<SampleFlags, 6> kFlagSteps{SampleFlags::near_field,   SampleFlags::surface,
                                                       SampleFlags::dropout,      SampleFlags::corrupted,
                                                       SampleFlags::interference, SampleFlags::impulse};

}  // namespace sonar
