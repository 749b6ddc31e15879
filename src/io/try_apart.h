// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "base/result.h"

namespace sonar {

/// Runs something that may crash or hang on bad input (a library's parser) in a child process first. Its results are
/// lost; what counts is whether it comes to its end.
/// named    stands in messages
/// seconds  longer counts as hanging. A child that waits for a lock which some thread held when it was made is given up
///          after a twelfth of that and made again, twice at most.
/// errors   format: it crashed or hung; io: no child process could be made
/// threads  any that is not inside_library(); the caller holds the locks that body needs free in no other thread, and
///          body takes none
Result<void> try_apart(const std::function<void()>& body, const std::string& named, unsigned seconds = 60);

}  // namespace sonar
