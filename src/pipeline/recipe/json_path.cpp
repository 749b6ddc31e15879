// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/json_path.h"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

namespace sonar {
namespace {

constexpr std::string_view kScheme = "file://";
constexpr std::string_view kUnreserved = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";

bool is_utf8(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::type_error&) {
    // The library tells it only by exception; it ends here.
    return false;
  }
}

}  // namespace

std::string json_text_of(const std::filesystem::path& path) {
  const std::string bytes = path.string();
  if (is_utf8(bytes)) return bytes;
  std::string uri(kScheme);
  for (const char c : bytes) {
    uri += kUnreserved.find(c) != kUnreserved.npos ? std::string(1, c)
                                                   : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

std::filesystem::path path_of_json(const std::string& text) {
  if (!text.starts_with(kScheme)) return text;
  const std::string_view uri = std::string_view(text).substr(kScheme.size());
  std::string bytes;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    const char* digits = uri.data() + i + 1;
    const bool escaped =
        uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2;
    bytes += escaped ? static_cast<char>(value) : uri[i];
    if (escaped) i += 2;
  }
  return bytes;
}

}  // namespace sonar
