#include "ground/capture/view_address.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "fsw/kernel/input_error.hpp"

namespace omma::ground {
namespace {

[[noreturn]] void refuse(const std::string& expected, const std::string& found) {
  throw InputError("omma capture", 0, "--serve", expected, found);
}

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

Addresses addresses_of(const ViewAddress& address) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICHOST | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(address.port);
  if (::getaddrinfo(address.host.c_str(), port.c_str(), &hints, &found) != 0) found = nullptr;
  return {found, [](addrinfo* list) {
            if (list != nullptr) ::freeaddrinfo(list);
          }};
}

std::uint16_t port_of(int socket) {
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&bound), &size);
  return ntohs(bound.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(bound).sin6_port
                                           : reinterpret_cast<const sockaddr_in&>(bound).sin_port);
}

}  // namespace

ViewAddress read_view_address(const std::string& text) {
  ViewAddress address;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) address.host = text.substr(0, colon);
  if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']')
    address.host = address.host.substr(1, address.host.size() - 2);
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (port.empty() || error != std::errc{} || end != port.data() + port.size())
    refuse("a port from 0 to 65535, or ADDRESS:PORT", text);
  if (!addresses_of(address)) refuse("an address of this machine in numbers, as 0.0.0.0:8080", text);
  return address;
}

int listen_at(ViewAddress& address) {
  const std::string wanted = address.host + ":" + std::to_string(address.port);
  const Addresses addresses = addresses_of(address);
  if (!addresses) refuse("an address of this machine in numbers, as 0.0.0.0:8080", wanted);
  const int file = ::socket(addresses->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  if (file < 0 || ::setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(file, addresses->ai_addr, addresses->ai_addrlen) != 0 || ::listen(file, 16) != 0) {
    const std::string why = std::strerror(errno);
    if (file >= 0) ::close(file);
    refuse("a port that can be listened at", wanted + ": " + why);
  }
  address.port = port_of(file);
  return file;
}

std::string url_of(const ViewAddress& address) {
  std::string host = address.host;
  if (host == "0.0.0.0" || host == "::") {
    std::array<char, 256> name{};
    host = ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "localhost";
  }
  if (host.find(':') != std::string::npos) host = "[" + host + "]";
  return "http://" + host + ":" + std::to_string(address.port) + "/";
}

}  // namespace omma::ground
