// Where a page is served: [ADDRESS:]PORT as an operator writes it, and the socket that listens there.
#pragma once

#include <cstdint>
#include <string>

namespace omma::ground {

struct ViewAddress {
  std::string host = "127.0.0.1";  ///< this machine alone, unless another is named
  std::uint16_t port = 0;          ///< 0: one that is free
};

/// "8080", "0.0.0.0:8080", "[::]:8080".
/// @throws InputError: no port, or no address in numbers
ViewAddress read_view_address(const std::string& text);

/// A socket that listens; `address` then has its port.
/// @throws InputError: the port is in use, not allowed, or the address is none of this machine's
int listen_at(ViewAddress& address);

/// What to type into a browser: this machine's name stands for "any address".
std::string url_of(const ViewAddress& address);

}  // namespace omma::ground
