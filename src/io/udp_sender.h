// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"

namespace sonar {

/// Sends texts as datagrams to one address, whoever listens there. Never waits. Move-only.
class UdpSender {
 public:
  /// address  "HOST:PORT", "[::1]:10110"
  /// errors   usage: no such address; io
  static Result<UdpSender> open(const std::string& address);
  UdpSender(UdpSender&& other) noexcept;
  UdpSender& operator=(UdpSender&& other) noexcept;
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;
  ~UdpSender();

  /// That nobody listens, or that the network is down for a while, is no error.
  void send(std::string_view text) const;

 private:
  explicit UdpSender(int socket) : socket_(socket) {}
  int socket_ = -1;
};

}  // namespace sonar
