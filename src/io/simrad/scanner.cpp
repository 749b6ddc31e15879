// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/scanner.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/simrad/fields.h"

namespace sonar::simrad {
namespace {

constexpr std::size_t kWindowBytes = std::size_t{4} << 20;

}  // namespace

void Notes::add(DiagnosticCode code, std::uint64_t offset, std::string text) {
  if (notes_.size() > kLimit) return;
  if (notes_.size() == kLimit) {
    code = DiagnosticCode::notes_limited;
    text = fmt::format("more than {} notes; the rest is left out", kLimit);
  }
  notes_.push_back({code, file_, static_cast<std::int64_t>(offset), -1, std::move(text)});
}

Result<std::span<const std::byte>> Scanner::peek(const ByteSource& source, std::uint64_t offset, std::size_t count) {
  const std::uint64_t available = size_ > offset ? size_ - offset : 0;
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, available));
  if (offset < window_offset_ || offset + count > window_offset_ + window_.size()) {
    // The size was asked for already, so this never allocates more than the source holds.
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(std::max(count, kWindowBytes), available));
    window_.resize(wanted);
    window_offset_ = offset;
    const auto got = source.read(offset, window_);
    if (!got) {
      window_.clear();
      return pass_on(got);
    }
    window_.resize(*got);
    count = std::min(count, *got);
  }
  return std::span<const std::byte>(window_).subspan(static_cast<std::size_t>(offset - window_offset_), count);
}

Result<Scanner::Found> Scanner::trailer_matches(const ByteSource& source, std::uint64_t offset, std::uint32_t length) {
  const std::uint64_t place = offset + 4 + length;
  if (place + 4 > size_) return Found::need_more;
  std::byte word[4];
  if (place >= window_offset_ && place + 4 <= window_offset_ + window_.size()) {
    std::copy_n(window_.begin() + static_cast<std::ptrdiff_t>(place - window_offset_), 4, word);
  } else {
    const auto got = source.read(place, word);
    if (!got) return pass_on(got);
    if (*got < 4) return Found::need_more;
  }
  return number_at<std::uint32_t>(word, 0) == length ? Found::yes : Found::no;
}

Result<void> Scanner::visit_datagram(const ByteSource& source, std::uint32_t length, const Visit& visit, Notes& notes) {
  const std::uint64_t offset = next_;
  const auto bytes = peek(source, offset, std::size_t{length} + 8);
  if (!bytes) return pass_on(bytes);
  if (bytes->size() < std::size_t{length} + 8) {
    return fail(ErrorCode::io, "the file became shorter while it was read",
                {.file = source.name(), .offset = static_cast<std::int64_t>(offset)});
  }
  next_ = offset + length + 8;
  const auto time = time_from_filetime(number_at<std::uint64_t>(*bytes, 8));
  const std::string type = type_text(bytes->subspan<4, 4>());
  if (!time) {
    notes.add(DiagnosticCode::bad_time, offset, fmt::format("the time stamp of this {} is outside 1970 to 2200", type));
    return {};
  }
  visit({offset, length, type, *time, bytes->subspan(kHeadBytes, length - kMinLength)});
  return {};
}

Result<bool> Scanner::resynchronise(const ByteSource& source, bool final) {
  while (next_ < size_) {
    const auto bytes = peek(source, next_, kHeadBytes);
    if (!bytes) return pass_on(bytes);
    const std::size_t nothing = bytes_without_head(
        std::span<const std::byte>(window_).subspan(static_cast<std::size_t>(next_ - window_offset_)));
    next_ += nothing;
    if (nothing > 0) continue;
    Found found = Found::no;
    const Frame frame = inspect_head(*bytes);
    if (frame == Frame::need_more) found = Found::need_more;
    if (frame == Frame::sound) {
      const auto matches = trailer_matches(source, next_, number_at<std::uint32_t>(*bytes, 0));
      if (!matches) return pass_on(matches);
      found = *matches;
    }
    if (found == Found::yes) {
      lost_ = false;
      return true;
    }
    if (found == Found::need_more && !final) return false;
    ++next_;
  }
  return false;
}

/// The last datagram does not fit: either the file was cut, or a length word is damaged and sound ones follow.
Result<bool> Scanner::tail(const ByteSource& source, Notes& notes) {
  const std::uint64_t start = next_;
  if (start >= size_) return false;
  next_ = start + 1;
  auto found = resynchronise(source, true);
  if (!found) return found;
  if (*found) {
    notes.add(DiagnosticCode::bad_length, start,
              fmt::format("the length word runs past the end; reading went on at byte {}", next_));
    return true;
  }
  next_ = start;
  notes.add(DiagnosticCode::file_truncated, start,
            fmt::format("the file ends inside a datagram, {} bytes after its beginning", size_ - start));
  return false;
}

Result<bool> Scanner::step(const ByteSource& source, const Visit& visit, Notes& notes, bool final) {
  if (lost_) return resynchronise(source, final);
  const auto head = peek(source, next_, 4);
  if (!head) return pass_on(head);
  const Frame frame = inspect_length(*head);
  if (frame == Frame::need_more) return final ? tail(source, notes) : Result<bool>(false);
  if (frame == Frame::bad_length) {
    notes.add(
        DiagnosticCode::bad_length, next_,
        fmt::format("length word {}, expected {} to {}", number_at<std::int32_t>(*head, 0), kMinLength, kMaxLength));
    lost_ = true;
    ++next_;
    return true;
  }
  const auto length = number_at<std::uint32_t>(*head, 0);
  const auto matches = trailer_matches(source, next_, length);
  if (!matches) return pass_on(matches);
  if (*matches == Found::need_more) return final ? tail(source, notes) : Result<bool>(false);
  if (*matches == Found::no) {
    notes.add(DiagnosticCode::length_mismatch, next_,
              fmt::format("length word {} is not repeated at byte {}", length, next_ + 4 + length));
    lost_ = true;
    ++next_;
    return true;
  }
  if (auto visited = visit_datagram(source, length, visit, notes); !visited) return pass_on(visited);
  return true;
}

Result<void> Scanner::run(const ByteSource& source, const Visit& visit, Notes& notes, bool final) {
  const auto size = source.size();
  if (!size) return pass_on(size);
  size_ = *size;
  for (;;) {
    const auto more = step(source, visit, notes, final);
    if (!more) return pass_on(more);
    if (!*more) return {};
  }
}

Result<void> Scanner::scan(const ByteSource& source, const Visit& visit, Notes& notes) {
  return run(source, visit, notes, false);
}

Result<void> Scanner::finish(const ByteSource& source, const Visit& visit, Notes& notes) {
  auto done = run(source, visit, notes, true);
  window_ = {};
  return done;
}

}  // namespace sonar::simrad
