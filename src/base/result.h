// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace sonar {

/// Why an operation could not be done. Each has one line in the message table of result.cpp.
enum class ErrorCode {
  usage,          ///< the caller asked for something that makes no sense
  not_found,      ///< a file, folder or named thing is not there
  io,             ///< the operating system refused to read or write
  format,         ///< the bytes are not what the format says
  unsupported,    ///< recognised, but not read by this version
  newer_version,  ///< written by a newer version of this program
  older_version,  ///< written by an older version whose results must be made again
  bad_parameter,  ///< a parameter is outside its range
  mismatch,       ///< two inputs do not belong together
  no_space,       ///< the disk is too small for the result
  cancelled,      ///< stopped on request
};

/// Whether the system refused: nothing is said of the bytes, and the next try may read them.
[[nodiscard]] constexpr bool is_of_system(ErrorCode code) {
  return code == ErrorCode::io || code == ErrorCode::not_found || code == ErrorCode::no_space;
}

/// Where it happened; unset members are left out of the message.
struct Where {
  std::string file;
  std::int64_t offset = -1;  ///< byte offset in `file`
  std::int64_t ping = -1;    ///< ping index in its observation
};

struct Error {
  ErrorCode code;
  std::string text;
  Where where;
};

/// Short name of a code, as it stands in messages and JSON.
[[nodiscard]] std::string_view name(ErrorCode code);

/// A file's name may hold line ends and a terminal's commands: control characters as '?'.
[[nodiscard]] std::string printable(std::string text);

/// The one line a user sees: "file: byte 12: ping 3: text", printable.
[[nodiscard]] std::string to_line(const Error& error);

/// A value, or the reason why there is none.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
 public:
  using tl::expected<T, Error>::expected;
};

[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string text, Where where = {}) {
  return tl::unexpected<Error>(Error{code, std::move(text), std::move(where)});
}

/// Hands the error of one result on as the error of another.
template <class T>
[[nodiscard]] tl::unexpected<Error> pass_on(const Result<T>& result) {
  return tl::unexpected<Error>(result.error());
}

}  // namespace sonar
