// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/transfer_function_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "pipeline/recipe/json_file.h"

namespace sonar {
namespace {

Result<TransferPoint> point_from_json(const nlohmann::json& json, std::size_t index) {
  const auto wrong = [&](const char* expected) {
    return fail(ErrorCode::format, fmt::format("points[{}]: expected {}", index, expected));
  };
  if (!json.is_object()) return wrong("an object");
  if (!json.contains("sv_db") || !json["sv_db"].is_number()) return wrong("a number sv_db");
  if (!json.contains("opacity") || !json["opacity"].is_number()) return wrong("a number opacity");
  TransferPoint point;
  point.sv_db = json["sv_db"].get<double>();
  point.opacity = json["opacity"].get<double>();
  const auto rgb = json.find("rgb");
  if (rgb == json.end()) return point;
  if (!rgb->is_array() || rgb->size() != 3 ||
      !std::all_of(rgb->begin(), rgb->end(), [](const auto& c) { return c.is_number(); })) {
    return wrong("rgb with three numbers");
  }
  point.rgb = {(*rgb)[0].get<double>(), (*rgb)[1].get<double>(), (*rgb)[2].get<double>()};
  if (std::any_of(point.rgb.begin(), point.rgb.end(), [](double c) { return !(c >= 0.0 && c <= 255.0); })) {
    return wrong("rgb within 0 .. 1 or 0 .. 255");
  }
  if (std::any_of(point.rgb.begin(), point.rgb.end(), [](double c) { return c > 1.0; })) {
    for (double& c : point.rgb) c /= 255.0;
  }
  return point;
}

}  // namespace

Result<TransferFunction> transfer_function_from_json(const nlohmann::json& json) {
  if (!json.is_object()) return fail(ErrorCode::format, "a transfer function is a JSON object");
  const auto given = json.find("points");
  if (!json.contains("tf_version") && given != json.end() && given->is_array() && given->empty()) {
    return fail(ErrorCode::bad_parameter, "a transfer function needs at least one point");
  }
  if (auto version = check_version(json, "tf_version", kTransferFunctionVersion); !version) return pass_on(version);
  const auto points = json.find("points");
  if (points == json.end() || !points->is_array()) return fail(ErrorCode::format, "expected an array points");
  double length_m = 10.0;
  if (const auto length = json.find("opacity_length_m"); length != json.end()) {
    if (!length->is_number()) return fail(ErrorCode::format, "opacity_length_m: expected a number");
    length_m = length->get<double>();
  }
  std::vector<TransferPoint> made;
  for (const auto& point : *points) {
    auto read = point_from_json(point, made.size());
    if (!read) return pass_on(read);
    made.push_back(*read);
  }
  return TransferFunction::make(std::move(made), length_m);
}

nlohmann::json to_json(const TransferFunction& curve) {
  nlohmann::json points = nlohmann::json::array();
  for (const TransferPoint& point : curve.points()) {
    points.push_back({{"sv_db", point.sv_db}, {"opacity", point.opacity}, {"rgb", point.rgb}});
  }
  return {{"tf_version", kTransferFunctionVersion},
          {"opacity_length_m", curve.opacity_length_m()},
          {"points", std::move(points)}};
}

Result<TransferFunction> read_transfer_function(const std::string& path) {
  const auto json = read_json_file(path);
  if (!json) return pass_on(json);
  auto curve = transfer_function_from_json(*json);
  if (!curve) return fail(curve.error().code, curve.error().text, {path});
  return curve;
}

}  // namespace sonar
