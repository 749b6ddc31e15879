// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "session/review/review.h"

namespace sonar {
namespace {

using Quantity = BulkRule::Quantity;
using Sign = BulkRule::Sign;

constexpr std::array<std::pair<std::string_view, Quantity>, 8> kQuantities{{{"pings", Quantity::pings},
                                                                            {"snr", Quantity::snr_db},
                                                                            {"edge", Quantity::edge_share},
                                                                            {"volume", Quantity::volume_m3},
                                                                            {"depth", Quantity::depth_m},
                                                                            {"length", Quantity::length_m},
                                                                            {"sv", Quantity::sv_db},
                                                                            {"backscatter", Quantity::backscatter_m2}}};
constexpr std::array<std::pair<std::string_view, Sign>, 5> kSigns{
    {{"<=", Sign::at_most}, {">=", Sign::at_least}, {"<", Sign::less}, {">", Sign::more}, {"=", Sign::equal}}};
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kVerbs{
    {{"accept", "accepted"}, {"reject", "rejected"}, {"unreview", "unreviewed"}}};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto [after, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || after != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<BulkRule::Condition> condition_of(std::string_view text) {
  if (text == "no edge") return BulkRule::Condition{Quantity::edge_share, Sign::equal, 0.0};
  for (const auto& [word, sign] : kSigns) {
    const auto at = text.find(word);
    if (at == std::string_view::npos) continue;
    const std::string_view name = trimmed(text.substr(0, at));
    const auto quantity =
        std::find_if(kQuantities.begin(), kQuantities.end(), [&](const auto& one) { return one.first == name; });
    const auto limit = number_of(trimmed(text.substr(at + word.size())));
    if (quantity == kQuantities.end() || !limit) break;
    return BulkRule::Condition{quantity->second, sign, *limit};
  }
  return fail(ErrorCode::usage,
              fmt::format("\"{}\" is no condition; expected \"no edge\", or one of pings, snr, edge, volume, depth, "
                          "length, sv, backscatter with <, <=, >, >=, = and a number",
                          text));
}

double value_of(Quantity quantity, const SurveySchool& school) {
  const auto figure = [&](double SchoolRow::*member) { return school.row == nullptr ? kUnknown : school.row->*member; };
  switch (quantity) {
    case Quantity::pings:
      return static_cast<double>(school.pings());
    case Quantity::snr_db:
      return school.snr_db();
    case Quantity::edge_share:
      return school.edge_share();
    case Quantity::volume_m3:
      return figure(&SchoolRow::volume_m3);
    case Quantity::depth_m:
      return figure(&SchoolRow::depth_m);
    case Quantity::length_m:
      return figure(&SchoolRow::length_m);
    case Quantity::sv_db:
      return figure(&SchoolRow::sv_mean_db);
    case Quantity::backscatter_m2:
      return school.backscatter_m2();
  }
  return kUnknown;
}

/// NaN holds against none.
bool holds(double value, const BulkRule::Condition& condition) {
  switch (condition.sign) {
    case Sign::less:
      return value < condition.limit;
    case Sign::at_most:
      return value <= condition.limit;
    case Sign::more:
      return value > condition.limit;
    case Sign::at_least:
      return value >= condition.limit;
    case Sign::equal:
      return value == condition.limit;
  }
  return false;
}

/// Limits of lengths are metres from here on, and the text says what they were.
void take_lengths(BulkRule& rule, const Unit& length) {
  bool any = false;
  for (BulkRule::Condition& condition : rule.conditions) {
    if (condition.quantity != Quantity::depth_m && condition.quantity != Quantity::length_m) continue;
    condition.limit *= length.si;
    any = true;
  }
  if (any && length.si != 1.0) rule.text += fmt::format(" (lengths in {})", length.name);
}

}  // namespace

Result<BulkRule> bulk_rule(std::string_view text, const Unit& length) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto arrow = small.find("->");
  if (arrow == std::string::npos) {
    return fail(
        ErrorCode::usage,
        fmt::format("\"{}\" says not what to do; expected \"... -> accept\" or \"... -> reject\"", trimmed(small)));
  }
  BulkRule rule;
  rule.text = std::string(trimmed(text));
  const std::string_view verb = trimmed(std::string_view(small).substr(arrow + 2));
  const auto known = std::find_if(kVerbs.begin(), kVerbs.end(), [&](const auto& one) { return one.first == verb; });
  if (known == kVerbs.end()) {
    return fail(ErrorCode::usage, fmt::format("\"{}\": expected accept, reject or unreview behind ->", verb));
  }
  rule.status = std::string(known->second);
  std::string_view rest = trimmed(std::string_view(small).substr(0, arrow));
  if (rest.empty()) return fail(ErrorCode::usage, "a rule without a condition would take every school");
  for (bool more = true; more;) {
    const auto comma = rest.find(',');
    more = comma != std::string_view::npos;
    const auto condition = condition_of(trimmed(rest.substr(0, comma)));
    if (!condition) return pass_on(condition);
    rule.conditions.push_back(*condition);
    if (more) rest.remove_prefix(comma + 1);
  }
  take_lengths(rule, length);
  return rule;
}

bool meets(const BulkRule& rule, const SurveySchool& school) {
  return std::all_of(rule.conditions.begin(), rule.conditions.end(),
                     [&](const auto& condition) { return holds(value_of(condition.quantity, school), condition); });
}

}  // namespace sonar
