// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics.h"

#include <array>
#include <cstddef>

namespace sonar {
namespace {

constexpr auto kTable = std::to_array<DiagnosticEntry>({
#define DIAGNOSTIC(name, code, sentence) {DiagnosticCode::name, code, sentence},
#include "base/diagnostic_codes.inc"
#undef DIAGNOSTIC
});

}  // namespace

std::span<const DiagnosticEntry> diagnostic_table() { return kTable; }

std::string_view name(DiagnosticCode code) { return kTable.at(static_cast<std::size_t>(code)).name; }

}  // namespace sonar
