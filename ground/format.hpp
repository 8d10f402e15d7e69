// Numbers into text, printf's way, for everything the ground tells: tables, reports, pages.
#pragma once

#include <string>

namespace omma::ground {

/// printf into a string; cut off after 1023 characters.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

}  // namespace omma::ground
