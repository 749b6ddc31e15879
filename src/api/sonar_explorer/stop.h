// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace sonar_explorer {

/// Ends what runs in this process now, in whatever threads: the calls throw Error of kind "cancelled". What begins later
/// is not touched.
/// threads  any; not for signal handlers
void stop_running();

}  // namespace sonar_explorer
