// SPDX-License-Identifier: Apache-2.0
#include "base/result.h"

#include <fmt/format.h>

#include <algorithm>

namespace sonar {

std::string_view name(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage:
      return "usage";
    case ErrorCode::not_found:
      return "not found";
    case ErrorCode::io:
      return "input/output";
    case ErrorCode::format:
      return "format";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::newer_version:
      return "newer version";
    case ErrorCode::older_version:
      return "older version";
    case ErrorCode::bad_parameter:
      return "bad parameter";
    case ErrorCode::mismatch:
      return "mismatch";
    case ErrorCode::no_space:
      return "no space";
    case ErrorCode::cancelled:
      return "cancelled";
  }
  return "unknown";
}

std::string printable(std::string text) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), is_control, '?');
  return text;
}

std::string to_line(const Error& error) {
  std::string line;
  if (!error.where.file.empty()) line += error.where.file + ": ";
  if (error.where.offset >= 0) line += fmt::format("byte {}: ", error.where.offset);
  if (error.where.ping >= 0) line += fmt::format("ping {}: ", error.where.ping);
  return printable(line + error.text);
}

}  // namespace sonar
