// SPDX-License-Identifier: Apache-2.0
#include "io/wire.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sonar::wire {
namespace {

/// So many bytes follow; of a text where it failed.
struct Head {
  std::int32_t failed = 0;
  std::int32_t code = 0;
  std::uint64_t size = 0;
};

constexpr std::uint64_t kLongestText = 4096;

constexpr std::size_t kRoomAtOnce = std::size_t{64} << 20U;

tl::unexpected<Error> broken() { return fail(ErrorCode::format, "is damaged: reading it breaks the library for it"); }

ErrorCode code_of(std::int32_t told) {
  for (const ErrorCode code : {ErrorCode::mismatch, ErrorCode::newer_version, ErrorCode::older_version}) {
    if (told == static_cast<std::int32_t>(code)) return code;
  }
  return ErrorCode::format;
}

/// silence  set where the child is there and says nothing
Result<Bytes> heard(const ChildProcess& child, std::uint64_t most, unsigned seconds, bool& silence) {
  const auto all = [&](std::span<std::byte> bytes) {
    const auto heard = child.hear(bytes, seconds);
    silence = heard == ChildProcess::Heard::silence;
    return heard == ChildProcess::Heard::all;
  };
  Head head;
  if (!all(bytes_of(head)) || head.size > (head.failed == 0 ? most : kLongestText)) return broken();
  // Room is made as it is needed, not as it is promised.
  Bytes said;
  while (said.size() < head.size) {
    const std::size_t before = said.size();
    said.resize(before + static_cast<std::size_t>(std::min<std::uint64_t>(kRoomAtOnce, head.size - before)));
    if (!all(std::span(said).subspan(before))) return broken();
  }
  if (head.failed == 0) return said;
  return fail(code_of(head.code), *decoded<std::string>(said));
}

}  // namespace

Bytes encoded(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

Bytes encoded(const std::vector<std::string>& texts) {
  Bytes out;
  for (const std::string& text : texts) {
    put(out, std::uint64_t{text.size()});
    const auto bytes = std::as_bytes(std::span(text));
    out.insert(out.end(), bytes.begin(), bytes.end());
  }
  return out;
}

std::optional<std::string> decoded(std::span<const std::byte> bytes, const std::string* /*kind*/) {
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

std::optional<std::vector<std::string>> decoded(std::span<const std::byte> bytes,
                                                const std::vector<std::string>* /*kind*/) {
  std::vector<std::string> texts;
  while (!bytes.empty()) {
    std::uint64_t size = 0;
    if (bytes.size() < sizeof(size)) return std::nullopt;
    std::memcpy(&size, bytes.data(), sizeof(size));
    bytes = bytes.subspan(sizeof(size));
    if (size > bytes.size()) return std::nullopt;
    texts.emplace_back(reinterpret_cast<const char*>(bytes.data()), size);
    bytes = bytes.subspan(size);
  }
  return texts;
}

bool tell(int stream, const Result<void>& status, const Bytes& said) {
  const std::string text = status ? std::string{} : status.error().text.substr(0, kLongestText);
  Bytes all = encoded(Head{status ? 0 : 1, status ? 0 : static_cast<std::int32_t>(status.error().code),
                           status ? said.size() : text.size()});
  const Bytes body = status ? Bytes{} : encoded(text);
  return say_all(stream, all) && say_all(stream, status ? said : body);
}

bool greet(int stream) { return tell(stream, {}, {}); }

Result<Bytes> hear(const ChildProcess& child, std::uint64_t most, unsigned seconds) {
  bool silence = false;
  auto said = heard(child, most, seconds, silence);
  if (silence) return fail(ErrorCode::io, fmt::format("reading it took more than {} s and was given up", seconds));
  return said;
}

Result<Begun> begin(const std::function<Result<ChildProcess>()>& make, std::uint64_t most, unsigned seconds) {
  const unsigned little = std::max(1U, seconds / 12);
  for (const unsigned wait : {little, little, seconds}) {
    auto child = make();
    if (!child) return pass_on(child);
    bool silence = false;
    const auto greeted = heard(*child, 0, wait, silence);
    if (silence) continue;
    if (!greeted) return pass_on(greeted);
    auto said = hear(*child, most, seconds);
    if (!said) return pass_on(said);
    return Begun{std::move(*child), std::move(*said)};
  }
  return fail(ErrorCode::io, "no process could be made that reads it");
}

}  // namespace sonar::wire
