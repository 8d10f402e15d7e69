// The page of ViewServer: complete in itself, made for a phone as well.
#pragma once

#include <string_view>

namespace omma::ground {

std::string_view view_page();

}  // namespace omma::ground
