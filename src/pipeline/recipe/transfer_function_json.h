// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"
#include "model/transfer_function.h"

namespace sonar {

inline constexpr int kTransferFunctionVersion = 1;

/// `{"tf_version":1,"opacity_length_m":10,"points":[{"sv_db":-70,"opacity":0,"rgb":[r,g,b]}, ...]}`; rgb 0..1, or 0..255
/// where a value is above 1.
/// errors  format: what is missing or of the wrong type; newer_version; bad_parameter: values out of range
[[nodiscard]] Result<TransferFunction> transfer_function_from_json(const nlohmann::json& json);
[[nodiscard]] nlohmann::json to_json(const TransferFunction& curve);
[[nodiscard]] Result<TransferFunction> read_transfer_function(const std::string& path);

}  // namespace sonar
