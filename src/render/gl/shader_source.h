// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace sonar {

/// Text of a file in render/gl/shaders, embedded at build time; empty where there is none of that name.
[[nodiscard]] std::string_view shader_source(std::string_view name);

}  // namespace sonar
