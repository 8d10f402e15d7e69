// The sentence with which a call refuses its input.
#pragma once

#include <string>
#include <utility>

#include "fsw/kernel/input_error.hpp"

namespace omma {

/// The message of the `Error` that `call` throws; "no error" where it throws none.
template <class Error = InputError, class Call>
std::string refusal_of(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace omma
