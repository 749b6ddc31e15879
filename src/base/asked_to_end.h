// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace sonar {

/// A descriptor that can be read from once the program was asked to end (SIGTERM, SIGINT, SIGHUP): a session that logs out, a
/// machine that shuts down. Asked a second time, the program ends at once. For programs that wait for events; -1 where the
/// system gives none.
/// threads  the first call before others are made
[[nodiscard]] int asked_to_end();

}  // namespace sonar
