// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace sonar {

/// Whether this build watches its own memory or threads: its runtime reserves terabytes, and asks the system for more than
/// the program does.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace sonar
