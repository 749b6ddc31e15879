// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/result.h"
#include "io/child_process.h"

// What a child process and we say to each other: values as they lie in memory, both being one program.

namespace sonar::wire {

using Bytes = std::vector<std::byte>;

template <class T>
[[nodiscard]] std::span<std::byte> bytes_of(T& value) {
  return std::as_writable_bytes(std::span(&value, 1));
}

template <class T>
  requires std::is_trivially_copyable_v<T>
void put(Bytes& out, const T& value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

template <class T>
  requires std::is_trivially_copyable_v<T>
[[nodiscard]] Bytes encoded(const T& value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  return {bytes.begin(), bytes.end()};
}
template <class T>
[[nodiscard]] Bytes encoded(const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}
[[nodiscard]] Bytes encoded(const std::string& text);
[[nodiscard]] Bytes encoded(const std::vector<std::string>& texts);

// What comes back is no more to be trusted than the file that was parsed: empty where it is not what was asked for.

template <class T>
  requires std::is_trivially_copyable_v<T>
[[nodiscard]] std::optional<T> decoded(std::span<const std::byte> bytes, const T* /*kind*/) {
  T value{};
  if (bytes.size() != sizeof(T)) return std::nullopt;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}
template <class T>
[[nodiscard]] std::optional<std::vector<T>> decoded(std::span<const std::byte> bytes, const std::vector<T>* /*kind*/) {
  if (bytes.size() % sizeof(T) != 0) return std::nullopt;
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}
[[nodiscard]] std::optional<std::string> decoded(std::span<const std::byte> bytes, const std::string* /*kind*/);
[[nodiscard]] std::optional<std::vector<std::string>> decoded(std::span<const std::byte> bytes,
                                                              const std::vector<std::string>* /*kind*/);
template <class T>
[[nodiscard]] std::optional<T> decoded(std::span<const std::byte> bytes) {
  return decoded(bytes, static_cast<const T*>(nullptr));
}

/// The child's first words: that it is alive and holds no lock in vain. False where nobody listens.
[[nodiscard]] bool greet(int stream);
/// The child's side: something, or why there is nothing. False where nobody listens.
[[nodiscard]] bool tell(int stream, const Result<void>& status, const Bytes& said);

/// Our side. Waits for what is told next.
/// most    bytes; more is not taken
/// errors  what the child tells, as format, mismatch, newer_version or older_version; format: it broke; io: it kept silent for
///         so long
[[nodiscard]] Result<Bytes> hear(const ChildProcess& child, std::uint64_t most, unsigned seconds = 60);

struct Begun {
  ChildProcess child;
  Bytes said;
};

/// Makes a child, which greets, and hears the first thing that it tells. One that waits for a lock which some thread held when
/// it was made (a thread's end, the C library's own: no gate knows of them) never greets: it is given up after a twelfth of
/// the time and made again, at another moment, twice at most.
/// make    called for each
/// errors  as hear(); io: no child process could be made
[[nodiscard]] Result<Begun> begin(const std::function<Result<ChildProcess>()>& make, std::uint64_t most,
                                  unsigned seconds = 60);

}  // namespace sonar::wire
