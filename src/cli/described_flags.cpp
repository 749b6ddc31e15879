// SPDX-License-Identifier: Apache-2.0
#include "cli/described_flags.h"

#include <cctype>

#include "cli/numbers.h"

namespace sonar {

std::string with_dashes(std::string_view name) {
  std::string out(name);
  std::replace(out.begin(), out.end(), '_', '-');
  return out;
}

std::string DescribedFlags::sentence(std::string_view text) {
  std::string out(text);
  if (!out.empty()) out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out;
}

std::string DescribedFlags::flag_of(std::string_view name, const FieldInfo& info) {
  return "--" + (info.flag.empty() ? with_dashes(name) : std::string(info.flag));
}

void DescribedFlags::add(CLI::Option* option, std::string_view suits) {
  option->group(group_);
  made_.push_back({option->get_name(), suits.empty() ? suits_ : std::string(suits)});
}

void DescribedFlags::field(std::string_view name, bool& value, const FieldInfo& info) {
  if (info.flag == kNoFlag) return;
  if (!value) return add(verb_.add_flag(flag_of(name, info), value, sentence(info.text)), info.suits);
  const std::string off = info.flag.empty() ? "--no-" + with_dashes(name) : flag_of(name, info);
  if (info.flag.empty()) {
    // Scripts may say what is so anyway.
    add(verb_.add_flag("--" + with_dashes(name), value), info.suits);
    verb_.get_option("--" + with_dashes(name))->group("");
  }
  add(verb_.add_flag(off + "{false}", value, "Do not " + std::string(info.text)), info.suits);
}

void DescribedFlags::field(std::string_view name, int& value, const FieldInfo& info) {
  if (info.flag == kNoFlag) return;
  auto* option = verb_.add_option(flag_of(name, info), value, sentence(info.text));
  add(option->check(whole_within(static_cast<std::int64_t>(info.min), static_cast<std::int64_t>(info.max)))
          ->capture_default_str(),
      info.suits);
}

void DescribedFlags::field(std::string_view name, double& value, const FieldInfo& info) {
  if (info.flag == kNoFlag) return;
  auto* option = verb_.add_option(flag_of(name, info), value, sentence(info.text));
  add(option->check(within(info.min, info.max))->capture_default_str(), info.suits);
}

void DescribedFlags::field(std::string_view name, std::string& value, const FieldInfo& info) {
  if (info.flag == kNoFlag) return;
  add(verb_.add_option(flag_of(name, info), value, sentence(info.text))->capture_default_str(), info.suits);
}

}  // namespace sonar
