// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace sonar {

/// Lets screen readers read what picture views show: what Qt paints itself it can tell, what is painted here it cannot.
void tell_screen_readers_of_pictures();

}  // namespace sonar
