// SPDX-License-Identifier: Apache-2.0
#include "io/udp_sender.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <memory>
#include <system_error>
#include <utility>

namespace sonar {
namespace {

struct HostAndPort {
  std::string host;
  std::string port;
};

HostAndPort split(const std::string& address) {
  const auto colon = address.rfind(':');
  if (colon == std::string::npos) return {};
  std::string host = address.substr(0, colon);
  if (host.size() > 1 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return {std::move(host), address.substr(colon + 1)};
}

}  // namespace

Result<UdpSender> UdpSender::open(const std::string& address) {
  const auto [host, port] = split(address);
  if (host.empty() || port.empty()) {
    return fail(ErrorCode::usage, fmt::format("'{}': expected HOST:PORT, as in 127.0.0.1:10110", address));
  }
  int number = 0;
  const auto [end, error_code] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error_code != std::errc{} || end != port.data() + port.size() || number < 1 || number > 65535) {
    return fail(ErrorCode::usage, fmt::format("'{}': expected a port from 1 to 65535", address));
  }
  addrinfo wanted{};
  wanted.ai_family = host.find(':') == std::string::npos ? AF_INET : AF_INET6;  // charts listen to the older one
  wanted.ai_socktype = SOCK_DGRAM;
  wanted.ai_flags = AI_NUMERICSERV;
  addrinfo* list = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), port.c_str(), &wanted, &list); error != 0) {
    return fail(ErrorCode::usage, fmt::format("'{}': {}", address, ::gai_strerror(error)));
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> found(list, &::freeaddrinfo);
  UdpSender sender(::socket(found->ai_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int on = 1;
  // A chart plotter may listen to a whole network.
  const bool ready = sender.socket_ >= 0 &&
                     ::setsockopt(sender.socket_, SOL_SOCKET, SO_BROADCAST, &on, sizeof(on)) == 0 &&
                     ::connect(sender.socket_, found->ai_addr, found->ai_addrlen) == 0;
  if (!ready) return fail(ErrorCode::io, std::system_category().message(errno), {.file = address});
  return sender;
}

UdpSender::UdpSender(UdpSender&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

UdpSender& UdpSender::operator=(UdpSender&& other) noexcept {
  std::swap(socket_, other.socket_);
  return *this;
}

UdpSender::~UdpSender() {
  if (socket_ >= 0) ::close(socket_);
}

void UdpSender::send(std::string_view text) const { (void)::send(socket_, text.data(), text.size(), MSG_NOSIGNAL); }

}  // namespace sonar
