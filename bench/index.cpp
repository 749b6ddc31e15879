// SPDX-License-Identifier: Apache-2.0
// How quickly a raw file is gone through where it is damaged: nothing but noise, zeros, text, or headless types, for so many
// MB, and one sound datagram behind it, which must be found. Beside it: what reading the bytes alone takes.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/ping_source.h"
#include "io/raw_datagrams.h"

namespace sonar {
namespace {

constexpr std::size_t kMegabytes = 256;
constexpr int kRounds = 5;

double seconds_of(const std::function<void()>& body) {
  const auto begin = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

RawBytes filled(const std::function<std::uint8_t(std::size_t)>& byte) {
  RawBytes bytes;
  append_nme0(bytes, 1'258'099'909'000'000'000, "$GPHDT,1,T");
  bytes.resize(kMegabytes << 20U);
  for (std::size_t i = 40; i < bytes.size(); ++i) bytes[i] = std::byte{byte(i)};
  append_nme0(bytes, 1'258'099'910'000'000'000, "$GPHDT,2,T");
  return bytes;
}

/// GB/s, the median.
void measure(const char* name, const RawBytes& bytes) {
  const MemorySource source(name, bytes);
  std::vector<double> index_s;
  std::vector<double> read_s;
  for (int round = 0; round < kRounds; ++round) {
    index_s.push_back(seconds_of([&] {
      const auto index = index_raw(source);
      const bool right = index && index->datagrams.at("NME0") == 2;
      if (!right) fmt::print("{}: the datagram behind the damage was not found\n", name);
    }));
    std::vector<std::byte> block(4U << 20U);
    read_s.push_back(seconds_of([&] {
      for (std::uint64_t at = 0; at < bytes.size(); at += block.size()) (void)source.read(at, block);
    }));
  }
  std::ranges::sort(index_s);
  std::ranges::sort(read_s);
  const double gigabytes = static_cast<double>(bytes.size()) / 1e9;
  fmt::print("{:<8} {:5.2f} GB/s, hash included; read alone {:5.2f}\n", name, gigabytes / index_s[kRounds / 2],
             gigabytes / read_s[kRounds / 2]);
}

}  // namespace
}  // namespace sonar

int main() {
  std::uint64_t state = 1;
  const auto noise = [&](std::size_t) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::uint8_t>(state >> 56U);
  };
  sonar::measure("noise", sonar::filled(noise));
  sonar::measure("zeros", sonar::filled([](std::size_t) { return std::uint8_t{0}; }));
  const std::string text = "$GPGGA,123519.00,4807.0380,N,01131.0000,E,1,08,0.9,545.4,M*47\r\n";
  sonar::measure("text",
                 sonar::filled([&](std::size_t i) { return static_cast<std::uint8_t>(text[i % text.size()]); }));
  const std::string types = "RAW0";
  sonar::measure("types",
                 sonar::filled([&](std::size_t i) { return static_cast<std::uint8_t>(types[i % types.size()]); }));
  return 0;
}
