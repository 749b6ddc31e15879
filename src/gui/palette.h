// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace sonar {

/// The application's palette: light, or dark for night watches. Pictures have themes of their own that match.
void take_theme(bool dark);

}  // namespace sonar
