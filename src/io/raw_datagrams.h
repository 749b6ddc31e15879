// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "model/ping.h"
#include "model/sounder.h"

namespace sonar {

// Bytes of Simrad datagrams, appended to a buffer with both length words. Layouts: Simrad ER60 manual 850-164692;
// little-endian whatever the machine. Pure functions, so that pings can be encoded on many threads and written in
// order.

using RawBytes = std::vector<std::byte>;

/// Any datagram, its body as it is (copying real ones through).
/// type    four characters, e.g. "NME0"
/// errors  bad_parameter: type is not four characters, or the body is longer than 2^31 - 32 bytes
Result<void> append_datagram(RawBytes& out, TimeNs time, std::string_view type, std::span<const std::byte> body);

/// CON0: 516 bytes of header and 320 a beam. Texts are cut to their field.
void append_con0(RawBytes& out, TimeNs time, const SounderConfig& config);

/// CON1: the XML, NUL-padded to a multiple of 4.
void append_con1(RawBytes& out, TimeNs time, std::string_view xml);

/// NME0: one sentence as given ("$GPGGA,...*hh", see nmea_sentence), NUL-padded to a multiple of 4.
void append_nme0(RawBytes& out, TimeNs time, std::string_view sentence);

/// RAW0 of one channel: 72 bytes of header, then the power counts; `mode` is written as 1 (power only).
/// errors  bad_parameter: channel outside 0..32766, negative offset
Result<void> append_raw0(RawBytes& out, TimeNs time, const ChannelPing& channel);

/// The minimal Configuration/BeamArrays: steering angles and frequencies of every beam, in channel order.
[[nodiscard]] std::string con1_xml(const SounderConfig& config);

/// "$" + body + "*" + checksum (XOR of the body, two hexadecimal digits).
[[nodiscard]] std::string nmea_sentence(std::string_view body);

}  // namespace sonar
