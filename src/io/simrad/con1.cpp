// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/con1.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <pugixml.hpp>

namespace sonar::simrad {
namespace {

std::vector<double> parse_list(std::string_view text) {
  std::vector<double> values;
  while (!text.empty()) {
    const std::size_t cut = std::min(text.find(';'), text.size());
    std::string_view item = text.substr(0, cut);
    text.remove_prefix(std::min(cut + 1, text.size()));
    const auto first = item.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) {
      // A trailing separator is common; an empty item between two is not a number.
      if (text.empty()) break;
      return {};
    }
    item = item.substr(first, item.find_last_not_of(" \t\r\n") - first + 1);
    if (item.front() == '+') item.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    if (error != std::errc{} || end != item.data() + item.size() || !std::isfinite(value)) return {};
    values.push_back(value);
  }
  return values;
}

std::vector<double> list_of(const pugi::xml_node& arrays, const char* name) {
  if (const auto attribute = arrays.attribute(name)) return parse_list(attribute.value());
  for (const pugi::xml_node& child : arrays.children()) {
    if (std::strcmp(child.attribute("name").value(), name) == 0) {
      const auto value = child.attribute("value");
      return parse_list(value ? value.value() : child.child_value());
    }
  }
  return {};
}

}  // namespace

Con1 parse_con1(std::string_view xml) {
  Con1 con1;
  // A tree takes twenty times what its text does; a sounder's has some hundred kilobytes.
  constexpr std::size_t kMostXml = 4U << 20U;
  xml = xml.substr(0, xml.find('\0'));
  if (xml.size() > kMostXml) return con1;
  pugi::xml_document document;
  // The outcome is not asked: what stands before a fault is in the tree, and every list is checked by its length.
  static_cast<void>(document.load_buffer(xml.data(), xml.size(), pugi::parse_default, pugi::encoding_auto));
  const pugi::xml_node arrays =
      document.find_node([](const pugi::xml_node& node) { return std::strcmp(node.name(), "BeamArrays") == 0; });
  if (!arrays) return con1;
  con1.readable = true;
  con1.steering_rx_x = list_of(arrays, "SteeringRxX");
  con1.steering_rx_y = list_of(arrays, "SteeringRxY");
  con1.frequency_tx = list_of(arrays, "FrequencyTx");
  con1.frequency_rx = list_of(arrays, "FrequencyRx");
  return con1;
}

Con1Outcome apply_con1(const Con1& con1, SounderConfig& config) {
  Con1Outcome outcome;
  const std::size_t n = config.beams.size();
  if (!con1.readable) {
    outcome.problem = "CON1 has no readable BeamArrays";
    return outcome;
  }
  if (con1.steering_rx_x.size() != n || con1.steering_rx_y.size() != n || n == 0) {
    outcome.problem = fmt::format("CON1 has {} and {} steering angles for {} beams", con1.steering_rx_x.size(),
                                  con1.steering_rx_y.size(), n);
    return outcome;
  }
  for (std::size_t i = 0; i < n; ++i) {
    auto& direction = config.beams[i].direction_deg;
    const double change =
        std::max(std::abs(direction[0] - con1.steering_rx_x[i]), std::abs(direction[1] - con1.steering_rx_y[i]));
    outcome.largest_change = std::max(outcome.largest_change, std::isnan(change) ? 360.0 : change);
    direction[0] = con1.steering_rx_x[i];
    direction[1] = con1.steering_rx_y[i];
  }
  outcome.used = true;
  return outcome;
}

}  // namespace sonar::simrad
