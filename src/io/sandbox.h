// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

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

/// What a process in the sandbox still reaches beside its own memory and one stream.
enum class Reach : std::uint8_t {
  nothing,       ///< every other file that was open is closed
  files_to_read  ///< files may be opened and read, as a library needs that looks things up; none is written or made
};

/// Gives up, for the rest of this process, all that a parser of somebody else's bytes has no need of: files, the network,
/// programs and children, and memory beyond a limit. What is tried all the same fails. Where the kernel knows no seccomp
/// the limits alone hold.
/// stream        that may be written to; the standard ones lead nowhere
/// memory_bytes  that may be taken from now on
/// out           whether the kernel watches the calls
bool enter_sandbox(int stream, Reach reach, std::uint64_t memory_bytes);

}  // namespace sonar
