// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sonar {

/// Stable codes of everything that can be wrong with data; the table is diagnostic_codes.inc.
enum class DiagnosticCode {
#define DIAGNOSTIC(name, code, sentence) name,
#include "base/diagnostic_codes.inc"
#undef DIAGNOSTIC
};

/// One remark about bad or doubtful data; it travels with the value it concerns.
struct Diagnostic {
  DiagnosticCode code{};
  std::string file;              ///< as the user named it; empty when no file is concerned
  std::int64_t offset = -1;      ///< byte offset, -1 = none
  std::int64_t ping_index = -1;  ///< in its observation, -1 = none
  std::string text;              ///< what was found and what was expected
};

using Diagnostics = std::vector<Diagnostic>;

struct DiagnosticEntry {
  DiagnosticCode code;
  std::string_view name;      ///< the stable code, e.g. "file-truncated"
  std::string_view sentence;  ///< what it means
};

[[nodiscard]] std::span<const DiagnosticEntry> diagnostic_table();
[[nodiscard]] std::string_view name(DiagnosticCode code);

}  // namespace sonar
