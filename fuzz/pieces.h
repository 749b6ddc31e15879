// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Mutators that keep a format's framing, so that what is changed is what the frames hold and how they follow each other.

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace sonar::fuzz {

using Pieces = std::vector<std::string>;

/// Lines with their ends.
inline Pieces lines_of(std::string_view text) {
  Pieces lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}
inline std::string line_of(std::string body) { return body.ends_with('\n') ? body : std::move(body) + '\n'; }

/// Bodies of Simrad datagrams, up to the first that is framed wrongly; what is left is the last piece.
inline Pieces datagrams_of(std::string_view bytes) {
  Pieces bodies;
  std::uint32_t length = 0;
  while (bytes.size() >= 8) {
    std::memcpy(&length, bytes.data(), sizeof length);
    if (length > bytes.size() - 8) break;
    bodies.emplace_back(bytes.substr(4, length));
    bytes.remove_prefix(length + 8);
  }
  if (!bytes.empty()) bodies.emplace_back(bytes);
  return bodies;
}
inline std::string datagram_of(const std::string& body) {
  const auto length = static_cast<std::uint32_t>(body.size());
  const std::string word(reinterpret_cast<const char*>(&length), sizeof length);
  return word + body + word;
}

/// One piece changed, taken out, given twice or changed for another; every fourth time any bytes of the whole.
/// frame  a piece's body -> its bytes
template <class Split, class Frame>
std::size_t mutate_pieces(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed, const Split& split,
                          const Frame& frame) {
  std::minstd_rand random(seed);
  const auto below = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  Pieces pieces = split(std::string_view(reinterpret_cast<const char*>(data), size));
  if (pieces.empty() || below(4) == 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::size_t at = below(pieces.size());
  switch (below(8)) {
    case 0:
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(at));
      break;
    case 1:
      pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(below(pieces.size() + 1)), std::string(pieces[at]));
      break;
    case 2:
      std::swap(pieces[at], pieces[below(pieces.size())]);
      break;
    default: {
      std::string& body = pieces[at];
      const std::size_t before = body.size();
      body.resize(std::min(max_size, before + 64));
      body.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(body.data()), before, body.size()));
    }
  }
  std::string joined;
  for (const std::string& piece : pieces) joined += frame(piece);
  const std::size_t whole = std::min(joined.size(), max_size);
  std::copy_n(joined.begin(), whole, data);
  return whole;
}

}  // namespace sonar::fuzz
